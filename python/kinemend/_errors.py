"""The one exception of the package, with the place in the file that it is about."""

from __future__ import annotations

import re
from typing import Literal

ErrorKind = Literal["quality_limit", "usage", "unreadable_input", "cannot_write"]

# The forms in which the library names a place: `walk.bvh:212: ...`, `trial.c3d: byte 512: ...`.
_LINE = re.compile(r"(?P<file>.+?):(?P<line>\d+): ", re.DOTALL)
_BYTE = re.compile(r"(?P<file>.+?): byte (?P<byte>\d+): ", re.DOTALL)
_FILE = re.compile(r"(?P<file>.+?): ", re.DOTALL)


class Error(Exception):
    """What went wrong, as one line for people.

    Attributes
    ----------
    kind : str
        "usage": an option, name or array that makes no sense. "unreadable_input": a file that cannot
        be opened or does not hold what its format demands. "cannot_write": an output that cannot be
        made, or exists. "quality_limit": a repair was needed under `strict`.
    file : str or None
        The file, where the error is about one.
    line : int or None
        Its line, counted from 1, of a text format.
    byte : int or None
        Its byte, counted from 0, of a binary format.
    """

    def __init__(self, message: str, kind: ErrorKind = "usage") -> None:
        super().__init__(message)
        self.kind: ErrorKind = kind
        self.file: str | None = None
        self.line: int | None = None
        self.byte: int | None = None
        # Messages about settings begin with the name of the setting.
        if kind == "usage":
            return
        for form in (_BYTE, _LINE, _FILE):
            if place := form.match(message):
                self.file = place["file"]
                self.line = int(place["line"]) if form is _LINE else None
                self.byte = int(place["byte"]) if form is _BYTE else None
                return

    def __reduce__(self) -> tuple[type[Error], tuple[str, ErrorKind]]:
        return (Error, (str(self), self.kind))
