# SPDX-License-Identifier: Apache-2.0
"""The panel, the menu entries, the operators and the preferences."""

import pathlib
import time

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import cleaning
from .program import ProgramError
from .rig import RigError

METHODS = [("", "Default", "The program's default: a learned method, with fall-backs"),
           ("auto", "Auto", "Measures the noise of each bone, repairs spikes, leaves clean takes unchanged"),
           ("learned", "Learned", "A network that ships with the program"),
           ("bilateral", "Bilateral", "Smooths slow motion and keeps quick turns"),
           ("nonlocal", "Non-local means", "Averages similar poses"),
           ("gaussian", "Gaussian", "A plain smoothing filter"),
           ("butterworth", "Butterworth", "A low-pass filter without delay"),
           ("wavelet", "Wavelet", "Removes small wavelet coefficients"),
           ("kalman", "Kalman", "A Kalman smoother"),
           ("median", "Median", "Removes spikes"),
           ("hampel", "Hampel", "Removes spikes and nothing else"),
           ("one-euro", "One Euro", "As in a live stream")]


class KINEMEND_Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="Path of the program kinemend; empty: the one on the search path")

    def draw(self, _context):
        self.layout.prop(self, "program")


class KINEMEND_Settings(bpy.types.PropertyGroup):
    method: EnumProperty(name="Method", items=[(name or "DEFAULT", *rest) for name, *rest in METHODS], default="DEFAULT")
    source: EnumProperty(name="Source", default="unknown", description="What recorded the motion", items=[
        ("unknown", "Unknown", "Only what the motion itself shows to be noise is taken out"),
        ("optical", "Optical", "Markers and cameras; as unknown"),
        ("suit", "Suit", "Sensors on the body: slow noise is taken out, too"),
        ("video", "Video", "Pose estimation without markers: slow noise is taken out, too"),
        ("depth", "Depth camera", "Slow noise is taken out, too"),
        ("keyframed", "Keyframed", "Keys set by hand: the default and Auto change nothing")])
    strength: FloatProperty(name="Strength", min=0, max=1, default=1, subtype="FACTOR",
                            description="How far to go from the input (0) to the cleaned motion (1)")
    bones: EnumProperty(name="Bones", default="ALL", items=[
        ("ALL", "All", "Every bone may change"), ("SELECTED", "Selected", "Selected bones may change"),
        ("NAME", "By name", "Bones that fit a pattern may change")])
    pattern: StringProperty(name="Names", default="*", description="Names or patterns, separated by commas: *Arm*, Head")
    use_range: BoolProperty(name="Frame range", description="Change these frames only")
    first: IntProperty(name="First", default=1)
    last: IntProperty(name="Last", default=250)
    feet: EnumProperty(name="Feet", default="by-source", items=[
        ("by-source", "By source", "As auto if the source is video, a depth camera or a suit"), ("off", "Off", "Feet are left"), ("auto", "Auto", "Slides of standing feet that are errors are removed"),
        ("force", "Force", "Every standing foot is held")])
    root_position: BoolProperty(name="Root position", default=True, description="Also clean the root's path")


class _Values:
    """The settings as the rest of the add-on sees them."""

    def __init__(self, settings):
        for name in ("source", "strength", "bones", "pattern", "use_range", "first", "last", "feet", "root_position"):
            setattr(self, name, getattr(settings, name))
        self.method = "" if settings.method == "DEFAULT" else settings.method


def program_path(context):
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.program) if addon and addon.preferences.program else ""


class KINEMEND_OT_clean(bpy.types.Operator):
    """Clean the active action of the armature into a new action; Escape stops"""
    bl_idname = "kinemend.clean"
    bl_label = "Clean Motion"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        return bool(thing and thing.type == "ARMATURE" and thing.animation_data and thing.animation_data.action)

    def _start(self, context):
        try:
            self.job = cleaning.Job(context, _Values(context.scene.kinemend), program_path(context))
            self.job.start()
        except (RigError, ProgramError) as error:
            self.report({"ERROR"}, str(error))
            return False
        return True

    def _finish(self):
        try:
            self.report({"INFO"}, self.job.finish())
        except ProgramError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def execute(self, context):
        return self._finish() if self._start(context) else {"CANCELLED"}

    def invoke(self, context, _event):
        if not self._start(context):
            return {"CANCELLED"}
        self.began = time.monotonic()
        manager = context.window_manager
        manager.progress_begin(0, 9999)
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self.job.run.kill()
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        seconds = time.monotonic() - self.began
        context.window_manager.progress_update(int(10 * seconds) % 9999)
        context.workspace.status_text_set(f"Kinemend: cleaning for {seconds:.0f} s; Escape stops")
        if not self.job.run.is_done():
            return {"RUNNING_MODAL"}
        self._close(context)
        return self._finish()

    def cancel(self, context):
        self.job.run.kill()
        self._close(context)

    def _close(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)


class KINEMEND_OT_compare(bpy.types.Operator):
    """Switch between the action before and after cleaning"""
    bl_idname = "kinemend.compare"
    bl_label = "Before / After"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return KINEMEND_OT_clean.poll(context) and cleaning.other_action(context.active_object.animation_data.action) is not None

    def execute(self, context):
        armature = context.active_object
        cleaning.activate(armature, cleaning.other_action(armature.animation_data.action))
        return {"FINISHED"}


class KINEMEND_OT_report(bpy.types.Operator):
    """Open the report of the cleaned action in the browser"""
    bl_idname = "kinemend.report"
    bl_label = "Report in the Browser"

    @classmethod
    def poll(cls, context):
        return KINEMEND_OT_clean.poll(context) and bool(context.active_object.animation_data.action.get(cleaning.REPORT))

    def execute(self, context):
        page = pathlib.Path(context.active_object.animation_data.action[cleaning.REPORT])
        if not page.exists():
            self.report({"ERROR"}, "the report is gone: it lasts until Blender ends; clean again")
            return {"CANCELLED"}
        bpy.ops.wm.url_open(url=page.as_uri())
        return {"FINISHED"}


class KINEMEND_PT_panel(bpy.types.Panel):
    bl_label = "Kinemend"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Kinemend"

    def draw(self, context):
        layout, settings = self.layout, context.scene.kinemend
        for name in ("method", "source", "strength", "bones"):
            layout.prop(settings, name)
        if settings.bones == "NAME":
            layout.prop(settings, "pattern")
        layout.prop(settings, "feet")
        layout.prop(settings, "root_position")
        layout.prop(settings, "use_range")
        if settings.use_range:
            row = layout.row(align=True)
            row.prop(settings, "first")
            row.prop(settings, "last")
        layout.operator("kinemend.clean", icon="BRUSHES_ALL")
        layout.operator("kinemend.compare", icon="FILE_REFRESH")
        layout.operator("kinemend.report", icon="URL")


def draw_menu(menu, _context):
    menu.layout.separator()
    menu.layout.operator("kinemend.clean", text="Clean Motion (Kinemend)")
    menu.layout.operator("kinemend.compare", text="Before / After (Kinemend)")


CLASSES = (KINEMEND_Preferences, KINEMEND_Settings, KINEMEND_OT_clean, KINEMEND_OT_compare, KINEMEND_OT_report, KINEMEND_PT_panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.kinemend = PointerProperty(type=KINEMEND_Settings)
    bpy.types.DOPESHEET_MT_key.append(draw_menu)


def unregister():
    bpy.types.DOPESHEET_MT_key.remove(draw_menu)
    del bpy.types.Scene.kinemend
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
