#!/usr/bin/env python3
"""Checks that the C++ snippet of docs/cpp.md is examples/clean_take.cpp, which is compiled and run as a test.

Usage: check_snippet.py [ROOT]    exit status 1 when they differ.
"""
import pathlib
import re
import sys


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    snippet = re.search(r"```cpp\n(.*?)\n```", (root / "docs" / "cpp.md").read_text(), re.DOTALL)
    example = (root / "examples" / "clean_take.cpp").read_text().split("\n", 1)[1].strip()
    if snippet is None or snippet.group(1).strip() != example:
        print("docs/cpp.md: the C++ snippet is not examples/clean_take.cpp")
        return 1
    print("docs/cpp.md: the snippet is the example that is compiled")
    return 0


if __name__ == "__main__":
    sys.exit(main())
