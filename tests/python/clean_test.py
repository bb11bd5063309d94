"""Cleaning gives the bytes and the report of the program; it can be watched, and ended."""

import inspect
import json
import math
import os
import signal
import threading

import numpy as np
import pytest

import kinemend


def without(entry, *keys):
    """A report without what depends on the run: the output, and times."""
    entry = {key: value for key, value in entry.items() if key not in {"output", *keys}}
    entry["figures"] = {key: value for key, value in entry["figures"].items() if key not in {"seconds", "frames_per_second"}}
    return entry


def test_every_format_has_the_bytes_and_the_report_of_the_program(all_formats, program):
    takes = sorted(path for path in all_formats.iterdir() if path.suffix not in {".asf", ".bin"})
    assert len(takes) >= 10
    program.run("clean", *takes, "--output-dir", "theirs", "--report", "report.json", "--method", "auto")
    entries = {entry["input"]: entry for entry in json.loads((program.folder / "report.json").read_text())["takes"]}
    (program.folder / "ours").mkdir()
    for path in takes:
        result = kinemend.clean(kinemend.read(path), "auto")
        kinemend.write(result.take, program.folder / "ours" / path.name)
        assert without(json.loads(result.to_json())) == without(entries[str(path)]), path.name
    assert any(entry["leftovers"] for entry in entries.values())
    for theirs in (program.folder / "theirs").iterdir():
        assert (program.folder / "ours" / theirs.name).read_bytes() == theirs.read_bytes(), theirs.name


def test_the_default_is_the_default_of_the_program(all_formats, program):
    program.run("clean", all_formats / "walk.bvh", "-o", "theirs.bvh")
    result = kinemend.clean(kinemend.read(all_formats / "walk.bvh"))
    assert kinemend.to_bytes(result.take) == (program.folder / "theirs.bvh").read_bytes()


def test_settings_do_what_the_flags_of_the_program_do(all_formats, program):
    program.run("clean", all_formats / "walk.bvh", "-o", "theirs.bvh", "--method", "butterworth", "--cutoff-hz", "5", "--strength",
                "0.7", "--joints", "Left*", "--exclude", "LeftHand", "--range", "21:100", "--feet", "force", "--no-root-position",
                "--max-change-deg", "20")
    take = kinemend.read(all_formats / "walk.bvh")
    result = kinemend.clean(take, kinemend.cleaners.butterworth(cutoff_hz=5), strength=0.7, joints=["Left*"], exclude=["LeftHand"],
                            range=(20, 99), feet="force", root_position=False, max_change_deg=20)
    assert kinemend.to_bytes(result.take) == (program.folder / "theirs.bvh").read_bytes()


def test_the_settings_have_the_defaults_of_the_table():
    given = {name: one.default for name, one in inspect.signature(kinemend.clean).parameters.items()}
    # Python says None and infinity where a command line needs a word and a number.
    words = {"fill": (None, "off"), "max_change": (math.inf, 0.0)}
    table = kinemend._core.clean_option_table()
    assert len(table) >= 10
    for option in table:
        here, there = words.get(option["name"], (option["default"],) * 2)
        assert (given[option["name"]], option["default"]) == (here, there), option["name"]


def test_gaps_are_filled_as_the_program_fills_them(all_formats, program):
    program.run("clean", all_formats / "gaps.trc", "-o", "theirs.trc", "--method", "auto", "--fill", "auto", "--fix-swaps")
    result = kinemend.clean(kinemend.read(all_formats / "gaps.trc"), "auto", fill="auto", fix_swaps=True)
    assert kinemend.to_bytes(result.take) == (program.folder / "theirs.trc").read_bytes()


def test_contacts_of_a_report_are_held(noisy):
    found = kinemend.contacts(noisy).feet.contacts
    held = kinemend.clean(noisy, "auto", contacts=found[:2]).report.feet.contacts
    assert [(c.side, c.part, c.first_frame, c.last_frame) for c in held] == [
        (c.side, c.part, c.first_frame, c.last_frame) for c in found[:2]]


def test_the_noise_of_another_take_is_used(noisy):
    known = kinemend.check(noisy)
    assert kinemend.clean(noisy, "auto", noise=known).report.method == "auto"
    assert kinemend.clean(noisy, "auto", noise="white").report.method == "auto"
    with pytest.raises(ValueError, match="noise"):
        kinemend.clean(noisy, "auto", noise="pink")


def test_the_source_is_given_or_read_and_the_report_names_it(noisy):
    kept = kinemend.clean(noisy, source="keyframed")
    assert np.array_equal(kept.take.rotations, noisy.rotations)
    assert (kept.report.source, kept.report.source_reason) == ("keyframed", "given")
    assert kinemend.check(noisy).source_reason == "not known"
    assert kinemend.check(noisy, source="video").source == "video"
    with pytest.raises(kinemend.Error, match="did you mean video"):
        kinemend.clean(noisy, source="vidoe")
    frames = [kinemend.LiveFilter(noisy, "learned", source=source, live=True).latency_frames for source in ("keyframed", "video")]
    assert frames[0] == 0 < frames[1]


def test_the_take_is_not_changed_and_threads_do_not_change_the_result(noisy):
    before = noisy.copy()
    one, two = (kinemend.clean(noisy, "auto", threads=threads) for threads in (1, 2))
    assert np.array_equal(before.rotations, noisy.rotations)
    assert np.array_equal(one.take.rotations, two.take.rotations)
    assert not np.array_equal(one.take.rotations, noisy.rotations)


def test_options_are_given_in_three_ways(noisy):
    options = [kinemend.clean(noisy, *arguments, **words).report.options for arguments, words in (
        (("butterworth",), {"cutoff_hz": 6, "order": 2}), (("butterworth",), {"options": {"cutoff_hz": 6.0, "order": 2}}),
        ((kinemend.cleaners.butterworth(cutoff_hz=6, order=2),), {}))]
    assert options[0] == options[1] == options[2] == {"cutoff_hz": 6.0, "order": 2}
    assert kinemend.Cleaner("sparse", lambda_=0.2).options["lambda"] == 0.2
    assert kinemend.cleaners.sparse(lambda_=0.2).options["lambda"] == 0.2
    with pytest.raises(TypeError):
        kinemend.clean(noisy, kinemend.cleaners.auto(), despike=False)


def test_every_method_has_a_function_with_its_defaults():
    for method in kinemend.methods():
        if method.learned and not method.ships_model:
            continue
        name = method.name.replace("-", "_")
        function = getattr(kinemend.cleaners, name, None) or getattr(kinemend.cleaners, name + "_")
        assert function().options == {option.name: option.default for option in method.options}, method.name


@pytest.mark.parametrize("words", [
    {"method": "no-such"}, {"method": "auto", "no_such": 1}, {"method": "butterworth", "cutoff_hz": -1}, {"method": "auto", "strength": 2},
    {"method": "auto", "joints": ["NoSuch"]}, {"method": "auto", "range": (5, 5000)}, {"method": "auto", "fill": "no-such"}])
def test_what_makes_no_sense_is_refused(noisy, words):
    with pytest.raises(kinemend.Error) as raised:
        kinemend.clean(noisy, **words)
    assert raised.value.kind == "usage"


@pytest.mark.parametrize("words", [{"cutoff_hz": None}, {"cutoff_hz": [1]}, {"joints": "Left*"}])
def test_wrong_types_are_refused(noisy, words):
    with pytest.raises(TypeError):
        kinemend.clean(noisy, "butterworth", **words)


def test_progress_is_told_in_order_and_in_this_thread(noisy):
    told = []
    kinemend.clean(noisy, "auto", feet="auto", progress=lambda *news: told.append((*news, threading.current_thread())))
    assert {thread for _, _, thread in told} == {threading.current_thread()}
    stages = list(dict.fromkeys(stage for stage, _, _ in told))
    assert stages == ["cleaning", "feet"]
    for stage in stages:
        shares = [done for name, done, _ in told if name == stage]
        assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1


def test_an_exception_of_progress_ends_the_work(noisy):
    def refuse(stage, done):
        raise LookupError(stage)

    with pytest.raises(LookupError, match="cleaning"):
        kinemend.clean(noisy, "auto", progress=refuse)
    # The refused call leaves nothing that disturbs the next one.
    assert kinemend.clean(noisy, "auto").report.method == "auto"


def test_ctrl_c_ends_work_that_would_take_minutes(noisy):
    # The timer's thread runs only because the GIL is released.
    long = kinemend.Take.of_joints(noisy.names, noisy.parents, noisy.offsets, np.tile(noisy.rotations, (200, 1, 1)), fps=120)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        kinemend.clean(long, "nonlocal", window_s=0, bandwidth_deg=5)
    timer.join()


def test_results_are_unpacked(noisy):
    take, report = kinemend.clean(noisy, "gaussian")
    assert isinstance(take, kinemend.Take) and isinstance(report, kinemend.Report)
    assert "gaussian" in kinemend.clean(noisy, "gaussian").to_text() or report.verdict
