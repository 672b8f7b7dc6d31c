"""What the artist does: make a material from a file, list presets, fetch one."""

from collections.abc import Callable
from functools import wraps
from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from .lookup_texture import SCENE_SPACE, LookupTexture, TextureError
from .material import film_material
from .preferences import READER_ITEMS, preferences
from .service import Service, ServiceError

Execute = Callable[[bpy.types.Operator, bpy.types.Context], set[str]]


def reporting(execute: Execute) -> Execute:
    """Turn an error that the artist can mend into a message in Blender's status bar."""

    @wraps(execute)
    def reported(self: bpy.types.Operator, context: bpy.types.Context) -> set[str]:
        try:
            return execute(self, context)
        except (TextureError, ServiceError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return reported


class CreateMaterial(bpy.types.Operator, ImportHelper):
    """Make a material from a lookup texture of Nacreous, and give it to the active object."""

    bl_idname = "nacreous.create_material"
    bl_label = "Film from Texture"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - Blender reads a set here

    filename_ext = ".exr"
    filter_glob: StringProperty(default="*.exr", options={"HIDDEN"})
    reader: EnumProperty(name="Read with", items=READER_ITEMS)

    @reporting
    def execute(self, context: bpy.types.Context) -> set[str]:
        """Make the material."""
        use_film(self, context, Path(bpy.path.abspath(self.filepath)))
        return {"FINISHED"}


class ListPresets(bpy.types.Operator):
    """Ask the service for its presets."""

    bl_idname = "nacreous.list_presets"
    bl_label = "List Presets"

    server: StringProperty(name="Server", options={"SKIP_SAVE"})

    @reporting
    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fill the list of the panel."""
        require_network()
        names = Service(self.server or preferences(context).server).presets()
        session = context.window_manager.nacreous
        session.presets.clear()
        for name in names:
            session.presets.add().name = name
        self.report({"INFO"}, f"{len(names)} presets")
        return {"FINISHED"}


class FetchPreset(bpy.types.Operator):
    """Download the chosen preset's textures and make a material of them."""

    bl_idname = "nacreous.fetch_preset"
    bl_label = "Fetch Preset"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - Blender reads a set here

    server: StringProperty(name="Server", options={"SKIP_SAVE"})
    folder: StringProperty(name="Folder", subtype="DIR_PATH", options={"SKIP_SAVE"})
    preset: StringProperty(name="Preset", options={"SKIP_SAVE"})
    reader: EnumProperty(name="Read with", items=READER_ITEMS)

    @reporting
    def execute(self, context: bpy.types.Context) -> set[str]:
        """Download, then make the material."""
        require_network()
        service = Service(self.server or preferences(context).server)
        folder = Path(bpy.path.abspath(self.folder or preferences(context).folder)).expanduser()
        use_film(self, context, service.download(self.preset, folder))
        return {"FINISHED"}


def require_network() -> None:
    """Respect the artist's choice to stay offline; raises `ServiceError`."""
    if not bpy.app.online_access:
        raise ServiceError("Blender is offline: allow online access in Preferences > System > Network")


def use_film(operator: bpy.types.Operator, context: bpy.types.Context, path: Path) -> None:
    """Make a material, give it to the active object, and say what else the artist should know."""
    material = film_material(path, operator.reader)
    active = context.active_object
    if active and hasattr(active.data, "materials"):
        active.active_material = material
    operator.report({"INFO"}, f"Made the material {material.name}")
    for warning in warnings(LookupTexture.read(path), operator.reader, context.scene):
        operator.report({"WARNING"}, warning)


def warnings(texture: LookupTexture, reader: str, scene: bpy.types.Scene) -> list[str]:
    """Return what keeps the film from looking right."""
    found = []
    if texture.colour_space != SCENE_SPACE:
        found.append(f"The texture's colours are {texture.colour_space}, the scene's {SCENE_SPACE}")
    if reader == "OSL" and not (scene.render.engine == "CYCLES" and scene.cycles.shading_system):
        found.append("Render with Cycles, and switch on Open Shading Language in its properties")
    return found


CLASSES = (CreateMaterial, ListPresets, FetchPreset)
