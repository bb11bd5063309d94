#!/usr/bin/env python3
"""VMC between a sender and a receiver of liblo, which the program never sees the source of.

Usage: liblo_test.py PROGRAM    exit status 0: passed; 77: skipped, as there is no liblo for Python.
"""
import math
import random
import re
import signal
import socket
import subprocess
import sys
import time

try:
    import liblo
except ImportError:
    sys.exit(77)

FRAMES = 90
BONES = ["Hips", "Spine", "Head", "LeftHand", "RightHand"]


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def pose(turn):
    return [0.0, 1.0, 0.0, math.sin(turn / 2), 0.0, 0.0, math.cos(turn / 2)]


def frame(f, rng):
    """The messages of a frame: address, arguments."""
    turn = 0.4 * math.sin(f / 12)
    messages = [("/VMC/Ext/Root/Pos", ["root"] + pose(0.0) + [1.0, 1.0, 1.0])]
    messages += [("/VMC/Ext/Bone/Pos", [bone] + pose(turn + rng.gauss(0, 0.03))) for bone in BONES]
    messages += [("/VMC/Ext/Blend/Val", ["Joy", f / FRAMES]), ("/VMC/Ext/Blend/Apply", []),
                 ("/VMC/Ext/OK", [1]), ("/VMC/Ext/T", [f / 60])]
    return messages


def turns(messages, bone):
    return [2 * math.atan2(args[4], args[7]) for address, args in messages
            if address == "/VMC/Ext/Bone/Pos" and args[0] == bone]


def roughness(values):
    return sum((a - 2 * b + c) ** 2 for a, b, c in zip(values, values[1:], values[2:]))


def same(left, right):
    return all(abs(a - b) < 1e-6 if isinstance(a, float) else a == b for a, b in zip(left, right))


def main():
    port = free_port()
    received = []
    receiver = liblo.Server(port)
    receiver.add_method(None, None, lambda path, args: received.append((path, list(args))))
    program = subprocess.Popen([sys.argv[1], "stream", "--vmc", "0", "--to-vmc", f"127.0.0.1:{port}"],
                               stderr=subprocess.PIPE, text=True)
    for line in program.stderr:
        if place := re.search(r"waiting for VMC at 127.0.0.1:(\d+)", line):
            break
    target = liblo.Address("127.0.0.1", int(place.group(1)))
    rng = random.Random(1)
    sent = []
    for f in range(FRAMES):
        messages = frame(f, rng)
        # One bundle with a time tag, two bundles, and single messages take turns.
        if f % 3 == 0:
            liblo.send(target, liblo.Bundle(liblo.time(), *[liblo.Message(a, *v) for a, v in messages]))
        elif f % 3 == 1:
            for part in (messages[:4], messages[4:]):
                liblo.send(target, liblo.Bundle(*[liblo.Message(a, *v) for a, v in part]))
        else:
            for address, args in messages:
                liblo.send(target, address, *args)
        sent += messages
        time.sleep(1 / 60)
        while receiver.recv(0):
            pass
    program.send_signal(signal.SIGINT)
    said = program.stderr.read()
    assert program.wait() == 0, said
    while receiver.recv(100):
        pass
    assert [a for a, _ in received] == [a for a, _ in sent], "the order or the number of messages differs"
    for (address, before), (_, after) in zip(sent, received):
        cleaned = address in ("/VMC/Ext/Bone/Pos", "/VMC/Ext/Root/Pos")
        unchanged = before[:1] + before[8:] if cleaned else before
        assert same(unchanged, after[:1] + after[8:] if cleaned else after), (address, before, after)
    for bone in BONES:
        before, after = roughness(turns(sent, bone)), roughness(turns(received, bone))
        assert after < 0.5 * before, (bone, before, after)
    print(f"liblo {getattr(liblo, '__version__', '')}: {len(received)} messages in order")


main()
