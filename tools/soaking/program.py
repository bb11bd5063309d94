"""Runs the program under limits and checks what holds for every run, whatever its input."""
import os
import pathlib
import re
import resource
import signal
import subprocess
import time
from dataclasses import dataclass

ADDRESS_SPACE = 4 << 30  # bytes
PROCESSOR_SECONDS = 30
FILE_BYTES = 256 << 20
MOST_RESIDENT_KB = 640 << 10
MOST_STANDARD_ERROR = 4096  # bytes
EXIT_CODES = range(5)


@dataclass
class Result:
    words: list
    code: int  # negative: the number of the signal
    hung: bool
    seconds: float
    resident_kb: int
    out: bytes
    err: bytes


class Program:
    """The program of one build. `logs` is a folder for what it prints."""

    def __init__(self, path, logs, wall_seconds=120):
        self.path = pathlib.Path(path)
        self.logs = pathlib.Path(logs)
        self.wall_seconds = wall_seconds
        # A sanitised program reserves terabytes of addresses and needs several times the memory.
        self.sanitized = b"__asan_init" in self.path.read_bytes()

    def start(self, words, folder, *, cores=2, stdin=subprocess.DEVNULL, label="run"):
        self.logs.mkdir(parents=True, exist_ok=True)
        with open(self.logs / f"{label}.out", "wb") as out, open(self.logs / f"{label}.err", "wb") as err:
            return subprocess.Popen([self.path, *words], cwd=folder, stdin=stdin, stdout=out, stderr=err,
                                    preexec_fn=lambda: self._limit(cores), env=environment())

    def _limit(self, cores):
        if not self.sanitized:
            resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 5))
        resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_BYTES, FILE_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it, and a child would inherit that

    def finish(self, process, words, began, label="run", seconds=None):
        """Waits, and kills the process after `seconds`."""
        end = began + (seconds or self.wall_seconds)
        hung, pause = False, 0.002
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > end and not hung:
                hung = True
                signal_to(process, signal.SIGKILL)
            time.sleep(pause)
            pause = min(pause * 1.3, 0.05)
        process.returncode = os.waitstatus_to_exitcode(status)
        return Result([os.fsdecode(word) for word in words], process.returncode, hung, time.monotonic() - began, usage.ru_maxrss,
                      (self.logs / f"{label}.out").read_bytes(), (self.logs / f"{label}.err").read_bytes())

    def run(self, words, folder, *, cores=2, stdin=None, label="run"):
        began = time.monotonic()
        source = open(stdin, "rb") if stdin else subprocess.DEVNULL
        try:
            process = self.start(words, folder, cores=cores, stdin=source, label=label)
        finally:
            if stdin:
                source.close()
        return self.finish(process, words, began, label)

    def broken_laws(self, result):
        """What is wrong with a run that any input may have caused, a line each."""
        found = []
        if result.hung:
            found.append(f"did not end within {self.wall_seconds} s")
        elif result.code < 0:
            name = signal.Signals(-result.code).name
            found.append("took more than 30 s of processor time" if name == "SIGXCPU" else
                         "wrote more than 256 MB" if name == "SIGXFSZ" else f"ended by {name}")
        elif result.code not in EXIT_CODES:
            found.append(f"exit code {result.code}")
        elif result.code != 0 and not result.err.strip():
            found.append(f"exit code {result.code} with nothing on standard error")
        if b"internal error" in result.err:
            found.append("reports an internal error")
        if len(result.err) > MOST_STANDARD_ERROR:
            found.append(f"{len(result.err):,} bytes on standard error")
        if result.resident_kb > MOST_RESIDENT_KB and not self.sanitized:
            found.append(f"{result.resident_kb >> 10:,} MB of memory")
        return found + odd_characters(result.err, "standard error")


def signal_to(process, number):
    """Popen.kill would wait for a process that has ended, and its figures would be lost."""
    os.kill(process.pid, number)


def environment():
    """The same for every run: colours, locale and the folder of temporaries do not depend on who soaks."""
    kept = {name: os.environ[name] for name in ("PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS") if name in os.environ}
    return {**kept, "HOME": "/nonexistent", "TMPDIR": "/tmp"}


def odd_characters(text, where):
    """Control characters other than line feed and tab, and bytes that are not UTF-8."""
    try:
        decoded = text.decode()
    except UnicodeDecodeError as error:
        return [f"{where} is not UTF-8 at byte {error.start}"]
    control = re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", decoded)
    return [f"control character U+{ord(control.group()):04X} on {where}"] if control else []


def last_line(text):
    lines = [line for line in text.decode(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else ""
