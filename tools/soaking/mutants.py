"""Mutated inputs and odd command lines."""
import pathlib
import shutil

from . import outputs
from .mutations import mutate
from .program import odd_characters
from .seeds import FIXTURES, TAKE_FORMATS, fixtures

# Mutated inputs and their frequency per hundred trials.
CASES = {"take": 48, "gaps": 8, "contacts": 7, "plan": 9, "config": 8, "model": 7, "noise": 4, "list": 4, "words": 5}
OUTPUTS = ("bvh", "csv", "trc", "tsv", "c3d", "glb", "amc")
METHODS = ("auto", "median", "butterworth", "gaussian", "one-euro", "kalman", "hampel", "weighted-mean", "wiener")
ODD_WORDS = ["nan", "inf", "1e999", "-1", "0", "", " ", "\x1b[31m", "a" * 3000, "\u202e", "--", "-", "-x", "=", "*", "../x", "1:0", "0s:9s",
             "18446744073709551615", "9" * 400, "%n", "\udcff"]
VALUED = ["--strength", "--cutoff-hz", "--range", "--joints", "--method", "--preset", "--noise", "--fill", "--feet", "--source", "--max-change-deg",
          "--max-change", "--peak-loss-limit", "--seed", "--jobs", "--exclude", "--config", "--gaps", "--from-fps", "--asf", "--report"]


def _take(rng, folder, seeds):
    """A mutated take, and a command on it."""
    paths = fixtures(rng.choice(TAKE_FORMATS))
    source = rng.choice(paths) if rng.random() < 0.85 else seeds.path(rng.choice(["short.bvh", "gaps.trc"]))
    name = "take" + source.suffix
    data = source.read_bytes()
    (folder / name).write_bytes(mutate(rng, data, rng.choice(paths).read_bytes(), name))
    if source.suffix == ".amc":
        asf = rng.choice(fixtures("asf")) if rng.random() < 0.2 else FIXTURES / "asf" / "good" / "figure.asf"
        text = asf.read_bytes()
        (folder / "take.asf").write_bytes(mutate(rng, text, data, "take.asf") if rng.random() < 0.4 else text)
    same = "out" + source.suffix
    kind = rng.randrange(10)
    if kind == 0:
        return ["info", name, *rng.choice([[], ["--json"]])], []
    if kind == 1:
        return ["check", name, *rng.choice([[], ["--json"]])], []
    if kind == 2:
        return ["compare", name, name, *rng.choice([[], ["--json"]])], []
    if kind == 3:
        return ["fill", name, "-o", same, *rng.choice([[], ["--fill-all"], ["--json"]])], [same]
    if kind <= 6:
        out = "out." + rng.choice(OUTPUTS)
        return ["convert", name, out, *rng.choice([[], [], ["--fps", "60"], ["--up", "y"], ["--unit", "m"]])], [out]
    report = rng.choice([[], ["--report", "report.json"], ["--report", "report.html"]])
    more = rng.choice([["-m", rng.choice(METHODS)], ["--fill", "auto"], ["--fix-swaps", "--fill", "auto"], ["--feet", "auto"], []])
    return ["clean", name, "-o", same, *more, *report], [same, *report[1:]]


def _beside(rng, folder, seeds, name, take, words):
    """A command on a whole take with a mutated file beside it."""
    (folder / take).write_bytes(seeds.bytes(take))
    others = [path for path in seeds.folder.iterdir() if path.suffix == pathlib.Path(name).suffix]
    (folder / name).write_bytes(mutate(rng, seeds.bytes(name), rng.choice(sorted(others)).read_bytes(), name))
    out = "out" + pathlib.Path(take).suffix
    return [*words[:1], take, *words[1:], "-o", out], [out]


def _gaps(rng, folder, seeds):
    words = rng.choice([["fill", "--gaps", "gaps.csv"], ["clean", "--gaps", "gaps.csv", "--fill", "auto"]])
    return _beside(rng, folder, seeds, "gaps.csv", "short.bvh", words)


def _contacts(rng, folder, seeds):
    return _beside(rng, folder, seeds, "contacts.txt", "walk.bvh", ["clean", "--contacts", "contacts.txt", "-m", "median"])


def _plan(rng, folder, seeds):
    name = rng.choice(["plan.csv", "plan.json"])
    return _beside(rng, folder, seeds, name, "gaps.trc", ["fill", "--plan", name])


def _config(rng, folder, seeds):
    words, outs = _beside(rng, folder, seeds, "config.toml", "short.bvh", ["clean", "--config", "config.toml"])
    return (words[:-2] + ["--print-config"], []) if rng.random() < 0.4 else (words, outs)


def _model(rng, folder, seeds):
    words, outs = _beside(rng, folder, seeds, "tiny.kmodel", "short.bvh",
                          ["clean", "-m", "kalman-learned", "--model", "tiny.kmodel"])
    return (["info", "tiny.kmodel", "--tree"], []) if rng.random() < 0.4 else (words, outs)


def _noise(rng, folder, seeds):
    return _beside(rng, folder, seeds, "noise.json", "short.bvh", ["clean", "--noise", "noise.json"])


def _list(rng, folder, seeds):
    for name in ("short.bvh", "walk.bvh"):
        shutil.copy(seeds.path(name), folder)
    (folder / "list.txt").write_bytes(mutate(rng, seeds.bytes("list.txt"), seeds.bytes("gaps.csv"), "list.txt"))
    return ["batch", "--list", "list.txt", "-o", "out", "-m", "median"], ["out"]


def _words(rng, folder, seeds):
    (folder / "short.bvh").write_bytes(seeds.bytes("short.bvh"))
    command = rng.choice(["clean", "fill", "check", "convert", "info", "compare", "corrupt", "stream", "batch", "plot", "synth", "x"])
    words = [command, *rng.choice([["short.bvh"], ["short.bvh", "short.bvh"], []])]
    for _ in range(rng.randint(1, 3)):
        words.insert(rng.randrange(1, len(words) + 1), rng.choice(ODD_WORDS))
        if rng.random() < 0.7:
            words += [rng.choice(VALUED), rng.choice(ODD_WORDS)]
    return words + ["-o", "out.bvh"] * (rng.random() < 0.5), None


MAKERS = {"take": _take, "gaps": _gaps, "contacts": _contacts, "plan": _plan, "config": _config, "model": _model,
          "noise": _noise, "list": _list, "words": _words}


def _broken_files(program, folder, before, outs, result):
    """Laws of the files in the folder after a run: whole results, nothing else, and no change of the inputs."""
    found = []
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if name in before:
            if before[name] != path.read_bytes():
                found.append(f"the input {name} was changed")
        elif path.is_file() and ".tmp" in path.name:
            found.append(f"the temporary file {name} was left")
        elif outs is not None and path.is_file() and name.split("/")[0] not in outs and not name.endswith(".asf"):
            found.append(f"the file {name} was not asked for")
    for out in outs or ():
        path = folder / out
        if path.is_file() and result.code not in (0, 1):
            found.append(f"exit code {result.code}, and {out} was written")
        elif path.is_dir() and result.code not in (0, 1) and not any(path.iterdir()):
            found.append(f"exit code {result.code}, and the empty folder {out} was left")
        elif not path.exists() and result.code == 0:
            found.append(f"exit code 0, and {out} was not written")
        elif path.is_file():
            if problem := outputs.not_finite_in(path):
                found.append(f"{out} {problem}")
            if path.suffix[1:] in OUTPUTS and path.suffix != ".glb":
                again = program.run(["info", out], folder, label="again")
                if again.code != 0:
                    found.append(f"{out} cannot be read again: {again.err.decode(errors='replace').strip()[:200]}")
    return found


def run(program, seeds, rng, folder, index):
    """One trial. Returns the row of the table, the findings and the commands."""
    case = rng.choices(list(CASES), list(CASES.values()))[0]
    words, outs = MAKERS[case](rng, folder, seeds)
    before = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    result = program.run([os_word(word) for word in words], folder)
    found = program.broken_laws(result)
    if case != "words":  # words may ask for a take on standard output
        found += odd_characters(result.out, "standard output")
    if "--json" in words and result.code == 0 and (problem := outputs.CHECKS[".json"](result.out)):
        found.append(f"standard output {problem}")
    return f"mutants: {case}", found + _broken_files(program, folder, before, outs, result), [result]


def os_word(word):
    return word.encode("utf-8", "surrogateescape")
