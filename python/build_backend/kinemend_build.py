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
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SUMMARY = "Cleans human motion capture: jitter, spikes, gaps and sliding feet"


def _version():
    return re.search(r"project\(kinemend VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


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
    files = {f"kinemend/{path.name}": path.read_bytes() for path in sorted(_built().iterdir())
             if path.suffix in {".py", ".pyi", ".typed", ".so", ".pyd"} or path.name == "py.typed"}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: kinemend\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(f"{name},{_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    name = f"kinemend-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)
    return name
