# SPDX-License-Identifier: Apache-2.0
"""Tests of the add-on within Blender, without a window:

    blender -b --factory-startup --python-exit-code 1 --python blender/test/in_blender.py -- PROGRAM TAKES

PROGRAM is kinemend, TAKES the folder examples/takes.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import addon_utils
import bpy
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(FOLDER))
PROGRAM, TAKES = sys.argv[sys.argv.index("--") + 1:][:2]

import kinemend_blender  # noqa: E402
from kinemend_blender import cleaning, program, rotations, takes  # noqa: E402
from kinemend_blender.rig import Rig, RigError, curves_of  # noqa: E402

NEAR_DEG = 1e-4


class Settings:
    def __init__(self, **others):
        self.method, self.source, self.strength, self.bones, self.pattern = "gaussian", "unknown", 1.0, "ALL", "*"
        self.use_range, self.first, self.last, self.feet, self.root_position = False, 1, 100, "off", True
        vars(self).update(others)


def run_program(*words, data=None):
    return subprocess.run([PROGRAM, *map(str, words)], input=data, capture_output=True, check=True).stdout


def pose_rotations(armature, times):
    """Rotations of the bones about their rest pose (F, J, 4) and locations, as Blender itself evaluates them."""
    turns, places = [], []
    for time in times:
        bpy.context.scene.frame_set(int(np.floor(time + 1e-6)), subframe=float(max(time - np.floor(time + 1e-6), 0)))
        bones = armature.pose.bones
        matrices = [bone.matrix_basis for bone in bones]
        turns.append([matrix.to_quaternion() for matrix in matrices])
        places.append([matrix.to_translation() for matrix in matrices])
    return np.array(turns, float), np.array(places, float)


def largest_deg(a, b):
    return np.degrees(rotations.angle_between(rotations.normalized(a), rotations.normalized(b)).max())


class InBlender(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.preferences.filepaths.use_scripts_auto_execute = False
        for addon in ("io_anim_bvh", "io_scene_fbx"):
            addon_utils.enable(addon)
        # Blender 3.4's BVH importer opens files in a mode that Python 3.11 no longer has.
        import io_anim_bvh.import_bvh
        io_anim_bvh.import_bvh.open = lambda path, _mode: open(path)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="kinemend-test-"))

    def armature(self):
        armature = next(each for each in bpy.data.objects if each.type == "ARMATURE")
        bpy.context.view_layer.objects.active = armature
        return armature

    def import_bvh(self, path=None, mode="NATIVE", **others):
        path = path or self.short_take()
        bpy.ops.import_anim.bvh(filepath=str(path), rotate_mode=mode, **{"update_scene_fps": True, **others})
        return self.armature()

    def short_take(self):
        lines = pathlib.Path(TAKES, "noisy_walk.bvh").read_text().splitlines(keepends=True)
        motion = next(i for i, line in enumerate(lines) if line.startswith("MOTION"))
        frames = 240
        lines[motion + 1] = f"Frames: {frames}\n"
        path = self.folder / "walk.bvh"
        path.write_text("".join(lines[:motion + 3 + frames]))
        return path

    @staticmethod
    def remove_keys(keys, first, last):
        for i in reversed(range(len(keys))):
            if first <= keys[i].co[0] <= last:
                keys.remove(keys[i])

    def clean(self, **settings):
        job = cleaning.Job(bpy.context, Settings(**settings), PROGRAM)
        job.start()
        self.message = job.finish()
        return job

    def expected(self, job):
        """What the program makes of the same npz, about the rest pose."""
        words = [word for word in job.words[1:] if not word.startswith("--report") and not word.endswith((".json", ".html"))]
        cleaned = takes.from_npz(run_program(*words, data=job.data))
        return job.rig.local_rotations(cleaned["rotations"]), cleaned["positions"]

    def expect_result(self, armature, job):
        turns, places = pose_rotations(armature, job.rig.times)
        columns = [list(armature.pose.bones).index(armature.pose.bones[joint.name]) for joint in job.rig.joints]
        wanted, positions = self.expected(job)
        self.assertLess(largest_deg(turns[:, columns], wanted), NEAR_DEG)
        if job.rig.joints[0].moves():
            wanted_place = job.rig.locations(positions[:, 0])
            size = np.abs(wanted_place).max()
            self.assertLess(np.abs(places[:, columns[0]] - wanted_place).max(), 1e-6 * size)
        return turns[:, columns]

    def test_a_bvh_gets_the_programs_result_in_every_rotation_mode(self):
        for mode in ("NATIVE", "XYZ", "ZYX", "QUATERNION"):
            with self.subTest(mode):
                self.setUp()
                armature = self.import_bvh(mode=mode)
                before = armature.animation_data.action
                job = self.clean()
                self.assertIsNot(armature.animation_data.action, before)
                self.expect_result(armature, job)

    def test_axis_and_angle(self):
        armature = self.import_bvh(mode="QUATERNION")
        action = armature.animation_data.action
        rig = Rig(armature, action, 1.0)
        rig.take(30)
        for curve in list(action.fcurves):
            if curve.data_path.endswith("rotation_quaternion"):
                action.fcurves.remove(curve)
        for j, joint in enumerate(rig.joints):
            armature.pose.bones[joint.name].rotation_mode = "AXIS_ANGLE"
            near = np.zeros((rig.count, 4)) + (0, 0, 1, 0)
            values = rotations.to_axis_angle_near(rotations.normalized(rig.channels[j]), near)
            for component in range(4):
                curve = action.fcurves.new(f'pose.bones["{joint.name}"].rotation_axis_angle', index=component)
                cleaning.write_keys(curve, rig.times, values[:, component])
        self.expect_result(armature, self.clean())

    def test_an_fbx_character(self):
        armature = self.import_fbx()
        job = self.clean(method="")
        self.expect_result(armature, job)

    def test_a_take_of_120_hz_in_a_scene_of_24(self):
        armature = self.import_bvh(update_scene_fps=False, use_fps_scale=True)
        job = self.clean()
        self.assertAlmostEqual(job.rig.step, 0.2, places=3)
        self.assertEqual(job.rig.count, 240)
        self.assertAlmostEqual(float(takes.from_npz(job.data)["fps"]), 120, delta=1e-9)  # the file says 0.008333 s
        self.expect_result(armature, job)

    def test_the_program_cleans_the_bvh_to_the_same_motion(self):
        path = self.short_take()
        # npz keeps all digits; the BVH file would round the result to 1e-4 degrees.
        exact = run_program("convert", path, "-", "--to", "npz")
        cleaned = takes.from_npz(run_program("clean", "-", "-o", "-", "-q", "--method", "gaussian", data=exact))
        # Quaternions, because near gimbal lock the importer's single-precision matrices lose digits.
        armature = self.import_bvh(path, mode="QUATERNION")
        job = self.clean()
        mine, _ = pose_rotations(armature, job.rig.times)
        # The importer turns y up to z up, and bones to their own y axes.
        to_file = rotations.normalized((1, -1, 0, 0))
        for b, bone in enumerate(armature.pose.bones):
            along = rotations.multiply(to_file, rotations.normalized(np.array(bone.bone.matrix_local.to_quaternion())))
            whole = cleaned["rotations"][:, list(cleaned["names"]).index(bone.name)]
            local = rotations.multiply(rotations.multiply(rotations.conjugate(along), whole), along)
            self.assertLess(largest_deg(mine[:, b], local), NEAR_DEG, bone.name)

    def expect_places(self, armature):
        """Joints of the take, placed by the program, are where Blender shows the bones."""
        rig = Rig(armature, armature.animation_data.action, 1.0)
        npz, table = self.folder / "places.npz", self.folder / "places.csv"
        npz.write_bytes(takes.to_npz(rig.take(120)))
        run_program("convert", npz, table, "--positions", "--end-sites", "--force")
        lines = [line for line in table.read_text().splitlines() if not line.startswith("#")]
        labels = lines[0].split(",")
        for row in lines[1::60]:
            cells = row.split(",")
            time = rig.times[int(cells[0]) - 1]
            bpy.context.scene.frame_set(int(time), subframe=time - int(time))
            for joint in rig.joints:
                bone = armature.pose.bones[joint.name]
                at = labels.index(joint.name + "_x")
                shown = armature.matrix_world @ bone.head
                self.assertLess(np.abs(np.array(cells[at:at + 3], float) / 1000 - shown).max(), 1e-4, joint.name)

    def import_fbx(self):
        run_program("convert", self.short_take(), self.folder / "walk.fbx")
        bpy.context.scene.render.fps = 120
        bpy.ops.import_scene.fbx(filepath=str(self.folder / "walk.fbx"))
        return self.armature()

    def test_joints_are_where_blender_shows_them(self):
        self.expect_places(self.import_fbx())
        self.setUp()
        armature = self.import_bvh()
        armature.location, armature.rotation_euler, armature.scale = (3, -2, 1), (0.3, 0.2, -1), (0.01, 0.01, 0.01)
        bpy.context.view_layer.update()
        self.expect_places(armature)

    def test_a_bone_that_stands_still_above_the_hips_is_part_of_the_rest_pose(self):
        armature = self.import_bvh()
        bpy.ops.object.mode_set(mode="EDIT")
        bones = armature.data.edit_bones
        above = bones.new("Ground")
        above.head, above.tail = (0, 0, 0), (5, 3, 10)
        hips = next(bone for bone in bones if bone.parent is None and bone.name != "Ground")
        hips.parent = above
        bpy.ops.object.mode_set(mode="OBJECT")
        armature.pose.bones["Ground"].rotation_mode = "XYZ"
        armature.pose.bones["Ground"].rotation_euler = (0.2, -0.1, 0.5)
        bpy.context.view_layer.update()
        self.expect_places(armature)
        job = self.clean()
        self.assertEqual(job.rig.joints[0].name, "Hips")
        self.assertNotIn("Ground", job.rig.index)
        self.expect_result(armature, job)

    def test_missing_keys_are_left_and_others_are_cleaned(self):
        armature = self.import_bvh()
        action = armature.animation_data.action
        path = 'pose.bones["LeftArm"].rotation_euler'
        for component, (first, last) in enumerate(((60, 80), (60, 80), (62, 70))):
            keys = action.fcurves.find(path, index=component).keyframe_points
            self.remove_keys(keys, first, last)
        for component in range(3):
            keys = action.fcurves.find(path, index=component).keyframe_points
            self.remove_keys(keys, 201, 10000)
        job = self.clean()
        after = armature.animation_data.action
        times = [[key.co[0] for key in after.fcurves.find(path, index=c).keyframe_points] for c in range(3)]
        self.assertEqual(times[0], times[2])  # if one curve has a key in a frame, all have
        self.assertNotIn(65.0, times[0])
        self.assertEqual(max(times[0]), 200.0)
        turns, _ = pose_rotations(armature, job.rig.times)
        wanted, _ = self.expected(job)
        j = job.rig.index["LeftArm"]
        column = list(armature.pose.bones).index(armature.pose.bones["LeftArm"])
        keyed = job.rig.key_frames(job.rig.joints[j].rotation)
        self.assertLess(largest_deg(turns[keyed, column], wanted[keyed, j]), NEAR_DEG)

    def test_constraints_are_left_and_do_not_reach_the_action(self):
        plain = self.import_bvh()
        job = self.clean()
        wanted, _ = self.expected(job)
        self.setUp()
        armature = self.import_bvh()
        constraint = armature.pose.bones["LeftArm"].constraints.new("COPY_ROTATION")
        constraint.target, constraint.subtarget = armature, "RightArm"
        job = self.clean()
        again, _ = self.expected(job)
        self.assertEqual(np.abs(wanted - again).max(), 0)
        self.assertEqual(len(armature.pose.bones["LeftArm"].constraints), 1)
        self.assertEqual(armature.pose.bones["LeftArm"].constraints[0].subtarget, "RightArm")
        del plain

    def test_only_chosen_bones_and_frames_change(self):
        armature = self.import_bvh()
        before = armature.animation_data.action
        self.clean(bones="NAME", pattern="leftarm, Right*Leg", use_range=True, first=100, last=150)
        after = armature.animation_data.action
        changed = set()
        for old, new in zip(before.fcurves, after.fcurves):
            for a, b in zip(old.keyframe_points, new.keyframe_points):
                if a.co[1] != b.co[1]:
                    changed.add(old.data_path.split('"')[1])
                    self.assertTrue(100 <= a.co[0] <= 150, a.co[0])
        self.assertEqual(changed, {"LeftArm", "RightLeg", "RightUpLeg"})

    def test_selected_bones(self):
        armature = self.import_bvh()
        for bone in armature.data.bones:
            bone.select = bone.name == "Head"
        job = self.clean(bones="SELECTED")
        self.assertEqual(job.chosen, {"Head"})

    def test_handles_move_with_their_keys_and_interpolation_stays(self):
        armature = self.import_bvh()
        for curve in armature.animation_data.action.fcurves:
            for key in curve.keyframe_points:
                key.interpolation, key.handle_left_type, key.handle_right_type = "BEZIER", "FREE", "FREE"
        before = armature.animation_data.action
        self.clean()
        for old, new in list(zip(before.fcurves, armature.animation_data.action.fcurves))[:12]:
            for a, b in zip(old.keyframe_points, new.keyframe_points):
                self.assertEqual(b.interpolation, "BEZIER")
                self.assertAlmostEqual(b.handle_left[1] - a.handle_left[1], b.co[1] - a.co[1], places=4)

    def test_before_and_after_switch_and_the_original_is_kept(self):
        armature = self.import_bvh()
        before = armature.animation_data.action
        values = [key.co[1] for curve in before.fcurves for key in curve.keyframe_points]
        self.clean()
        after = armature.animation_data.action
        self.assertTrue(before.use_fake_user)
        self.assertEqual(cleaning.other_action(after), before)
        self.assertEqual(cleaning.other_action(before), after)
        self.assertEqual(values, [key.co[1] for curve in before.fcurves for key in curve.keyframe_points])

    def test_marks_and_the_page_of_the_report(self):
        armature = self.import_bvh()
        self.clean(method="auto", feet="auto")
        names = [marker.name for marker in bpy.context.scene.timeline_markers]
        self.assertTrue(any(name.startswith("K spike") for name in names), names)
        self.clean(method="gaussian")  # cleans the new action: its marks replace the old
        self.assertFalse(any(name.startswith("K spike") for name in
                             [marker.name for marker in bpy.context.scene.timeline_markers]))
        self.assertIn(b"<html", pathlib.Path(armature.animation_data.action[cleaning.REPORT]).read_bytes()[:2000])

    def test_feet_are_held_in_metres_whatever_the_armature_is_scaled_to(self):
        self.import_fbx()
        job = self.clean(feet="force", method="auto")
        take = takes.from_npz(job.data)
        height = np.ptp(take["positions"][:, 0, 2])
        self.assertLess(height, 0.5)  # the hips of a person, up and down, in metres
        entry = program.read_report(job.report)
        self.assertGreater(entry["feet"]["held"], 0)

    def test_killing_changes_nothing(self):
        armature = self.import_bvh(pathlib.Path(TAKES, "noisy_walk.bvh"))
        before = armature.animation_data.action
        job = cleaning.Job(bpy.context, Settings(method="nonlocal"), PROGRAM)
        job.start()
        job.run.kill()
        with self.assertRaises(program.ProgramError):
            job.finish()
        self.assertIs(armature.animation_data.action, before)

    def test_refusals_are_lines_for_the_user(self):
        armature = self.import_bvh()
        with self.assertRaisesRegex(program.ProgramError, "is not found"):
            cleaning.Job(bpy.context, Settings(), "/no/such/program")
        with self.assertRaisesRegex(RigError, "no bone is chosen"):
            cleaning.Job(bpy.context, Settings(bones="NAME", pattern="Tail"), PROGRAM)
        armature.animation_data.action = None
        with self.assertRaisesRegex(RigError, "has no action"):
            cleaning.Job(bpy.context, Settings(), PROGRAM)

    def test_the_operators_and_the_panel_register(self):
        kinemend_blender.register()
        try:
            armature = self.import_bvh()
            bpy.context.scene.kinemend.method = "gaussian"
            os.environ["PATH"] = str(pathlib.Path(PROGRAM).parent) + os.pathsep + os.environ["PATH"]
            before = armature.animation_data.action
            self.assertEqual(bpy.ops.kinemend.clean(), {"FINISHED"})
            self.assertIsNot(armature.animation_data.action, before)
            self.assertEqual(bpy.ops.kinemend.compare(), {"FINISHED"})
            self.assertIs(armature.animation_data.action, before)
        finally:
            kinemend_blender.unregister()


if __name__ == "__main__":
    found = unittest.TestLoader().loadTestsFromTestCase(InBlender)
    outcome = unittest.TextTestRunner(verbosity=2).run(found)
    sys.exit(0 if outcome.wasSuccessful() else 1)
