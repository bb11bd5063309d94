"""What the tests of the Python package share: takes, and the program whose results it must give."""

import json
import os
import pathlib
import shutil
import subprocess

import pytest

import kinemend

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TAKES = ROOT / "examples" / "takes"
FIXTURES = ROOT / "tests" / "fixtures"


class Program:
    """The command line, in a folder."""

    def __init__(self, folder):
        self.folder = folder

    def ran(self, *words):
        return subprocess.run([os.environ["KINEMEND_PROGRAM"], *map(str, words)], cwd=self.folder, capture_output=True, text=True)

    def run(self, *words, code=0):
        ran = self.ran(*words)
        assert ran.returncode == code, ran.stderr
        return ran.stdout

    def take_of_json(self, *words):
        return json.loads(self.run(*words))["takes"][0]


@pytest.fixture
def program(tmp_path):
    return Program(tmp_path)


@pytest.fixture
def noisy():
    """Two seconds of a noisy walk."""
    return kinemend.read(TAKES / "noisy_walk.bvh")[:240]


@pytest.fixture(scope="session")
def all_formats(tmp_path_factory):
    """A short noisy walk in every format that the program writes."""
    folder = tmp_path_factory.mktemp("formats")
    program = Program(folder)
    kinemend.write(kinemend.read(TAKES / "noisy_walk.bvh")[100:220], folder / "walk.bvh")
    for form in kinemend.formats():
        if form.writes_joints and form.reads and form.name not in {"bvh", "asf"}:
            program.run("convert", "walk.bvh", "-o", f"walk{form.extensions[0]}")
        elif form.writes_markers and form.reads:
            program.run("convert", "walk.bvh", "-o", f"markers{form.extensions[0]}")
    shutil.copy(FIXTURES / "trc/good/gaps.trc", folder)
    shutil.copy(FIXTURES / "bvh/good/some_positions.bvh", folder)
    return folder
