# SPDX-License-Identifier: Apache-2.0
"""Installs the packed add-on into Blender, cleans an FBX character by its operator, and looks at the result; opens no source.

    BLENDER_USER_SCRIPTS=$(mktemp -d) blender -b --factory-startup --python-exit-code 1 \
        --python blender/test/installed.py -- ZIP PROGRAM TAKES
"""

import pathlib
import subprocess
import sys
import tempfile

import addon_utils
import bpy
import numpy as np

ZIP, PROGRAM, TAKES = sys.argv[sys.argv.index("--") + 1:][:3]


def jitter(action):
    """The mean second difference of all keys."""
    values = []
    for curve in action.fcurves:
        if "rotation" in curve.data_path and len(curve.keyframe_points) > 3:
            keys = np.empty(2 * len(curve.keyframe_points), np.float32)
            curve.keyframe_points.foreach_get("co", keys)
            values.append(np.abs(np.diff(keys[1::2], 2)).mean())
    return float(np.mean(values))


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("io_scene_fbx")
    bpy.ops.preferences.addon_install(filepath=ZIP)
    bpy.ops.preferences.addon_enable(module="kinemend_blender")
    bpy.context.preferences.addons["kinemend_blender"].preferences.program = PROGRAM
    fbx = pathlib.Path(tempfile.mkdtemp(prefix="kinemend-test-")) / "walk.fbx"
    subprocess.run([PROGRAM, "convert", pathlib.Path(TAKES) / "noisy_walk.bvh", fbx], check=True)
    bpy.context.scene.render.fps = 120
    bpy.ops.import_scene.fbx(filepath=str(fbx))
    armature = next(each for each in bpy.data.objects if each.type == "ARMATURE")
    bpy.context.view_layer.objects.active = armature
    before = armature.animation_data.action
    rough = jitter(before)
    assert bpy.ops.kinemend.clean() == {"FINISHED"}
    after = armature.animation_data.action
    assert after != before and after.name == before.name + ".clean", after.name
    assert jitter(before) == rough and jitter(after) < rough / 4, (rough, jitter(after))
    assert any(marker.name.startswith("K spike") for marker in bpy.context.scene.timeline_markers)
    assert bpy.ops.kinemend.compare() == {"FINISHED"} and armature.animation_data.action == before
    assert bpy.ops.kinemend.compare() == {"FINISHED"} and armature.animation_data.action == after
    bpy.ops.preferences.addon_disable(module="kinemend_blender")
    assert not hasattr(bpy.types.Scene, "kinemend")
    print(f"installed: cleaned in Blender {bpy.app.version_string}; jitter {rough:.2g} to {jitter(after):.2g} radians a frame squared")


main()
