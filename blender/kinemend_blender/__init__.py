# SPDX-License-Identifier: Apache-2.0
"""Kinemend for Blender: cleans the motion of an armature by the program kinemend, into a new action."""

bl_info = {
    "name": "Kinemend",
    "author": "The Kinemend authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Kinemend; Dope Sheet > Key",
    "description": "Cleans motion capture: jitter, spikes, sliding feet",
    "category": "Animation",
}

try:
    import bpy  # noqa: F401
except ModuleNotFoundError:
    pass  # plain Python, in tests: modules that do not need Blender still work
else:
    from .interface import register, unregister  # noqa: F401
