"""Live frames equal the whole take cleaned at once, with a constant delay."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import kinemend
from conftest import FIXTURES


def streamed(take, live):
    frames = []
    for frame in range(len(take)):
        rotations = take.rotations[frame] if take.kind == "joints" else None
        out = live.push(rotations, take.positions[frame], take.observed[frame])
        assert (out is not None) == (frame >= live.latency_frames)
        frames += [] if out is None else [out]
    return frames + list(live.flush())


@pytest.mark.parametrize("method", [method for method in kinemend.methods() if method.live is not None and not method.learned],
                         ids=lambda method: method.name)
def test_frames_are_those_of_the_whole_take(noisy, method):
    live = kinemend.LiveFilter(noisy, method.name, options=method.live)
    frames = streamed(noisy, live)
    assert len(frames) == len(noisy)
    cleaned = kinemend.clean(noisy, live.cleaner).take
    ours, theirs = np.array([frame.rotations for frame in frames]), cleaned.rotations
    distance = 1 - np.abs((ours * theirs).sum(axis=-1))
    assert distance.max() < 1e-9


def test_a_filter_begins_anew(noisy):
    live = kinemend.LiveFilter(noisy, "one-euro")
    first = live.push(noisy.rotations[0], noisy.positions[0]).rotations
    live.push(noisy.rotations[1], noisy.positions[1])
    live.reset()
    assert np.array_equal(live.push(noisy.rotations[0], noisy.positions[0]).rotations, first)


def test_markers_stream_too():
    take = kinemend.read(FIXTURES / "trc/good/gaps.trc")
    frames = streamed(take, kinemend.LiveFilter(take, "one-euro"))
    assert len(frames) == len(take)
    assert np.array_equal([frame.observed for frame in frames], take.observed)


def test_wrong_shapes_are_refused_and_values_are_not(noisy):
    live = kinemend.LiveFilter(noisy, "one-euro")
    for rotations, positions, observed in ((noisy.rotations[:2], noisy.positions[0], None), (None, noisy.positions[0], None),
                                           (noisy.rotations[0], noisy.positions, None),
                                           (noisy.rotations[0], noisy.positions[0], [True])):
        with pytest.raises(ValueError):
            live.push(rotations, positions, observed)
    assert live.push(noisy.rotations[0], noisy.positions[0]) is not None
    live.push(np.zeros_like(noisy.rotations[0]), noisy.positions[0] * 1e300)


def test_methods_that_need_the_whole_take_are_refused(noisy):
    with pytest.raises(kinemend.Error) as raised:
        kinemend.LiveFilter(noisy, "wavelet")
    assert raised.value.kind == "usage"
    assert kinemend.Cleaner("wavelet").why_not_live(120) and not kinemend.Cleaner("one-euro").why_not_live(120)


def test_streams_run_in_threads(noisy):
    cleaner = kinemend.cleaners.bilateral()
    expected = [frame.rotations for frame in streamed(noisy, kinemend.LiveFilter(noisy, cleaner))]
    with ThreadPoolExecutor(4) as pool:
        for frames in pool.map(lambda _: streamed(noisy, kinemend.LiveFilter(noisy, cleaner)), range(4)):
            assert np.array_equal([frame.rotations for frame in frames], expected)
