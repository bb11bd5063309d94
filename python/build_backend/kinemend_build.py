"""Builds the wheel of the package with CMake, for pip and other front ends (PEP 517); it needs no other Python package.

The environment variable KINEMEND_BUILD names a build folder that already has the target kinemend_python.
"""

import base64
import hashlib
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SUMMARY = "Cleans human motion capture: jitter, spikes, gaps and sliding feet"


def _version():
    return re.search(r"project\(kinemend VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


# System libraries that PEP 600 allows a module to need.
ALLOWED = {"libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libz.so.1", "libgcc_s.so.1", "libstdc++.so.6"}


def _platform(modules):
    """manylinux_2_36_x86_64 where every module carries what the system need not have; else linux_x86_64.

    A module that was compiled on glibc 2.36 runs with that version and all later ones.
    """
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    glibc = re.fullmatch(r"glibc (\d+)\.(\d+)", os.confstr("CS_GNU_LIBC_VERSION") or "") if hasattr(os, "confstr") else None
    if not platform.startswith("linux_") or glibc is None or shutil.which("readelf") is None:
        return platform
    for module in modules:
        listed = subprocess.run(["readelf", "--dynamic", "--wide", module], capture_output=True, text=True, check=True).stdout
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", listed))
        if any(name not in ALLOWED and not name.startswith("ld-linux") for name in needed):
            return platform
    return platform.replace("linux", f"manylinux_{glibc[1]}_{glibc[2]}", 1)


def _tag(modules):
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{_platform(modules)}"


def _stripped(module):
    """The bytes of a module without its table of local symbols."""
    if shutil.which("strip") is None or module.suffix != ".so":
        return module.read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder, module.name)
        subprocess.run(["strip", "--strip-unneeded", "-o", copy, module], check=True)
        return copy.read_bytes()


def _licences():
    """Of the project and of the libraries inside the module."""
    script = ROOT / "tools" / "dist" / "licences.py"
    return subprocess.run([sys.executable, script, "wheel"], capture_output=True, check=True).stdout


def _metadata():
    return (f"Metadata-Version: 2.1\nName: kinemend\nVersion: {_version()}\nSummary: {SUMMARY}\n"
            "Requires-Python: >=3.10\nRequires-Dist: numpy>=1.21\nProvides-Extra: pandas\n"
            'Requires-Dist: pandas; extra == "pandas"\n')


def _built():
    """The folder of the built package."""
    if "KINEMEND_BUILD" in os.environ:
        return pathlib.Path(os.environ["KINEMEND_BUILD"]).resolve() / "python" / "kinemend"
    build = ROOT / "build" / "wheel"
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                    "-DKINEMEND_PYTHON=ON", "-DKINEMEND_TESTS=OFF", "-DKINEMEND_BENCH=OFF", "-DKINEMEND_TRAIN=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "kinemend_python"], check=True)
    return build / "python" / "kinemend"


def _digest(content):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def get_requires_for_build_wheel(config_settings=None):
    has_headers = any(pathlib.Path(folder, "cmake", "pybind11").is_dir() for folder in ("/usr/lib", "/usr/share", "/usr/local/share"))
    if "KINEMEND_BUILD" in os.environ or has_headers or importlib.util.find_spec("pybind11"):
        return []
    return ["pybind11>=2.10", "numpy"]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    if shutil.which("cmake") is None and "KINEMEND_BUILD" not in os.environ:
        raise SystemExit("kinemend: CMake is needed to build the package (tools/install_packages packages.txt core python)")
    info = f"kinemend-{_version()}.dist-info"
    paths = [path for path in sorted(_built().iterdir())
             if path.suffix in {".py", ".pyi", ".typed", ".so", ".pyd"} or path.name == "py.typed"]
    modules = [path for path in paths if path.suffix in {".so", ".pyd"}]
    tag = _tag(modules)
    files = {f"kinemend/{path.name}": _stripped(path) if path in modules else path.read_bytes() for path in paths}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: kinemend\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/LICENCES.txt"] = _licences()
    record = "".join(f"{name},{_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    name = f"kinemend-{_version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            member = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))
            member.external_attr = 0o644 << 16
            wheel.writestr(member, content, zipfile.ZIP_DEFLATED)
    return name
