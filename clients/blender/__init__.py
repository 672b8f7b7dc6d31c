"""Nacreous for Blender: materials of thin films from lookup textures. README.md is the manual."""

import bpy

from . import operators, panel, preferences

CLASSES = (*preferences.CLASSES, *operators.CLASSES, *panel.CLASSES)


def register() -> None:
    """Add the classes, and what a session remembers."""
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.WindowManager.nacreous = bpy.props.PointerProperty(type=preferences.Session)


def unregister() -> None:
    """Take everything away again."""
    del bpy.types.WindowManager.nacreous
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
