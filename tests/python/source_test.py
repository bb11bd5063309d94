"""Stubs fit the module, types are checked, generated files are fresh, and the examples of docstrings and of the page run."""

import doctest
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import kinemend
from conftest import ROOT, TAKES

BUILT = pathlib.Path(kinemend.__file__).parent.parent


def run(*words, **more):
    ran = subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True, **more)
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.fixture(scope="module")
def types_path(tmp_path_factory):
    pytest.importorskip("mypy")
    return {**os.environ, "MYPYPATH": str(BUILT), "MYPY_CACHE_DIR": str(tmp_path_factory.mktemp("mypy"))}


def test_types_of_package_and_examples_are_right(types_path):
    examples = sorted((ROOT / "python" / "examples").glob("*.py"))
    assert len(examples) == 5
    run("-m", "mypy", "--strict", *examples, env=types_path, cwd=BUILT)


def test_a_wrong_use_is_found(types_path, tmp_path):
    (tmp_path / "wrong.py").write_text("import kinemend\nkinemend.cleaners.butterworth(cutoff=6)\nkinemend.read(5)\n"
                                       "kinemend.check(kinemend.read('a')).figures.no_such\n")
    ran = subprocess.run([sys.executable, "-m", "mypy", "--strict", tmp_path / "wrong.py"], env=types_path, cwd=BUILT,
                         capture_output=True, text=True)
    assert [line.split(":")[1] for line in ran.stdout.splitlines() if ": error:" in line] == ["2", "3", "4"], ran.stdout


def test_stubs_fit_the_module(types_path):
    run("-m", "mypy.stubtest", "kinemend._core", "--allowlist", ROOT / "tests/python/stubs.allow",
        "--ignore-unused-allowlist", env=types_path, cwd=BUILT)


def test_generated_files_are_fresh():
    run(ROOT / "tools" / "make_python_tables", BUILT, "--check")


def test_everything_public_has_a_docstring():
    for name in kinemend.__all__:
        if name not in {"cleaners", "__version__"}:
            assert getattr(kinemend, name).__doc__, name
    for method in kinemend.methods():
        assert method.name in kinemend.clean.__doc__


@pytest.fixture
def in_folder_with_takes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(TAKES / "noisy_walk.bvh", "walk.bvh")
    shutil.copy(TAKES / "walk.bvh", "truth.bvh")


def test_examples_in_docstrings_run(in_folder_with_takes):
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    for module in (kinemend, kinemend._commands, kinemend._files, kinemend._live, kinemend._tables, kinemend.arrays, kinemend.cleaners):
        for test in finder.find(module, extraglobs={"kinemend": kinemend}):
            pathlib.Path("walk.clean.bvh").unlink(missing_ok=True)
            runner.run(test)
    assert runner.failures == 0 and runner.tries > 20


def test_the_code_of_the_page_runs(in_folder_with_takes):
    page = (ROOT / "docs" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) >= 5
    names = {}
    for block in blocks:
        exec(block, names)
