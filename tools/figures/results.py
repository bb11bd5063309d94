"""Compares what programs measured with what is stored, and stores it, with the reason where a figure moves."""
import csv
import datetime
import shutil
import subprocess
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from figures.stored import FigureError, Store, StoredFile, Tolerances, as_number

REASONS = ["date", "commit", "file", "moved", "largest", "reason"]


@dataclass
class Move:
    """A figure that differs from the stored one by more than its noise. `size` is the difference as a multiple of the noise."""
    file: str
    text: str
    size: Decimal


def key_length(*files: StoredFile) -> int:
    """The number of leading columns that name a line: the fewest by which all lines of each file differ."""
    for length in range(1, len(files[0].header)):
        if all(len({key_of(line, length) for line in file.lines}) == len(file.lines) for file in files):
            return length
    return len(files[0].header)


def key_of(line: dict[str, str], length: int) -> tuple:
    return tuple(cell.strip() for cell in list(line.values())[:length])


def compare_file(stored: StoredFile, measured: StoredFile, name: str, tolerances: Tolerances) -> tuple[list[Move], int]:
    """The figures that moved, with lines that are gone or new, and the number of figures compared."""
    endless = Decimal("Infinity")
    if stored.header != measured.header:
        return [Move(name, f"the columns are {', '.join(measured.header)}, stored {', '.join(stored.header)}", endless)], 0
    length = key_length(stored, measured)
    new_lines = {key_of(line, length): line for line in measured.lines}
    moves, count = [], 0
    for line in stored.lines:
        key = key_of(line, length)
        new_line = new_lines.pop(key, None)
        if new_line is None:
            moves.append(Move(name, f"{', '.join(key)}: the line is gone", endless))
            continue
        for column, cell in list(line.items())[length:]:
            old, new = as_number(cell), as_number(new_line[column])
            if old is None or new is None:
                size = Decimal(0) if cell == new_line[column] else endless
            else:
                size, count = tolerances.excess(stored.name, old, new), count + 1
            if size > 1:
                moves.append(Move(name, f"{', '.join(key)}: {column} {cell or '(empty)'} -> {new_line[column] or '(empty)'}", size))
    moves += [Move(name, f"{', '.join(key)}: the line is new", endless) for key in new_lines]
    return moves, count


def compare_results(store: Store, folder: Path, quick: bool) -> tuple[list[str], int]:
    """Complaints about figures that moved, and the number of figures compared."""
    complaints, count = [], 0
    for path in store.paths(quick):
        # tools/ablation takes an hour and is run by hand; tools/run_benchmarks makes the speeds.
        if path.name == "speeds.csv" or path.name.startswith("ablation_"):
            continue
        if not (folder / path.name).is_file():
            complaints.append(f"{path.name}: not among the results in {folder}")
            continue
        moves, compared = compare_file(StoredFile(path), StoredFile(folder / path.name), path.name, Tolerances(store))
        complaints += [f"{move.file}: {move.text}" for move in moves]
        count += compared
    return complaints, count


def compare_speeds(store: Store, folder: Path) -> tuple[list[str], int]:
    """Complaints about passes that take much longer than stored and benchmarks that are gone, and the number of passes."""
    stored, measured = store.file("speeds.csv"), StoredFile(folder / "speeds.csv")
    factor, complaints = Tolerances(store).of["speeds.csv"][1], []
    times = {key_of(line, 3): line["ms"] for line in measured.lines}
    for line in stored.lines:
        name, found = " ".join(key_of(line, 3)), times.get(key_of(line, 3))
        if found is None:
            complaints.append(f"speeds.csv: {name}: not among the results in {folder}")
        elif Decimal(found) > factor * Decimal(line["ms"]):
            complaints.append(f"speeds.csv: {name}: {found} ms, stored {line['ms']}")
    return complaints, len(stored.lines)


def store_results(store: Store, folder: Path, quick: bool, names: list[str], reason: str) -> int:
    """Stores the files of a folder that are stored already, and those named. Returns the exit status.

    Stores nothing and returns 1 if a figure moves by more than its noise and no reason is given.
    """
    target = store.folder / "quick" if quick else store.folder
    for name in names:
        if not (folder / name).is_file():
            raise FigureError(f"{name}: not among the results in {folder}")
    wanted = {path.name for path in store.paths(quick)} | set(names)
    results = [folder / name for name in sorted(wanted) if (folder / name).is_file() and (folder / name).stat().st_size]
    moves: list[Move] = []
    for path in results:
        if (target / path.name).is_file():
            name = str((target / path.name).relative_to(store.folder))
            moves += compare_file(StoredFile(target / path.name), StoredFile(path), name, Tolerances(store))[0]
    for move in moves:
        print(f"{move.file}: {move.text}")
    if moves and not reason.strip():
        print(f"Figures that move by more than their noise: {len(moves)}. Nothing was stored; find out why, then add: --reason \"...\"")
        return 1
    for path in results:
        target.mkdir(exist_ok=True)
        shutil.copyfile(path, target / path.name)
        print("stored", (target / path.name).relative_to(store.root))
    if moves:
        keep_reason(store, moves, reason)
    print("Now write the tables and counts: tools/check_figures --write")
    return 0


def keep_reason(store: Store, moves: list[Move], reason: str) -> None:
    """Adds a line for each file with figures that moved."""
    path = store.folder / "reasons.csv"
    is_new = not path.is_file()
    with open(path, "a", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        if is_new:
            table.writerow(REASONS)
        for name in sorted({move.file for move in moves}):
            of_file = [move for move in moves if move.file == name]
            # New or removed lines have no size; a figure is more informative if there is one.
            largest = max(of_file, key=lambda move: (move.size.is_finite(), move.size))
            table.writerow([datetime.date.today().isoformat(), current_commit(store.root), name, len(of_file), largest.text,
                            " ".join(reason.split())])


def current_commit(root: Path) -> str:
    """The commit that the new figures build on; empty outside of Git."""
    try:
        done = subprocess.run(["git", "-C", root, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()
