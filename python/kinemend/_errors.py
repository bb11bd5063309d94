"""The exception of the package, with the place in the file that it is about."""

from __future__ import annotations

import errno
import os
import re
from typing import Literal

ErrorKind = Literal["quality_limit", "usage", "unreadable_input", "cannot_write"]

# The forms in which the library names a place: `walk.bvh:212: ...`, `trial.c3d: byte 512: ...`.
_LINE = re.compile(r"(?P<file>.+?):(?P<line>\d+): ", re.DOTALL)
_BYTE = re.compile(r"(?P<file>.+?): byte (?P<byte>\d+): ", re.DOTALL)
_FILE = re.compile(r"(?P<file>.+?): ", re.DOTALL)


class Error(Exception):
    """What went wrong, as one line for people.

    Where the system refuses a file, the error is also a `FileNotFoundError`, `PermissionError`,
    `FileExistsError` or `IsADirectoryError`.

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
        return (error_of, (str(self), self.kind))


class _SystemError(Error):
    """What the classes below share: the message of the library, and the attributes of `OSError`."""

    _number = 0

    def __init__(self, message: str, kind: ErrorKind) -> None:
        super().__init__(message, kind)
        self.errno = self._number
        self.strerror = os.strerror(self._number)
        self.filename = self.file

    def __str__(self) -> str:
        return str(self.args[0])


class FileNotFound(_SystemError, FileNotFoundError):
    _number = errno.ENOENT


class FileDenied(_SystemError, PermissionError):
    _number = errno.EACCES


class FileExists(_SystemError, FileExistsError):
    _number = errno.EEXIST


class FileIsFolder(_SystemError, IsADirectoryError):
    _number = errno.EISDIR


# The end of the library's message in the system's words; `exists already` is the library's own.
_BY_WORDS: dict[str, type[Error]] = {
    os.strerror(kind._number): kind for kind in (FileNotFound, FileDenied, FileExists, FileIsFolder)
}


def error_of(message: str, kind: ErrorKind) -> Error:
    """The error of the class that fits the message of the library."""
    error = Error(message, kind)
    if error.file is None:
        return error
    words = message[len(error.file) + 2 :]
    if kind == "cannot_write" and words.startswith("exists already"):
        return FileExists(message, kind)
    return _BY_WORDS.get(words, Error)(message, kind)
