"""What a paper states beside the stored figures: each claim holds, does not hold, or cannot be compared."""
import re
from dataclasses import dataclass, field

from figures.prose import numbered_prose
from figures.stored import FigureError, Store, as_number

REDUCED = {"min": min, "max": max, "mean": lambda numbers: sum(numbers) / len(numbers), "list": list}
FUNCTIONS = {function.__name__: function for function in (min, max, abs, sum, len, all, any, sorted, zip, range)}
# Words that compare with a paper. They belong into a claim, whose figures are compared.
COMPARES = re.compile(r"\b(?:un)?like (?:in )?the paper\b(?!')|\b(?:as|than) in the paper\b|\bas the paper (?:says|states|reports|finds)\b", re.IGNORECASE)


@dataclass
class Claim:
    """`holds` is an expression of the values; `cannot` says why there is none."""
    of: str
    place: str
    paper: str
    here: str = ""
    holds: str = ""
    cannot: str = ""
    why: str = ""
    values: dict = field(default_factory=dict)


def find_value(store: Store, name: str, entry: dict):
    """The number of the one line that `where` selects, or what `take` makes of several."""
    file = store.file(entry["file"])
    file.require(entry["column"])
    numbers = []
    for line in file.select(entry.get("where", {})):
        number = as_number(line[entry["column"]])
        if number is None:
            raise FigureError(f"value {name!r}: {entry['column']} of {file.name} is {line[entry['column']]!r}")
        numbers.append(float(number))
    take = entry.get("take")
    if not numbers or (take is None and len(numbers) > 1):
        raise FigureError(f"value {name!r}: {len(numbers) or 'no'} lines of {file.name} are selected")
    return numbers[0] if take is None else REDUCED[take](numbers)


def verdict_of(claim: Claim, values: dict) -> str:
    """"yes", "no" or "not compared". Throws where the expression gives no verdict."""
    if claim.cannot:
        return "not compared"
    try:
        found = eval(claim.holds, {"__builtins__": {}, **FUNCTIONS, **values})  # noqa: S307: a file of the project
    except Exception as error:
        raise FigureError(f"{claim.holds!r}: {error}") from None
    if not isinstance(found, bool):
        raise FigureError(f"{claim.holds!r} is {found!r}, neither true nor false")
    if not found and not claim.why:
        raise FigureError("it does not hold, and `why` is missing")
    return "yes" if found else "no"


def describe(claim: Claim, values: dict) -> str:
    texts = []
    for template in (claim.here, claim.cannot or claim.why):
        try:
            texts.append(template.format(**values))
        except (KeyError, ValueError, IndexError, TypeError) as error:
            raise FigureError(f"the template {template!r}: {error!r}") from None
    return "; ".join(filter(None, texts))


def generate(store: Store, claims: list[Claim]) -> tuple[list[str], int]:
    """The lines of a table with a verdict on each claim, after a sentence that counts them; and the number of values."""
    rows, counts, figures = [], {"yes": 0, "no": 0, "not compared": 0}, 0
    for claim in claims:
        try:
            values = {name: find_value(store, name, entry) for name, entry in claim.values.items()}
            verdict = verdict_of(claim, values)
            cells = [claim.place, claim.paper, describe(claim, values), verdict]
        except FigureError as error:
            raise FigureError(f"claim {claim.paper!r}: {error}") from None
        if "|" in "".join(cells) or "\n" in "".join(cells):
            raise FigureError(f"claim {claim.paper!r}: a bar or the end of a line")
        counts[verdict] += 1
        figures += len(values)
        rows.append("| " + " | ".join(cells) + " |")
    compared = counts["yes"] + counts["no"]
    more = f"; {counts['not compared']} are not compared" if counts["not compared"] else ""
    return [f"| place | what the paper states: {counts['yes']} of {compared} claims hold{more} | here | holds |", "|---|---|---|---|", *rows], figures


def compare_in_words(lines: list[str]) -> list[tuple[int, str]]:
    """The lines outside of generated tables and of code that compare with a paper in words, with their numbers."""
    return [(number, match.group()) for number, line in numbered_prose(lines) for match in COMPARES.finditer(line)]
