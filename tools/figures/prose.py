"""Finds numbers of prose: those that repeat a figure of a table, and those that look measured."""
import re
from collections.abc import Iterator

from figures.markers import COMMENT, END, START, is_fence

UNITS = r"%|percent|s|ms|us|min|minutes?|seconds?|hours?|mm|cm|m|degrees?|deg|rad|Hz|dB|[kMG]B|MB/s|GB/s|times"
MEASURED = re.compile(rf"(?<![\w.])(?:\d+(?:,\d{{3}})*\.\d+|\d+(?:,\d{{3}})+|\d+(?= (?:{UNITS})\b| %))(?:(?: (?:{UNITS}))(?!\w))?")
# Code, comments and links.
SKIPPED = re.compile(COMMENT.pattern + r"|``.*?``|`[^`]*`|\]\([^)]*\)|https?://\S+")
DECIMAL = re.compile(r"(?<![\w.,/])\d+(?:,\d{3})*\.\d+(?!\w|\.\d)")


def numbered_prose(lines: list[str]) -> Iterator[tuple[int, str]]:
    """The lines of a page outside of code and generated tables, with their line numbers and without links."""
    code = marked = False
    for number, line in enumerate(lines, 1):
        if is_fence(line):
            code = not code
        marked = (marked or bool(START.fullmatch(line))) and line != END
        if not code and not marked and not line.startswith("    "):
            yield number, SKIPPED.sub(" ", line)


def repeated(lines: list[str], printed: set[str]) -> list[tuple[int, str]]:
    """The numbers of the prose that are figures of a table too, with their lines.

    Two numbers with a decimal point and three significant digits are hardly equal by chance. Shorter ones often are, such as settings.
    """
    return [(number, text) for number, line in numbered_prose(lines) if not line.startswith("|") for text in DECIMAL.findall(line)
            if text in printed and len(re.sub(r"\D", "", text).lstrip("0")) >= 3]


def unpinned(lines: list[str]) -> Iterator[str]:
    """Lines with numbers that look measured and are in no generated table."""
    for number, line in numbered_prose(lines):
        if found := [match.group() for match in MEASURED.finditer(line)]:
            yield f"{number}: {'; '.join(found)}: {lines[number - 1].strip()}"
