"""The other functions give what the commands of the program give."""

import json

import numpy as np
import pytest

import kinemend
from conftest import FIXTURES, TAKES


def plain(entry):
    return {key: value for key, value in entry.items() if key not in {"input", "output", "reference"}}


def as_json(report):
    """A report as the JSON that it was made of: what a command does not give is left out."""
    def strip(value):
        if isinstance(value, list):
            return [strip(one) for one in value]
        if hasattr(value, "__dataclass_fields__"):
            return {name: strip(getattr(value, name)) for name in value.__dataclass_fields__}
        return value

    return strip(report)


def is_part_of(entry, report):
    """Whether every key of the JSON has its value in the report, and all others are None."""
    for key, value in report.items():
        if key in {"input", "output", "reference"}:
            continue
        if isinstance(value, dict) and isinstance(entry.get(key), dict):
            assert is_part_of(entry[key], value), key
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            assert len(value) == len(entry[key]), key
            assert all(is_part_of(one, other) for one, other in zip(entry[key], value)), key
        else:
            assert value == entry.get(key), key
    return True


def test_check_finds_what_the_program_finds(all_formats, program):
    for name in ("walk.bvh", "gaps.trc"):
        entry = program.take_of_json("check", all_formats / name, "--json")
        assert is_part_of(entry, as_json(kinemend.check(kinemend.read(all_formats / name))))


LIMITS = """
speed_deg_s = 400
[joints."*Leg"]
speed_deg_s = 100
[joints.LeftLeg]
acceleration_deg_s2 = 900
"""


def test_check_finds_what_a_robot_cannot_follow(all_formats, program):
    take = kinemend.read(all_formats / "walk.bvh")
    theirs = program.take_of_json("check", all_formats / "walk.bvh", "--robot", "--json")
    ours = kinemend.check(take, robot=True)
    assert ours.robot is not None and is_part_of(theirs, as_json(ours))
    assert kinemend.check(take).robot is None
    (program.folder / "limits.toml").write_text(LIMITS)
    theirs = program.take_of_json("check", all_formats / "walk.bvh", "--limits", "limits.toml", "--json")
    limits = kinemend.RobotLimits(
        speed_deg_s=400, joints={"*Leg": {"speed_deg_s": 100}, "LeftLeg": {"acceleration_deg_s2": 900}})
    ours = kinemend.check(take, robot=limits)
    assert any(finding.kind == "joint_speed" for finding in ours.findings)
    assert is_part_of(theirs, as_json(ours))


def test_check_takes_every_limit_of_a_robot(all_formats):
    take = kinemend.read(all_formats / "walk.bvh")
    strict = kinemend.check(take, robot=kinemend.RobotLimits(
        acceleration_deg_s2=1, step_s=0.05, penetration_cm=0, floating_cm=0, jump_deg=0.01, jump_cm=0.01, floor_cm=0))
    assert len(strict.findings) > len(kinemend.check(take, robot=True).findings)
    for refused in ({"step_s": 0}, {"jump_cm": 0}, {"joints": {"*": {"speeds": 1}}}):
        with pytest.raises(kinemend.Error):
            kinemend.check(take, robot=kinemend.RobotLimits(**refused))


def test_fill_fills_what_the_program_fills(all_formats, program):
    program.run("fill", all_formats / "gaps.trc", "-o", "theirs.trc", "--report", "r.json")
    entry = json.loads((program.folder / "r.json").read_text())["takes"][0]
    take, report = kinemend.fill(kinemend.read(all_formats / "gaps.trc"))
    assert kinemend.to_bytes(take) == (program.folder / "theirs.trc").read_bytes()
    assert is_part_of(entry, as_json(report))


def test_fill_bridges_what_is_marked_as_missing(noisy):
    joint = noisy.names.index("LeftArm")
    noisy.observed[50:60, joint] = False
    noisy.rotations[50:60, joint] = [1, 0, 0, 0]
    take, report = kinemend.fill(noisy, "spline")
    assert take.observed.all() and report.figures.filled == 1 and report.figures.refused == 0
    assert not np.allclose(take.rotations[50:60, joint], [1, 0, 0, 0], atol=1e-3)
    assert not noisy.observed.all()


def test_compare_gives_the_figures_of_the_program(all_formats, program):
    pairs = [(TAKES / "walk.bvh", TAKES / "noisy_walk.bvh"), (all_formats / "markers.trc", all_formats / "markers.trc")]
    for reference, other in pairs:
        entry = program.take_of_json("compare", reference, other, "--json")
        assert is_part_of(entry, as_json(kinemend.compare(kinemend.read(reference), kinemend.read(other))))


def test_compare_refuses_takes_that_do_not_fit(noisy, all_formats):
    with pytest.raises(kinemend.Error):
        kinemend.compare(noisy, noisy[:10])
    with pytest.raises(kinemend.Error, match="markers"):
        kinemend.compare(noisy, kinemend.read(all_formats / "gaps.trc"))
    with pytest.raises(kinemend.Error, match="up"):
        kinemend.compare(noisy, noisy, up="w")


def test_contacts_are_those_of_the_program(all_formats, program):
    entry = program.take_of_json("contacts", all_formats / "walk.bvh", "--json")
    assert is_part_of(entry, as_json(kinemend.contacts(kinemend.read(all_formats / "walk.bvh"))))
    with pytest.raises(kinemend.Error, match="joints"):
        kinemend.contacts(kinemend.read(all_formats / "gaps.trc"))


def test_masks_of_contacts_have_the_frames_of_the_contacts(noisy):
    names, masks = kinemend.contact_masks(noisy)
    found = kinemend.contacts(noisy).feet.contacts
    assert masks.shape == (len(noisy), len(names)) and masks.any()
    assert masks.sum() == sum(contact.last_frame - contact.first_frame + 1 for contact in found)


def test_damage_is_that_of_the_program(all_formats, program):
    program.run("corrupt", all_formats / "walk.bvh", "-o", "theirs.bvh", "--damage", "gaussian:std_deg=2", "--damage", "outliers",
                "--seed", "5")
    take, reports = kinemend.corrupt(kinemend.read(all_formats / "walk.bvh"), [("gaussian", {"std_deg": 2}), ("outliers", {})], seed=5)
    assert kinemend.to_bytes(take) == (program.folder / "theirs.bvh").read_bytes()
    assert [report.damage for report in reports] == ["gaussian", "outliers"]


def test_a_model_has_the_bytes_of_the_program(all_formats, program):
    program.run("train", "example", all_formats / "walk.bvh", "-o", "theirs.kmodel", "--title", "T", "--command", "C", "--quiet")
    told = []
    model = kinemend.train("example", [kinemend.read(all_formats / "walk.bvh")], title="T", command="C",
                           progress=lambda stage, done: told.append(done))
    assert model.to_bytes() == (program.folder / "theirs.kmodel").read_bytes()
    assert model.to_bytes() == kinemend.train("example", [all_formats / "walk.bvh"], title="T", command="C").to_bytes()
    assert told and model.takes == 1 and model.kind == "joints" and "LeftArm" in model.names
    model.write(program.folder / "ours.kmodel")
    assert kinemend.Model.read(program.folder / "ours.kmodel").method == "example"
    cleaner = kinemend.cleaners.example(model=program.folder / "ours.kmodel")
    assert kinemend.clean(kinemend.read(all_formats / "walk.bvh"), cleaner).report.method == "example"
    with pytest.raises(kinemend.Error) as raised:
        model.write(program.folder / "ours.kmodel")
    assert raised.value.kind == "cannot_write" and raised.value.file == str(program.folder / "ours.kmodel")


def test_a_training_ends_when_progress_raises(noisy):
    def refuse(stage, done):
        raise LookupError

    with pytest.raises(LookupError):
        kinemend.train("wiener", [noisy], progress=refuse)


def test_training_refuses_what_makes_no_sense(noisy):
    for takes, words in (([], {}), ([noisy], {"no_such": 1}), (["nowhere.bvh"], {})):
        with pytest.raises(kinemend.Error):
            kinemend.train("example", takes, **words)
    with pytest.raises(TypeError):
        kinemend.train("example", [5])


def test_errors_name_the_file_and_the_place(tmp_path):
    cut = (TAKES / "walk.bvh").read_text().splitlines()
    cut[200] = cut[200].rsplit(" ", 1)[0]
    path = tmp_path / "a walk: 7: b.bvh"
    path.write_text("\n".join(cut) + "\n")
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(path)
    error = raised.value
    assert (error.kind, error.file, error.line, error.byte) == ("unreadable_input", str(path), 201, None)
    assert str(error).startswith(f"{path}:201: ")
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(tmp_path / "nowhere.bvh")
    assert raised.value.kind == "unreadable_input" and raised.value.file == str(tmp_path / "nowhere.bvh")
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(b"\x02\x50" + bytes(600), name="a.c3d")
    assert raised.value.kind == "unreadable_input" and raised.value.file == "a.c3d"


def test_a_file_that_exists_is_kept(noisy, tmp_path):
    (tmp_path / "a.bvh").write_text("mine")
    with pytest.raises(kinemend.Error) as raised:
        kinemend.write(noisy, tmp_path / "a.bvh")
    assert raised.value.kind == "cannot_write" and (tmp_path / "a.bvh").read_text() == "mine"
    kinemend.write(noisy, tmp_path / "a.bvh", overwrite=True)
    assert len(kinemend.read(tmp_path / "a.bvh")) == len(noisy)


def test_repairs_are_listed_and_refused_on_request():
    path = FIXTURES / "bvh/good/frames_too_many.bvh"
    assert [entry.name for entry in kinemend.diagnostics(kinemend.read(path))] == ["frame_count_mismatch"]
    with pytest.raises(kinemend.Error) as raised:
        kinemend.read(path, strict=True)
    assert raised.value.kind == "quality_limit" and raised.value.file == str(path)
