"""Three films in one picture: a soap bubble, anodised titanium, and a beetle's green.

    nacreous tabulate soap-bubble --format exr -o tables      (and anodised-titanium, beetle)
    blender --background --python example.py -- --tables tables --output films.png

It runs as well with the Python module: ``python example.py --tables tables``.
"""

import argparse
import os
import sys
from importlib import util
from math import radians
from pathlib import Path
from types import ModuleType

import bpy

PRESETS = ("soap-bubble", "anodised-titanium", "beetle")
HERE = Path(__file__).resolve().parent


def arguments() -> argparse.Namespace:
    """Parse what stands behind ``--``, or all of it outside of Blender's program."""
    parser = argparse.ArgumentParser(description="Render three thin films.")
    parser.add_argument("--tables", type=Path, default=Path("tables"), help="folder of the lookup textures")
    parser.add_argument("--output", type=Path, default=Path("films.png"))
    parser.add_argument("--width", type=int, default=960, help="in pixels")
    parser.add_argument("--samples", type=int, default=256, help="rays in a pixel")
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    return parser.parse_args(given)


def add_on() -> ModuleType:
    """Return the add-on of this folder, installed or not."""
    spec = util.spec_from_file_location(
        "nacreous_films", HERE / "__init__.py", submodule_search_locations=[str(HERE)]
    )
    module = util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def film(tables: Path, preset: str, roughness: float) -> tuple[bpy.types.Material, bpy.types.Node]:
    """Return the material of a preset's film, and its node group."""
    from nacreous_films.material import film_material

    path = tables / f"{preset}.exr"
    if not path.is_file():
        raise SystemExit(f"{path} is missing: nacreous tabulate {preset} --format exr -o {tables}")
    material = film_material(path)
    group = next(node for node in material.node_tree.nodes if node.type == "GROUP")
    group.inputs["Roughness"].default_value = roughness
    return material, group


def thickness_map(
    material: bpy.types.Material, group: bpy.types.Node, axis: str, ends: tuple[float, float], swirl: float
) -> None:
    """Let the thickness go from one end of the object's own axis to the other, with swirls on top."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    place = nodes.new("ShaderNodeTexCoord")
    height, grown = nodes.new("ShaderNodeSeparateXYZ"), nodes.new("ShaderNodeMapRange")
    links.new(place.outputs["Generated"], height.inputs[0])
    links.new(height.outputs[axis], grown.inputs["Value"])
    grown.inputs["To Min"].default_value, grown.inputs["To Max"].default_value = ends
    noise, swirled = nodes.new("ShaderNodeTexNoise"), nodes.new("ShaderNodeMath")
    noise.inputs["Scale"].default_value, noise.inputs["Distortion"].default_value = 2.2, 1.6
    links.new(place.outputs["Generated"], noise.inputs["Vector"])
    swirled.operation = "MULTIPLY_ADD"
    links.new(noise.outputs["Fac"], swirled.inputs[0])
    swirled.inputs[1].default_value = swirl
    links.new(grown.outputs["Result"], swirled.inputs[2])
    links.new(swirled.outputs[0], group.inputs["Thickness Scale"])


def smooth(material: bpy.types.Material, scale: tuple[float, float, float] = (1, 1, 1)) -> None:
    """Give the active object its film and a smooth shape."""
    bpy.ops.object.shade_smooth()
    bpy.context.active_object.scale = scale
    bpy.context.active_object.data.materials.append(material)


def add_films(tables: Path) -> None:
    """Add the bubble, the ring of titanium, and the beetle."""
    bubble, group = film(tables, "soap-bubble", roughness=0.0)
    thickness_map(bubble, group, "Z", ends=(0.5, 0.1), swirl=0.3)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=192, ring_count=96, radius=1.2, location=(-2.75, 0.3, 1.35))
    smooth(bubble)
    titanium, group = film(tables, "anodised-titanium", roughness=0.3)
    thickness_map(titanium, group, "X", ends=(0.1, 1.5), swirl=0.35)
    bpy.ops.mesh.primitive_torus_add(
        major_segments=256, minor_segments=96, major_radius=0.85, minor_radius=0.36, location=(0, 0, 1.21)
    )
    bpy.context.active_object.rotation_euler = (radians(90), 0, radians(22))
    smooth(titanium)
    beetle, group = film(tables, "beetle", roughness=0.25)
    group.inputs["Thickness Scale"].default_value = 1.08
    bpy.ops.mesh.primitive_uv_sphere_add(segments=192, ring_count=96, radius=1, location=(2.55, 0, 0.82))
    bpy.context.active_object.rotation_euler = (0, 0, radians(-20))
    smooth(beetle, (1.25, 0.85, 0.82))


def add_floor() -> None:
    """Add a dark floor that shows the films once more."""
    bpy.ops.mesh.primitive_plane_add(size=60)
    material = bpy.data.materials.new("floor")
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"].inputs
    surface["Base Color"].default_value = (0.012, 0.013, 0.017, 1)
    surface["Roughness"].default_value = 0.22
    bpy.context.active_object.data.materials.append(material)


def add_lamp(place: tuple[float, float, float], size: tuple[float, float], watts: float) -> None:
    """Add a soft box that shines at the middle of the scene."""
    from mathutils import Vector

    lamp = bpy.data.lights.new("soft box", "AREA")
    lamp.shape, lamp.energy = "RECTANGLE", watts
    lamp.size, lamp.size_y = size
    made = bpy.data.objects.new("soft box", lamp)
    made.location = place
    made.rotation_euler = (Vector((0, 0, 1)) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(made)


def light_scene() -> None:
    """Light the scene as a studio does: soft boxes all around, a dim room."""
    add_lamp((-5, -5, 6), (3, 5), 700)
    add_lamp((6, -3, 5), (2.5, 5), 600)
    add_lamp((0, 5, 5), (9, 2), 500)
    add_lamp((1, -7, 8), (5, 3), 500)
    world = bpy.data.worlds.new("room")
    world.use_nodes = True
    room = world.node_tree.nodes["Background"].inputs
    room["Color"].default_value, room["Strength"].default_value = (0.55, 0.65, 0.85, 1), 0.05
    bpy.context.scene.world = world


def look(scene: bpy.types.Scene, width: int) -> None:
    """Place the camera."""
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 52
    camera.location, camera.rotation_euler = (0, -12.2, 3.0), (radians(81), 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = width, width * 9 // 20
    scene.render.resolution_percentage = 100


def main() -> None:
    """Build the scene and render it."""
    options = arguments()
    add_on()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.max_bounces = options.samples, 16
    add_films(options.tables.resolve())
    add_floor()
    light_scene()
    look(scene, options.width)
    scene.render.filepath = str(options.output.resolve())
    bpy.ops.render.render(write_still=True)


def run_alone() -> None:
    """Run under Python, whose process can hang as the module `bpy` is taken down."""
    try:
        main()
    except SystemExit as error:
        print(error, file=sys.stderr)
        os._exit(1)
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main() if bpy.app.binary_path else run_alone()
