"""Prints the licences of what a download holds: python3 tools/dist/licences.py wheel"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from dist.libraries import PARTS, licences_of  # noqa: E402

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in PARTS:
        sys.exit(f"{__doc__}\nParts: {', '.join(PARTS)}")
    sys.stdout.write(licences_of(sys.argv[1]))
