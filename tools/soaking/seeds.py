"""Whole files that trials start from: the test fixtures, and small files that the program makes from the examples."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FIXTURES = ROOT / "tests" / "fixtures"
TAKE_FORMATS = ("bvh", "amc", "c3d", "trc", "tsv", "csv")
MOST_BYTES = 128 << 10
GAPS = b"name,first,last\nLeftArm,10,14\n'Right*',20,22\n*,30,31\n# a comment\n"


def fixtures(*formats):
    """Fixtures of these formats, good, bad and found, in the order of their names."""
    return sorted(path for name in formats for path in (FIXTURES / name).rglob(f"*.{name}")
                  if path.stat().st_size <= MOST_BYTES)


def cut_bvh(text, frames):
    """The first frames of a BVH file whose lines are whole."""
    head, rest = text.split(b"Frames:", 1)
    lines = rest.splitlines(keepends=True)
    return head + b"Frames: %d\n" % frames + b"".join(lines[1:2 + frames])


def with_gaps(trc):
    """A TRC file in which two markers are missing for some frames."""
    rows = trc.split(b"\n")
    for i, row in enumerate(rows):
        cells = row.split(b"\t")
        if not re.fullmatch(rb"\d+", cells[0]) or len(cells) < 30:
            continue
        frame = int(cells[0])
        if 11 <= frame <= 16:
            cells[8:11] = [b""] * 3
        if 14 <= frame <= 34:
            cells[20:23] = [b""] * 3
        rows[i] = b"\t".join(cells)
    return b"\n".join(rows)


class Seeds:
    """The files by name, made once for a run: `walk.bvh`, `markers.trc`, `plan.csv`, ..."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def path(self, name):
        return self.folder / name

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def make(self, program):
        """Problems, a line each: a command here is an ordinary one, and none may fail."""
        self.folder.mkdir(parents=True, exist_ok=True)
        noisy = (ROOT / "examples/takes/noisy_walk.bvh").read_bytes()
        clean = (ROOT / "examples/takes/walk.bvh").read_bytes()
        self.path("walk.bvh").write_bytes(cut_bvh(noisy, 120))
        self.path("clean.bvh").write_bytes(cut_bvh(clean, 120))
        self.path("short.bvh").write_bytes(cut_bvh(noisy, 40))
        self.path("gaps.csv").write_bytes(GAPS)
        self.path("list.txt").write_bytes(b"short.bvh\n# a comment\n\nwalk.bvh\n")
        problems = []
        for name, words in self._commands():
            if name == "plan.csv":
                self.path("gaps.trc").write_bytes(with_gaps(self.bytes("markers.trc")))
            result = program.run(words, self.folder, label="seed")
            problems += [f"{name}: {problem}" for problem in program.broken_laws(result)]
            if name == "config.toml":
                self.path(name).write_bytes(result.out)
            if result.code != 0 or not self.path(name).is_file():
                problems.append(f"{name}: `kinemend {' '.join(words)}` gave exit code {result.code}")
                self.path(name).write_bytes(self.path(name).read_bytes() if self.path(name).is_file() else b"")
        return problems

    @staticmethod
    def _commands():
        return [
            ("markers.trc", ["convert", "walk.bvh", "markers.trc", "--force"]),
            ("plan.csv", ["fill", "gaps.trc", "--dry-run", "--plan-out", "plan.csv", "--force"]),
            ("plan.json", ["fill", "gaps.trc", "--dry-run", "--plan-out", "plan.json", "--force"]),
            ("contacts.txt", ["contacts", "walk.bvh", "-o", "contacts.txt", "--force"]),
            ("config.toml", ["clean", "walk.bvh", "--print-config"]),
            ("noise.json", ["clean", "walk.bvh", "--dry-run", "--report", "noise.json", "--force"]),
            ("tiny.kmodel", ["train", "kalman-learned", "clean.bvh", "-o", "tiny.kmodel", "--force"]),
        ]
