#!/usr/bin/env python3
"""Checks that the README's C++ snippet is examples/readme.cpp, which is compiled and run as a test.

Usage: check_readme.py [ROOT]    exit status 1 when they differ.
"""
import pathlib
import re
import sys


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    snippet = re.search(r"```cpp\n(.*?)\n```", (root / "README.md").read_text(), re.DOTALL)
    example = (root / "examples" / "readme.cpp").read_text().split("\n", 1)[1].strip()
    if snippet is None or snippet.group(1).strip() != example:
        print("README.md: the C++ snippet is not examples/readme.cpp")
        return 1
    print("README: the snippet is the example that is compiled")
    return 0


if __name__ == "__main__":
    sys.exit(main())
