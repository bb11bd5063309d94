"""Keeps the number of figures that each page prints and of filled cells in each stored file.

Otherwise a deleted figure would go unnoticed, as the check of it is deleted too.
"""
import csv
from pathlib import Path

from figures.pages import Page
from figures.stored import Store, read_csv

Counts = dict[str, tuple[int, int]]  # figures, and pairs that orderings compare


def count(store: Store, pages: list[Page]) -> Counts:
    counts = {page.name: (page.figures, page.comparisons) for page in pages if page.figures or page.comparisons}
    for path in store.paths(quick=False) + store.paths(quick=True):
        _, rows = read_csv(path)
        counts[str(path.relative_to(store.root))] = (sum(bool(cell.strip()) for row in rows for cell in row), 0)
    return counts


def counts_path(store: Store) -> Path:
    return store.folder / "counts.csv"


def read_counts(store: Store) -> Counts:
    if not counts_path(store).is_file():
        return {}
    _, rows = read_csv(counts_path(store))
    return {row[0]: (int(row[1]), int(row[2])) for row in rows}


def differences(stored: Counts, found: Counts) -> list[str]:
    lines = []
    for name in sorted(stored.keys() | found.keys()):
        for index, what in enumerate(("figures", "compared pairs")):
            before, now = (counts.get(name, (0, 0))[index] for counts in (stored, found))
            if before != now:
                lines.append(f"{name}: {now} {what}, {'fewer' if now < before else 'more'} than the {before} of counts.csv")
    return lines


def write_counts(store: Store, counts: Counts) -> None:
    with open(counts_path(store), "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["file", "figures", "comparisons"])
        table.writerows([name, *numbers] for name, numbers in sorted(counts.items()))
