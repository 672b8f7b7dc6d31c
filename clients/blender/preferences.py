"""What is kept from session to session, and what is not."""

import bpy
from bpy.props import CollectionProperty, EnumProperty, IntProperty, StringProperty

READER_ITEMS = (
    ("IMAGE", "Image nodes", "For Cycles and EEVEE, on every device"),
    ("OSL", "OSL shader", "For Cycles with Open Shading Language, on the CPU or OptiX"),
)
"""How a table is read: names in `material.READERS`."""


class Preferences(bpy.types.AddonPreferences):
    """The service, and where its files go."""

    bl_idname = __package__

    server: StringProperty(name="Server", default="http://localhost:8000")
    folder: StringProperty(name="Folder for textures", subtype="DIR_PATH", default="~/Nacreous")

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw both fields."""
        self.layout.prop(self, "server")
        self.layout.prop(self, "folder")


class Preset(bpy.types.PropertyGroup):
    """A preset of the service, by its name."""


class Session(bpy.types.PropertyGroup):
    """What the panel shows: gone when Blender closes."""

    presets: CollectionProperty(type=Preset)
    chosen: IntProperty()
    reader: EnumProperty(name="Read with", items=READER_ITEMS)


def preferences(context: bpy.types.Context) -> Preferences:
    """Return the add-on's preferences."""
    return context.preferences.addons[__package__].preferences


CLASSES = (Preferences, Preset, Session)
