"""What the cases of the add-on have in common: meshes, what is seen of them, a scene in a file of its own."""
import json
import math
import os
import shutil
import sys
import tempfile
import unittest

import addon_utils
import bmesh
import bpy
import numpy as np

PLIANT = os.environ["PLIANT"]
sys.path.insert(0, os.path.join(os.environ["PLIANT_SOURCE_DIR"], "integrations", "blender"))
addon_utils.enable("pliant_blender", default_set=True)

from pliant_blender import baked_files  # noqa: E402


def preferences():
    return bpy.context.preferences.addons["pliant_blender"].preferences


def add_mesh(name, vertices, faces, edges=(), **transform):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, list(edges), faces)
    mesh.update()
    return _add_object(name, mesh, transform)


def _add_object(name, mesh, transform):
    obj = bpy.data.objects.new(name, mesh)
    for key, value in transform.items():
        setattr(obj, key, value)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def add_grid(name="Sheet", cells=8, size=1.0, **transform):
    """A flat square around the origin."""
    steps = np.linspace(-size / 2, size / 2, cells + 1)
    vertices = [(x, y, 0) for y in steps for x in steps]
    faces = [
        (j * (cells + 1) + i, j * (cells + 1) + i + 1, (j + 1) * (cells + 1) + i + 1, (j + 1) * (cells + 1) + i)
        for j in range(cells)
        for i in range(cells)
    ]
    return add_mesh(name, vertices, faces, **transform)


def add_box(name="Box", size=0.5, **transform):
    mesh = bpy.data.meshes.new(name)
    builder = bmesh.new()
    bmesh.ops.create_cube(builder, size=size)
    builder.to_mesh(mesh)
    builder.free()
    return _add_object(name, mesh, transform)


def pin(obj, weights):
    """A vertex group of pins: weights by vertex."""
    group = obj.vertex_groups.new(name="Held")
    for vertex, weight in weights.items():
        group.add([vertex], weight, "REPLACE")
    obj.pliant.pins = "Held"


def world_positions(obj, frame):
    """What is seen of an object at a frame."""
    bpy.context.scene.frame_set(frame)
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    local = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", local)
    evaluated.to_mesh_clear()
    matrix = np.array(evaluated.matrix_world, dtype=np.float64)
    return local.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def animate_in_circles(obj, frames):
    """It moves and turns on the way."""
    obj.rotation_mode = "XYZ"
    for frame in range(1, frames + 1):
        angle = 2 * math.pi * (frame - 1) / 48
        obj.location = (0.2 * math.cos(angle), 0.2 * math.sin(angle), obj.location.z)
        obj.rotation_euler = (0, 0.2 * math.sin(angle), angle)
        obj.keyframe_insert("location", frame=frame)
        obj.keyframe_insert("rotation_euler", frame=frame)


class AddonCase(unittest.TestCase):
    """An empty scene in a file of its own, in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pliant_blender_")
        self.addCleanup(shutil.rmtree, self.folder)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("pliant_blender", default_set=True)
        preferences().program = PLIANT
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(self.folder, "work.blend"))
        self.scene = bpy.context.scene
        self.scene.frame_end = 12

    def bake(self):
        self.assertEqual(bpy.ops.pliant.bake(), {"FINISHED"})

    def message_of_failure(self, operator=None):
        """The line that a bake ends with that cannot be made."""
        with self.assertRaisesRegex(RuntimeError, "^Error: ") as caught:
            (operator or bpy.ops.pliant.bake)()
        text = self.scene.pliant.messages
        self.assertIn(text, str(caught.exception))
        self.assertNotIn("\n", text)
        return text

    def bake_folder(self):
        return baked_files.bake_folder(self.scene)

    def baked_to(self):
        """The last frame that is baked, -1 without any."""
        baked = baked_files.baked_range(self.scene)
        return -1 if baked is None else baked.last

    def bytes_of(self, obj):
        with open(os.path.join(self.bake_folder(), f"{obj.name}.pc2"), "rb") as file:
            return file.read()

    def written_scene(self):
        with open(os.path.join(self.bake_folder(), "scene.json"), encoding="utf-8") as file:
            return json.load(file)
