"""SIGKILL at a random moment: results are the old file or the new one, and the next run does its work."""
import os
import shutil
import signal
import time

from .program import last_line, signal_to

OLD = b"an earlier result\n"
KILLS = 3
SINGLE = {
    "clean": ["clean", "walk.bvh", "-o", "out.bvh", "--force", "-m", "auto"],
    "fill": ["fill", "gaps.trc", "-o", "out.trc", "--force"],
    "convert": ["convert", "walk.bvh", "out.c3d", "--force"],
}


def _kill(program, words, folder, after):
    began = time.monotonic()
    process = program.start(words, folder, label="killed")
    time.sleep(after)
    signal_to(process, signal.SIGKILL)
    return program.finish(process, words, began, label="killed")


def _temporaries(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if ".tmp" in path.name)


def _single(program, seeds, rng, folder, command):
    words = SINGLE[command]
    shutil.copy(seeds.path(words[1]), folder)
    out = folder / words[words.index("--force") - 1]
    whole = program.run(words, folder)
    if whole.code != 0:
        return [f"exit code {whole.code}: {last_line(whole.err)}"], [whole]
    new, found, runs = out.read_bytes(), [], [whole]
    for _ in range(KILLS):
        out.write_bytes(OLD)
        runs.append(_kill(program, words, folder, rng.uniform(0, 1.1) * whole.seconds))
        if not out.is_file() or out.read_bytes() not in (OLD, new):
            found.append(f"{out.name} is neither the old file nor the new one")
    again = program.run(words, folder)
    if again.code != 0 or out.read_bytes() != new:
        found.append(f"the run after a kill gave exit code {again.code} or another result: {last_line(again.err)}")
    return found, [*runs, again]


def _takes(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.suffix in (".bvh", ".trc") and not path.name.startswith(".")}


def _batch(program, seeds, rng, folder, _):
    tree = folder / "in"
    (tree / "sub").mkdir(parents=True)
    for i, name in enumerate(["short.bvh", "walk.bvh", "markers.trc"]):
        shutil.copy(seeds.path(name), tree / f"{i}-{name}")
        shutil.copy(seeds.path(name), tree / "sub" / name)
    words = ["batch", "in", "-o", "out", "-m", "median"]
    whole = program.run(words, folder)
    if whole.code != 0:
        return [f"exit code {whole.code}: {last_line(whole.err)}"], [whole]
    expected, found, runs = _takes(folder / "out"), [], [whole]
    shutil.rmtree(folder / "out")
    for _ in range(KILLS):
        runs.append(_kill(program, words, folder, rng.uniform(0, 1.1) * whole.seconds))
        for name, data in _takes(folder / "out").items():
            if expected.get(name) != data:
                found.append(f"{name} is not whole after a kill")
    # A batch removes temporary files only after an hour, because another machine may still write them; this ages them.
    for name in _temporaries(folder / "out"):
        os.utime(folder / "out" / name, (time.time() - 7200,) * 2)
    again = program.run(words, folder)
    if again.code != 0 or _takes(folder / "out") != expected:
        found.append(f"the batch after a kill gave exit code {again.code} or other results: {last_line(again.err)}")
    if left := _temporaries(folder / "out"):
        found.append(f"temporary files are left after the last run: {', '.join(left)}")
    return found, [*runs, again]


def run(program, seeds, rng, folder, index):
    """One trial: a whole run, kills, and the run after them."""
    command = ["clean", "batch", "fill", "batch", "convert"][index % 5]
    found, runs = (_batch if command == "batch" else _single)(program, seeds, rng, folder, command)
    return f"kills: {command}", found, runs
