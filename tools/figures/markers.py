"""The lines between which a page has a generated table, and the parts of Markdown that hold neither markers nor prose."""
import re

START = re.compile(r"<!-- table: (\S|\S.*\S) -->")
END = "<!-- end of table -->"
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
CODE_SPAN = re.compile(r"(`+).*?\1")
# Text that starts or ends a comment, or was meant to.
LIKE_A_MARKER = re.compile(r"<\s*!|-->|<-+\s*(?:table|end of table)\b|^\s*(?:table|end of table)\s*:?.*--\s*>")


def is_fence(line: str) -> bool:
    return line.lstrip().startswith(("```", "~~~"))


def fold(text: str) -> str:
    """The text with single blanks."""
    return " ".join(text.split())
