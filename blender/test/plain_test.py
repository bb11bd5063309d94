# SPDX-License-Identifier: Apache-2.0
"""Tests of what the add-on does without Blender: python3 blender/test/plain_test.py [PROGRAM]

Without NumPy everything is skipped; with PROGRAM, which is kinemend, takes go through it.
"""

import itertools
import math
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
PROGRAM = sys.argv.pop() if len(sys.argv) > 1 and not sys.argv[-1].startswith("-") else None

try:
    import numpy as np
except ModuleNotFoundError:
    print("skipped: there is no NumPy")
    sys.exit(77)

from kinemend_blender import curves, program, rotations, takes  # noqa: E402

RANDOM = np.random.default_rng(7)


def axis_matrix(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return {"X": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]), "Y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
            "Z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])}[axis]


def random_rotations(count):
    return rotations.normalized(RANDOM.normal(size=(count, 4)))


class Rotations(unittest.TestCase):
    def test_an_order_names_the_axes_in_the_order_in_which_they_act(self):
        for order in rotations.EULER_ORDERS:
            angles = RANDOM.uniform(-3, 3, 3)
            first, second, third = (axis_matrix(axis, angles["XYZ".index(axis)]) for axis in order)
            found = rotations.matrices(rotations.from_euler(angles, order))
            np.testing.assert_allclose(found, third @ second @ first, atol=1e-12)

    def test_angles_give_the_rotation_back_and_stay_close(self):
        for order in rotations.EULER_ORDERS:
            near = RANDOM.uniform(-9, 9, (500, 3))
            q = rotations.multiply(rotations.from_euler(near, order), rotations.normalized(
                np.concatenate([np.ones((500, 1)), RANDOM.normal(size=(500, 3)) * 0.01], axis=1)))
            angles = rotations.to_euler_near(q, order, near)
            self.assertLess(rotations.angle_between(rotations.from_euler(angles, order), q).max(), 1e-9)
            level = np.abs(np.cos(near[:, "XYZ".index(order[1])])) > 0.3
            self.assertLess(np.abs(angles - near)[level].max(), 0.3)

    def test_no_other_branch_is_closer(self):
        order, q = "ZXY", random_rotations(200)
        near = RANDOM.uniform(-6, 6, (200, 3))
        chosen = np.abs(rotations.to_euler_near(q, order, near) - near).max(axis=1)
        plain = rotations.to_euler_near(q, order, np.zeros((200, 3)))
        first, second, third = ("XYZ".index(axis) for axis in order)
        other = plain.copy()
        other[:, [first, third]] += math.pi
        other[:, second] = math.pi - plain[:, second]
        for branch, turns in itertools.product((plain, other), itertools.product((-2, -1, 0, 1, 2), repeat=3)):
            size = np.abs(branch + 2 * math.pi * np.array(turns) - near).max(axis=1)
            self.assertTrue((chosen <= size + 1e-9).all())

    def test_in_gimbal_lock_the_rotation_is_exact_and_the_change_is_shared(self):
        for order, sign in itertools.product(rotations.EULER_ORDERS, (1, -1)):
            near = RANDOM.uniform(-1, 1, (50, 3))
            locked = near.copy()
            locked[:, "XYZ".index(order[1])] = sign * math.pi / 2
            locked[:, "XYZ".index(order[0])] += 0.2
            q = rotations.from_euler(locked, order)
            angles = rotations.to_euler_near(q, order, near)
            self.assertLess(rotations.angle_between(rotations.from_euler(angles, order), q).max(), 1e-6)
            outer = ["XYZ".index(order[0]), "XYZ".index(order[2])]
            self.assertLess(np.abs(angles - near)[:, outer].max(), 0.11)

    def test_quaternions_and_axes_keep_the_side_of_the_original(self):
        near = random_rotations(100)
        self.assertTrue((np.sum(rotations.to_quaternion_near(random_rotations(100), near) * near, axis=1) >= 0).all())
        axis_angle = np.concatenate([RANDOM.uniform(-9, 9, (100, 1)), RANDOM.normal(size=(100, 3))], axis=1)
        q = rotations.from_axis_angle(axis_angle)
        back = rotations.to_axis_angle_near(q, axis_angle)
        self.assertLess(rotations.angle_between(rotations.from_axis_angle(back), q).max(), 1e-7)
        self.assertLess(np.abs(back[:, 0] - axis_angle[:, 0]).max(), 1e-6)
        still = rotations.to_axis_angle_near(np.array([[1.0, 0, 0, 0]]), np.array([[0.1, 0, 0, 1]]))
        np.testing.assert_allclose(still, [[0, 0, 0, 1]], atol=1e-12)

    def test_a_quaternion_of_length_zero_does_not_turn(self):
        np.testing.assert_array_equal(rotations.normalized(np.zeros((1, 4))), [[1, 0, 0, 0]])


class Grid(unittest.TestCase):
    def test_keys_on_frames_between_frames_and_on_twos(self):
        self.assertEqual(takes.frame_grid(np.arange(5, 60)), (5.0, 1.0, 55))
        first, step, count = takes.frame_grid(1 + 0.2 * np.arange(500))
        self.assertEqual((first, count), (1.0, 500))
        self.assertAlmostEqual(step, 0.2)
        self.assertEqual(takes.frame_grid(np.arange(1, 99, 2))[1], 2.0)

    def test_keys_anywhere_are_read_at_whole_frames(self):
        self.assertEqual(takes.frame_grid([1, 2.5, 9, 11.25, 40])[1], 1.0)
        self.assertEqual(takes.frame_grid([7]), (7.0, 1.0, 1))
        self.assertEqual(takes.frame_grid([])[2], 0)

    def test_gaps_do_not_change_the_step(self):
        times = np.delete(np.arange(200.0), slice(50, 90))
        self.assertEqual(takes.frame_grid(times), (0.0, 1.0, 200))

    def test_keys_between_frames_have_no_place(self):
        np.testing.assert_array_equal(takes.places_on_grid([1, 1.5, 3, 99, 0], 1, 1, 10), [0, -1, 2, -1, -1])

    def test_rates_of_rounded_frame_times(self):
        self.assertEqual(takes.usual_rate(1 / 0.008333), 120)
        self.assertEqual(takes.usual_rate(24000 / 1001), 24000 / 1001)


class Package(unittest.TestCase):
    def test_every_file_states_the_version_of_the_project(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        version = re.search(r"project\(kinemend VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
        addon = root / "blender" / "kinemend_blender"
        self.assertIn(f'\nversion = "{version}"\n', (addon / "blender_manifest.toml").read_text())
        self.assertIn(f'"version": ({version.replace(".", ", ")}),', (addon / "__init__.py").read_text())


class FakeKeys:
    """Blender's keyframe_points, as far as write_keys uses them."""

    def __init__(self, times, values):
        self.co = np.stack([times, values], axis=1).astype(float)
        self.handle_left, self.handle_right = self.co - (0.3, 0), self.co + (0.3, 0)
        self.kinds = np.ones(len(self.co), int)

    def __len__(self):
        return len(self.co)

    def _array(self, name):
        return self.kinds if name == "interpolation" or name.endswith("_type") else getattr(self, name)

    def foreach_get(self, name, out):
        out[:] = self._array(name).ravel()

    def foreach_set(self, name, values):
        self._array(name)[...] = np.reshape(values, self._array(name).shape)

    def add(self, count):
        for name in ("co", "handle_left", "handle_right"):
            setattr(self, name, np.concatenate([getattr(self, name), np.zeros((count, 2))]))
        self.kinds = np.concatenate([self.kinds, np.zeros(count, int)])


class FakeCurve:
    def __init__(self, times, values, index=0):
        self.keyframe_points, self.array_index = FakeKeys(times, values), index

    def evaluate(self, time):
        return float(np.interp(time, self.keyframe_points.co[:, 0], self.keyframe_points.co[:, 1]))

    def update(self):
        keys = self.keyframe_points
        order = np.argsort(keys.co[:, 0])
        for name in ("co", "handle_left", "handle_right"):
            setattr(keys, name, getattr(keys, name)[order])
        keys.kinds = keys.kinds[order]


class Curves(unittest.TestCase):
    def test_values_are_those_of_keys_and_of_the_curve_in_between(self):
        part = curves.BoneCurves("location", (7, 8, 9))
        part.add(FakeCurve([1, 2, 4], [10, 20, 40], index=1))
        np.testing.assert_allclose(part.at(np.array([1.0, 2, 3, 4])), [[7, 10, 9], [7, 20, 9], [7, 30, 9], [7, 40, 9]])
        self.assertEqual(part.key_range(), (1, 4))
        self.assertTrue(part.varies())

    def test_keys_move_with_their_handles_and_missing_ones_are_added(self):
        curve = FakeCurve([1, 2, 4], [10, 20, 40])
        curves.write_keys(curve, np.array([2.0, 3, 4]), np.array([21.0, 31, 41]))
        keys = curve.keyframe_points
        np.testing.assert_allclose(keys.co, [[1, 10], [2, 21], [3, 31], [4, 41]])
        np.testing.assert_allclose(keys.handle_left[1], [1.7, 21], atol=1e-6)
        np.testing.assert_array_equal(keys.kinds, 1)

    def test_a_new_curve_gets_keys(self):
        curve = FakeCurve([], [])
        curves.write_keys(curve, np.array([5.0, 6]), np.array([1.0, 2]))
        np.testing.assert_allclose(curve.keyframe_points.co, [[5, 1], [6, 2]])

    def test_a_curve_of_one_key_is_a_constant(self):
        part = curves.BoneCurves("rotation_euler", (0, 0, 0))
        part.add(FakeCurve([1], [3]))
        self.assertIsNone(part.key_range())
        part.add(FakeCurve([10, 50], [0, 1], index=1))
        self.assertEqual(part.key_range(), (10, 50))


class Program(unittest.TestCase):
    def test_names_become_patterns_that_fit_them(self):
        self.assertEqual(program.name_pattern("a,b*c d[e]"), "a?b?c?d?e?")
        self.assertEqual(program.name_pattern("mixamorig:LeftArm"), "mixamorig:LeftArm")

    def test_marks_name_what_was_repaired_and_not_what_was_smoothed(self):
        def finding(kind, verdict, track, frame):
            return {"kind": kind, "verdict": verdict, "track": track, "first_frame": frame}

        entry = {"first_frame": 1, "frame_rate_hz": 100.0, "findings": [
            finding("spike", "despiked", "Arm", 8), finding("noise", "denoised", "Arm", 1),
            finding("spike", "despiked", "Leg", 20), finding("gap", "filled", None, 3), finding("spike", "despiked", "Arm", 90)]}
        self.assertEqual(program.time_marks(entry), [(2, "gap: take"), (7, "spike: Arm +1"), (89, "spike: Arm")])
        self.assertEqual(program.time_marks(entry, most=1), [(7, "spike: Arm +1")])

    def test_a_program_that_is_not_there_is_a_line_for_the_user(self):
        with self.assertRaisesRegex(program.ProgramError, "is not found"):
            program.find_program("/no/such/program")


def walk():
    frames, speed = 200, np.array([0.01, -0.02])
    half = np.arange(frames)[:, None] * speed / 2 + RANDOM.normal(0, 0.02, (frames, 2))
    zero = np.zeros_like(half)
    return {"fps": np.float64(100), "names": np.array(["Hips", "Füße"]), "parents": np.array([-1, 0], np.int32),
            "offsets": np.array([[0, 1.0, 0], [0, -1, 0]]),
            "rotations": np.stack([np.cos(half), np.sin(half), zero, zero], axis=2),
            "positions": RANDOM.normal(0, 0.01, (frames, 1, 3)), "metres_per_unit": np.float64(1)}


@unittest.skipIf(PROGRAM is None, "no program is named")
class WithProgram(unittest.TestCase):
    def clean(self, take, **settings):
        run = program.Run(program.command_line(PROGRAM, **settings), takes.to_npz(take))
        return takes.from_npz(run.result()[0])

    def test_a_take_comes_back_smoother_and_otherwise_the_same(self):
        take = walk()
        cleaned = self.clean(take, method="gaussian")
        for name in ("names", "parents", "offsets", "fps", "metres_per_unit"):
            np.testing.assert_array_equal(cleaned[name], take[name])
        jitter = [np.abs(np.diff(each["rotations"], 2, axis=0)).mean() for each in (take, cleaned)]
        self.assertLess(jitter[1], jitter[0] / 3)

    def test_keys_come_back_where_the_source_says_so(self):
        take = walk()
        self.assertTrue(np.any(self.clean(take)["rotations"] != take["rotations"]))
        np.testing.assert_array_equal(self.clean(take, source="keyframed")["rotations"], take["rotations"])

    def test_other_arrays_and_samples_that_are_not_chosen_stay(self):
        take = {**walk(), "contacts": RANDOM.random((200, 4)).astype(np.float32)}
        cleaned = self.clean(take, method="gaussian", joints=["Füße"], frames=(51, 100))
        np.testing.assert_array_equal(cleaned["contacts"], take["contacts"])
        changed = np.any(cleaned["rotations"] != take["rotations"], axis=2)
        self.assertFalse(changed[:, 0].any() or changed[:50].any() or changed[100:].any())
        self.assertTrue(changed[51:99, 1].all())

    def test_numpy_opens_what_the_program_writes_anew(self):
        takes_folder = pathlib.Path(__file__).resolve().parents[2] / "examples" / "takes"
        words = [PROGRAM, "convert", takes_folder / "walk.bvh", "-", "--to", "npz"]
        take = takes.from_npz(subprocess.run(words, capture_output=True, check=True).stdout)
        frames, joints = take["rotations"].shape[:2]
        self.assertEqual(take["format"], takes.LAYOUT)
        self.assertEqual(take["positions"].shape, (frames, 1, 3))
        self.assertEqual(take["names"].shape, (joints,))
        np.testing.assert_allclose(np.linalg.norm(take["rotations"], axis=2), 1, atol=1e-12)

    def test_an_error_of_the_program_is_told(self):
        with self.assertRaisesRegex(program.ProgramError, "parents"):
            self.clean({**walk(), "parents": np.array([-1, 5], np.int32)})


if __name__ == "__main__":
    unittest.main()
