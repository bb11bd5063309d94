"""The snippets of docs/python.md run as they are printed, and run again."""

import re

import pytest

import kinemend
from conftest import ROOT, TAKES

SNIPPETS = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.DOTALL)


def test_all_snippets_of_the_guide_run_twice(tmp_path, monkeypatch, capsys):
    pytest.importorskip("pandas")
    monkeypatch.chdir(tmp_path)
    kinemend.write(kinemend.read(TAKES / "noisy_walk.bvh")[:360], "walk.bvh")
    lines = (tmp_path / "walk.bvh").read_text().splitlines()
    (tmp_path / "broken.bvh").write_text("\n".join([*lines[:-1], lines[-1].rsplit(" ", 1)[0]]) + "\n")
    assert len(SNIPPETS) > 6
    for _ in range(2):
        names = {}
        for snippet in SNIPPETS:
            exec(snippet, names)
    assert "broken.bvh:" in capsys.readouterr().out and (tmp_path / "walk.clean.bvh").exists()
