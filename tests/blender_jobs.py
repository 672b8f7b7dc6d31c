"""What Blender does for the tests, in its own process: python blender_jobs.py JOBS.json ANSWERS.json.

A job is an object whose ``job`` names a function here; the others are its arguments. The answers are a list.
The add-on is installed from its archive, as an artist would, and used through its operators alone.
"""

import contextlib
import io
import json
import os
import sys
import traceback
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

MODULE = "bl_ext.user_default.nacreous"
STRIP_ROWS = 4
"""Blender renders no picture of fewer rows."""


def install(archive: str) -> dict[str, Any]:
    """Install and enable the extension."""
    # the Python module leaves out Blender's own packages: the compiler of OSL nodes asks one of them
    sys.path.append(bpy.utils.resource_path("LOCAL") + "/python/lib/python3.11/site-packages")
    bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    return {"enabled": MODULE in bpy.context.preferences.addons, "operators": operators()}


def uninstall() -> dict[str, Any]:
    """Disable it and enable it again, then disable it for good."""
    for operate in ("disable", "enable", "disable"):
        getattr(bpy.ops.preferences, f"addon_{operate}")(module=MODULE)
    session = hasattr(bpy.types.WindowManager, "nacreous")
    return {
        "enabled": MODULE in bpy.context.preferences.addons,
        "operators": operators(),
        "session": session,
        "panels": hasattr(bpy.types, "NACREOUS_PT_view"),
    }


def operators() -> list[str]:
    """Return the operators of the add-on that Blender knows."""
    return sorted(name for name in dir(bpy.ops.nacreous) if not name.startswith("_"))


def read_strip(path: str, reader: str, output: str, points: list[list[float]], picture: str) -> None:
    """Render a strip whose i-th pixel emits what the film's group gives for the i-th point."""
    scene = empty_scene(len(points), STRIP_ROWS, reader)
    corners = [(x, y, 0) for x in range(len(points) + 1) for y in (0, STRIP_ROWS)]
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(len(points))]
    strip = added("strip", mesh_of(corners, faces))
    cos_theta, thickness_scale = np.array(points, np.float32).T
    # the camera looks along -z: a normal at acos(cos_theta) from +z
    normals = np.stack([np.sqrt(1 - cos_theta**2), 0 * cos_theta, cos_theta], axis=1)
    strip.data.attributes.new("normal", "FLOAT_VECTOR", "FACE").data.foreach_set("vector", normals.ravel())
    strip.data.attributes.new("scale", "FLOAT", "FACE").data.foreach_set("value", thickness_scale)
    create_material(path, reader)
    emit(strip.active_material.node_tree, output)
    look_down(scene, (len(points) / 2, STRIP_ROWS / 2), len(points))
    render(scene, picture)


def emit(tree: bpy.types.NodeTree, output: str) -> None:
    """Let the material emit an output of the film's group, read where the attributes say."""
    film = next(node for node in tree.nodes if node.type == "GROUP")
    surface = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL").inputs["Surface"]
    for attribute, result, socket in (("normal", "Vector", "Normal"), ("scale", "Fac", "Thickness Scale")):
        node = tree.nodes.new("ShaderNodeAttribute")
        node.attribute_name = attribute
        tree.links.new(node.outputs[result], film.inputs[socket])
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(film.outputs[output], emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], surface)


def render_sphere(
    path: str, reader: str, thickness_scale: float, pixels: int, samples: int, picture: str
) -> None:
    """Render a sphere that fills the picture, in a white world, with the material as it is made."""
    scene, _ = sphere_in_white(path, reader, thickness_scale, pixels)
    scene.cycles.samples = samples
    render(scene, picture)


def render_sphere_by_shader(path: str, thickness_scale: float, pixels: int, picture: str) -> None:
    """Render the sphere with the OSL shader's own cosine instead of the group's."""
    scene, group = sphere_in_white(path, "OSL", thickness_scale, pixels)
    see_by_shader(group)
    render(scene, picture)


def see_by_shader(group: bpy.types.NodeTree) -> None:
    """Let the OSL shader take the cosine of its own N and I."""
    script = next(node for node in group.nodes if node.type == "SCRIPT")
    cosine = script.inputs["cos_theta"]
    group.links.remove(cosine.links[0])
    cosine.default_value = -1


def render_sphere_of_closure(
    path: str, closure: str, ior: float, thickness_scale: float, pixels: int, samples: int, picture: str
) -> None:
    """Render the sphere with an OSL shader that turns R and T into a closure."""
    scene, _ = sphere_in_white(path, "OSL", thickness_scale, pixels)
    scene.cycles.samples = samples
    tree = bpy.context.view_layer.objects[0].active_material.node_tree
    add_closure(tree, closure).inputs["ior"].default_value = ior
    render(scene, picture)


def add_closure(tree: bpy.types.NodeTree, closure: str) -> bpy.types.Node:
    """Let an OSL shader make the material's surface of R and T."""
    script = tree.nodes.new("ShaderNodeScript")
    script.script = bpy.data.texts.load(closure)
    film = next(node for node in tree.nodes if node.type == "GROUP")
    for name in set(film.outputs.keys()) & {"R", "T"}:
        tree.links.new(film.outputs[name], script.inputs[name])
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(script.outputs["surface"], output.inputs["Surface"])
    return script


def render_draining_sphere(
    path: str,
    closure: str,
    thickness_scale: tuple[float, float],
    roughness: float,
    surroundings: str,
    pixels: int,
    samples: int,
    picture: str,
) -> None:
    """Render a sphere by both OSL shaders; its film changes evenly from its top, y = 1, to its bottom."""
    scene, group = sphere_in_white(path, "OSL", thickness_scale[0], pixels)
    see_by_shader(group)
    scene.cycles.samples = samples
    tree = bpy.context.view_layer.objects[0].active_material.node_tree
    add_closure(tree, closure).inputs["roughness"].default_value = roughness
    drain(tree, *thickness_scale)
    SURROUNDINGS[surroundings](scene)
    render(scene, picture)


def drain(tree: bpy.types.NodeTree, top: float, bottom: float) -> None:
    """Connect a thickness that goes from y = 1 to y = -1."""
    place, parts, scale = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("NewGeometry", "SeparateXYZ", "MapRange")
    )
    tree.links.new(place.outputs["Position"], parts.inputs[0])
    tree.links.new(parts.outputs["Y"], scale.inputs["Value"])
    for name, value in {"From Min": -1, "From Max": 1, "To Min": bottom, "To Max": top}.items():
        scale.inputs[name].default_value = value
    film = next(node for node in tree.nodes if node.type == "GROUP")
    tree.links.new(scale.outputs["Result"], film.inputs["Thickness Scale"])


def stay_white(_: bpy.types.Scene) -> None:
    """Leave the white world of `sphere_in_white`."""


def light_studio(scene: bpy.types.Scene) -> None:
    """Dim the world, add two soft boxes, and leave out what is behind the sphere."""
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.35
    scene.render.film_transparent = True
    scene.cycles.filter_width = 1.5
    for place, size, watts in (((-4, 5, 4), 4, 700), ((5, -1, 4), 2.5, 250)):
        lamp = bpy.data.lights.new("soft box", "AREA")
        lamp.energy, lamp.size = watts, size
        made = added("soft box", lamp)
        made.location = place
        made.rotation_euler = Vector(place).to_track_quat("Z", "Y").to_euler()


SURROUNDINGS = {"white": stay_white, "studio": light_studio}


def sphere_in_white(
    path: str, reader: str, thickness_scale: float, pixels: int
) -> tuple[bpy.types.Scene, bpy.types.NodeTree]:
    """Return a scene of a coated sphere that fills the picture, and the film's node group."""
    scene = empty_scene(pixels, pixels, reader)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=1)
    bpy.ops.object.shade_smooth()
    create_material(path, reader)
    tree = bpy.context.active_object.active_material.node_tree
    film = next(node for node in tree.nodes if node.type == "GROUP")
    film.inputs["Thickness Scale"].default_value = thickness_scale
    scene.world = bpy.data.worlds.new("white")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    look_down(scene, (0, 0), 2)
    return scene, film.node_tree


def refuse(path: str, reader: str) -> dict[str, Any]:
    """Ask for a material of a file that is none, and return what Blender said and what it made."""
    before = datablocks()
    message = said(lambda: create_material(path, reader))
    return {"message": message, "made": sorted(datablocks() - before)}


def list_presets(server: str, online: bool = True) -> dict[str, Any]:  # noqa: FBT001, FBT002 - the artist's switch
    """Ask a service for its presets through the operator."""
    bpy.context.preferences.system.use_online_access = online
    message = said(lambda: bpy.ops.nacreous.list_presets(server=server))
    return {"message": message, "names": [one.name for one in bpy.context.window_manager.nacreous.presets]}


def fetch_preset(server: str, preset: str, folder: str) -> dict[str, Any]:
    """Fetch a preset through the operator."""
    bpy.context.preferences.system.use_online_access = True
    before = datablocks()
    message = said(lambda: bpy.ops.nacreous.fetch_preset(server=server, preset=preset, folder=folder))
    return {"message": message, "made": sorted(datablocks() - before)}


def empty_scene(width: int, height: int, reader: str) -> bpy.types.Scene:
    """Return the scene without any object, set up so that a pixel is one ray's linear colour."""
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.materials, *bpy.data.meshes, *bpy.data.node_groups])
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.shading_system, cycles.samples = "CPU", reader == "OSL", 1
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 64
    cycles.sample_clamp_indirect = 0
    scene.view_settings.view_transform = "Raw"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    return scene


def mesh_of(corners: list[tuple[float, ...]], faces: list[tuple[int, ...]]) -> bpy.types.Mesh:
    """Return a new mesh."""
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(corners, [], faces)
    return mesh


def added(name: str, data: bpy.types.ID) -> bpy.types.Object:
    """Return a new active object."""
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    return made


def look_down(scene: bpy.types.Scene, centre: tuple[float, float], width: float) -> None:
    """Look along -z without perspective."""
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.ortho_scale = "ORTHO", width
    scene.camera = added("camera", camera)
    scene.camera.location = (*centre, 5)


def render(scene: bpy.types.Scene, picture: str) -> None:
    """Render into a file."""
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


def create_material(path: str, reader: str) -> None:
    """Make the material through the operator."""
    bpy.ops.nacreous.create_material(filepath=path, reader=reader)


def said(operate: Any) -> str:  # noqa: ANN401 - anything that can be called
    """Return the error that an operator reported, or nothing."""
    try:
        operate()
    except RuntimeError as error:  # how Blender hands a reported error to scripts
        return str(error).removeprefix("Error: ").strip()
    return ""


def datablocks() -> set[str]:
    """Return the names of all that an add-on might make."""
    data = bpy.data
    return {
        f"{kind} {one.name}"
        for kind in ("materials", "node_groups", "images", "texts")
        for one in getattr(data, kind)
    }


def main() -> int:
    """Do all jobs; report the first that fails."""
    jobs, answers = Path(sys.argv[1]), Path(sys.argv[2])
    done = []
    for job in json.loads(jobs.read_text()):
        work = globals()[job.pop("job")]
        with contextlib.redirect_stdout(io.StringIO()):
            done.append(work(**job))
    answers.write_text(json.dumps(done))
    return 0


if __name__ == "__main__":
    try:
        status = main()
    except Exception:  # noqa: BLE001 - told on stderr and by the status
        traceback.print_exc()
        status = 1
    # the Python module can hang as the interpreter takes it down
    sys.stderr.flush()
    os._exit(status)
