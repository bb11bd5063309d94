"""Generates the tables of pages from the stored figures."""
import re
from dataclasses import dataclass
from decimal import Decimal

from figures.spec import FORMAT, Column, Part, Row, Table
from figures.stored import FigureError, Store, as_number

# {column}, {column:.2f}, {column:,.0f}, {column:+.1f}, {column*1000:.0f}
FIELD = re.compile(r"\{([^{}:*]+)(?:\*([\d.eE+-]+))?(?::" + FORMAT.pattern + r")?\}")


@dataclass
class Cell:
    """The text of a cell, the number of figures in it, and the first of them, exact and as printed."""
    text: str
    figures: int = 0
    value: Decimal | None = None
    printed: Decimal | None = None


def print_number(stored: str, scale: str | None, sign: str, comma: str, digits: str) -> str:
    """A stored number with so many digits; zero has no minus."""
    value = as_number(stored)
    if value is None:
        raise FigureError(f"{stored!r} is not a number")
    rounded = round(float(value) * float(scale or 1), int(digits))
    return format(rounded or 0.0, f"{sign}{comma}.{digits}f")


def fill_template(template: str, line: dict[str, str], name: str, row_format: str | None = None) -> Cell:
    """The template with the figures of a line, in the format of the row if it has one. Throws if a figure is missing."""
    cell = Cell("")

    def fill(match: re.Match) -> str:
        column, scale, sign, comma, digits = match.groups()
        if column not in line:
            raise FigureError(f"{name} has no column {column!r}")
        stored = line[column].strip()
        if not stored:
            raise FigureError(f"{name}: {column} is empty in the line {', '.join(filter(None, line.values()))!r}")
        if row_format and digits is not None:
            sign, comma, digits = FORMAT.fullmatch(row_format).groups()
        text = stored if digits is None else print_number(stored, scale, sign, comma, digits)
        cell.figures += 1
        if cell.value is None and (exact := as_number(stored)) is not None:
            cell.value, cell.printed = exact * Decimal(scale or 1), as_number(text.lstrip("+"))
        return text
    cell.text = FIELD.sub(fill, template)
    if "{" in FIELD.sub("", template) or "}" in FIELD.sub("", template):
        raise FigureError(f"the template {template!r} has a field that is not {{column}}, {{column:.2f}}, {{column:,.0f}} or the like")
    return cell


def find_cell(store: Store, table: Table, row: Row, column: Column, part: Part) -> Cell:
    """One part of a cell. Table, row, column and part may each narrow the filter, and each may name another file."""
    template = part.template or column.part.template
    if "{" not in template:
        return Cell(template)
    name = part.file or row.part.file or column.part.file or table.file
    if name is None:
        raise FigureError(f"row {row.title!r}, column {column.title!r}: no file is named")
    where = table.where | row.part.where | column.part.where | part.where
    lines = store.file(name).select(where)
    cells = [fill_template(template, line, name, None if part.template else row.format) for line in lines]
    if len({cell.text for cell in cells}) != 1:
        raise FigureError(f"row {row.title!r}, column {column.title!r}: {len(lines) or 'no'} lines of {name} have {say(where)}")
    return cells[0]


def say(where: dict) -> str:
    return ", ".join(f"{column} = {wanted!r}" for column, wanted in where.items()) or "no filter"


def whole_cell(store: Store, table: Table, row: Row, column: Column) -> Cell:
    parts = row.cells.get(column.id, [Part("")])
    cells = [Cell(part) if isinstance(part, str) else find_cell(store, table, row, column, part) for part in parts]
    first = next((cell for cell in cells if cell.value is not None), Cell(""))
    return Cell("".join(cell.text for cell in cells), sum(cell.figures for cell in cells), first.value, first.printed)


def make_bold(table: Table, cells: list[list[Cell]]) -> None:
    """Prints the best figures in bold, with those that look the same."""
    if table.bold is None:
        return
    best_of = min if table.bold.startswith("lowest") else max
    grid = [[cell if column.bold and row.bold and cell.value is not None else None for cell, column in zip(row_cells, table.columns)]
            for row_cells, row in zip(cells, table.rows)]
    for group in grid if table.bold.endswith("row") else zip(*grid):
        taking_part = [cell for cell in group if cell is not None]
        best = best_of(taking_part, key=lambda cell: cell.value, default=None)
        for cell in taking_part:
            if cell.printed == best.printed:
                cell.text = f"**{cell.text}**"


def generate(store: Store, table: Table) -> tuple[list[str], int]:
    """The lines of a table in Markdown, and the number of figures in it. Throws if a figure is not found."""
    cells = [[whole_cell(store, table, row, column) for column in table.columns] for row in table.rows]
    figures = sum(cell.figures for row_cells in cells for cell in row_cells)
    make_bold(table, cells)
    lines = [[table.row_title, *(column.title for column in table.columns)]]
    lines += [[row.title, *(cell.text for cell in row_cells)] for row, row_cells in zip(table.rows, cells)]
    for text in (text for line in lines for text in line):
        if re.search(r"(?<!\\)\||\n", text):
            raise FigureError(f"the cell {text!r} holds a bar or the end of a line")
    printed = ["|" + "|".join(f" {text} " if text else " " for text in line) + "|" for line in lines]
    return [printed[0], "|" + "---|" * len(lines[0]), *printed[1:]], figures
