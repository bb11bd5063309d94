"""What the compiled module offers to the package."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

version: str

_Doubles = npt.NDArray[np.float64]
_Floats = npt.NDArray[np.float32]
_Marks = npt.NDArray[np.bool_]
_Indices = npt.NDArray[np.int32]
_Path = str | PathLike[str]
_Option = bool | int | float | str
_Progress = Callable[[str, float], object] | None
_Site = tuple[int, tuple[float, float, float], str]
_Diagnostic = tuple[str, str, int, int]

class Take:
    @staticmethod
    def of_joints(
        names: Iterable[str],
        parents: Sequence[int] | npt.NDArray[Any],
        offsets: npt.ArrayLike,
        rotations: npt.ArrayLike,
        positions: npt.ArrayLike | None = None,
        *,
        fps: float,
        translated_joints: Sequence[int] | npt.NDArray[Any] = ...,
        observed: npt.ArrayLike | None = None,
        observed_positions: npt.ArrayLike | None = None,
        rest_rotations: npt.ArrayLike | None = None,
        metres_per_unit: float = 0.0,
        rotation_order: str = "ZXY",
        end_sites: Sequence[_Site] = ...,
    ) -> Take: ...
    @staticmethod
    def of_markers(
        names: Iterable[str],
        positions: npt.ArrayLike,
        *,
        fps: float,
        observed: npt.ArrayLike | None = None,
        unit: str = "",
    ) -> Take: ...
    @property
    def rotations(self) -> _Doubles: ...
    @property
    def positions(self) -> _Doubles: ...
    @property
    def observed(self) -> _Marks: ...
    @property
    def observed_positions(self) -> _Marks: ...
    @property
    def residuals(self) -> _Floats | None: ...
    @property
    def parents(self) -> _Indices: ...
    @property
    def offsets(self) -> _Doubles: ...
    @property
    def rest_rotations(self) -> _Doubles: ...
    @property
    def translated_joints(self) -> _Indices: ...
    @property
    def is_position(self) -> _Marks: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def fps(self) -> float: ...
    @fps.setter
    def fps(self, fps: float) -> None: ...
    @property
    def kind(self) -> Literal["joints", "markers"]: ...
    @property
    def unit(self) -> str: ...
    @unit.setter
    def unit(self, unit: str) -> None: ...
    @property
    def metres_per_unit(self) -> float: ...
    @metres_per_unit.setter
    def metres_per_unit(self, metres: float) -> None: ...
    @property
    def first_frame(self) -> int: ...
    @property
    def name(self) -> str: ...
    @name.setter
    def name(self, name: str) -> None: ...
    @property
    def format(self) -> str: ...
    @property
    def animation(self) -> str: ...
    @property
    def animations(self) -> list[str]: ...
    @property
    def end_sites(self) -> list[_Site]: ...
    @property
    def rotation_orders(self) -> list[str]: ...
    @property
    def events(self) -> list[tuple[str, str, float]]: ...
    @property
    def facts(self) -> dict[str, str]: ...
    @property
    def _diagnostics(self) -> list[_Diagnostic]: ...
    def _addresses(self) -> dict[str, int]: ...
    def copy(self) -> Take: ...
    def __copy__(self) -> Take: ...
    def __deepcopy__(self, memo: dict[Any, Any]) -> Take: ...
    def __len__(self) -> int: ...
    def __getitem__(self, frames: slice) -> Take: ...
    def validate(self) -> None: ...
    def forward_kinematics(self) -> tuple[_Doubles, _Doubles]: ...

class CoreCleaner:
    def __init__(self, method: str, options: Mapping[str, _Option]) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def options(self) -> dict[str, _Option]: ...
    def why_not_live(self, fps: float) -> str: ...

class CoreReport:
    def to_json(self, with_spans: bool = True) -> str: ...
    def to_text(self) -> str: ...

class CoreStream:
    def __init__(self, cleaner: CoreCleaner, like: Take, body_height: float, source: str) -> None: ...
    @property
    def latency_frames(self) -> int: ...
    def push(
        self,
        rotations: npt.ArrayLike | None,
        positions: npt.ArrayLike,
        observed: npt.ArrayLike | None,
    ) -> tuple[_Doubles, _Doubles, _Marks] | None: ...
    def flush(self) -> tuple[_Doubles, _Doubles, _Marks] | None: ...
    def reset(self) -> None: ...

class Model:
    @staticmethod
    def read(path: _Path) -> Model: ...
    @property
    def method(self) -> str: ...
    @property
    def fps(self) -> float: ...
    @property
    def takes(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def kind(self) -> Literal["joints", "markers"]: ...
    def to_bytes(self) -> bytes: ...
    def write(self, path: _Path, *, overwrite: bool = False) -> None: ...

def read_path(
    path: _Path,
    format: str,
    strict: bool,
    skeleton: _Path,
    frame_rate_hz: float,
    animation: str,
    progress: _Progress,
) -> Take: ...
def read_bytes(
    bytes: bytes,
    name: str,
    format: str,
    strict: bool,
    skeleton: _Path,
    frame_rate_hz: float,
    animation: str,
    progress: _Progress,
) -> Take: ...
def write_path(take: Take, path: _Path, format: str, overwrite: bool) -> None: ...
def to_bytes(take: Take, format: str) -> bytes: ...
def losses(take: Take, format: str) -> list[_Diagnostic]: ...
def method_table() -> list[dict[str, Any]]: ...
def fill_method_table() -> list[dict[str, Any]]: ...
def damage_table() -> list[dict[str, Any]]: ...
def training_table() -> list[dict[str, Any]]: ...
def format_table() -> list[dict[str, Any]]: ...
def clean(
    take: Take,
    cleaner: CoreCleaner,
    *,
    strength: float,
    max_change_deg: float,
    max_change: float,
    joints: Iterable[str],
    exclude: Iterable[str],
    root_position: bool,
    range: tuple[int, int] | None,
    noise: tuple[float, Mapping[str, float]] | None,
    source: str,
    peak_loss_limit: float,
    fill: str | None,
    fill_all: bool,
    unlabelled: bool,
    feet: str | None,
    feet_names: Mapping[str, str],
    contacts: list[tuple[str, str, int, int]] | None,
    fix_swaps: bool,
    threads: int,
    progress: _Progress,
) -> tuple[Take, CoreReport]: ...
def fill(
    take: Take,
    *,
    method: str,
    names: Iterable[str],
    donor: str,
    longest_gap_s: float,
    fill_all: bool,
    max_error: float,
    max_error_deg: float,
    unlabelled: bool,
    range: tuple[int, int] | None,
    model: str,
    map: str,
) -> tuple[Take, CoreReport]: ...
def check(
    take: Take,
    *,
    up: str | None,
    metres_per_unit: float | None,
    feet_names: Mapping[str, str],
    robot: Mapping[str, float] | None,
    joint_limits: Mapping[str, Mapping[str, float]],
    source: str,
) -> CoreReport: ...
def contacts(take: Take, *, feet_names: Mapping[str, str]) -> CoreReport: ...
def compare(
    reference: Take,
    other: Take,
    *,
    psnr_peak: float,
    metres_per_unit: float | None,
    up: str,
    fit: str,
    fit_to: Take | None,
    lag_frames: int,
    least_motion: float,
) -> CoreReport: ...
def corrupt(
    take: Take, damages: Sequence[tuple[str, Mapping[str, _Option]]], seed: int
) -> tuple[Take, list[dict[str, Any]]]: ...
def train(
    method: str,
    takes: Sequence[Take | _Path],
    *,
    options: Mapping[str, _Option],
    names: Iterable[str],
    fill: str | None,
    seed: int,
    card: Mapping[str, str],
    threads: int,
    progress: _Progress,
) -> Model: ...
