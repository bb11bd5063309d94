# SPDX-License-Identifier: Apache-2.0
"""Uses the add-on in Blender's window: a modal run, Escape, before and after, the panel. Writes pictures of the window.

    xvfb-run -a -s "-screen 0 1280x800x24" blender --factory-startup --enable-event-simulate \
        --window-geometry 0 0 1280 800 --python blender/test/in_window.py -- PROGRAM TAKES [PICTURES]

The exit status is 0 when every step held.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import time
import traceback

import addon_utils
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
PROGRAM, TAKES, *rest = sys.argv[sys.argv.index("--") + 1:]
PICTURES = pathlib.Path(rest[0]) if rest else None
os.environ["PATH"] = str(pathlib.Path(PROGRAM).resolve().parent) + os.pathsep + os.environ["PATH"]

import kinemend_blender  # noqa: E402

LIMIT_S = 120


def area_of(kind):
    return next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == kind)


class Within:
    """The context of the main part of an area."""

    def __new__(cls, area):
        region = next(each for each in area.regions if each.type == "WINDOW")
        window = bpy.context.window_manager.windows[0]
        return bpy.context.temp_override(window=window, screen=window.screen, area=area, region=region)


def press(kind, x=0, y=0):
    window = bpy.context.window_manager.windows[0]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=kind, value=value, x=x, y=y)


def picture(name):
    if PICTURES is not None:
        PICTURES.mkdir(parents=True, exist_ok=True)
        bpy.ops.screen.screenshot(filepath=str(PICTURES / f"{name}.png"))


def runs_of_program():
    found = subprocess.run(["pgrep", "-c", "-P", str(os.getpid()), "kinemend"], capture_output=True, text=True, check=False)
    return int(found.stdout or 0)


def load_character():
    fbx = pathlib.Path(tempfile.mkdtemp(prefix="kinemend-test-")) / "walk.fbx"
    subprocess.run([PROGRAM, "convert", pathlib.Path(TAKES) / "noisy_walk.bvh", fbx], check=True)
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    bpy.context.scene.render.fps = 120
    bpy.ops.import_scene.fbx(filepath=str(fbx))
    armature = next(each for each in bpy.data.objects if each.type == "ARMATURE")
    bpy.context.view_layer.objects.active = armature
    armature.select_set(True)
    bpy.context.scene.frame_end = 960
    bpy.context.scene.frame_set(400)
    return armature


def silent_program():
    """A folder with a program of the same name that does nothing for a minute."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="kinemend-test-"))
    program = folder / "kinemend"
    program.write_text("#!/usr/bin/python3\nimport time\ntime.sleep(60)\n")
    program.chmod(0o755)
    return str(folder)


def steps():
    """Yields how long to wait, or a condition to wait for."""
    view = area_of("VIEW_3D")
    with Within(view):
        armature = load_character()
        before = armature.animation_data.action
        view.spaces[0].show_region_ui = True
        bpy.ops.view3d.view_axis(type="RIGHT")
        bpy.ops.view3d.view_selected()
    yield 0.5
    settings = bpy.context.scene.kinemend

    # The program never answers, so that Escape comes in time.
    path = os.environ["PATH"]
    os.environ["PATH"] = silent_program() + os.pathsep + path
    with Within(view):
        assert bpy.ops.kinemend.clean("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert runs_of_program() == 1
    yield 0.3
    press("ESC")
    yield lambda: runs_of_program() == 0
    yield 1.0
    assert armature.animation_data.action == before and len(bpy.data.actions) == 1
    os.environ["PATH"] = path

    settings.method, settings.feet = "DEFAULT", "auto"
    with Within(view):
        assert bpy.ops.kinemend.clean("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield lambda: armature.animation_data.action != before
    after = armature.animation_data.action
    assert any(marker.name.startswith("K spike") for marker in bpy.context.scene.timeline_markers)

    # The tab of the add-on is the last one of the sidebar.
    panel = next(each for each in view.regions if each.type == "UI")
    x, y = panel.x + panel.width - 10, panel.y + panel.height - 175
    bpy.context.window_manager.windows[0].event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.5
    press("LEFTMOUSE", x, y)
    yield 1.5
    picture("blender_panel")

    view.type = "GRAPH_EDITOR"
    view.spaces[0].show_region_ui = False
    with Within(view):
        bpy.ops.object.mode_set(mode="POSE")
        for bone in armature.data.bones:
            bone.select = bone.name == "LeftForeArm"
        armature.data.bones.active = armature.data.bones["LeftForeArm"]
    for name, action in (("after", after), ("before", before)):
        if armature.animation_data.action != action:
            with Within(view):
                assert bpy.ops.kinemend.compare() == {"FINISHED"}
        assert armature.animation_data.action == action
        for curve in action.fcurves:
            curve.select = curve.hide = False
            curve.hide = not curve.data_path.startswith('pose.bones["LeftForeArm"].rotation')
        yield 0.5
        with Within(view):
            bpy.ops.graph.view_all()
        yield 1.0
        picture(f"blender_{name}")


class Runner:
    """Takes a step whenever Blender is idle."""

    def __init__(self):
        self.steps, self.condition, self.since = steps(), None, time.monotonic()

    def __call__(self):
        try:
            if self.condition is not None and not self.condition():
                assert time.monotonic() - self.since < LIMIT_S, "waited too long"
                return 0.1
            self.since = time.monotonic()
            waiting = next(self.steps)
            self.condition = waiting if callable(waiting) else None
            return 0.1 if callable(waiting) else waiting
        except StopIteration:
            print("in a window: everything held", flush=True)
            code = 0
        except BaseException:  # Blender would continue without the timer
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        os._exit(code)


bpy.context.preferences.view.show_splash = False
addon_utils.enable("io_scene_fbx")
kinemend_blender.register()
bpy.app.timers.register(Runner(), first_interval=1)
