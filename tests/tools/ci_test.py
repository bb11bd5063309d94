#!/usr/bin/python3
"""Tests that continuous integration types `make demo` and `make test` as README.md prints them, and sets nothing for them."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = ("make demo", "make test")
TYPED = re.compile(r"\bmake\b[^;&|]*\s(demo|test)(?![\w-])")
EXPORTED = re.compile(r"\bexport\b|\b(declare|typeset|local|readonly) -\w*x|\bset -\w*a")
# Variables used only by the script are in lower case; an assignment before a command ends with that command.
SET = re.compile(r"[A-Z]\w*\+?=(\S*|\"[^\"]*\"|'[^']*')$")


def printed_commands(readme):
    """The commands that begin with those two, in backticks or on lines of code blocks."""
    blocks = re.findall(r"(?ms)^```\w*\n(.*?)^```$", readme)
    code = [line.split("#")[0].strip() for block in blocks for line in block.splitlines()]
    code += re.findall(r"(?<!`)`([^`\n]+)`(?!`)", readme)
    return {text for text in code if TYPED.search(text)}


def statements(script):
    """The lines of a script of the shell, without comments."""
    lines = (re.sub(r"(^|\s)#.*", "", line).strip() for line in script.replace("\\\n", " ").splitlines())
    return [line for line in lines if line]


def problems(readme, script):
    """What keeps a script from typing the two commands as README.md prints them."""
    found = []
    printed = printed_commands(readme)
    if printed != set(COMMANDS):
        found.append(f"README.md prints {sorted(printed)}, not {list(COMMANDS)}")
    typed = [line.removeprefix("stage ") for line in statements(script) if TYPED.search(line)]
    found += [f".ci/run does not call {command}" for command in COMMANDS if command not in typed]
    found += [f".ci/run calls: {line}" for line in typed if line not in COMMANDS]
    found += [f".ci/run exports: {line}" for line in statements(script) if EXPORTED.search(line)]
    found += [f".ci/run sets a variable: {line}" for line in statements(script) if SET.match(line)]
    return found


SCRIPT = "set -euo pipefail\ntimes=()\nstage make lint\nstage make demo\nFUZZ_SECONDS=2 stage make fuzz\nstage make test  # last\n"
README = "`make demo` builds.\n\n```\nmake test    # all tests\nmake test-all\n```\n"


class Commands(unittest.TestCase):
    def test_are_typed_as_the_readme_prints_them(self):
        self.assertEqual(problems((ROOT / "README.md").read_text(), (ROOT / ".ci/run").read_text()), [])

    def test_in_another_form_or_with_variables_are_found(self):
        self.assertEqual(problems(README, SCRIPT), [])
        for before, after, named in (
                ("stage make test  # last\n", "", "does not call make test"),
                ("stage make demo", "make -C . demo", "does not call make demo"),
                ("stage make demo", "PRESET=ci make demo", "calls: PRESET=ci make demo"),
                ("stage make test", "TESTS=ci stage make test", "calls: TESTS=ci"),
                ("stage make test", "make test JOBS=1", "calls: make test JOBS=1"),
                ("times=()", "export KINEMEND_DATA=data", "exports"),
                ("times=()", "declare -x PRESET=ci", "exports"),
                ("times=()", "set -a", "exports"),
                ("times=()", "PRESET=ci", "sets a variable")):
            self.assertIn(named, "\n".join(problems(README, SCRIPT.replace(before, after))), after)

    def test_that_the_readme_prints_otherwise_are_found(self):
        for before, after in (("`make demo`", "`make first`"), ("make test ", "make test TESTS=ci ")):
            self.assertIn("README.md prints", "\n".join(problems(README.replace(before, after), SCRIPT)), after)


class Makefile(unittest.TestCase):
    def test_has_one_build_that_no_variable_chooses(self):
        makefile = (ROOT / "Makefile").read_text()
        self.assertIn("\nRELEASE := $(BUILD)/release\n", makefile)
        self.assertNotRegex(makefile, r"(?m)^(PRESET|TESTS|FIRST)\b")
        for target in ("demo", "build", "test", "$(RELEASE)/.built", "$(RELEASE)/.benches"):
            recipe = re.search(rf"(?m)^{re.escape(target)}:.*\n((?:\t.*\n)*)", makefile)[1]
            for preset in re.findall(r"--preset (\S+)", recipe):
                self.assertEqual(preset, "release", target)


if __name__ == "__main__":
    unittest.main()
