"""The same command gives the same bytes, twice on one core and twice on two."""
import shutil

from .program import last_line

METHODS = ("auto", "wiener", "sparse", "example", "bilateral", "nonlocal", "butterworth", "wavelet", "median", "kalman",
           "kalman-learned", "gaussian", "hampel", "one-euro", "weighted-mean")


def _commands(rng, index):
    """What runs, its input, and the file that holds the result; None: standard output."""
    method = METHODS[index // 2 % len(METHODS)]
    if index % 2 == 0:
        take = rng.choice(["walk.bvh", "markers.trc"])
        return f"clean -m {method}", ["clean", take, "-m", method], take
    return rng.choice([
        ("fill", ["fill", "gaps.trc", "--fill-all"], "gaps.trc"),
        ("clean --fill", ["clean", "gaps.trc", "--fill", "auto", "--fix-swaps"], "gaps.trc"),
        ("clean --feet", ["clean", "walk.bvh", "--feet", "auto"], "walk.bvh"),
        ("check", ["check", "walk.bvh", "--json"], None),
        ("compare", ["compare", "clean.bvh", "walk.bvh", "--json"], None),
        ("train", ["train", "kalman-learned", "clean.bvh"], "x.kmodel"),
        ("corrupt", ["corrupt", "clean.bvh", "--damage", "gaussian:std_deg=2", "--seed", str(rng.randrange(99))], "x.bvh"),
    ])


def run(program, seeds, rng, folder, index):
    name, words, like = _commands(rng, index)
    for seed in ("walk.bvh", "clean.bvh", "gaps.trc", "markers.trc"):
        shutil.copy(seeds.path(seed), folder)
    results, runs = [], []
    out = "out." + like.split(".")[1] if like else None
    found = []
    for cores in (1, 1, 2, 2):
        if out:
            (folder / out).unlink(missing_ok=True)
        runs.append(program.run([*words, *(["-o", out] if out else [])], folder, cores=cores))
        found += program.broken_laws(runs[-1])
        written = (folder / out).read_bytes() if out and (folder / out).is_file() else b""
        results.append((runs[-1].code, written if out else runs[-1].out))
        # A method that does not support this kind of take is refused equally each time.
        if runs[-1].code not in (0, 2):
            found.append(f"{name}: exit code {runs[-1].code}: {last_line(runs[-1].err)}")
    if results[0] != results[1] or results[2] != results[3]:
        found.append(f"{name}: two runs on the same cores differ")
    elif results[0] != results[2]:
        found.append(f"{name}: one core and two cores give different results")
    return f"determinism: {words[0]}", found, runs
