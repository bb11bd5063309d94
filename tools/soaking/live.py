"""Streams with loss, reordering, garbage and reconnections: each frame that was sent comes out, and no other."""
import json
import os
import pathlib
import re
import signal
import socket
import time

from .program import signal_to

MOST_RESIDENT_KB = 256 << 10
PATIENCE = 20  # seconds allowed for a start or an end


class Stream:
    """`kinemend stream` at a free port of this machine, for the time of a `with` block."""

    def __init__(self, program, folder, words):
        self.program, self.words = program, words
        self.began = time.monotonic()
        self.process = program.start(words, folder, label="stream")
        self.result = None
        self.peak_kb = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.result is None:
            signal_to(self.process, signal.SIGKILL)
            self.program.finish(self.process, self.words, self.began, label="stream")

    def text(self, name):
        return (self.program.logs / f"stream.{name}").read_bytes()

    def port(self):
        """The number in the line that says where frames are waited for; 0: none came."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self._runs():
            if found := re.search(rb"127\.0\.0\.1:(\d+)", self.text("err")):
                return int(found.group(1))
            time.sleep(0.01)
        return 0

    def _runs(self):
        # Does not reap the process, so that its statistics stay available.
        return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None

    def settled(self, quiet=0.4):
        """Waits until nothing has come out for a while."""
        size, since = -1, time.monotonic()
        end = time.monotonic() + PATIENCE
        while time.monotonic() < min(end, since + quiet):
            time.sleep(0.05)
            if len(self.text("out")) != size:
                size, since = len(self.text("out")), time.monotonic()

    def end(self):
        """Asks it to end, and returns the result."""
        try:
            status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
            self.peak_kb = int(re.search(r"VmHWM:\s*(\d+)", status).group(1))
            signal_to(self.process, signal.SIGINT)
        except (OSError, AttributeError):
            pass
        self.result = self.program.finish(self.process, self.words, self.began, "stream", time.monotonic() - self.began + PATIENCE)
        return self.result


def _take(seeds):
    head, motion = seeds.bytes("walk.bvh").split(b"Frame Time:", 1)
    rate, *frames = motion.strip().splitlines()
    return head + b"Frame Time:" + rate + b"\n", [b" ".join(frame.split()) for frame in frames]


def _garbage(rng, frame, number):
    """A line that holds no frame."""
    kind = rng.randrange(5)
    if kind == 0:
        return bytes(byte for byte in rng.randbytes(rng.randint(1, 300)) if byte not in b"\n\r|") or b"?"
    words = frame.split()
    if kind == 1:  # a frame that was cut
        return b" ".join([number, *words[:rng.randint(1, len(words) - 2)]])
    if kind == 2:
        return b" ".join([number, *words, *words])
    if kind == 3:
        return b"hello " * rng.randint(1, 200)
    return b" ".join([number, *words[:-1], b"x1.5y"])


def _plan(rng, frames, *, loses, swaps):
    """What is sent, in order: pairs of a number and a line. Losses are single frames, and neighbours change places."""
    sent = [(100 + i, frame) for i, frame in enumerate(frames)]
    kept = [pair for i, pair in enumerate(sent) if not loses or i % 9 != 4 or rng.random() < 0.4]
    i = 3
    while swaps and i + 3 < len(kept):
        if rng.random() < 0.2:
            kept[i], kept[i + 1] = kept[i + 1], kept[i]
            i += 4
        i += 1
    return kept


def _summary(err):
    """The counts in the line `frames: 960 in, 960 out, ...`."""
    line = re.search(rb"frames: (\d+ .*)", err)
    return {name: int(count) for count, name in re.findall(r"(\d+) ([a-z ]+)", line.group(1).decode())} if line else {}


def _frames_out(out):
    """The numbers of the frames on standard output, and the root positions by number; lines that are not JSON raise."""
    numbers, roots = [], {}
    for line in out.splitlines():
        piece = json.loads(line)
        if "frame" in piece:
            numbers.append(piece["frame"])
            roots[piece["frame"]] = piece.get("root")
    return numbers, roots


def _laws(stream, received, *, numbered, exact, garbage):
    """What holds for the output. `received`: pairs of number and line, each once, in the order of their numbers."""
    result = stream.result
    found = stream.program.broken_laws(result)
    if result.code != 0:
        return found + [f"exit code {result.code}"] * (result.code > 0)
    if stream.peak_kb > MOST_RESIDENT_KB and not stream.program.sanitized:
        found.append(f"{stream.peak_kb >> 10:,} MB of memory")
    counts = _summary(result.err)
    made = counts.get("interpolated", counts.get("made up", 0))
    try:
        numbers, roots = _frames_out(result.out)
    except ValueError as error:
        return found + [f"a line of the output is not JSON: {error}"]
    if len(numbers) != counts.get("out") or counts.get("out") != counts.get("in", 0) + made + counts.get("held", 0):
        found.append(f"{len(numbers)} frames came out, and the summary says {counts}")
    if counts.get("in") != len(received) if exact else counts.get("in", 0) > len(received):
        found.append(f"{len(received)} frames were sent, and {counts.get('in')} counted as in")
    if any(b <= a for a, b in zip(numbers, numbers[1:])):
        found.append("the numbers of the frames do not rise")
    if numbered and received:
        first, last = received[0][0], received[-1][0]
        if exact and numbers != list(range(first, last + 1)):
            found.append(f"frames {first} to {last} were sent, and others came out: {sorted(set(numbers) ^ set(range(first, last + 1)))[:9]}")
        if numbers and not first <= numbers[0] <= numbers[-1] <= last:
            found.append(f"frames {numbers[0]} to {numbers[-1]} came out, and {first} to {last} were sent")
        # An interpolated frame replaces a late one.
        if counts.get("in") == len(received):
            found += _moved(received, roots)
    elif made > garbage:
        found.append(f"{made} frames were made up for {garbage} malformed lines")
    return found


def _moved(received, roots):
    """With strength 0 the positions of frames that were sent are those that were sent."""
    for number, line in received:
        root = roots.get(number)
        if root is not None and any(abs(float(a) - b) > 1e-4 for a, b in zip(line.split(), root)):
            return [f"frame {number} came out with another position of the root"]
    return []


def _dropped(port):
    """Datagrams that the system dropped, because its buffer for the port was full."""
    for line in pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]:
        cells = line.split()
        if int(cells[1].split(":")[1], 16) == port:
            return int(cells[-1])
    return 0


WORDS = ["stream", "--format", "jsonl", "-m", "median", "--strength", "0"]


def _udp(program, seeds, rng, folder):
    header, frames = _take(seeds)
    (folder / "skeleton.bvh").write_bytes(header)
    plan = _plan(rng, frames, loses=rng.random() < 0.6, swaps=rng.random() < 0.6)
    with Stream(program, folder, [*WORDS, "--udp", "0", "--numbered", "--skeleton", "skeleton.bvh"]) as stream:
        port, garbage = stream.port(), 0
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            for i, (number, frame) in enumerate(plan if port else []):
                out.sendto(b"%d " % number + frame + b"\n" * rng.randrange(2), ("127.0.0.1", port))
                if rng.random() < 0.1:
                    out.sendto(b"%d " % number + frame, ("127.0.0.1", port))  # the same frame again
                if rng.random() < 0.15:
                    out.sendto(_garbage(rng, frame, b"%d" % (number + rng.randint(-3, 3))), ("127.0.0.1", port))
                    garbage += 1
                if i % 8 == 7:
                    time.sleep(0.004)
        stream.settled()
        dropped = _dropped(port)
        stream.end()
        return "live: udp", _laws(stream, sorted(plan), numbered=True, exact=dropped == 0, garbage=garbage), [stream.result]


def _tcp(program, seeds, rng, folder):
    header, frames = _take(seeds)
    numbered = rng.random() < 0.5
    plan = _plan(rng, frames, loses=numbered and rng.random() < 0.5, swaps=False)
    lines = [(b"%d " % number if numbered else b"") + frame for number, frame in plan]
    garbage = 0
    with Stream(program, folder, [*WORDS, "--tcp", "0", *["--numbered"] * numbered]) as stream:
        port = stream.port()
        if not port:
            return "live: tcp", [*program.broken_laws(stream.end()), "no port was printed"], [stream.result]
        connections = sorted({0, *(rng.randrange(2, len(lines)) for _ in range(rng.randrange(4)))})
        for begin, end in zip(connections, [*connections[1:], len(lines)]):
            text = header if begin == 0 or rng.random() < 0.5 else b""
            for i in range(begin, end):
                if not numbered and rng.random() < 0.05:
                    text += _garbage(rng, frames[0], b"") + b"\n"
                    garbage += 1
                text += lines[i] + rng.choice([b"\n", b"\r\n"])
            if end < len(lines) and rng.random() < 0.5:  # cut in the middle of a line, which is not sent again
                text += b" ".join(lines[end].split()[:9])
                garbage += 1
            with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as out:
                while text:
                    size = rng.choice([1, 7, 100, 1000, 60000])
                    out.sendall(text[:size])
                    text = text[size:]
                out.shutdown(socket.SHUT_WR)
                # The stream closes the connection once it has read everything.
                try:
                    out.recv(1)
                except OSError:
                    pass
        stream.settled()
        stream.end()
        return "live: tcp", _laws(stream, plan, numbered=numbered, exact=True, garbage=garbage), [stream.result]


def _flood(program, seeds, rng, folder):
    """Much text without a line end, then a stream: memory stays bounded and the frames come."""
    header, frames = _take(seeds)
    with Stream(program, folder, [*WORDS, "--tcp", "0", "--numbered"]) as stream:
        port = stream.port()
        piece = rng.choice([b"x", b"1 ", b"\x00", b"HIERARCHY ", b"{", b"ROOT Hips\n{\n"]) * 10_000
        with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as out:
            for _ in range(16_000_000 // len(piece)):
                out.sendall(piece)
        plan = _plan(rng, frames, loses=False, swaps=False)
        with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as out:
            out.sendall(header + b"".join(b"%d " % number + frame + b"\n" for number, frame in plan))
        stream.settled()
        stream.end()
        return "live: flood", _laws(stream, plan, numbered=True, exact=True, garbage=1), [stream.result]


def _pipe(program, seeds, rng, folder):
    """Through standard input; the same bytes come out however the input arrives."""
    header, frames = _take(seeds)
    plan = _plan(rng, frames, loses=True, swaps=False)
    end = rng.choice([b"\n", b"\r\n", b"||"])
    (folder / "in.txt").write_bytes(header + b"".join(b"%d " % number + frame + end for number, frame in plan))
    words = ["stream", "--numbered", "-m", rng.choice(["median", "one-euro", "bilateral", "gaussian"])]
    runs = [program.run(words, folder, stdin=folder / "in.txt", cores=cores, label="stream") for cores in (1, 2)]
    found = [problem for run in runs for problem in program.broken_laws(run)]
    if runs[0].out != runs[1].out:
        found.append("two runs on the same input differ")
    lines = runs[0].out.count(b"\n") - header.count(b"\n")
    if runs[0].code == 0 and lines != plan[-1][0] - plan[0][0] + 1:
        found.append(f"{lines} frames came out, and {plan[-1][0] - plan[0][0] + 1} were expected")
    return "live: pipe", found, runs


def run(program, seeds, rng, folder, index):
    return [_udp, _tcp, _udp, _pipe, _tcp, _flood][index % 6](program, seeds, rng, folder)
