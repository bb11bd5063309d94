#!/usr/bin/env python3
"""Refuses comments that do not read as plain English: python3 tools/check_comments.py [FILE...]

A comment, and each of its sentences, has a subject: none begins with "Of", "What", "That" or "Those" without one. Phrases that readers
stumble over are refused too. Without a FILE it looks at every C++ file of the project; exit status 1 where it finds something.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMENT = re.compile(r"^\s*//[/!]?<?( ?)(.*)$|(?<=[;{},)])\s+//[/!]?<? ?(.*)$")
BEGINS = re.compile(r"(?:^|(?<=[.:;] ))(Of|What|That|Those)\b(?! (is|are|was|were)\b.{0,40}\?)", re.M)
PHRASES = re.compile(r"\b((?<!there )is none|(?<!there )are none|told of|as it is there|by right|for want of|is not to be had|are not to be had)\b")


def comments(text):
    """The comments of a C++ source, as (first line, text); lines that follow each other are one comment."""
    found, last = [], -1
    for number, line in enumerate(text.splitlines(), 1):
        match = COMMENT.search(line)
        if not match:
            continue
        own = match.group(2) is not None
        words = (match.group(2) if own else match.group(3)).strip()
        if own and last == number - 1 and found:
            found[-1][1].append(words)
        else:
            found.append((number, [words]))
        last = number if own else -1
    return [(number, " ".join(words)) for number, words in found]


def faults(text):
    for number, comment in comments(text):
        for pattern, why in ((BEGINS, "has no subject"), (PHRASES, "is no plain English")):
            match = pattern.search(comment)
            if match:
                yield number, f"'{comment[match.start():match.start() + 60]}' {why}"


def main():
    names = sys.argv[1:] or subprocess.run(["git", "ls-files", "*.cpp", "*.hpp"], cwd=ROOT, text=True, capture_output=True,
                                           check=True).stdout.split()
    count = 0
    for name in names:
        for number, why in faults((ROOT / name).read_text()):
            print(f"{name}:{number}: {why}")
            count += 1
    if count:
        print(f"check_comments: {count} comments to rewrite", file=sys.stderr)
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
