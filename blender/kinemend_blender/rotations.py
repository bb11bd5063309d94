# SPDX-License-Identifier: Apache-2.0
"""Rotations as NumPy arrays: quaternions (w, x, y, z), Euler angles in Blender's orders, axis and angle.

An order names the axes in the order in which they act: "XYZ" is R = Rz Ry Rx. Angles are radians.
"""

import numpy as np

AXES = "XYZ"
EULER_ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")


def multiply(a, b):
    """The products a b of quaternions (..., 4): b acts first."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a, float), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b, float), -1, 0)
    return np.stack([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw], axis=-1)


def conjugate(q):
    return np.asarray(q, float) * (1, -1, -1, -1)


def normalized(q):
    """Unit quaternions; the identity for a quaternion of length 0."""
    q = np.asarray(q, float)
    length = np.linalg.norm(q, axis=-1, keepdims=True)
    return np.where(length > 0, q / np.where(length > 0, length, 1), (1.0, 0, 0, 0))


def rotate(q, vectors):
    """Vectors (..., 3) turned by quaternions (..., 4)."""
    pure = np.concatenate([np.zeros_like(vectors[..., :1]), vectors], axis=-1)
    return multiply(multiply(q, pure), conjugate(q))[..., 1:]


def matrices(q):
    """Rotation matrices (..., 3, 3) of unit quaternions."""
    return np.stack([rotate(q, np.broadcast_to(axis, np.shape(q)[:-1] + (3,))) for axis in np.eye(3)], axis=-1)


def angle_between(a, b):
    """The angle of a^-1 b, 0 to pi."""
    d = multiply(conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(d[..., 1:], axis=-1), np.abs(d[..., 0]))


def from_euler(angles, order):
    angles = np.asarray(angles, float)
    q = np.broadcast_to((1.0, 0, 0, 0), angles.shape[:-1] + (4,))
    for axis in map(AXES.index, order):
        turn = np.zeros(q.shape)
        turn[..., 0] = np.cos(angles[..., axis] / 2)
        turn[..., 1 + axis] = np.sin(angles[..., axis] / 2)
        q = multiply(turn, q)
    return q


def _wrapped(angle):
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))


def to_euler_near(q, order, near):
    """The angles (N, 3), by axis x, y, z, that give unit quaternions (N, 4) and lie closest to `near` (N, 3).

    Of the two branches and all whole turns, the one with the smallest largest change. In gimbal lock the two locked
    angles share the change.
    """
    first, second, third = map(AXES.index, order)
    even = 1 if (second - first) % 3 == 1 else -1
    r = matrices(normalized(q))
    near = np.asarray(near, float)
    level = np.hypot(r[:, first, first], r[:, second, first])
    alpha = np.arctan2(even * r[:, third, second], r[:, third, third])
    beta = np.arctan2(-even * r[:, third, first], level)
    gamma = np.arctan2(even * r[:, second, first], r[:, first, first])
    columns = [first, second, third]
    wanted = near[:, columns]

    def closest(triple):
        change = _wrapped(np.stack(triple, axis=-1) - wanted)
        return change, np.abs(change).max(axis=-1)

    change, size = closest((alpha, beta, gamma))
    other, other_size = closest((alpha + np.pi, np.pi - beta, gamma + np.pi))
    change = np.where((other_size < size)[:, None], other, change)

    locked = level < 1e-6
    if locked.any():
        # Only the sum or difference of the outer angles is determined.
        up = np.sign(np.sin(beta))
        outer = np.arctan2(up * r[:, first, second], r[:, second, second])
        rest = _wrapped(outer - (wanted[:, 0] - even * up * wanted[:, 2])) / 2
        share = np.stack([rest, _wrapped(beta - wanted[:, 1]), -even * up * rest], axis=-1)
        change = np.where(locked[:, None], share, change)
    angles = np.empty_like(near)
    angles[:, columns] = wanted + change
    return angles


def to_quaternion_near(q, near):
    """q or -q, whichever is closer to `near`."""
    return np.where((np.sum(q * near, axis=-1) < 0)[..., None], -np.asarray(q), q)


def from_axis_angle(values):
    """Of (angle, x, y, z), as Blender keeps them; an axis of length 0 is y, as in Blender."""
    values = np.asarray(values, float)
    length = np.linalg.norm(values[..., 1:], axis=-1, keepdims=True)
    axis = np.where(length > 0, values[..., 1:] / np.where(length > 0, length, 1), (0.0, 1, 0))
    half = values[..., :1] / 2
    return np.concatenate([np.cos(half), np.sin(half) * axis], axis=-1)


def to_axis_angle_near(q, near):
    """(angle, x, y, z) of unit quaternions, by sign and whole turns closest to `near`, whose axis stays where q does not turn."""
    q, near = normalized(q), np.asarray(near, float)
    sine = np.linalg.norm(q[..., 1:], axis=-1)
    length = np.linalg.norm(near[..., 1:], axis=-1, keepdims=True)
    old_axis = np.where(length > 0, near[..., 1:] / np.where(length > 0, length, 1), (0.0, 1, 0))
    turns = sine > 1e-9
    axis = np.where(turns[..., None], q[..., 1:] / np.where(turns, sine, 1)[..., None], old_axis)
    angle = 2 * np.arctan2(sine, q[..., 0]) * 1.0
    flip = np.sum(axis * old_axis, axis=-1) < 0
    axis = np.where(flip[..., None], -axis, axis)
    angle = np.where(flip, -angle, angle)
    angle = near[..., 0] + _wrapped(angle - near[..., 0])
    return np.concatenate([angle[..., None], axis], axis=-1)


WIDTHS = {"QUATERNION": 4, "AXIS_ANGLE": 4, **{order: 3 for order in EULER_ORDERS}}


def to_quaternions(values, mode):
    """Quaternions (N, 4) of channel values in a rotation mode of Blender's."""
    if mode == "QUATERNION":
        return normalized(values)
    return from_axis_angle(values) if mode == "AXIS_ANGLE" else from_euler(values, mode)


def to_values_near(q, mode, near):
    """Channel values in a rotation mode, closest to the values `near`."""
    if mode == "QUATERNION":
        return to_quaternion_near(normalized(q), near)
    return to_axis_angle_near(q, near) if mode == "AXIS_ANGLE" else to_euler_near(q, mode, near)
