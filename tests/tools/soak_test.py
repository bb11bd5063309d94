#!/usr/bin/python3
"""Tests of tools/soak with small programs in place of `kinemend`, each with one fault: the fault is found, kept and can be repeated.

  tests/tools/soak_test.py
"""
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from soaking import outputs  # noqa: E402
from soaking.mutations import BINARY, JSON, mutate  # noqa: E402
from soaking.program import MOST_STANDARD_ERROR, Program, Result  # noqa: E402

# A minimal well-behaved program: refuses words of `batch`, and for all else writes a one-line file if it does not
# exist.
GOOD = """#!/bin/bash
words=("$@"); out=
for ((i = 1; i < $#; i++)); do case "${words[i]}" in -o|--report|--plan-out) out=${words[i+1]}; [ -e "$out" ] || echo 1 > "$out";; esac; done
new=; [ "$1" = convert ] && [ ! -e "$3" ] && new=1
[ -n "$new" ] && echo 1 > "$3"
[ -n "$new" ] && [ "${3##*.}" = glb ] && printf 'glTF\\2\\0\\0\\0\\30\\0\\0\\0\\4\\0\\0\\0JSON{}  ' > "$3"
[ "$1" = batch ] && { rm -f out; echo "kinemend: no" >&2; exit 3; }
%s
exit 0
"""


class Soak(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, fault=""):
        path = self.folder / "kinemend"
        path.write_text(GOOD % fault)
        path.chmod(0o755)
        return path

    def soak(self, program, *words):
        run = subprocess.run([ROOT / "tools" / "soak", program, "--home", self.folder / "home", *words], capture_output=True,
                             text=True, timeout=300, check=False)
        return run.returncode, run.stdout + run.stderr

    def finds(self):
        return sorted((self.folder / "home" / "finds").glob("*/finding.txt"))

    def test_a_program_without_faults_gives_a_table_and_no_findings(self):
        code, text = self.soak(self.program(), "3", "--seed", "7", "--kinds", "mutants")
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"mutants: take +\d+ +0\n")
        self.assertIn("soak: no findings; the seed is 7", text)
        self.assertEqual(self.finds(), [])

    def test_an_unknown_kind_is_refused(self):
        code, text = self.soak(self.program(), "1", "--seed", "1", "--kinds", "x")
        self.assertEqual(code, 2)
        self.assertIn("unknown kind x", text)

    def fault_is_found(self, fault, words, seconds="1"):
        code, text = self.soak(self.program(fault), seconds, "--seed", "3", "--kinds", "mutants")
        self.assertEqual(code, 1, text)
        self.assertIn(words, text)
        kept = self.finds()
        self.assertTrue(kept)
        self.assertIn(words, kept[0].read_text())
        return kept

    def test_a_signal_is_found_and_the_command_that_is_kept_repeats_it(self):
        kept = self.fault_is_found("kill -SEGV $$", "ended by SIGSEGV")
        self.assertRegex(kept[0].read_text(), r"\n  kinemend [a-z]+ ")
        files = {path.name: path.read_bytes() for path in (kept[0].parent / "files").iterdir()}
        command = next(line for line in kept[0].read_text().splitlines() if "tools/soak" in line).split()
        code, text = self.soak(self.folder / "kinemend", *command[2:])
        self.assertEqual(code, 1, text)
        again = {path.name: path.read_bytes() for path in (kept[0].parent / "files").iterdir()}
        self.assertEqual(again, files)

    def test_an_odd_exit_code_is_found(self):
        self.fault_is_found("exit 77", "exit code 77")

    def test_a_failure_without_a_message_is_found(self):
        self.fault_is_found("rm -f out*; exit 3", "exit code 3 with nothing on standard error")

    def test_a_control_character_on_standard_error_is_found(self):
        self.fault_is_found(r"printf '\033[31mred\n' >&2", "control character U+001B on standard error")

    def test_much_on_standard_error_is_found(self):
        self.fault_is_found("head -c 5000 /dev/zero | tr '\\0' x >&2", "5,000 bytes on standard error")

    def test_a_file_that_was_not_asked_for_is_found(self):
        self.fault_is_found("echo half > .kinemend-1-2.tmp", "the temporary file .kinemend-1-2.tmp was left")

    def test_a_result_beside_a_failure_is_found(self):
        self.fault_is_found('[ -n "$out" ] && { echo no >&2; exit 3; }', "was written", seconds="6")

    def test_a_changed_input_is_found(self):
        self.fault_is_found('for f in take.*; do echo 1 >> "$f"; done', "was changed")

    def test_half_a_file_after_a_kill_is_found(self):
        program = self.program('[ "$1" = clean ] && { echo ha > "$out"; sleep 0.3; echo half > "$out"; }')
        code, text = self.soak(program, "1", "--seed", "1", "--kinds", "kills")
        self.assertEqual(code, 1, text)
        self.assertIn("is neither the old file nor the new one", text)

    def test_results_that_depend_on_the_cores_are_found(self):
        code, text = self.soak(self.program('[ -n "$out" ] && nproc > "$out"'), "1", "--seed", "1", "--kinds", "determinism")
        self.assertEqual(code, 1 if "one core only" not in text else 0, text)

    def test_a_stream_that_invents_frames_is_found(self):
        fault = """[ "$1" = stream ] && exec /usr/bin/python3 -c '
import signal, socket, sys, time
way = socket.SOCK_DGRAM if "--udp" in sys.argv else socket.SOCK_STREAM
s = socket.socket(socket.AF_INET, way); s.bind(("127.0.0.1", 0))
def end(*_):
    for i in range(500): print("{\\"frame\\":%d}" % i)
    print("frames: 500 in, 500 out, 0 lost", file=sys.stderr); sys.stdout.flush(); sys.exit(0)
signal.signal(signal.SIGINT, end)
print("at 127.0.0.1:%d" % s.getsockname()[1], file=sys.stderr, flush=True)
time.sleep(60)' "$@\""""
        code, text = self.soak(self.program(fault), "1", "--seed", "1", "--only", "live:0")
        self.assertEqual(code, 1, text)
        self.assertIn("500 counted as in", text)


class Laws(unittest.TestCase):
    def place(self, name, data):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / name
        path.write_bytes(data)
        return outputs.not_finite_in(path)

    def test_numbers_that_are_not_finite_are_found_in_every_format(self):
        self.assertIn("line 3", self.place("a.bvh", b"HIERARCHY\nFrame Time: 1\n1 2 nan\n"))
        self.assertIn("inf", self.place("a.csv", b"Frame,A\n1,inf\n"))
        self.assertIn("NaN", self.place("a.trc", b"a\tb\n1\t0.0\tNaN\n"))
        self.assertIn("nan", self.place("a.amc", b":DEGREES\nroot 1 2 nan\n"))
        self.assertIn("NaN", self.place("a.json", b'{"a": NaN}'))
        header = bytearray(1024)
        header[0:2] = bytes([2, 0x50])
        header[2:10] = struct.pack("<HHHH", 1, 0, 1, 1)
        header[12:18] = struct.pack("<fH", -1, 3)
        header[515] = 84
        self.assertIn("nan", self.place("a.c3d", bytes(header) + struct.pack("<4f", 1, float("nan"), 1, 0)))
        self.assertEqual(self.place("a.c3d", bytes(header) + struct.pack("<4f", 1, 2, 1, 0)), "")
        glb = b'{"nodes":[{"name":"n","translation":[0,null,0]}]}'
        whole = struct.pack("<4sIIII", b"glTF", 2, 20 + len(glb), len(glb), 0x4E4F534A) + glb
        self.assertIn("null", self.place("a.glb", whole))

    def test_names_that_look_like_numbers_are_not_found(self):
        self.assertEqual(self.place("a.csv", b"Frame,nan,inf\n1,2,3\n"), "")
        self.assertEqual(self.place("a.bvh", b"ROOT nan\nFrame Time: 1\n1 2 3\n# inf 1\n"), "")
        self.assertEqual(self.place("a.amc", b"1\nnan 1 2\n"), "")

    def test_a_sane_run_breaks_no_law(self):
        program = Program("/bin/true", "/tmp")
        fine = Result(["x"], 3, False, 0.1, 1000, b"", b"kinemend: no such file\n")
        self.assertEqual(program.broken_laws(fine), [])
        loud = Result(["x"], 0, False, 0.1, 1000, b"", b"x" * (MOST_STANDARD_ERROR + 1))
        self.assertEqual(len(program.broken_laws(loud)), 1)

    def test_a_run_that_does_not_end_is_killed_and_found(self):
        with tempfile.TemporaryDirectory() as logs:
            program = Program("/bin/sleep", logs, wall_seconds=0.2)
            result = program.run(["600"], "/tmp")
            self.assertLess(result.seconds, 30)
            self.assertEqual(program.broken_laws(result), ["did not end within 0.2 s"])

    def test_a_mutation_depends_on_the_seed_alone(self):
        data = (ROOT / "tests/fixtures/bvh/good/plain.bvh").read_bytes()
        for name in ("a.bvh", "a.c3d", "a.json"):
            made = {tuple(mutate(random.Random(f"{seed}"), data, data, name) for _ in range(20)) for seed in range(3) for _ in range(2)}
            self.assertEqual(len(made), 3)

    def test_every_mutation_takes_any_bytes(self):
        for kind in {*BINARY, *JSON}:
            for data in (b"1", b"\n", b"\x00" * 9, b"Frames: 12\n0.1 2\n", b'{"a":1}'):
                for seed in range(20):
                    self.assertIsInstance(kind(random.Random(seed), data, b"0 1\n"), bytes, kind.__name__)


if __name__ == "__main__":
    unittest.main()
