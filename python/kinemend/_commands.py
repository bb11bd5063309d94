"""Cleans, fills, checks, compares and damages takes, and trains models."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from . import _core
from ._core import Model, Take
from ._files import _GivenTake, taken
from ._shown import Shown
from ._tables import Cleaner, _GivenOption, damages, methods, plain_options, trainings
from .reports import Contact, DamageReport, Report

_Progress = Callable[[str, float], object] | None
_Range = tuple[int, int] | None
_Source = Literal["optical", "suit", "video", "depth", "keyframed", "unknown"]


def _report(core: _core.CoreReport) -> Report:
    return Report.from_dict(json.loads(core.to_json()))


@dataclass(repr=False)
class Result:
    """A take, and the report of what was done to it. It can be unpacked: `take, report = ...`.

    The report is made when it is first asked for, so that a loop over many takes does not wait for
    reports that nobody reads.
    """

    take: Take
    _core: _core.CoreReport
    _report: Report | None = None

    @property
    def report(self) -> Report:
        """What was done, as in the JSON of `kinemend clean --report`."""
        if self._report is None:
            self._report = _report(self._core)
        return self._report

    def to_json(self) -> str:
        """The report as the entry of this take in the JSON of the program."""
        return self._core.to_json()

    def to_text(self) -> str:
        """The report as the program prints it with --verbose."""
        return self._core.to_text()

    def __repr__(self) -> str:
        return f"<kinemend.Result: {self.report.verdict}; take={self.take!r}>"

    def __iter__(self) -> Iterator[Take | Report]:
        yield self.take
        yield self.report


def _from_zero(take: Take, contacts: Sequence[Contact]) -> list[tuple[str, str, int, int]]:
    first = take.first_frame
    return [(c.side, c.part, c.first_frame - first, c.last_frame - first) for c in contacts]


def clean(
    take: _GivenTake,
    method: str | Cleaner = "learned",
    *,
    strength: float = 1.0,
    max_change_deg: float = 180.0,
    max_change: float = math.inf,
    joints: Iterable[str] = (),
    exclude: Iterable[str] = (),
    root_position: bool = True,
    range: _Range = None,
    source: _Source = "unknown",
    noise: Literal["auto", "white"] | Report = "auto",
    peak_loss_limit: float = 0.10,
    fill: str | None = None,
    fill_all: bool = False,
    unlabelled: bool = False,
    feet: Literal["by-source", "off", "auto", "force"] = "by-source",
    feet_names: Mapping[str, str] | None = None,
    contacts: Sequence[Contact] | None = None,
    fix_swaps: bool = False,
    threads: int = 0,
    progress: _Progress = None,
    options: Mapping[str, _GivenOption] | None = None,
    **more: _GivenOption,
) -> Result:
    """Clean a take: jitter and spikes, and on request gaps and sliding feet.

    The take is not changed. Other Python threads run meanwhile; they must not write into the take.
    Ctrl-C ends the work.

    Parameters
    ----------
    take : Take or path
        Joints or markers; of a path the file is read.
    method : str or Cleaner, default "learned"
        How to clean; the methods and their options are listed below.
    strength : float, default 1
        0 changes nothing, 1 is the method's result.
    max_change_deg : float, default 180
        Largest change of an observed rotation.
    max_change : float, default inf
        Largest change of an observed marker, in the unit of the take.
    joints, exclude : list of str, optional
        Joints or markers that may change, and exceptions. `*` stands for any text.
    root_position : bool, default True
        Also clean the position of joint 0.
    range : (int, int), optional
        First and last frame that may change, counted from 0.
    source : {"optical", "suit", "video", "depth", "keyframed", "unknown"}
        What recorded the motion, for the methods `learned` and `auto`. Video, depth and suit: slow
        noise is taken out, too. Keyframed: only gaps change. Unknown: what the file says, where
        that is certain; else only what the take shows to be noise is taken out.
    noise : "auto", "white" or Report
        The noise of the capture system: measured, independent from frame to frame, or as the report
        of another take of the same system says.
    peak_loss_limit : float, default 0.1
        A larger loss of a peak speed is a warning.
    fill : str, optional
        Also fill gaps, with this entry of `fill_methods()`: "auto".
    fill_all : bool, default False
        Fill gaps that the rules of the method refuse, too.
    unlabelled : bool, default False
        Fill unlabelled markers, too.
    feet : {"by-source", "off", "auto", "force"}, default "by-source"
        Also stop standing feet from sliding: where the slide is an error, or everywhere. By source:
        where the slide is an error, in takes of video, depth cameras and suits.
    feet_names : mapping, optional
        Known names of feet to names in the take: {"LeftFoot": "bone_17"}.
    contacts : list of Contact, optional
        Times in which feet stand, in place of those that are found.
    fix_swaps : bool, default False
        Of markers: first give exchanged labels back.
    threads : int, default 0
        At most so many; 0: as many as there are cores. The result does not depend on it.
    progress : callable, optional
        Called as `progress(stage, done)` in this thread, with `done` from 0 to 1. If it raises, the
        work ends.
    options : mapping, optional
        Options of the method.
    **more
        The same as keywords. An option with the name of a parameter above goes into `options`.

    Returns
    -------
    Result
        The cleaned take, and a report.

    Raises
    ------
    Error
        A setting is out of range, the method does not work on this kind of take, or the file cannot
        be read.

    Examples
    --------
    >>> kinemend.clean("walk.bvh").report.method
    'learned'
    >>> take = kinemend.read("walk.bvh")
    >>> result = kinemend.clean(take, "butterworth", cutoff_hz=6)
    >>> result.report.method, result.report.options["cutoff_hz"]
    ('butterworth', 6.0)
    >>> kinemend.clean(take, "butterworth", cutoff_hz=900)
    Traceback (most recent call last):
        ...
    kinemend._errors.Error: cutoff_hz: 900 is outside 0.05 to 500 Hz
    """
    cleaner = method if isinstance(method, Cleaner) else Cleaner(method, options, **more)
    if isinstance(method, Cleaner) and (options or more):
        raise TypeError("options go into the Cleaner")
    take = taken(take)
    settings = {
        "strength": float(strength),
        "max_change_deg": float(max_change_deg),
        "root_position": bool(root_position),
        "source": source,
        "peak_loss_limit": float(peak_loss_limit),
        "fill": "off" if fill is None else fill,
        "fill_all": bool(fill_all),
        "unlabelled": bool(unlabelled),
        "feet": feet,
        "fix_swaps": bool(fix_swaps),
    }
    cleaned, report = _core.clean(
        take,
        cleaner._core,
        settings,
        max_change=max_change,
        joints=joints,
        exclude=exclude,
        range=range,
        noise=_noise(noise),
        feet_names=feet_names or {},
        contacts=None if contacts is None else _from_zero(take, contacts),
        threads=threads,
        progress=progress,
    )
    return Result(cleaned, report)


def _noise(noise: Literal["auto", "white"] | Report) -> tuple[float, dict[str, float]] | None:
    if noise == "auto":
        return None
    if noise == "white":
        return (0.0, {})
    if not isinstance(noise, Report):
        raise ValueError(f'noise: expected "auto", "white" or a report, found {noise!r}')
    quantity = "position" if noise.kind == "markers" else "rotation"
    for character in noise.noise or []:
        if character.quantity == quantity:
            strengths = {track.name: track.noise for track in noise.tracks if track.noise}
            return (character.correlation, strengths)
    raise ValueError("noise: the report found no noise in its take")


def fill(
    take: _GivenTake,
    method: str = "auto",
    *,
    names: Iterable[str] = (),
    donor: str = "",
    longest_gap_s: float = 0.0,
    fill_all: bool = False,
    max_error: float = 0.0,
    max_error_deg: float = 0.0,
    unlabelled: bool = False,
    range: _Range = None,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
) -> Result:
    """Fill gaps: samples that are not `observed`.

    Parameters
    ----------
    take : Take or path
        Joints or markers; of a path the file is read.
    method : str, default "auto"
        An entry of `fill_methods()`. "auto" tests methods on artificial gaps and leaves a gap open
        when none is reliable.
    names : list of str, optional
        Joints or markers to fill. Default: all.
    donor : str, optional
        Of "pattern": the marker whose movement is copied.
    longest_gap_s : float, default 0
        Longer gaps are refused; 0: the rules of the method.
    fill_all : bool, default False
        Fill gaps that the rules refuse, too.
    max_error, max_error_deg : float, default 0
        Refuse fills whose expected error is larger, of positions in the unit of the take and of
        rotations; 0: no limit.
    unlabelled : bool, default False
        Fill unlabelled markers, too.
    range : (int, int), optional
        First and last frame, counted from 0, of the gaps that are filled.
    model, map : path, optional
        Of "recurrent" and "learned": the file of a model, and of names in the take.

    Returns
    -------
    Result

    Examples
    --------
    >>> take = kinemend.read("walk.bvh")
    >>> take.observed[100:110, take.names.index("LeftArm")] = False
    >>> filled, report = kinemend.fill(take)
    >>> report.verdict
    '1 gap: 1 filled, 0 refused'
    """
    return Result(
        *_core.fill(
            taken(take),
            method=method,
            names=names,
            donor=donor,
            longest_gap_s=longest_gap_s,
            fill_all=fill_all,
            max_error=max_error,
            max_error_deg=max_error_deg,
            unlabelled=unlabelled,
            range=range,
            model=os.fspath(model),
            map=os.fspath(map),
        )
    )


@dataclass(frozen=True, kw_only=True, repr=False)
class RobotLimits(Shown):
    """What a take has to keep to if a robot or a simulated body imitates it.

    None is the limit that `kinemend check --robot` has (docs/check-robot.md).

    Attributes
    ----------
    speed_deg_s, acceleration_deg_s2 : float, optional
        What a joint may do at most (> 0). Default: 1146 and 72700.
    joints : mapping
        Names or shell patterns to limits of these joints, such as
        `{"*Knee": {"speed_deg_s": 900}}`; the last one that matches counts.
    step_s : float, optional
        Time over which speeds and accelerations are differences (0.001 to 1). Default: 0.02.
    penetration_cm, floating_cm : float, optional
        Depth of a foot below its standing level, and height of a standing foot above the floor
        (>= 0). Default: 5.
    jump_deg, jump_cm : float, optional
        Of a joint, and of the root or a marker, within one frame (> 0). Default: 30 and 10.
    floor_cm : float, optional
        Distance of the floor from height 0 (>= 0). Default: 5.
    """

    speed_deg_s: float | None = None
    acceleration_deg_s2: float | None = None
    joints: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    step_s: float | None = None
    penetration_cm: float | None = None
    floating_cm: float | None = None
    jump_deg: float | None = None
    jump_cm: float | None = None
    floor_cm: float | None = None

    def _given(self) -> dict[str, float]:
        numbers = {name: value for name, value in vars(self).items() if name != "joints"}
        return {name: value for name, value in numbers.items() if value is not None}


def check(
    take: _GivenTake,
    *,
    up: Literal["x", "y", "z"] | None = None,
    metres_per_unit: float | None = None,
    feet_names: Mapping[str, str] | None = None,
    robot: bool | RobotLimits = False,
    source: _Source = "unknown",
) -> Report:
    """Find what is wrong with a take before it is cleaned, worst first.

    Parameters
    ----------
    take : Take or path
        Joints or markers; of a path the file is read.
    up : {"x", "y", "z"}, optional
        The vertical axis. Default: found from the body.
    metres_per_unit : float, optional
        Of lengths. Default: what the take says, else what makes the body a person.
    feet_names : mapping, optional
        Known names of feet to names in the take.
    robot : bool or RobotLimits, optional
        Also find what a robot or a simulated body cannot follow, as `kinemend check --robot`:
        with its limits, or with your own.
    source : {"optical", "suit", "video", "depth", "keyframed", "unknown"}
        What recorded the motion: noise and spikes are found that `clean` would take out with this
        source.

    Examples
    --------
    >>> report = kinemend.check(kinemend.read("walk.bvh"))
    >>> report.findings[0].kind, report.findings[0].verdict
    ('spike', 'warning')
    """
    limits = robot if isinstance(robot, RobotLimits) else RobotLimits()
    return _report(
        _core.check(
            taken(take),
            up=up,
            metres_per_unit=metres_per_unit,
            feet_names=feet_names or {},
            robot=limits._given() if robot else None,
            joint_limits=limits.joints,
            source=source,
        )
    )


def contacts(take: _GivenTake, *, feet_names: Mapping[str, str] | None = None) -> Report:
    """Find when heels and toes stand, and which slides `clean(feet="auto")` would take out.

    `report.feet.contacts` lists them; `contact_masks` gives them as arrays.

    Examples
    --------
    >>> report = kinemend.contacts(kinemend.read("walk.bvh"))
    >>> sorted({contact.side for contact in report.feet.contacts})
    ['left', 'right']
    """
    return _report(_core.contacts(taken(take), feet_names=feet_names or {}))


def compare(
    reference: _GivenTake,
    other: _GivenTake,
    *,
    psnr_peak: float = math.pi / 2,
    metres_per_unit: float | None = None,
    up: Literal["x", "y", "z"] = "y",
    fit: Literal["none", "rigid", "gain-offset"] = "none",
    fit_to: _GivenTake | None = None,
    lag_frames: int = 0,
    least_motion: float = 0.0,
) -> Report:
    """Compare a take with a reference: every error figure.

    Parameters
    ----------
    reference, other : Take or path
        Both of joints, or both of markers, with the same number of frames.
    psnr_peak : float, default pi / 2
        Of `figures.psnr_db`.
    metres_per_unit : float, optional
        Of lengths. Default: guessed from the skeleton.
    up : {"x", "y", "z"}, default "y"
        The vertical axis, for `figures.foot_slide`.
    fit : {"none", "rigid", "gain-offset"}, default "none"
        Of markers: how the reference is brought to `fit_to` first.
    fit_to : Take or path, optional
        Of markers. Default: `other`.
    lag_frames : int, default 0
        Of markers: frames by which `other` comes behind the reference.
    least_motion : float, default 0
        Of markers: channels that move less do not count.

    Examples
    --------
    >>> take = kinemend.read("walk.bvh")
    >>> kinemend.compare(take, take).figures.rms_deg
    0.0
    """
    return _report(
        _core.compare(
            taken(reference),
            taken(other),
            psnr_peak=psnr_peak,
            metres_per_unit=metres_per_unit,
            up=up,
            fit=fit,
            fit_to=None if fit_to is None else taken(fit_to),
            lag_frames=lag_frames,
            least_motion=least_motion,
        )
    )


def corrupt(
    take: _GivenTake,
    damage: str | Sequence[tuple[str, Mapping[str, _GivenOption]]],
    *,
    seed: int = 1,
    options: Mapping[str, _GivenOption] | None = None,
    **more: _GivenOption,
) -> tuple[Take, list[DamageReport]]:
    """Damage a take in a known way, for tests, comparisons and training.

    The same seed gives the same take on every machine.

    Parameters
    ----------
    take : Take or path
        It is not changed; of a path the file is read.
    damage : str, or list of (str, mapping)
        A damage, listed below; or several with their options, one after the other.
    seed : int, default 1
        Of the random numbers.
    options : mapping, optional
        Options of the damage.
    **more
        The same as keywords.

    Returns
    -------
    Take
        The damaged take.
    list of DamageReport
        What each damage did.

    Examples
    --------
    >>> take = kinemend.read("walk.bvh")
    >>> noisy, reports = kinemend.corrupt(take, "gaussian", std_deg=1.5)
    >>> reports[0].samples == len(take) * len(take.names)
    True
    """
    wanted = [(damage, plain_options(options, more))] if isinstance(damage, str) else [
        (name, plain_options(values, {})) for name, values in damage
    ]
    damaged, reports = _core.corrupt(taken(take), wanted, seed)
    return damaged, [DamageReport(**report) for report in reports]


def train(
    method: str,
    takes: Iterable[Take | str | os.PathLike[str]],
    *,
    names: Iterable[str] = (),
    fill: str | None = "auto",
    seed: int = 1,
    title: str = "",
    data: str = "",
    licence: str = "",
    command: str = "",
    figures: str = "",
    threads: int = 0,
    progress: _Progress = None,
    options: Mapping[str, _GivenOption] | None = None,
    **more: _GivenOption,
) -> Model:
    """Learn from clean takes how people move, for methods that need a model.

    Write the model to a file, and give its path to the option `model` of the method. The same takes
    and options give the same bytes. Ctrl-C ends the training and loses its work.

    Parameters
    ----------
    method : str
        A training, listed below.
    takes : list of Take or path
        Clean takes of one kind. Files are read when it is their turn.
    names : list of str, optional
        Joints or markers to learn. Default: all that move.
    fill : str, optional
        How gaps are filled first; None leaves them open.
    seed : int, default 1
        Of the random numbers.
    title, data, licence, command, figures : str, optional
        What the model says of itself.
    threads : int, default 0
        At most so many; 0: as many as there are cores.
    progress : callable, optional
        Called as `progress(stage, done)` in this thread. If it raises, the training ends.
    options : mapping, optional
        Options of the training.
    **more
        The same as keywords.
    """
    card = {
        "title": title,
        "data": data,
        "licence": licence,
        "command": command,
        "figures": figures,
    }
    return _core.train(
        method,
        list(takes),
        options=plain_options(options, more),
        names=names,
        fill=fill,
        seed=seed,
        card=card,
        threads=threads,
        progress=progress,
    )


def _add_table(function: Callable[..., object], heading: str, rows: Iterable[object]) -> None:
    """Appends a section with the rows of a table to the docstring."""
    lines = [(function.__doc__ or "").rstrip(), "", f"    {heading}", "    " + "-" * len(heading)]
    for row in rows:
        options = ", ".join(option.name for option in getattr(row, "options"))
        summary = getattr(row, "summary")
        lines.append(f"    {getattr(row, 'name')}\n        {summary}. Options: {options or 'none'}.")
    function.__doc__ = "\n".join(lines) + "\n    "


_add_table(clean, "Methods", methods())
_add_table(corrupt, "Damages", damages())
_add_table(train, "Trainings", trainings())
