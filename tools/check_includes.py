#!/usr/bin/env python3
"""Checks the direction of includes between the rooms of src/, and that programs see the public headers only.

Usage: check_includes.py [ROOT]    exit status 1 and a line for each include that breaks a rule.
"""
import pathlib
import re
import sys

# Which rooms a room may include; the closure is taken below.
USES = {
    "base": set(),
    "rotation": {"base"},
    "motion": {"rotation"},
    "io": {"motion"},
    "body": {"motion"},
    "signal": {"base"},
    "nn": {"base"},
    "metrics": {"motion", "signal"},
    "corrupt": {"motion"},
    "synth": {"motion"},
    "fill": {"motion", "signal"},
    "feet": {"motion", "metrics"},
    "methods/core": {"motion", "fill"},
    "methods/auto": {"methods/core", "signal"},
    "methods/filters": {"methods/core", "body", "metrics"},
    "learned/core": {"methods/auto", "body", "nn", "corrupt"},
    "learned/example": {"learned/core"},
    "learned/wiener": {"learned/core"},
    "learned/sparse": {"learned/core"},
    "learned/corrector": {"learned/core"},
    "learned/papers": {"learned/core"},
    "pipeline": {"methods/auto", "metrics", "fill", "feet"},
    "check": {"pipeline", "learned/corrector"},
    "report": {"check"},
    "registry": {"methods/filters", "learned/example", "learned/wiener", "learned/sparse", "learned/corrector",
                 "learned/papers"},
    "osc": {"base"},
    "live": {"io", "pipeline", "registry", "osc"},
    "all": {"report", "live"},  # the header that includes the stable ones
}

# The room of every public header.
PUBLIC = {header: room for room, headers in {
    "base": "error random options pose_matrix version json_depth content_hash frame_rate text threads wildcards letter_case",
    "rotation": "rotation",
    "motion": "skeleton take take_view kinematics convert gaps frame_numbers subjects",
    "io": "io",
    "body": "representation body",
    "signal": "signal",
    "nn": "tensor",
    "metrics": "metrics",
    "corrupt": "corrupt",
    "synth": "synth",
    "fill": "fill gap_plan",
    "feet": "feet normalise",
    "methods/core": "cleaner methods",
    "learned/core": "model train",
    "pipeline": "clean stream",
    "check": "check",
    "report": "report batch_rows svg curves pictures page",
    "live": "live vmc",
    "all": "kinemend",
}.items() for header in headers.split()}

# Folders of programs: they see include/ (and their own folder) only.
PROGRAMS = ["cli", "examples", "tools", "python", "web"]

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def closure(room):
    seen, todo = set(), [room]
    while todo:
        current = todo.pop()
        if current not in seen:
            seen.add(current)
            todo.extend(USES[current])
    return seen


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".cpp", ".hpp", ".h"})


def room_of_include(name):
    """The room an include belongs to; None for a file of the includer's own folder."""
    parts = pathlib.PurePosixPath(name).parts
    if parts[0] == "kinemend":
        return PUBLIC.get(pathlib.PurePosixPath(parts[-1]).stem, "unknown")
    return next((room for room in ("/".join(parts[:2]), parts[0]) if len(parts) > 1 and room in USES), None)


def check(root):
    problems = []
    for header in sources(root / "include"):
        if header.stem not in PUBLIC:
            problems.append(f"{header.relative_to(root)}: no room is named for this public header")
        if header.parent.name != "experimental" and "experimental/" in "".join(INCLUDE.findall(header.read_text())):
            problems.append(f"{header.relative_to(root)}: what stays may not include what is experimental")
    for room in USES:
        allowed = closure(room)
        files = sources(root / "src" / room)
        files += [header for header in sources(root / "include") if PUBLIC.get(header.stem) == room]
        for path in files:
            for name in INCLUDE.findall(path.read_text()):
                other = room_of_include(name)
                if other is not None and other not in allowed:
                    problems.append(f"{path.relative_to(root)}: room {room} may not include {name} (room {other})")
    for folder in PROGRAMS:
        for path in sources(root / folder):
            for name in INCLUDE.findall(path.read_text()):
                own = (path.parent / name).exists() or (root / folder / name).exists()
                if not name.startswith("kinemend/") and not own:
                    problems.append(f"{path.relative_to(root)}: a program sees include/ only, not {name}")
    return problems


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    folders = {path.parent.relative_to(root / "src") for path in sources(root / "src")}
    missing = sorted(str(folder) for folder in folders if not {str(folder), *map(str, folder.parents)} & set(USES))
    problems = [f"src/{name}: no rule for this room" for name in missing] + check(root)
    print("\n".join(problems) if problems else "includes: every room looks the right way")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
