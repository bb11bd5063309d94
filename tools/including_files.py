#!/usr/bin/env python3
"""Lists the sources of src/, cli/ and lab/ that are among the files named, or include a header that is, directly or not.

Usage: including_files.py FILE...
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
ROOTS = (pathlib.Path("include"), pathlib.Path("lab/include"), pathlib.Path("src"), pathlib.Path("."))


def included(path):
    """The project's headers that a file names."""
    for name in INCLUDE.findall(path.read_text()):
        for root in (*ROOTS, path.parent):
            if (root / name).is_file():
                yield (root / name).resolve()


def reaches(path, changed, known):
    """Whether a file is among the changed ones or includes one of them."""
    path = path.resolve()
    if path not in known:
        known[path] = path in changed
        known[path] = known[path] or any([reaches(header, changed, known) for header in included(path)])
    return known[path]


def main():
    changed = {pathlib.Path(name).resolve() for name in sys.argv[1:]}
    known = {}
    for folder in ("src", "cli", "lab/damage", "lab/samples", "lab/synthesis", "lab/training"):
        for path in sorted(pathlib.Path(folder).rglob("*.cpp")):
            if reaches(path, changed, known):
                print(path)


if __name__ == "__main__":
    main()
