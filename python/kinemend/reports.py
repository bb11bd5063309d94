"""Reports as dataclasses: the JSON of the program, key for key.

Frames are counted as the file counts them: index = frame - `Report.first_frame`. A figure that the
take does not have is None. Made by tools/make_python_tables from docs/report.schema.json.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ._shown import Shown


@dataclass(frozen=True, kw_only=True, repr=False)
class Diagnostic(Shown):
    """A repair that the reader made.

    Attributes
    ----------
    name : str
        Stable, for programs.
    message : str
        For people, of the first occurrence.
    first_line : int or None
        0: not known.
    first_byte : int or None
        In place of first_line where places in the format are bytes.
    count : int
        Of occurrences.
    """

    name: str
    message: str
    count: int
    first_line: int | None = None
    first_byte: int | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Diagnostic:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Noise(Shown):
    """What the noise of a take is like.

    Attributes
    ----------
    quantity : {"rotation", "position"}
        Of joints also the positions of the root and of joints that have some.
    strength : float or None
        Per axis, median of the tracks that have noise: degrees of rotations, else in `unit`.
    correlation : float
        From one sample to the next; 0 is white.
    half_below_hz : float or None
        Half of its power lies below this frequency.
    ninety_percent_below_hz : float or None
        The same of nine tenths.
    is_expected : bool
        Not measured: noise that a model expects of takes like this one; with correlation 0 it is
        slow.
    samples : {"every_frame", "held", "interpolated"}
        Where frames are fewer samples than they seem: how those of a lower rate were brought to
        that of the file.
    sample_rate_hz : float or None
        Of the samples.
    """

    quantity: Literal["rotation", "position"]
    strength: float | None
    correlation: float
    half_below_hz: float | None
    ninety_percent_below_hz: float | None
    is_expected: bool
    samples: Literal["every_frame", "held", "interpolated"]
    sample_rate_hz: float | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Noise:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class FallBackTrack(Shown):
    """A track that another method cleaned.

    Attributes
    ----------
    name : str
        Joint, marker, or "root position".
    share : float
        How much of it is the other method's, 0 to 1.
    """

    name: str
    share: float

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> FallBackTrack:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class FallBack(Shown):
    """Where another method cleaned in place of the one that was asked for.

    Attributes
    ----------
    method : str
        The other.
    reason : str
        For people.
    tracks : list[FallBackTrack]
    """

    method: str
    reason: str
    tracks: list[FallBackTrack]

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> FallBack:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        values = dict(data)
        if data.get("tracks") is not None:
            values["tracks"] = [FallBackTrack.from_dict(row) for row in data["tracks"]]
        return cls(**values)


@dataclass(frozen=True, kw_only=True, repr=False)
class Leftover(Shown):
    """Something wrong that cleaning left as it was.

    Attributes
    ----------
    what : str
        "34 frozen or bridged spans left".
    mend : str
        The command or option that mends it.
    """

    what: str
    mend: str

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Leftover:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Subject(Shown):
    """One of several people in a take of markers.

    Attributes
    ----------
    name : str
        Of the person.
    markers : int
        How many.
    slide_cm : float or None
        As in figures.
    sink_cm : float or None
        As in figures.
    """

    name: str
    markers: int
    slide_cm: float | None
    sink_cm: float | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Subject:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class StandingTime(Shown):
    """Seconds in which feet stand, summed over feet.

    Attributes
    ----------
    expected_s : float
        The sum of the likelihoods that a foot stands.
    found_s : float
        In contacts.
    held_s : float
        In contacts whose slide was taken out.
    still_s : float
        In contacts that had no slide.
    confidence : float
        Mean over the time found.
    """

    expected_s: float
    found_s: float
    held_s: float
    still_s: float
    confidence: float

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> StandingTime:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class FeetFigures(Shown):
    """How feet stand.

    Attributes
    ----------
    slide : float or None
        Mean horizontal travel a frame of parts in contact, file units.
    most_slide : float or None
        Farthest from where a contact began.
    sink : float or None
        Deepest below the level on which the part stands.
    knee_pop_deg : float or None
        Largest second difference of a knee's angle.
    """

    slide: float | None
    most_slide: float | None
    sink: float | None
    knee_pop_deg: float | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> FeetFigures:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Contact(Shown):
    """A time in which a part of a foot stands.

    Attributes
    ----------
    side : str
        Left, right, or a joint.
    part : {"heel", "toe"}
    first_frame : int
        As the file counts.
    last_frame : int
        Inclusive.
    confidence : float
        How likely the part stands.
    held : bool
        Whether the slide was taken out.
    reason : str or None
        Why not.
    """

    side: str
    part: Literal["heel", "toe"]
    first_frame: int
    last_frame: int
    confidence: float
    held: bool
    reason: str | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Contact:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Feet(Shown):
    """What was found of feet, and done to them.

    Attributes
    ----------
    metres_per_unit : float or None
        Of the figures; null where it is not known.
    time : StandingTime
    held : int
        Contacts whose slide was taken out.
    frames_adjusted : int
        Frames in which a leg turned or the body was lowered.
    before : FeetFigures or None
    after : FeetFigures or None
    contacts : list[Contact] or None
        By leg, part, then frame; not in rows of a batch.
    """

    metres_per_unit: float | None
    time: StandingTime
    held: int
    frames_adjusted: int
    before: FeetFigures | None
    after: FeetFigures | None
    contacts: list[Contact] | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Feet:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        values = dict(data)
        if data.get("time") is not None:
            values["time"] = StandingTime.from_dict(data["time"])
        if data.get("before") is not None:
            values["before"] = FeetFigures.from_dict(data["before"])
        if data.get("after") is not None:
            values["after"] = FeetFigures.from_dict(data["after"])
        if data.get("contacts") is not None:
            values["contacts"] = [Contact.from_dict(row) for row in data["contacts"]]
        return cls(**values)


@dataclass(frozen=True, kw_only=True, repr=False)
class Figures(Shown):
    """Numbers about the whole take; None where the command does not give them.

    Attributes
    ----------
    tracks_changed : int or None
        Clean: joints or markers of which a sample changed.
    frames_repaired : int or None
        Clean: frames in which at least one track was despiked or filled.
    spikes : int or None
        Clean: spans that were despiked; check: spikes found; batch: of all takes.
    bursts : int or None
        Clean: spikes that last three frames or more.
    gaps : int or None
        Clean: spans that were filled; check, fill: gaps of the take; batch: of all takes.
    gaps_refused : int or None
        Clean: gaps that the step --fill left.
    gaps_left : int or None
        Clean: gaps that are still there; null for joints.
    swaps_undone : int or None
        Clean: spans in which labels were given back.
    root_rms_change : float or None
        Clean: of the root position, in `unit`; null for markers.
    root_max_change : float or None
        Clean: the same, the largest.
    seconds : float or None
        Clean, batch: time the cleaning took.
    frames_per_second : float or None
        Clean: frames cleaned a second.
    longest_gap_s : float or None
        Check: seconds.
    missing_percent : float or None
        Check: of all samples.
    swaps : int or None
        Check: spans in which two labels are exchanged.
    frozen : int or None
        Check: spans that are frozen or bridged.
    worst_noise : float or None
        Check: largest of any track, per axis, in `track_unit`.
    length_change_percent : float or None
        Check: largest of any bone or rigid pair.
    slide_cm : float or None
        Check: travel of a standing foot; null without contact or scale.
    sink_cm : float or None
        Check: depth of a foot below the floor; null without contact or scale.
    flips : int or None
        Check: leaps of Euler angles.
    joint_speed_deg_s : float or None
        Check --robot: of the fastest joint; null of markers.
    joint_acceleration_deg_s2 : float or None
        Check --robot: the largest of any joint; null of markers.
    jumps : int or None
        Check --robot: changes within one frame that stay; null without scale.
    flights : int or None
        Check --robot: times in which no foot touches the floor; null without feet or scale.
    penetration_cm : float or None
        Check --robot: depth of a foot below the level on which it stands.
    floating_cm : float or None
        Check --robot: height of a standing foot above the floor; null of markers.
    floor_cm : float or None
        Check --robot: distance of the floor from height 0; null of markers.
    filled : int or None
        Fill: gaps filled.
    refused : int or None
        Fill: gaps left.
    unlabelled : int or None
        Fill: gaps of unlabelled points, left alone without --unlabelled.
    not_within_range : int or None
        Fill: gaps that do not lie within --range.
    frames_compared : int or None
        Compare: frames without calibration pose.
    psnr_peak : float or None
        Compare: the peak of psnr_db, radians.
    rms_deg : float or None
        Compare: joint-angle channels, mean over frames (Mall et al.).
    geodesic_rms_deg : float or None
        Compare: angle between local rotations, all joints.
    geodesic_p99_deg : float or None
        Compare: its 99th percentile.
    geodesic_max_deg : float or None
        Compare: its largest value.
    mpjpe : float or None
        Compare: mean distance of joint positions, file units.
    mpjpe_cm : float or None
        Compare: the same in cm; null where the scale is not known.
    accel_error : float or None
        Compare: difference of joint accelerations, file units / s2.
    psnr_db : float or None
        Compare: peak signal to noise of the logarithms (Dean); null for equal takes.
    rmse_per_marker_m : float or None
        Compare: distance of joint positions per frame, mean (Xiao et al.); null where the scale is
        not known.
    rmse_per_marker_deviation_m : float or None
        Compare: its standard deviation over frames.
    mse_rad2 : float or None
        Compare: squared angle, mean over joints (Courty).
    foot_slide : float or None
        Compare: travel per frame of feet in contact, file units; null where none stands.
    foot_slide_reference : float or None
        Compare: the same of the reference.
    rms_distance : float or None
        Compare, markers: distance of positions, root mean square, in `unit`.
    p99_distance : float or None
        Compare, markers: its 99th percentile.
    max_distance : float or None
        Compare, markers: its largest value.
    rms_axis : float or None
        Compare, markers: error along an axis.
    velocity_rms : float or None
        Compare, markers: error of velocity along an axis, a second.
    below_2_hz : float or None
        Compare, markers: error along an axis below 2 Hz.
    from_2_to_6_hz : float or None
        Compare, markers: the same from 2 to 6 Hz.
    from_6_to_15_hz : float or None
        Compare, markers: the same from 6 to 15 Hz.
    above_15_hz : float or None
        Compare, markers: the same above 15 Hz.
    above_6_hz : float or None
        Compare, markers: the same above 6 Hz: jitter.
    lag_s : float or None
        Compare, markers: by how much the other take comes later, seconds; not applied.
    contacts : int or None
        Contacts: times in which a part of a foot stands.
    held : int or None
        Contacts: those that clean --feet auto would hold.
    takes : int or None
        Batch: all takes.
    cleaned : int or None
        Batch: takes cleaned.
    failed : int or None
        Batch: takes that failed.
    to_do : int or None
        Batch: takes not yet done.
    frames : int or None
        Batch: of all takes.
    duration_s : float or None
        Batch: of the motion of all takes, seconds.
    """

    tracks_changed: int | None = None
    frames_repaired: int | None = None
    spikes: int | None = None
    bursts: int | None = None
    gaps: int | None = None
    gaps_refused: int | None = None
    gaps_left: int | None = None
    swaps_undone: int | None = None
    root_rms_change: float | None = None
    root_max_change: float | None = None
    seconds: float | None = None
    frames_per_second: float | None = None
    longest_gap_s: float | None = None
    missing_percent: float | None = None
    swaps: int | None = None
    frozen: int | None = None
    worst_noise: float | None = None
    length_change_percent: float | None = None
    slide_cm: float | None = None
    sink_cm: float | None = None
    flips: int | None = None
    joint_speed_deg_s: float | None = None
    joint_acceleration_deg_s2: float | None = None
    jumps: int | None = None
    flights: int | None = None
    penetration_cm: float | None = None
    floating_cm: float | None = None
    floor_cm: float | None = None
    filled: int | None = None
    refused: int | None = None
    unlabelled: int | None = None
    not_within_range: int | None = None
    frames_compared: int | None = None
    psnr_peak: float | None = None
    rms_deg: float | None = None
    geodesic_rms_deg: float | None = None
    geodesic_p99_deg: float | None = None
    geodesic_max_deg: float | None = None
    mpjpe: float | None = None
    mpjpe_cm: float | None = None
    accel_error: float | None = None
    psnr_db: float | None = None
    rmse_per_marker_m: float | None = None
    rmse_per_marker_deviation_m: float | None = None
    mse_rad2: float | None = None
    foot_slide: float | None = None
    foot_slide_reference: float | None = None
    rms_distance: float | None = None
    p99_distance: float | None = None
    max_distance: float | None = None
    rms_axis: float | None = None
    velocity_rms: float | None = None
    below_2_hz: float | None = None
    from_2_to_6_hz: float | None = None
    from_6_to_15_hz: float | None = None
    above_15_hz: float | None = None
    above_6_hz: float | None = None
    lag_s: float | None = None
    contacts: int | None = None
    held: int | None = None
    takes: int | None = None
    cleaned: int | None = None
    failed: int | None = None
    to_do: int | None = None
    frames: int | None = None
    duration_s: float | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Figures:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Finding(Shown):
    """A span in which something was wrong, and what was done about it.

    Attributes
    ----------
    kind : {"gap", "spike", "frozen", "bridged", "noise", "swap", "rate", "unit", "length", "slide",
    "sink", "euler_flip", "repeated_frames", "zero_frames", "calibration", "left_out", "no_contact",
    "expected_noise", "joint_speed", "joint_acceleration", "penetration", "floating", "flight",
    "jump", "floor"}
        What was wrong, in the words of check: what clean smoothed is noise, what it moved for a
        foot to stand is slide.
    verdict : {"note", "warning", "serious", "denoised", "despiked", "filled", "foot_adjusted",
    "refused", "undone"}
        Of check how bad it is (the first three), of others what was done.
    track : str or None
        Joint or marker; "A, B" for two; null for the whole take.
    first_frame : int
        As the file counts.
    last_frame : int
        Inclusive.
    amount : float or None
        Check: how much is wrong; clean: the largest change; fill: the expected error.
    unit : str or None
        Of amount and rms.
    reason : str or None
        In words: of check what was found, of others why it was refused.
    rms : float or None
        Clean: root mean square of the change over the frames.
    quantity : {"rotation", "position"} or None
        Clean, fill: which samples of the track; the root position is that of joint 0.
    method : str or None
        Clean, fill: that filled the gap, or was tried last.
    """

    kind: Literal["gap", "spike", "frozen", "bridged", "noise", "swap", "rate", "unit", "length", "slide", "sink", "euler_flip", "repeated_frames", "zero_frames", "calibration", "left_out", "no_contact", "expected_noise", "joint_speed", "joint_acceleration", "penetration", "floating", "flight", "jump", "floor"]
    verdict: Literal["note", "warning", "serious", "denoised", "despiked", "filled", "foot_adjusted", "refused", "undone"]
    track: str | None
    first_frame: int
    last_frame: int
    amount: float | None
    unit: str | None
    reason: str | None
    rms: float | None = None
    quantity: Literal["rotation", "position"] | None = None
    method: str | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Finding:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Track(Shown):
    """Figures of one joint or marker; None where the command does not give them.

    Attributes
    ----------
    name : str
        As the file spells it.
    noise : float or None
        Clean, check: noise per axis before, measured in the same way whatever the method; 0 for
        tracks that may not change.
    expected_noise : float or None
        Clean: noise per axis that the model of the method expects and takes out, also where it
        cannot be measured; only of methods that say it.
    left : float or None
        Clean: how far the result is expected to be off, per axis; only of methods that say it.
    rms_change : float or None
        Clean: over the frames that were observed.
    max_change : float or None
        Clean.
    frames_changed : int or None
        Clean.
    frames_repaired : int or None
        Clean: despiked or filled.
    peak_speed_before : float or None
        Clean: a second, in `track_unit`, without spikes and missing samples; the same whatever the
        method.
    peak_speed_after : float or None
        Clean: the same after.
    peak_frames : int or None
        Clean, compare: frames over which the peak speed is taken.
    gaps_left : int or None
        Clean, of markers.
    frames_missing : int or None
        Clean, of markers: in the gaps that are left.
    gaps : int or None
        Check.
    longest_gap : int or None
        Check: frames.
    missing_frames : int or None
        Check: of all gaps.
    spikes : int or None
        Check.
    frozen : int or None
        Check: spans.
    bridged : int or None
        Check: spans.
    swaps : int or None
        Check.
    flips : int or None
        Check.
    peak_speed_deg_s : float or None
        Check --robot, of joints.
    peak_acceleration_deg_s2 : float or None
        Check --robot, of joints.
    geodesic_rms_deg : float or None
        Compare.
    geodesic_max_deg : float or None
        Compare.
    peak_speed_reference_deg_s : float or None
        Compare.
    peak_speed_other_deg_s : float or None
        Compare.
    samples : int or None
        Compare, of markers: that both takes have.
    rms_distance : float or None
        Compare, of markers; in `track_unit`, as those that follow.
    max_distance : float or None
        Compare, of markers.
    rms_axis : float or None
        Compare, of markers: along an axis.
    velocity_rms : float or None
        Compare, of markers: of velocity along an axis, a second.
    above_6_hz : float or None
        Compare, of markers: along an axis.
    """

    name: str
    noise: float | None = None
    expected_noise: float | None = None
    left: float | None = None
    rms_change: float | None = None
    max_change: float | None = None
    frames_changed: int | None = None
    frames_repaired: int | None = None
    peak_speed_before: float | None = None
    peak_speed_after: float | None = None
    peak_frames: int | None = None
    gaps_left: int | None = None
    frames_missing: int | None = None
    gaps: int | None = None
    longest_gap: int | None = None
    missing_frames: int | None = None
    spikes: int | None = None
    frozen: int | None = None
    bridged: int | None = None
    swaps: int | None = None
    flips: int | None = None
    peak_speed_deg_s: float | None = None
    peak_acceleration_deg_s2: float | None = None
    geodesic_rms_deg: float | None = None
    geodesic_max_deg: float | None = None
    peak_speed_reference_deg_s: float | None = None
    peak_speed_other_deg_s: float | None = None
    samples: int | None = None
    rms_distance: float | None = None
    max_distance: float | None = None
    rms_axis: float | None = None
    velocity_rms: float | None = None
    above_6_hz: float | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Track:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Standing(Shown):
    """A time in which a heel or a toe stands.

    Attributes
    ----------
    side : str
        Of the leg: "left", "right", or the name of its ankle.
    part : {"heel", "toe"}
    first_frame : int
        As the file counts.
    last_frame : int
        Inclusive.
    """

    side: str
    part: Literal["heel", "toe"]
    first_frame: int
    last_frame: int

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Standing:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Robot(Shown):
    """What only `check --robot` finds.

    Attributes
    ----------
    contacts : list[Standing]
        Heels and toes that stand, of joints.
    """

    contacts: list[Standing]

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Robot:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        values = dict(data)
        if data.get("contacts") is not None:
            values["contacts"] = [Standing.from_dict(row) for row in data["contacts"]]
        return cls(**values)


@dataclass(frozen=True, kw_only=True, repr=False)
class Stand(Shown):
    """A time in which a heel or a toe stands, and how likely.

    Attributes
    ----------
    side : str
        Of the foot: "left", "right", the name of its ankle, or "Ann left".
    part : {"heel", "toe"}
    first_frame : int
        As the file counts.
    last_frame : int
        Inclusive.
    confidence : float
        How likely it stands, 0 to 1.
    """

    side: str
    part: Literal["heel", "toe"]
    first_frame: int
    last_frame: int
    confidence: float

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Stand:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class GroundTime(Shown):
    """A time in which a foot carries load.

    Attributes
    ----------
    side : str
        Of the foot.
    touch_down_s : float or None
        From the first frame, seconds.
    lift_off_s : float or None
        From the first frame, seconds.
    """

    side: str
    touch_down_s: float | None
    lift_off_s: float | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> GroundTime:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class PlateLoad(Shown):
    """A load of force plates under one foot, and how the motion of the foot differs.

    Attributes
    ----------
    side : str
        Of the foot.
    plates : list[int]
        Their numbers, from 1.
    first_s : float
        Begin of the load, seconds from the first frame.
    last_s : float
        Its end.
    found : bool
        Whether the foot stands at some time of it.
    onset_ms : float or None
        By how much the foot comes down later than the load begins; null: unknown.
    offset_ms : float or None
        By how much it lifts off later than the load ends; null: unknown.
    """

    side: str
    plates: list[int]
    first_s: float
    last_s: float
    found: bool
    onset_ms: float | None
    offset_ms: float | None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> PlateLoad:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        return cls(**data)


@dataclass(frozen=True, kw_only=True, repr=False)
class Stands(Shown):
    """When feet stand.

    Attributes
    ----------
    expected_s : float
        The sum of the likelihoods that a foot stands, seconds.
    found_s : float
        In contacts, seconds summed over feet.
    confidence : float
        Mean over the time found, 0 to 1.
    contacts : list[Stand]
        Heels and toes that stand.
    ground : list[GroundTime]
        When each foot comes down and lifts off.
    loads : list[PlateLoad]
        Loads of force plates under one foot.
    """

    expected_s: float
    found_s: float
    confidence: float
    contacts: list[Stand]
    ground: list[GroundTime]
    loads: list[PlateLoad]

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Stands:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        values = dict(data)
        if data.get("contacts") is not None:
            values["contacts"] = [Stand.from_dict(row) for row in data["contacts"]]
        if data.get("ground") is not None:
            values["ground"] = [GroundTime.from_dict(row) for row in data["ground"]]
        if data.get("loads") is not None:
            values["loads"] = [PlateLoad.from_dict(row) for row in data["loads"]]
        return cls(**values)


@dataclass(frozen=True, kw_only=True, repr=False)
class Report(Shown):
    """What a command found in a take, or did to it.

    Attributes
    ----------
    input : str
        The take as it was named; "-" is standard input; of compare OTHER.
    animation : str or None
        Which take of a file that holds several; left out where it holds one.
    output : str or None
        Where the result was written; null where none is.
    kind : {"joints", "markers"}
        What the tracks are.
    format : str or None
        Of the input: "bvh", "c3d".
    frames : int
        Of the file.
    first_frame : int
        The number that the file gives to its first frame; all frames of the report are counted like
        this.
    frame_rate_hz : float
        Of the file.
    calibration_frames : int or None
        Frames at the start that are a pose and no motion; null where the command does not look for
        them.
    unit : str or None
        Of lengths in the file; null where it does not say.
    metres_per_unit : float or None
        Null where it is not known; of check also what makes the body a person.
    track_unit : str or None
        Of figures of tracks whose name does not tell: "deg" of joints, the file's unit of markers.
    verdict : str or None
        One line for people; null of compare.
    method : str or None
        Clean.
    source : {"optical", "suit", "video", "depth", "keyframed", "unknown"} or None
        Clean, check: what counted as the source of the motion.
    source_reason : str or None
        Clean, check: "given", "not known", or where the file says it.
    options : dict[str, bool | float | str] or None
        Clean: of the method, all with their values.
    noise : list[Noise] or None
        Clean, check: what the noise of rotations and that of positions is like, measured in the
        same way whatever the method, and what a model expects (is_expected); none of what is clean.
    fall_backs : list[FallBack] or None
        Clean: what another method did in place of the one that was asked for.
    notes : list[str] or None
        Clean: what the method left alone and why, or could not use, one a line.
    leftovers : list[Leftover] or None
        Clean: what cleaning does not mend.
    feet : Feet or None
    subjects : list[Subject] or None
        Check: of several people in a file of markers the feet of each.
    stands : Stands or None
    robot : Robot or None
    reference : str or None
        Compare: the take that is the truth.
    fit : {"none", "rigid", "gain-offset"} or None
        Compare, markers: how the reference was brought to the other take.
    unmatched : list[str] or None
        Compare, markers: those of the reference that the other take lacks.
    figures : Figures
    warnings : list[str]
        For people, one a line.
    diagnostics : list[Diagnostic]
        What the reader repaired.
    findings : list[Finding]
        What was wrong when, and what became of it: of check worst first, of others by track, then
        frame.
    tracks : list[Track]
        Joints or markers in the file's order; empty where the command looks at none of them.
    """

    input: str
    output: str | None
    kind: Literal["joints", "markers"]
    format: str | None
    frames: int
    first_frame: int
    frame_rate_hz: float
    calibration_frames: int | None
    unit: str | None
    metres_per_unit: float | None
    track_unit: str | None
    verdict: str | None
    figures: Figures
    warnings: list[str]
    diagnostics: list[Diagnostic]
    findings: list[Finding]
    tracks: list[Track]
    animation: str | None = None
    method: str | None = None
    source: Literal["optical", "suit", "video", "depth", "keyframed", "unknown"] | None = None
    source_reason: str | None = None
    options: dict[str, bool | float | str] | None = None
    noise: list[Noise] | None = None
    fall_backs: list[FallBack] | None = None
    notes: list[str] | None = None
    leftovers: list[Leftover] | None = None
    feet: Feet | None = None
    subjects: list[Subject] | None = None
    stands: Stands | None = None
    robot: Robot | None = None
    reference: str | None = None
    fit: Literal["none", "rigid", "gain-offset"] | None = None
    unmatched: list[str] | None = None

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Report:
        """The same from a JSON object. Raises TypeError for a key that there is not."""
        values = dict(data)
        if data.get("noise") is not None:
            values["noise"] = [Noise.from_dict(row) for row in data["noise"]]
        if data.get("fall_backs") is not None:
            values["fall_backs"] = [FallBack.from_dict(row) for row in data["fall_backs"]]
        if data.get("leftovers") is not None:
            values["leftovers"] = [Leftover.from_dict(row) for row in data["leftovers"]]
        if data.get("feet") is not None:
            values["feet"] = Feet.from_dict(data["feet"])
        if data.get("subjects") is not None:
            values["subjects"] = [Subject.from_dict(row) for row in data["subjects"]]
        if data.get("stands") is not None:
            values["stands"] = Stands.from_dict(data["stands"])
        if data.get("robot") is not None:
            values["robot"] = Robot.from_dict(data["robot"])
        if data.get("figures") is not None:
            values["figures"] = Figures.from_dict(data["figures"])
        if data.get("diagnostics") is not None:
            values["diagnostics"] = [Diagnostic.from_dict(row) for row in data["diagnostics"]]
        if data.get("findings") is not None:
            values["findings"] = [Finding.from_dict(row) for row in data["findings"]]
        if data.get("tracks") is not None:
            values["tracks"] = [Track.from_dict(row) for row in data["tracks"]]
        return cls(**values)


@dataclass(frozen=True, kw_only=True, repr=False)
class DamageReport(Shown):
    """What a damage did, as in the JSON of `kinemend corrupt --json`.

    Attributes
    ----------
    damage : str
        Its name.
    samples : int
        Of joints, or of markers that are seen.
    samples_damaged : int
        Of these, those that it changed.
    rms_deg, max_deg : float
        Angles between local rotations; of positions as arcs.
    rms_position : float
        Of positions, in the unit of the take.
    notes : list of str
        What was done otherwise than asked.
    """

    damage: str
    samples: int
    samples_damaged: int
    rms_deg: float
    max_deg: float
    rms_position: float
    notes: list[str]
