"""The libraries inside each download: their licences, versions and licence texts."""
import json
import pathlib
import re
import subprocess
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMON = pathlib.Path("/usr/share/common-licenses")
GCC_RUNTIME = "GPL-3.0-or-later WITH GCC-exception-3.1"


@dataclass(frozen=True)
class Library:
    """A library: its SPDX licence, where it comes from, and the Debian or npm package that says its version."""

    name: str
    licence: str
    home: str
    debian: str = ""
    npm: str = ""


LIBRARIES = {library.name: library for library in (
    Library("fmt", "MIT", "https://fmt.dev", "libfmt-dev"),
    Library("Highway", "Apache-2.0", "https://github.com/google/highway", "libhwy-dev"),
    Library("Eigen", "MPL-2.0", "https://eigen.tuxfamily.org", "libeigen3-dev"),
    Library("Spectra", "MPL-2.0", "https://spectralib.org", "libspectra-dev"),
    Library("oneTBB", "Apache-2.0", "https://github.com/oneapi-src/oneTBB", "libtbb-dev"),
    Library("zlib", "Zlib", "https://zlib.net", "zlib1g-dev"),
    Library("nlohmann-json", "MIT", "https://json.nlohmann.me", "nlohmann-json3-dev"),
    Library("fast_float", "Apache-2.0 OR MIT", "https://github.com/fastfloat/fast_float", "libfast-float-dev"),
    Library("CLI11", "BSD-3-Clause", "https://github.com/CLIUtils/CLI11", "libcli11-dev"),
    Library("toml++", "MIT", "https://marzer.github.io/tomlplusplus", "libtomlplusplus-dev"),
    Library("xxHash", "BSD-2-Clause", "https://xxhash.com", "libxxhash-dev"),
    Library("pybind11", "BSD-3-Clause", "https://github.com/pybind/pybind11", "pybind11-dev"),
    Library("three.js", "MIT", "https://threejs.org", npm="three"),
    Library("uPlot", "MIT", "https://github.com/leeoniya/uPlot", npm="uplot"),
    Library("libstdc++ and libgcc", GCC_RUNTIME, "https://gcc.gnu.org", "libstdc++-12-dev"),
    Library("libstdc++ and libgcc of MinGW-w64", GCC_RUNTIME, "https://gcc.gnu.org", "g++-mingw-w64-x86-64-posix"),
    Library("MinGW-w64 runtime and winpthreads", "MIT AND BSD-3-Clause AND ZPL-2.1 AND LicenseRef-public-domain",
            "https://www.mingw-w64.org", "mingw-w64-x86-64-dev"),
    Library("Emscripten runtime (musl, libc++, compiler-rt)", "MIT AND (Apache-2.0 WITH LLVM-exception OR NCSA)",
            "https://emscripten.org", "emscripten"),
)}

# Header libraries are compiled into every program; `links` are separate and installed by the package manager.
CORE = ["Eigen", "Spectra", "nlohmann-json", "fast_float", "xxHash"]
COMMANDS = ["CLI11", "toml++"]
PAGE = ["three.js", "uPlot"]
COMPILED = ["fmt", "Highway"]
PARTS = {
    "kinemend": {"holds": CORE + COMMANDS + PAGE, "links": COMPILED + ["oneTBB", "zlib", "libstdc++ and libgcc"]},
    "libkinemend-dev": {"holds": CORE + PAGE, "links": COMPILED + ["oneTBB", "zlib", "libstdc++ and libgcc"]},
    "wheel": {"holds": CORE + PAGE + COMPILED + ["pybind11", "libstdc++ and libgcc"], "links": ["zlib"]},
    "windows": {"holds": CORE + COMMANDS + PAGE + COMPILED + ["zlib", "libstdc++ and libgcc of MinGW-w64",
                                                              "MinGW-w64 runtime and winpthreads"], "links": []},
    "html": {"holds": CORE + COMMANDS + PAGE + COMPILED + ["zlib", "Emscripten runtime (musl, libc++, compiler-rt)"], "links": []},
    "npm": {"holds": CORE + COMMANDS + COMPILED + ["zlib", "Emscripten runtime (musl, libc++, compiler-rt)"], "links": []},
    "blender": {"holds": [], "links": []},
    "source": {"holds": PAGE, "links": []},
}


def project_version():
    return re.search(r"project\(kinemend VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def version_of(library):
    """The version of the package that this machine compiles with; None where it is not installed."""
    if library.npm:
        return json.loads((ROOT / "web" / "package.json").read_text())["dependencies"][library.npm]
    query = subprocess.run(["dpkg-query", "-W", "-f", "${db:Status-Status} ${Version}", library.debian], capture_output=True, text=True)
    status, _, version = query.stdout.partition(" ")
    return version if status == "installed" else None


def licence_text(library):
    """The text that comes with the package; where it is not installed, the name of the licence."""
    if library.npm:
        return (pathlib.Path(__file__).parent / "licences" / f"{library.npm}.txt").read_text()
    path = pathlib.Path("/usr/share/doc") / library.debian / "copyright"
    return path.read_text() if path.exists() else f"{library.licence}, see {library.home}\n"


def licences_of(part):
    """One text for a download: the project's licence, then that of each library inside."""
    held = [LIBRARIES[name] for name in PARTS[part]["holds"]]
    sections = [("Kinemend (Apache-2.0)", (ROOT / "LICENSE").read_text())]
    sections += [(f"{library.name} ({library.licence})", licence_text(library)) for library in held]
    # Debian's licence files refer to these; the text of Apache-2.0 is at the top.
    for name, mark in (("MPL-2.0", "MPL-2.0"), ("GPL-3", "GPL-3.0")):
        if any(mark in library.licence for library in held) and (COMMON / name).exists():
            sections.append((f"Text of {name}", (COMMON / name).read_text()))
    line = "=" * 100
    return "\n".join(f"{line}\n{title}\n{line}\n\n{text.strip()}\n" for title, text in sections)
