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
    "representation": {"motion"},
    "metrics": {"motion", "signal"},
    "corrupt": {"motion"},
    "synth": {"motion"},
    "signal": {"base"},
    "tracks": {"rotation", "signal"},
    "fill": {"motion", "signal"},
    "nn": {"base"},
    "sparse": {"nn"},
    "priors": {"representation", "tracks", "nn", "sparse", "corrupt"},
    "feet": {"motion", "metrics"},
    "clean": {"representation", "tracks", "priors", "metrics", "fill", "feet"},
    "check": {"clean"},
    "stream": {"clean"},
    "live": {"io", "stream"},
    "report": {"check", "metrics"},
    "page": {"report"},
}

# The room of every public header.
PUBLIC = {
    "error": "base", "diagnostics": "base", "random": "base", "options": "base", "pose_matrix": "base",
    "version": "base", "json_depth": "base", "content_hash": "base", "frame_rate": "base", "rotation": "rotation", "skeleton": "motion", "clip": "motion", "take_view": "motion", "kinematics": "motion",
    "marker_clip": "motion", "convert": "motion", "gaps": "motion", "fill": "fill", "gap_plan": "fill", "check": "check",
    "io": "io", "representation": "representation", "metrics": "metrics", "corrupt": "corrupt",
    "synth": "synth", "signal": "signal", "cleaner": "clean", "methods": "clean", "clean": "clean",
    "stream": "stream", "live": "live", "tensor": "nn", "body": "representation", "model": "priors", "train": "priors",
    "feet": "feet", "frame_numbers": "motion", "text": "base", "report": "report", "batch_rows": "report", "svg": "report", "curves": "report", "pictures": "report", "page": "page", "known_names": "motion", "subjects": "motion",
}

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
    if len(parts) > 1 and parts[0] in USES:
        return parts[0]
    return None


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
                if not name.startswith("kinemend/") and not (path.parent / name).exists():
                    problems.append(f"{path.relative_to(root)}: a program sees include/ only, not {name}")
    return problems


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    missing = [room.name for room in (root / "src").iterdir() if room.is_dir() and room.name not in USES]
    problems = [f"src/{name}: no rule for this room" for name in missing] + check(root)
    print("\n".join(problems) if problems else "includes: every room looks the right way")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
