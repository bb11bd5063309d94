"""Reads the file beside a page, PAGE.figures.toml: the tables that the page prints and the orderings that its prose states."""
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from figures.claims import REDUCED, Claim
from figures.stored import FigureError

FORMAT = re.compile(r"(\+?)(,?)\.(\d+)f")
BOLD = ("lowest in row", "highest in row", "lowest in column", "highest in column")


@dataclass
class Part:
    """A template that is filled from one line of a stored file; `where` and `file` add to those of table, row and column."""
    template: str
    where: dict = field(default_factory=dict)
    file: str | None = None


@dataclass
class Column:
    title: str
    id: str
    part: Part
    bold: bool = True


@dataclass
class Row:
    title: str
    part: Part
    cells: dict[str, list[Part | str]]
    bold: bool = True
    format: str | None = None


@dataclass
class Table:
    name: str
    file: str | None
    where: dict
    row_title: str
    columns: list[Column]
    rows: list[Row]
    bold: str | None


@dataclass
class Ordering:
    """A sentence of the page, and the lines of a stored file whose order it states."""
    says: str
    file: str
    value: str
    lower: list[dict]
    higher: list[dict]
    for_each: list[str]
    where: dict
    ties: bool


@dataclass
class Spec:
    tables: list[Table]
    orderings: list[Ordering]
    claims: list[Claim]
    may_repeat: list[str]  # numbers of the prose that are not those of a table, although they look the same


def spec_path(page: Path) -> Path:
    return page.with_suffix(".figures.toml")


def read_spec(page: Path) -> Spec:
    """The specification of a page; an empty one if there is no file beside it."""
    path = spec_path(page)
    if not path.is_file():
        return Spec([], [], [], [])
    try:
        content = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise FigureError(f"{path.name}: {error}") from None
    take(content, "the file", {"table": list, "ordering": list, "claim": list, "prose": dict})
    prose = content.get("prose", {})
    take(prose, "[prose]", {"may_repeat": list})
    tables = [read_table(entry) for entry in content.get("table", [])]
    names = [table.name for table in tables]
    for name in names:
        if names.count(name) > 1:
            raise FigureError(f"{path.name}: two tables are named {name!r}")
    return Spec(tables, [read_ordering(entry) for entry in content.get("ordering", [])],
                [read_claim(entry) for entry in content.get("claim", [])], prose.get("may_repeat", []))


def take(entry: dict, place: str, types: dict, required: tuple[str, ...] = ()) -> None:
    """Throws if an entry has an unknown key, lacks a required one, or has a value of a wrong type."""
    if not isinstance(entry, dict):
        raise FigureError(f"{place}: expected a table of TOML, found {entry!r}")
    for key, value in entry.items():
        if key not in types:
            raise FigureError(f"{place}: unknown key {key!r}; known are {', '.join(types)}")
        if not isinstance(value, types[key]):
            raise FigureError(f"{place}: {key} has a value of a wrong type: {value!r}")
    for key in required:
        if key not in entry:
            raise FigureError(f"{place}: {key} is missing")


def read_table(entry: dict) -> Table:
    place = f"table {entry.get('name', '') if isinstance(entry, dict) else ''!r}"
    take(entry, place, {"name": str, "file": str, "where": dict, "row_title": str, "key": str, "columns": list, "rows": list,
                        "bold": str}, ("name", "columns", "rows"))
    if entry.get("bold") not in (None, *BOLD):
        raise FigureError(f"{place}: bold is one of {', '.join(BOLD)}")
    columns = [read_column(column, place) for column in entry["columns"]]
    ids = [column.id for column in columns]
    rows = [read_row(row, entry.get("key"), ids, place) for row in entry["rows"]]
    if not columns or not rows:
        raise FigureError(f"{place}: there are no columns or no rows")
    return Table(entry["name"], entry.get("file"), entry.get("where", {}), entry.get("row_title", ""), columns, rows,
                 entry.get("bold"))


def read_column(entry: dict, place: str) -> Column:
    take(entry, f"{place}, a column", {"title": str, "id": str, "print": str, "where": dict, "file": str, "bold": bool}, ("title",))
    part = Part(entry.get("print", ""), entry.get("where", {}), entry.get("file"))
    return Column(entry["title"], entry.get("id", entry["title"]), part, entry.get("bold", True))


def read_row(entry, key: str | None, ids: list[str], place: str) -> Row:
    """Reads a row: a table of TOML, or only its title. Without a filter it is the line whose `key` column holds the title."""
    if isinstance(entry, str):
        if key is None:
            raise FigureError(f"{place}: row {entry!r} is a text, so the table needs a `key`")
        entry = {"title": entry}
    take(entry, f"{place}, a row", {"title": str, "where": dict, "file": str, "cells": dict, "bold": bool,
                                  "format": str}, ("title",))
    if not FORMAT.fullmatch(entry.get("format", ".0f")):
        raise FigureError(f"{place}, row {entry['title']!r}: format is .2f, +.1f, ,.0f or the like")
    cells = {}
    for column, cell in entry.get("cells", {}).items():
        if ids.count(column) != 1:
            raise FigureError(f"{place}: row {entry['title']!r} has a cell for {column!r}, "
                              f"which is the title or id of {ids.count(column)} columns")
        cells[column] = [read_part(one, f"{place}, row {entry['title']!r}") for one in (cell if isinstance(cell, list) else [cell])]
    where = entry.get("where", {key: entry["title"]} if key else {})
    return Row(entry["title"], Part("", where, entry.get("file")), cells, entry.get("bold", True),
               entry.get("format"))


def read_part(entry, place: str) -> Part | str:
    """Reads a part of a cell: a text, or a table of TOML that prints figures, with the column's template if it has no `print`."""
    if isinstance(entry, str):
        return entry
    take(entry, place, {"print": str, "where": dict, "file": str})
    return Part(entry.get("print", ""), entry.get("where", {}), entry.get("file"))


def read_ordering(entry: dict) -> Ordering:
    place = f"ordering {entry.get('says', '') if isinstance(entry, dict) else ''!r}"
    take(entry, place, {"says": str, "file": str, "value": str, "lower": (dict, list), "higher": (dict, list), "for_each": list,
                        "where": dict, "ties": bool}, ("says", "file", "value", "lower", "higher"))
    sides = [entry[side] if isinstance(entry[side], list) else [entry[side]] for side in ("lower", "higher")]
    if not all(sides) or not all(isinstance(one, dict) for side in sides for one in side):
        raise FigureError(f"{place}: lower and higher are filters, or lists of filters")
    if not entry["says"].strip():
        raise FigureError(f"{place}: says is empty")
    return Ordering(entry["says"], entry["file"], entry["value"], *sides, entry.get("for_each", []), entry.get("where", {}),
                    entry.get("ties", False))


def read_claim(entry: dict) -> Claim:
    place = f"claim {entry.get('paper', '') if isinstance(entry, dict) else ''!r}"
    take(entry, place, {"of": str, "place": str, "paper": str, "here": str, "holds": str, "cannot": str, "why": str, "values": dict},
         ("of", "place", "paper"))
    if ("holds" in entry) == ("cannot" in entry):
        raise FigureError(f"{place}: it has one of holds and cannot")
    for name, value in entry.get("values", {}).items():
        take(value, f"{place}, value {name!r}", {"file": str, "column": str, "where": dict, "take": str}, ("file", "column"))
        if value.get("take", "list") not in REDUCED:
            raise FigureError(f"{place}, value {name!r}: take is one of {', '.join(REDUCED)}")
    return Claim(**entry)
