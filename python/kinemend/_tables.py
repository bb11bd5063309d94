"""The tables of the library: methods with their options, ways to fill, damages and formats."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from . import _core

OptionValue = bool | int | float | str
_GivenOption = OptionValue | os.PathLike[str]


@dataclass(frozen=True)
class Option:
    """One option of a method: its range is `minimum` to `maximum`, or one of `choices`."""

    name: str
    unit: str
    default: OptionValue
    minimum: float
    maximum: float
    choices: list[str]
    help: str


@dataclass(frozen=True)
class Method:
    """A cleaning method. `live`: the options that it needs to run live; None if it cannot."""

    name: str
    summary: str
    paper: str
    learned: bool
    ships_model: bool
    live: dict[str, OptionValue] | None
    options: list[Option]


@dataclass(frozen=True)
class FillMethod:
    """A way to fill gaps. `rules`: which gaps it accepts."""

    name: str
    summary: str
    paper: str
    rules: str
    markers: bool
    joints: bool
    learned: bool


@dataclass(frozen=True)
class DamageKind:
    """A way to damage takes."""

    name: str
    summary: str
    paper: str
    options: list[Option]


@dataclass(frozen=True)
class Training:
    """A method that `train` makes models for, with the options of the training."""

    name: str
    summary: str
    options: list[Option]


@dataclass(frozen=True)
class FileFormat:
    """A file format."""

    name: str
    description: str
    extensions: list[str]
    reads: bool
    writes_joints: bool
    writes_markers: bool


def _with_options(row: dict[str, Any]) -> dict[str, Any]:
    return {**row, "options": [Option(**option) for option in row["options"]]}


@cache
def methods() -> tuple[Method, ...]:
    """All cleaning methods.

    Examples
    --------
    >>> [method.name for method in kinemend.methods()][:3]
    ['auto', 'bilateral', 'nonlocal']
    >>> [option.name for option in kinemend.methods()[0].options]
    ['sensitivity', 'despike']
    """
    return tuple(Method(**_with_options(row)) for row in _core.method_table())


@cache
def fill_methods() -> tuple[FillMethod, ...]:
    """All ways to fill gaps, `auto` first."""
    return tuple(FillMethod(**row) for row in _core.fill_method_table())


@cache
def damages() -> tuple[DamageKind, ...]:
    """All ways to damage takes, for tests and comparisons."""
    return tuple(DamageKind(**_with_options(row)) for row in _core.damage_table())


@cache
def trainings() -> tuple[Training, ...]:
    """All methods that `train` makes models for."""
    return tuple(Training(**_with_options(row)) for row in _core.training_table())


@cache
def formats() -> tuple[FileFormat, ...]:
    """All file formats."""
    return tuple(FileFormat(**row) for row in _core.format_table())


def plain_options(
    options: Mapping[str, _GivenOption] | None, more: Mapping[str, _GivenOption]
) -> dict[str, OptionValue]:
    """Both together, without the underscore that `lambda_` needs, and paths as texts."""
    given = {**(options or {}), **more}
    return {
        name.rstrip("_"): os.fspath(value) if isinstance(value, os.PathLike) else value
        for name, value in given.items()
    }


class Cleaner:
    """A method with its options. It never changes, and threads may share it.

    `kinemend.cleaners` has a function for each method, whose arguments are its options.

    Parameters
    ----------
    method : str
        Its name, as in `methods()`.
    options : mapping, optional
        Options by name. Those that are left out have their defaults.
    **more
        The same as keywords.

    Raises
    ------
    Error
        There is no such method or option, or a value is out of range.

    Examples
    --------
    >>> kinemend.Cleaner("butterworth", cutoff_hz=6)
    <kinemend.Cleaner butterworth cutoff_hz=6.0 order=4>
    """

    def __init__(
        self,
        method: str = "learned",
        options: Mapping[str, _GivenOption] | None = None,
        **more: _GivenOption,
    ) -> None:
        self._core = _core.CoreCleaner(method, plain_options(options, more))

    @property
    def name(self) -> str:
        """The name of the method."""
        return self._core.name

    @property
    def options(self) -> dict[str, OptionValue]:
        """Every option with its value."""
        return self._core.options

    def why_not_live(self, fps: float) -> str:
        """Why it does not run live at this frame rate, and what would; empty if it runs."""
        return self._core.why_not_live(fps)

    def __repr__(self) -> str:
        options = "".join(f" {name}={value!r}" for name, value in self.options.items())
        return f"<kinemend.Cleaner {self.name}{options}>"


def options_text(options: list[Option]) -> str:
    """The options as the section `Parameters` of a docstring in NumPy style."""
    return "\n".join(f"{option.name} : {type_text(option)}\n    {help_text(option)}" for option in options)


def type_text(option: Option) -> str:
    """ "float, default 8.0" """
    if option.choices:
        kind = "{" + ", ".join(f'"{choice}"' for choice in option.choices) + "}"
    else:
        kind = type(option.default).__name__
    default = f'"{option.default}"' if isinstance(option.default, str) else repr(option.default)
    return f"{kind}, default {default}"


def help_text(option: Option) -> str:
    """The help of an option as a sentence, with unit and range."""
    is_number = isinstance(option.default, (int, float)) and not isinstance(option.default, bool)
    notes = [option.unit] if option.unit else []
    if is_number:
        notes.append(f"{option.minimum:g} to {option.maximum:g}")
    help = option.help[:1].upper() + option.help[1:]
    return help + (f" ({', '.join(notes)})." if notes else ".")
