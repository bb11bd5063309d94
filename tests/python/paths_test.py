"""Functions accept the path of a file in place of a take, and everything shows what is set."""

import kinemend
from conftest import TAKES


def test_a_path_gives_what_its_take_gives(all_formats):
    for path in (all_formats / "walk.bvh", str(all_formats / "walk.bvh"), all_formats / "gaps.trc"):
        take = kinemend.read(path)
        assert kinemend.to_bytes(kinemend.clean(path, "auto").take) == kinemend.to_bytes(kinemend.clean(take, "auto").take)
        assert kinemend.to_bytes(kinemend.fill(path).take) == kinemend.to_bytes(kinemend.fill(take).take)
        assert kinemend.check(path) == kinemend.check(take)
        assert kinemend.compare(path, take) == kinemend.compare(take, path)
    path = all_formats / "walk.bvh"
    assert kinemend.contacts(path) == kinemend.contacts(kinemend.read(path))
    assert kinemend.contact_masks(path)[0] == kinemend.contact_masks(kinemend.read(path))[0]
    assert kinemend.corrupt(path, "gaussian", seed=3)[1] == kinemend.corrupt(kinemend.read(path), "gaussian", seed=3)[1]
    assert kinemend.LiveFilter(path, "one-euro").latency_frames == 0


def test_a_take_shows_its_name_and_size(all_formats):
    path = all_formats / "walk.bvh"
    assert repr(kinemend.read(path)) == f"<kinemend.Take {path}: 120 frames of 31 joints at 120 Hz>"
    assert " markers in mm at " in repr(kinemend.read(all_formats / "gaps.trc"))
    assert " 10 frames of 31 joints" in repr(kinemend.read(path)[:10])


def test_results_and_reports_show_what_is_set(noisy):
    result = kinemend.clean(noisy, "auto")
    assert repr(result) == f"<kinemend.Result: {result.report.verdict}; take={result.take!r}>"
    shown = repr(result.report)
    assert "None" not in shown and "method='auto'" in shown and "tracks=<list of 31>" in shown and len(shown) < 2000
    assert repr(kinemend.RobotLimits(jump_cm=4)) == "RobotLimits(jump_cm=4)"
    assert repr(kinemend.RobotLimits()) == "RobotLimits()"


def test_live_filters_and_models_show_what_is_set(noisy):
    live = kinemend.LiveFilter(noisy, "one-euro", min_cutoff_hz=2)
    assert repr(live).startswith("<kinemend.LiveFilter 0 frames behind: <kinemend.Cleaner one-euro") and "min_cutoff_hz=2.0" in repr(live)
    frame = live.push(noisy.rotations[0], noisy.positions[0])
    assert repr(frame) == "<kinemend.LiveFrame: rotations (31, 4), positions (1, 3), 31 of 31 observed>"
    model = kinemend.train("example", [TAKES / "walk.bvh"])
    assert repr(model) == f"<kinemend.Model for example: {len(model.names)} joints, 8 s of motion at {model.fps:g} Hz>"
