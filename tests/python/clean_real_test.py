"""On real takes, too, cleaning gives the bytes of the program."""

import json
import os
import pathlib

import pytest

import kinemend

DATA = pathlib.Path(os.environ.get("KINEMEND_DATA", ""))
ENDINGS = ("bvh", "amc", "c3d", "trc", "tsv", "csv", "fbx", "glb", "gltf")


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_real_take_has_the_bytes_of_the_program(ending, program):
    if not os.environ.get("KINEMEND_DATA"):
        pytest.skip("KINEMEND_DATA names no folder")
    # Small takes of many sizes. If the program refuses a take, the package refuses it with the same words.
    takes = sorted((path for path in DATA.rglob(f"*.{ending}") if 20_000 < path.stat().st_size < 2_000_000),
                   key=lambda path: (path.stat().st_size, path))[::7][:4]
    for number, path in enumerate(takes):
        output = pathlib.Path(f"{number}.{ending}")
        words = ["clean", path, "-o", program.folder / output, "--method", "auto", "--json"]
        theirs = program.ran(*words)
        try:
            result = kinemend.clean(kinemend.read(path), "auto")
            kinemend.write(result.take, program.folder / f"ours{output}")
        except kinemend.Error as error:
            assert theirs.returncode != 0 and str(error) in theirs.stderr, path
            continue
        assert theirs.returncode == 0, (path, theirs.stderr)
        assert (program.folder / f"ours{output}").read_bytes() == (program.folder / output).read_bytes(), path
        assert result.report.figures.spikes == json.loads(theirs.stdout)["takes"][0]["figures"]["spikes"], path
