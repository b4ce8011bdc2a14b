"""Goes through docs/blender.md in a window of Blender, and makes its pictures on the way. From the project's folder:

    PLIANT=build/release/bin/pliant xvfb-run -a -s "-screen 0 1440x960x24" \
      blender --factory-startup --window-geometry 0 0 1440 960 --python scripts/blender_pictures.py
"""
import math
import os
import sys
import tempfile
import traceback

import addon_utils
import bpy
from mathutils import Quaternion

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PICTURES = os.path.join(ROOT, "docs", "pictures")
sys.path.insert(0, os.path.join(ROOT, "integrations", "blender"))
addon_utils.enable("pliant_blender", default_set=True)
from pliant_blender import operators  # noqa: E402

bpy.context.preferences.view.show_splash = False

FOLDER = tempfile.mkdtemp(prefix="pliant_blender_")
TICK = 0.5  # [s]


def window():
    return bpy.context.window_manager.windows[0]


def area_of(kind):
    return next(area for area in window().screen.areas if area.type == kind)


def picture(name):
    """Of the whole window, once it is drawn."""
    yield
    yield
    with bpy.context.temp_override(window=window()):
        whole = os.path.join(FOLDER, "window.png")
        bpy.ops.screen.screenshot(filepath=whole)
    image = bpy.data.images.load(whole)
    image.pixels[0]  # reads the file
    image.file_format = "JPEG"
    image.filepath_raw = os.path.join(PICTURES, name)
    image.save()
    bpy.data.images.remove(image)


def look_at(location, distance, turn=0.75, tilt=1.12):
    view = area_of("VIEW_3D").spaces[0].region_3d
    view.view_location = location
    view.view_distance = distance
    view.view_rotation = Quaternion((0, 0, 1), turn) @ Quaternion((1, 0, 0), tilt)


def colored(obj, name, color, roughness):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.diffuse_color = (*color, 1)
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = roughness
    obj.data.materials.clear()
    obj.data.materials.append(material)


def set_up_window():
    preferences = bpy.context.preferences
    preferences.addons["pliant_blender"].preferences.program = os.path.abspath(os.environ["PLIANT"])
    area_of("PROPERTIES").spaces[0].context = "PHYSICS"
    with bpy.context.temp_override(window=window(), area=area_of("VIEW_3D")):
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "table.blend"))


def light(scene):
    """A large lamp at the side of the camera, and a pale sky."""
    lamp = bpy.data.objects["Light"]
    lamp.data.type = "AREA"
    lamp.data.energy, lamp.data.size = 160, 2.5
    lamp.location = (2.6, -1.2, 3.2)
    lamp.rotation_euler = (0.75, 0.35, 0.5)
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.55, 0.62, 0.72, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.45


def render(scene, name):
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 160
    scene.cycles.use_denoising = False
    scene.view_settings.look = "Medium High Contrast"
    scene.render.resolution_x, scene.render.resolution_y = 960, 600
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.quality = 92
    scene.render.filepath = os.path.join(PICTURES, name)
    camera = scene.camera
    camera.location = (2.35, -2.55, 1.75)
    camera.rotation_euler = (math.radians(66), 0, math.radians(42.5))
    camera.data.lens = 50
    bpy.ops.render.render(write_still=True)


def story():
    set_up_window()
    scene = bpy.context.scene
    scene.frame_end = 100
    with bpy.context.temp_override(window=window(), area=area_of("VIEW_3D")):
        cube = bpy.data.objects["Cube"]
        cube.scale, cube.location = (0.4, 0.4, 0.4), (0, 0, 0.4)
        cube.pliant.role = "COLLIDER"
        look_at((0, 0, 0.5), 4.5)
        yield from picture("blender_table.jpg")
        bpy.ops.mesh.primitive_plane_add(size=8)
        floor = bpy.context.object
        floor.pliant.role = "COLLIDER"
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=100, y_subdivisions=100, size=1.6, location=(0, 0, 0.85))
        cloth = bpy.context.object
        bpy.ops.object.shade_smooth()
        cloth.pliant.role = "CLOTH"
        cloth.modifiers.new("Subdivision", "SUBSURF")
        cloth.pliant.sheet = "cotton"
        yield from picture("blender_cloth.jpg")
    with bpy.context.temp_override(window=window(), area=area_of("VIEW_3D")):
        bpy.ops.pliant.bake("INVOKE_DEFAULT")
    while operators.at_work() is not None:
        yield
    print(scene.pliant.messages)
    scene.frame_set(14)
    yield from picture("blender_bake.jpg")
    scene.frame_set(100)
    colored(cube, "Wood", (0.25, 0.12, 0.05), 0.5)
    colored(floor, "Floor", (0.55, 0.55, 0.53), 0.8)
    colored(cloth, "Cotton", (0.75, 0.12, 0.09), 0.9)
    light(scene)
    render(scene, "blender_tablecloth.jpg")


steps = story()


def tick():
    try:
        next(steps)
        return TICK
    except StopIteration:
        pass
    except BaseException:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=1)
