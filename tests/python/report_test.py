"""The dataclasses of reports have the keys and types of docs/report.schema.json."""

import dataclasses
import json
import types
import typing

import pytest

import kinemend
from conftest import ROOT
from kinemend import reports

SCHEMA = json.loads((ROOT / "docs" / "report.schema.json").read_text())["$defs"]
CLASSES = {"take": reports.Report, "figures": reports.Figures, "finding": reports.Finding, "track": reports.Track,
           "diagnostic": reports.Diagnostic, "noise": reports.Noise, "fall_back": reports.FallBack, "leftover": reports.Leftover,
           "subject": reports.Subject, "feet": reports.Feet, "standing_time": reports.StandingTime, "feet_figures": reports.FeetFigures, "contact": reports.Contact, "standing": reports.Standing,
           "robot": reports.Robot, "stand": reports.Stand, "ground_time": reports.GroundTime, "plate_load": reports.PlateLoad,
           "stands": reports.Stands}
PLAIN = {"string": str, "integer": int, "number": float, "boolean": bool, "null": type(None), "array": list, "object": dict}


def parts_of(kind):
    """The plain types that a hint allows."""
    if typing.get_origin(kind) in (typing.Union, types.UnionType):
        return set().union(*map(parts_of, typing.get_args(kind)))
    if typing.get_origin(kind) is typing.Literal:
        return {type(value) for value in typing.get_args(kind)}
    return {typing.get_origin(kind) or kind}


@pytest.mark.parametrize("name", CLASSES)
def test_a_class_has_the_keys_and_types_of_the_schema(name):
    hints, properties = typing.get_type_hints(CLASSES[name]), SCHEMA[name]["properties"]
    assert set(hints) == set(properties)
    for key, part in properties.items():
        allowed = parts_of(hints[key])
        if key not in SCHEMA[name]["required"]:
            assert type(None) in allowed, key
            allowed -= {type(None)}
        if "enum" in part:
            assert allowed == {str}, key
        elif "$ref" in part:
            assert CLASSES[part["$ref"].split("/")[-1]] in allowed, key
        else:
            wanted = part["type"] if isinstance(part["type"], list) else [part["type"]]
            assert allowed - {type(None)} == {PLAIN[kind] for kind in wanted} - {type(None)}, key


def test_a_report_is_the_json_it_was_made_of(noisy):
    result = kinemend.clean(noisy, "auto", feet="auto", fill="auto")
    data = json.loads(result.to_json())
    report = result.report
    assert report is result.report
    assert report.figures.spikes == data["figures"]["spikes"]
    assert [finding.kind for finding in report.findings] == [finding["kind"] for finding in data["findings"]]
    assert report.feet.before.slide == data["feet"]["before"]["slide"]
    assert dataclasses.is_dataclass(report.tracks[0]) and report.tracks[0].name == noisy.names[0]
    assert report.first_frame == noisy.first_frame


def test_a_key_that_the_schema_does_not_have_is_refused():
    with pytest.raises(TypeError):
        reports.Leftover.from_dict({"what": "a", "mend": "b", "why": "c"})
