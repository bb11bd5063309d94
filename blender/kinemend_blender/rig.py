# SPDX-License-Identifier: Apache-2.0
"""An armature and its action as a take: joints, rest pose and motion, in the world's axes and units.

Bones above the one that carries the body, if none of them moves, become part of its rest pose. So the hips are joint 0 of a rig
whose topmost bone stands still.
"""

import re

import numpy as np

from . import rotations
from .curves import BoneCurves
from .takes import frame_grid, places_on_grid, usual_rate

BONE_PATH = re.compile(r'^pose\.bones\["((?:[^"\\]|\\.)*)"\]\.(location|rotation_quaternion|rotation_euler|rotation_axis_angle)$')
ROTATION_PATHS = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}


class RigError(Exception):
    """A line for the user."""


class Joint:
    """A bone: its rest matrix in its parent, its curves, and its place in the take."""

    def __init__(self, pose_bone):
        self.name = pose_bone.name
        self.mode = pose_bone.rotation_mode
        self.bone = pose_bone.bone
        self.rotation = BoneCurves(ROTATION_PATHS.get(self.mode, "rotation_euler"),
                                   getattr(pose_bone, ROTATION_PATHS.get(self.mode, "rotation_euler")))
        self.location = BoneCurves("location", pose_bone.location)
        self.children = []
        self.parent = None  # a Joint

    def can_be_moved(self):
        """A connected bone has no location; one whose location is not along its own axes is left alone."""
        return not (self.bone.use_connect and self.bone.parent) and self.bone.use_local_location

    def moves(self):
        return self.location.varies() and self.can_be_moved()

    def stands_still(self):
        return not self.rotation.varies() and not self.moves()


def curves_of(action, armature):
    """The F-curves of an action; of one with slots (Blender 4.4 and later) those of the armature's slot."""
    if hasattr(action, "fcurves"):
        return action.fcurves
    slot = armature.animation_data.action_slot
    bags = [strip.channelbag(slot) for layer in action.layers for strip in layer.strips]
    bags = [bag for bag in bags if bag is not None]
    if not bags:
        raise RigError(f"the action {action.name} has no curves for {armature.name}")
    return bags[0].fcurves


def unescaped(name):
    return re.sub(r"\\(.)", r"\1", name)


def joints_of(armature, action):
    """All bones with their curves, parents first, the tree that moves most first."""
    joints = {bone.name: Joint(bone) for bone in armature.pose.bones}
    for joint in joints.values():
        if joint.bone.parent:
            joint.parent = joints[joint.bone.parent.name]
            joint.parent.children.append(joint)
    for curve in curves_of(action, armature):
        match = BONE_PATH.match(curve.data_path)
        joint = match and joints.get(unescaped(match.group(1)))
        if not joint:
            continue
        for part in (joint.rotation, joint.location):
            if part.path == match.group(2):
                part.add(curve)
    roots = _roots([joint for joint in joints.values() if joint.parent is None])
    return [joint for root in roots for joint in _depth_first(root)]


def _depth_first(joint):
    found, waiting = [], [joint]
    while waiting:
        joint = waiting.pop()
        found.append(joint)
        waiting.extend(reversed(joint.children))
    return found


def _roots(tops):
    """The topmost bones; instead of one that stands still and carries one moving child, its children. The first is the one that
    carries the most that moves."""
    roots, waiting = [], list(tops)
    while waiting:
        joint = waiting.pop()
        moving = sum(any(not below.stands_still() for below in _depth_first(child)) for child in joint.children)
        if joint.stands_still() and moving == 1:
            waiting.extend(joint.children)
        else:
            roots.append(joint)

    def weight(root):
        below = _depth_first(root)
        return (root.moves(), sum(not each.stands_still() for each in below), len(below))

    return sorted(roots, key=weight, reverse=True)


def matrix_of(q, offset):
    matrix = np.eye(4)
    matrix[:3, :3] = rotations.matrices(np.asarray(q, float))
    matrix[:3, 3] = offset
    return matrix


def quaternion_of(matrix):
    """Of the rotation of a matrix (numpy, 4 x 4, any uniform scale)."""
    from mathutils import Matrix
    return np.array(Matrix(matrix.tolist()).to_quaternion())


class Rig:
    """The armature as a skeleton, with what turns Blender's channels into the take's and back."""

    def __init__(self, armature, action, metres_per_unit):
        self.armature = armature
        self.joints = joints_of(armature, action)
        if not any(joint.rotation.varies() or joint.moves() for joint in self.joints):
            raise RigError(f"the action {action.name} moves no bone of {armature.name}")
        self.index = {joint.name: j for j, joint in enumerate(self.joints)}
        times = np.concatenate([part.key_times() for joint in self.joints for part in (joint.rotation, joint.location)])
        self.first, self.step, self.count = frame_grid(times)
        self.times = self.first + self.step * np.arange(self.count)
        self.metres_per_unit = metres_per_unit
        world = np.array(armature.matrix_world, float)
        self.scale = float(np.cbrt(abs(np.linalg.det(world[:3, :3])))) or 1.0
        self._find_rest(world)

    def parent_of(self, joint):
        """The index of the parent among the joints; -1 for a root."""
        return self.index.get(joint.parent.name, -1) if joint.parent else -1

    def _find_rest(self, world):
        """Rest rotations and offsets of bones in their parents; of roots in the world."""
        count = len(self.joints)
        self.rest, self.offsets = np.empty((count, 4)), np.empty((count, 3))
        for j, joint in enumerate(self.joints):
            local = self._local_rest(joint)
            if self.parent_of(joint) < 0:
                above = joint.parent
                while above is not None:
                    still = matrix_of(rotations.to_quaternions(above.rotation.at(self.times[:1]), above.mode)[0],
                                      above.location.at(self.times[:1])[0] if above.can_be_moved() else (0, 0, 0))
                    local = self._local_rest(above) @ still @ local
                    above = above.parent
                local = world @ local
                self.offsets[j] = local[:3, 3]
            else:
                self.offsets[j] = self.scale * local[:3, 3]
            self.rest[j] = rotations.normalized(quaternion_of(local))

    @staticmethod
    def _local_rest(joint):
        matrix = np.array(joint.bone.matrix_local, float)
        above = joint.bone.parent
        return np.linalg.inv(np.array(above.matrix_local, float)) @ matrix if above else matrix

    def movers(self):
        """Joints other than 0 whose location changes: they are told, so that feet are where they are."""
        return [j for j, joint in enumerate(self.joints) if j > 0 and joint.moves()]

    def take(self, frames_per_second):
        """The take as arrays of docs/formats/npz.md; keeps what was sent, so that changes are seen."""
        joints, movers = self.joints, self.movers()
        offsets = self.offsets.copy()
        for j, joint in enumerate(joints):
            if j > 0 and joint.can_be_moved():
                offsets[j] = self._positions(j, self.times[:1])[0]
        leaves = [j for j, joint in enumerate(joints) if not joint.children]
        self.channels = [joint.rotation.at(self.times) for joint in joints]
        local = np.stack([rotations.to_quaternions(self.channels[j], joint.mode) for j, joint in enumerate(joints)], axis=1)
        self.sent_rotations = rotations.multiply(self.rest, local)
        self.sent_positions = np.stack([self._positions(j, self.times) for j in [0, *movers]], axis=1)
        take = {
            "fps": np.float64(usual_rate(frames_per_second / self.step)), "names": np.array([joint.name for joint in joints]),
            "parents": np.array([self.parent_of(joint) for joint in joints], np.int32), "offsets": offsets,
            "rest_rotations": self.rest, "rotations": self.sent_rotations, "positions": self.sent_positions,
            "metres_per_unit": np.float64(self.metres_per_unit),
            "end_parents": np.array(leaves, np.int32),
            "end_offsets": np.array([[0, self.scale * joints[j].bone.length, 0] for j in leaves]).reshape(-1, 3)}
        if movers:
            take["translated_joints"] = np.array(movers, np.int32)
        seen = np.stack([self._is_keyed(joint.rotation) for joint in joints], axis=1)
        if not seen.all():
            take["observed"] = seen.astype(np.uint8)
        return take

    # Outside the keys of a bone there is no motion to judge.
    def _is_keyed(self, part):
        span = part.key_range()
        if span is None:
            return np.ones(self.count, bool)
        return (self.times > span[0] - 1e-3) & (self.times < span[1] + 1e-3)

    def _positions(self, j, times):
        joint = self.joints[j]
        if not joint.can_be_moved():
            return np.broadcast_to(self.offsets[j], (len(times), 3))
        moved = rotations.rotate(np.broadcast_to(self.rest[j], (len(times), 4)), joint.location.at(times))
        return self.offsets[j] + self.scale * moved

    def locations(self, positions):
        """Locations of joint 0 for its positions in the take."""
        back = np.broadcast_to(rotations.conjugate(self.rest[0]), (len(positions), 4))
        return rotations.rotate(back, (positions - self.offsets[0]) / self.scale)

    def local_rotations(self, whole):
        """Rotations (F, J, 4) about the rest pose."""
        return rotations.multiply(rotations.conjugate(self.rest), whole)

    def key_frames(self, part):
        """Frames of the grid in which the property has a key, within the range of its keys."""
        places = places_on_grid(part.key_times(), self.first, self.step, self.count)
        frames = np.unique(places[places >= 0])
        return frames[self._is_keyed(part)[frames]]

    def keys_between_frames(self):
        """How many keys lie between frames: these are left."""
        times = np.unique(np.concatenate([joint.rotation.key_times() for joint in self.joints]))
        return int(np.sum(places_on_grid(times, self.first, self.step, self.count) < 0))
