"""Lists numbers of prose that look measured."""
import re
from collections.abc import Iterator
from pathlib import Path

from figures.pages import END, START, is_fence

UNITS = r"%|percent|s|ms|us|min|minutes?|seconds?|hours?|mm|cm|m|degrees?|deg|rad|Hz|dB|[kMG]B|MB/s|GB/s|times"
MEASURED = re.compile(rf"(?<![\w.])(?:\d+(?:,\d{{3}})*\.\d+|\d+(?:,\d{{3}})+|\d+(?= (?:{UNITS})\b| %))(?:(?: (?:{UNITS}))(?!\w))?")
# Code, comments and links.
SKIPPED = re.compile(r"<!--.*?-->|``.*?``|`[^`]*`|\]\([^)]*\)|https?://\S+")


def unpinned(root: Path, path: Path) -> Iterator[str]:
    """Lines of a page with numbers that look measured and are in no generated table."""
    code = marked = False
    for number, line in enumerate(path.read_text().split("\n"), 1):
        if is_fence(line):
            code = not code
        marked = (marked or bool(START.fullmatch(line))) and line != END
        if code or marked or line.startswith("    "):
            continue
        if found := [match.group() for match in MEASURED.finditer(SKIPPED.sub(" ", line))]:
            yield f"{path.relative_to(root)}:{number}: {'; '.join(found)}: {line.strip()}"
