"""The panel "Nacreous" in the sidebar of the 3D view and of the shader editor."""

import bpy

from .operators import CreateMaterial, FetchPreset, ListPresets
from .preferences import preferences


class FilmPanel:
    """A film from a file, or from a service."""

    bl_label = "Nacreous"
    bl_category = "Nacreous"
    bl_region_type = "UI"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what makes a film, from a file and from the service."""
        session = context.window_manager.nacreous
        self.layout.prop(session, "reader")
        self.layout.operator(CreateMaterial.bl_idname, icon="FILE_IMAGE").reader = session.reader
        service = self.layout.box()
        draw_service(service, context)


class ViewFilmPanel(FilmPanel, bpy.types.Panel):
    """The panel in the 3D view."""

    bl_idname = "NACREOUS_PT_view"
    bl_space_type = "VIEW_3D"


class ShaderFilmPanel(FilmPanel, bpy.types.Panel):
    """The panel in the shader editor."""

    bl_idname = "NACREOUS_PT_shader"
    bl_space_type = "NODE_EDITOR"


def draw_service(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw the address, the list of presets, and the button that fetches the chosen one."""
    session, kept = context.window_manager.nacreous, preferences(context)
    layout.prop(kept, "server")
    layout.prop(kept, "folder", text="Folder")
    layout.operator(ListPresets.bl_idname, icon="FILE_REFRESH")
    if not session.presets:
        return
    layout.template_list("UI_UL_list", "nacreous", session, "presets", session, "chosen", rows=4)
    fetch = layout.operator(FetchPreset.bl_idname, icon="IMPORT")
    fetch.preset, fetch.reader = session.presets[session.chosen].name, session.reader


CLASSES = (ViewFilmPanel, ShaderFilmPanel)
