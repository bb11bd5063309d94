# SPDX-License-Identifier: Apache-2.0
"""Cleans the active action of an armature into a new action."""

import os
import tempfile

import bpy
import numpy as np

from . import program, rotations, takes
from .curves import write_keys
from .rig import Rig, RigError, curves_of

SOURCE = "kinemend_source"  # the action that a cleaned one comes from
REPORT = "kinemend_report"  # the page of a cleaned action
MARK = "K "                 # how the add-on's time-line markers begin


class Job:
    """A take on its way: read from the action, cleaned by the program, written to a new action."""

    def __init__(self, context, settings, program_path):
        self.armature = context.active_object
        if self.armature is None or self.armature.type != "ARMATURE":
            raise RigError("select an armature")
        data = self.armature.animation_data
        if data is None or data.action is None:
            raise RigError(f"{self.armature.name} has no action")
        self.scene, self.source = context.scene, data.action
        render = self.scene.render
        units = self.scene.unit_settings
        self.rig = Rig(self.armature, self.source, units.scale_length if units.system != "NONE" else 1.0)
        self.chosen = self._chosen(settings)
        frames = self._frames(settings)
        self.folder = tempfile.mkdtemp(prefix="kinemend-", dir=bpy.app.tempdir or None)
        self.report, self.page = (os.path.join(self.folder, "report." + kind) for kind in ("json", "html"))
        self.words = program.command_line(
            program.find_program(program_path), settings.method, settings.strength,
            None if len(self.chosen) == len(self.rig.joints) else sorted(self.chosen), frames, settings.feet,
            settings.root_position, (self.report, self.page), settings.source)
        self.data = takes.to_npz(self.rig.take(render.fps / render.fps_base))
        self.run = None

    def start(self):
        self.run = program.Run(self.words, self.data)

    def _chosen(self, settings):
        names = [joint.name for joint in self.rig.joints]
        if settings.bones == "SELECTED":
            names = [name for name in names if self.armature.data.bones[name].select]
        elif settings.bones == "NAME":
            from fnmatch import fnmatch
            patterns = [part.strip() for part in settings.pattern.split(",") if part.strip()]
            names = [name for name in names if any(fnmatch(name.lower(), part.lower()) for part in patterns)]
        if not names:
            raise RigError("no bone is chosen")
        return set(names)

    # The first and last frame number of the take, from 1; None for all frames.
    def _frames(self, settings):
        if not settings.use_range:
            return None
        inside = np.flatnonzero((self.rig.times >= settings.first - 1e-3) & (self.rig.times <= settings.last + 1e-3))
        if not inside.size:
            raise RigError(f"no key lies between frames {settings.first} and {settings.last}")
        return int(inside[0]) + 1, int(inside[-1]) + 1

    def finish(self):
        """Writes the new action and makes it the active one. Returns a line for the user."""
        output, warnings = self.run.result()
        cleaned = takes.from_npz(output)
        action = self.source.copy()
        action.name = self.source.name + ".clean"
        self.source.use_fake_user = True
        changed = self._write(action, cleaned)
        action[SOURCE], action[REPORT] = self.source, self.page
        activate(self.armature, action)
        entry = program.read_report(self.report)
        self._mark(entry)
        left = self.rig.keys_between_frames()
        between = f"; {left} keys between frames are left" if left else ""
        more = f"; {warnings[-1]}" if warnings else ""
        return f"{entry['verdict']}; {changed} bones changed{between}{more}"

    def _write(self, action, cleaned):
        rig, changed = self.rig, 0
        curves = curves_of(action, self.armature)
        whole = cleaned["rotations"]
        is_new = np.any(whole != rig.sent_rotations, axis=2)
        local = rig.local_rotations(whole)
        for j, joint in enumerate(rig.joints):
            if joint.name not in self.chosen:
                continue
            frames = rig.key_frames(joint.rotation)
            frames = frames[is_new[frames, j]]
            if frames.size:
                near = rig.channels[j][frames]
                values = rotations.to_values_near(local[frames, j], joint.mode, near)
                self._write_part(curves, joint, joint.rotation, frames, values)
                changed += 1
        self._write_root(curves, cleaned["positions"][:, 0])
        return changed

    def _write_root(self, curves, positions):
        joint, rig = self.rig.joints[0], self.rig
        if joint.name not in self.chosen or not joint.moves():
            return
        frames = rig.key_frames(joint.location)
        frames = frames[np.any(positions[frames] != rig.sent_positions[frames, 0], axis=1)]
        if frames.size:
            self._write_part(curves, joint, joint.location, frames, rig.locations(positions[frames]))

    def _write_part(self, curves, joint, part, frames, values):
        path = f'pose.bones["{bpy.utils.escape_identifier(joint.name)}"].{part.path}'
        before = part.at(self.rig.times[frames])
        for component in range(values.shape[1]):
            curve = curves.find(path, index=component)
            if curve is None:
                if np.abs(values[:, component] - before[:, component]).max() < 1e-9:
                    continue
                curve = curves.new(path, index=component)
            write_keys(curve, self.rig.times[frames], values[:, component])

    def _mark(self, entry):
        markers = self.scene.timeline_markers
        for marker in [each for each in markers if each.name.startswith(MARK)]:
            markers.remove(marker)
        for frame, text in program.time_marks(entry):
            markers.new(MARK + text, frame=int(round(self.rig.first + self.rig.step * frame)))


def activate(armature, action):
    """Makes the action the active one; of one with slots the slot that the armature used."""
    data = armature.animation_data
    slot = getattr(data, "action_slot", None)
    data.action = action
    if slot is not None and getattr(data, "action_slot", None) is None:
        data.action_slot = next((each for each in action.slots if each.identifier == slot.identifier), action.slots[0])


def other_action(action):
    """The original of a cleaned action; else the last action that was cleaned from it; None where there is none."""
    source = action.get(SOURCE)
    if source is not None:
        return source
    cleaned = [each for each in bpy.data.actions if each.get(SOURCE) == action]
    return cleaned[-1] if cleaned else None
