"""Checks orderings that prose states ("`auto` is better than the Gaussian in every row") against the stored figures."""
from decimal import Decimal

from figures.spec import Ordering
from figures.stored import FigureError, Store, StoredFile, as_number


def find_side(file: StoredFile, ordering: Ordering, side: dict) -> dict[tuple, Decimal]:
    """The figures of one side, by the columns that pair the sides. Throws if there are none, or two for the same pair."""
    column = side.get("column", ordering.value)
    where = ordering.where | {key: wanted for key, wanted in side.items() if key != "column"}
    for name in (column, *ordering.for_each):
        file.require(name)
    found: dict[tuple, Decimal] = {}
    for line in file.select(where):
        pair = tuple(line[name].strip() for name in ordering.for_each)
        value = as_number(line[column])
        if value is None:
            raise FigureError(f"{file.name}: {column} is {line[column]!r} in the line {', '.join(filter(None, line.values()))!r}")
        if pair in found:
            raise FigureError(f"{file.name}: several lines have {describe(where)}{describe_pair(ordering, pair)}; "
                              "`where` or `for_each` must tell them apart")
        found[pair] = value
    if not found:
        raise FigureError(f"{file.name}: no line has {describe(where)}")
    return found


def describe(where: dict) -> str:
    return ", ".join(f"{column} = {wanted}" for column, wanted in where.items()) or "any values"


def describe_pair(ordering: Ordering, pair: tuple) -> str:
    return "".join(f", {column} = {value}" for column, value in zip(ordering.for_each, pair))


def describe_side(ordering: Ordering, side: dict) -> str:
    """The name of a side in messages: its filter, or its column if it has no filter."""
    filters = {key: wanted for key, wanted in side.items() if key != "column"}
    return ", ".join(filter(None, [describe(filters) if filters else "", side.get("column", "" if filters else ordering.value)]))


def compare(store: Store, ordering: Ordering) -> tuple[list[str], int]:
    """Complaints about pairs that are not in the stated order, and the number of pairs. Throws if a side or a pair is missing."""
    file = store.file(ordering.file)
    complaints, count = [], 0
    for lower in ordering.lower:
        for higher in ordering.higher:
            small, large = find_side(file, ordering, lower), find_side(file, ordering, higher)
            for pair in sorted(small.keys() ^ large.keys()):
                missing = lower if pair not in small else higher
                raise FigureError(f"{file.name}: {describe_side(ordering, missing)} has no line{describe_pair(ordering, pair)}")
            for pair, value in small.items():
                count += 1
                if value > large[pair] or (value == large[pair] and not ordering.ties):
                    complaints.append(f"{file.name}{describe_pair(ordering, pair)}: {describe_side(ordering, lower)} has {value}, "
                                      f"{describe_side(ordering, higher)} has {large[pair]}")
    return complaints, count
