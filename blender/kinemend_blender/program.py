# SPDX-License-Identifier: Apache-2.0
"""Runs the program kinemend over pipes, and reads its report. Knows nothing of Blender."""

import json
import re
import shutil
import subprocess
import sys
import threading


class ProgramError(Exception):
    """A line for the user."""


def find_program(path):
    """The program at `path`, or the one on the search path. Raises ProgramError."""
    found = shutil.which(path or "kinemend")
    if found is None:
        raise ProgramError(f"the program {path or 'kinemend'} is not found; set its path in the add-on's preferences")
    return found


def name_pattern(name):
    """A pattern for --joints that fits this name; what has a meaning in a list of patterns is any character."""
    return re.sub(r"[,*?\[\]\\\s]", "?", name)


def command_line(program, method="", strength=1.0, joints=None, frames=None, feet="off", root_position=True, reports=(), source="unknown"):
    """The words that clean standard input to standard output.

    `joints`: names; None for all. `frames`: first and last frame, counted from 1; None for all.
    `source`: what recorded the motion, as --source names it.
    """
    words = [program, "clean", "-", "--from", "npz", "-o", "-", "--quiet", "--force", "--feet", feet, f"--strength={strength:.6g}"]
    if method:
        words += ["--method", method]
    if source != "unknown":
        words += ["--source", source]
    if joints is not None:
        words.append("--joints=" + ",".join(map(name_pattern, joints)))
    if frames is not None:
        words += ["--range", f"{frames[0]}:{frames[1]}"]
    if not root_position:
        words.append("--no-root-position")
    for report in reports:
        words += ["--report", str(report)]
    return words


class Run:
    """A run of the program in a thread, so that the window stays alive."""

    def __init__(self, words, data):
        flags = {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}
        try:
            self._process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **flags)
        except OSError as error:
            raise ProgramError(f"{words[0]}: {error.strerror}") from error
        self._output = self._messages = b""
        self.is_killed = False
        self._thread = threading.Thread(target=self._talk, args=(data,), daemon=True)
        self._thread.start()

    def _talk(self, data):
        self._output, self._messages = self._process.communicate(data)

    def is_done(self):
        return not self._thread.is_alive()

    def kill(self):
        self.is_killed = True
        self._process.kill()
        self._thread.join()

    def result(self):
        """Waits. The output and the warnings. Raises ProgramError with the program's message."""
        self._thread.join()
        messages = self._messages.decode("utf-8", "replace").strip()
        if self.is_killed:
            raise ProgramError("stopped: nothing is changed")
        # Exit code 1 is a warning treated as an error; the output is complete only with 0.
        if self._process.returncode != 0:
            raise ProgramError(messages.splitlines()[-1] if messages else f"kinemend failed ({self._process.returncode})")
        return self._output, messages.splitlines()


def read_report(path):
    """The entry of the take in a report of the program."""
    with open(path, encoding="utf-8") as file:
        return json.load(file)["takes"][0]


def time_marks(entry, most=40, apart_s=0.25):
    """Times at which something was repaired: (frame index from 0, text), in order. Smoothing everywhere is no mark.

    Repairs of one kind that follow within `apart_s` are one mark. Of more than `most` marks those on the most tracks are kept.
    """
    repairs = [each for each in entry["findings"] if each["verdict"] != "denoised" and each["kind"] != "noise"]
    repairs.sort(key=lambda each: (each["kind"], each["first_frame"]))
    apart = apart_s * entry["frame_rate_hz"]
    groups = []
    for each in repairs:
        last = groups[-1][-1] if groups else None
        if last is None or last["kind"] != each["kind"] or each["first_frame"] - last["first_frame"] > apart:
            groups.append([])
        groups[-1].append(each)
    groups = sorted(groups, key=lambda group: len({each["track"] for each in group}), reverse=True)[:most]
    return sorted((group[0]["first_frame"] - entry["first_frame"], _mark_text(group)) for group in groups)


def _mark_text(group):
    tracks = list(dict.fromkeys(each["track"] or "take" for each in group))
    more = f" +{len(tracks) - 1}" if len(tracks) > 1 else ""
    return f"{group[0]['kind']}: {tracks[0]}{more}"
