"""Reads the stored figures: the CSV files of lab/experiments/figures, their tolerances, and filters on their lines."""
import csv
import re
from decimal import Decimal
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:,\d{3})*(?:\.\d+)?(?:[eE][-+]?\d+)?")
# Files beside the figures that hold no figures.
NO_FIGURES = {"tolerances.csv", "counts.csv", "reasons.csv"}


class FigureError(Exception):
    """A figure, a marker or a specification is wrong; the text says where and how."""


def as_number(text: str) -> Decimal | None:
    """The number, or None if the text is anything else."""
    text = text.strip()
    return Decimal(text.replace(",", "")) if NUMBER.fullmatch(text) else None


def read_csv(path: Path) -> tuple[list[str], list[list[str]]]:
    """Header and lines of a CSV file. Throws if a line and the header differ in their number of cells."""
    with open(path, newline="") as file:
        header, *rows = [*csv.reader(file)] or [[]]
    for number, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise FigureError(f"{path.name}:{number}: expected {len(header)} cells, found {len(row)}")
    return header, rows


def fits(cell: str, wanted) -> bool:
    """Whether a cell is the wanted text or number, or one of a list of them."""
    if isinstance(wanted, list):
        return any(fits(cell, one) for one in wanted)
    if isinstance(wanted, (int, float)):
        return as_number(cell) == Decimal(str(wanted))
    return cell.strip() == wanted.strip()


class StoredFile:
    """One CSV file; each of its lines is a dictionary from column to text."""

    def __init__(self, path: Path):
        self.name = path.name
        self.header, rows = read_csv(path)
        self.lines = [dict(zip(self.header, row)) for row in rows]

    def select(self, where: dict) -> list[dict[str, str]]:
        """The lines in which each named column has the wanted text. Throws if a column is missing."""
        for column in where:
            self.require(column)
        return [line for line in self.lines if all(fits(line[column], wanted) for column, wanted in where.items())]

    def require(self, column: str) -> None:
        if column not in self.header:
            raise FigureError(f"{self.name} has no column {column!r}; it has {', '.join(self.header)}")


class Store:
    """The stored figures of a tree. Remembers which files were asked for."""

    def __init__(self, root: Path):
        self.root = root
        self.folder = root / "lab" / "experiments" / "figures"
        self.files: dict[str, StoredFile] = {}

    def file(self, name: str) -> StoredFile:
        if name not in self.files:
            if not (self.folder / name).is_file():
                raise FigureError(f"there is no stored file {(self.folder / name).relative_to(self.root)}")
            self.files[name] = StoredFile(self.folder / name)
        return self.files[name]

    def paths(self, quick: bool) -> list[Path]:
        """The stored files of the whole experiments, or of their quick forms."""
        folder = self.folder / "quick" if quick else self.folder
        return [path for path in sorted(folder.glob("*.csv")) if path.name not in NO_FIGURES]

    def unused(self) -> list[str]:
        """The files that nobody asked for. Those of quick forms serve only to compare results."""
        return [path.name for path in self.paths(quick=False) if path.name not in self.files]


class Tolerances:
    """The difference that is allowed between a figure and the stored one."""

    def __init__(self, store: Store):
        _, rows = read_csv(store.folder / "tolerances.csv")
        self.of = {row[0]: (Decimal(row[1]), Decimal(row[2])) for row in rows}

    def excess(self, name: str, stored: Decimal, measured: Decimal) -> Decimal:
        """The difference as a multiple of the allowed one. More than 1 is a move beyond the noise."""
        absolute, relative = self.of.get(name, self.of["*"])
        if name == "speeds.csv":
            # Machines differ: a time or rate may be several times larger or smaller.
            small, large = sorted([abs(stored), abs(measured)])
            return large / (relative * small) if small else Decimal(0 if not large else 1000)
        allowed = max(absolute, relative * abs(stored)) + Decimal("1e-12")
        return abs(stored - measured) / allowed
