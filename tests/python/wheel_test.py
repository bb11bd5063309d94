"""A wheel is made without a network, installed into a fresh environment, and runs the examples there."""

import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest

import kinemend
from conftest import ROOT, TAKES

BUILD = pathlib.Path(kinemend.__file__).parent.parent.parent
EXAMPLES = ROOT / "python" / "examples"


def run(*words, **more):
    ran = subprocess.run(list(map(str, words)), capture_output=True, text=True, **more)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """The Python of a fresh environment that has the wheel and, of the system, NumPy."""
    for module in ("pip", "venv", "ensurepip"):
        pytest.importorskip(module)
    folder = tmp_path_factory.mktemp("wheel")
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment |= {"KINEMEND_IS_BUILT": "1", "PYTHON": sys.executable}
    wheel = run(ROOT / "tools" / "make_wheel", BUILD, folder, env=environment).strip()
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", folder / "venv", env=environment)
    inside = folder / "venv" / "bin" / "python"
    run(sys.executable, "-m", "pip", "--python", inside, "install", "--quiet", "--no-index", "--no-deps", wheel, env=environment)
    return inside


@pytest.mark.skipif(not shutil.which("readelf"), reason="needs readelf")
def test_the_wheel_carries_its_libraries(tmp_path):
    environment = {**os.environ, "KINEMEND_IS_BUILT": "1", "PYTHON": sys.executable}
    wheel = run(ROOT / "tools" / "make_wheel", BUILD, tmp_path, env=environment).strip()
    assert "manylinux_2_" in wheel
    with zipfile.ZipFile(wheel) as archive:
        module = archive.extract(next(name for name in archive.namelist() if name.endswith(".so")), tmp_path)
        licences = archive.read(next(name for name in archive.namelist() if name.endswith("LICENCES.txt"))).decode()
    needed = run("readelf", "--dynamic", "--wide", module)
    assert "libc.so.6" in needed
    assert not any(name in needed for name in ("libtbb", "libfmt", "libhwy", "libstdc++"))
    assert "pybind11 (BSD-3-Clause)" in licences and "GCC-exception" in licences
    again = tmp_path / "again"
    again.mkdir()
    second = run(ROOT / "tools" / "make_wheel", BUILD, again, env=environment).strip()
    assert pathlib.Path(wheel).read_bytes() == pathlib.Path(second).read_bytes()


def example(python, folder, name, *words):
    return run(python, "-I", EXAMPLES / name, *words, cwd=folder)


def test_the_package_is_that_of_the_wheel(python, tmp_path):
    found = run(python, "-I", "-c", "import kinemend; print(kinemend.__file__, kinemend.__version__)", cwd=tmp_path)
    assert "site-packages" in found and found.split()[-1] == kinemend.__version__
    listed = run(python, "-I", "-c", "import importlib.metadata as m; print(m.version('kinemend'))", cwd=tmp_path)
    assert listed.strip() == kinemend.__version__


def test_a_take_from_arrays(python, tmp_path):
    assert "first frame of the elbow" in example(python, tmp_path, "take_from_arrays.py", "arm.bvh")
    assert kinemend.read(tmp_path / "arm.bvh").names == ["Shoulder", "Elbow"]


def test_a_tree_in_parallel(python, tmp_path):
    (tmp_path / "in" / "deep").mkdir(parents=True)
    short = kinemend.read(TAKES / "noisy_walk.bvh")[:120]
    for name in ("a.bvh", "deep/b.bvh", "deep/c.bvh"):
        kinemend.write(short, tmp_path / "in" / name)
    (tmp_path / "in" / "bad.bvh").write_text("no take")
    lines = example(python, tmp_path, "tree_in_parallel.py", "in", "out").splitlines()
    assert len(lines) == 4 and sum("failed" in line for line in lines) == 1
    assert sorted(path.name for path in (tmp_path / "out").rglob("*.bvh")) == ["a.bvh", "b.bvh", "c.bvh"]


def test_errors_of_a_pair(python, tmp_path):
    assert "rms of joint angles" in example(python, tmp_path, "errors_of_a_pair.py", TAKES / "walk.bvh", TAKES / "noisy_walk.bvh")


def test_training_on_own_clips(python, tmp_path):
    out = example(python, tmp_path, "train_on_own_clips.py", TAKES / "noisy_walk.bvh", TAKES / "walk.bvh", "mine.kmodel")
    assert "joints from 1 takes" in out and (tmp_path / "mine.kmodel").exists()


def test_live_frames(python, tmp_path):
    assert "jitter" in example(python, tmp_path, "live_frames.py", TAKES / "noisy_walk.bvh")
