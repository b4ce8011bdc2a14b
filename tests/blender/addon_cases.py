"""What the add-on promises, tested in Blender. Run by test_addon.py; arguments behind -- are those of unittest."""
import json
import math
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

import addon_utils
import bmesh
import bpy
import numpy as np
from mathutils import Matrix

PLIANT = os.environ["PLIANT"]
sys.path.insert(0, os.path.join(os.environ["PLIANT_SOURCE_DIR"], "integrations", "blender"))
addon_utils.enable("pliant_blender", default_set=True)

from pliant_blender import bake as baking, baked_files, export, program  # noqa: E402


def preferences():
    return bpy.context.preferences.addons["pliant_blender"].preferences


def add_mesh(name, vertices, faces, edges=(), **transform):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, list(edges), faces)
    mesh.update()
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
    obj = bpy.data.objects.new(name, mesh)
    for key, value in transform.items():
        setattr(obj, key, value)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


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
        return baked_files.folder_of(self.scene)[0]

    def bytes_of(self, obj):
        with open(os.path.join(self.bake_folder(), f"{obj.name}.pc2"), "rb") as file:
            return file.read()

    def written_scene(self):
        with open(os.path.join(self.bake_folder(), "scene.json"), encoding="utf-8") as file:
            return json.load(file)


class Cloth(AddonCase):
    def test_it_falls_freely_as_the_law_says(self):
        sheet = add_grid(location=(0, 0, 2))
        sheet.pliant.role = "CLOTH"
        self.bake()
        before = world_positions(sheet, 1)
        np.testing.assert_allclose(before[:, 2], 2, atol=1e-6)
        h = 1 / 72
        # BDF2 begins with a step of implicit Euler, h²/2 more than the law; both solvers are exact on parabolas else.
        for frame in (7, 12):
            t = (frame - 1) / 24
            fallen = 2 - world_positions(sheet, frame)[:, 2]
            self.assertLess(np.ptp(fallen), 1e-5)
            self.assertAlmostEqual(fallen.mean(), 9.81 / 2 * t * t, delta=9.81 * h * t)

    def test_hard_pins_are_where_the_animation_has_them(self):
        sheet = add_grid(location=(0, 0, 1), scale=(1.5, 0.5, 1))
        animate_in_circles(sheet, 12)
        pin(sheet, {0: 1, 8: 1, 40: 1})
        sheet.pliant.role = "CLOTH"
        expected = {frame: world_positions(sheet, frame)[[0, 8, 40]] for frame in range(1, 13)}
        self.bake()
        for frame, wanted in expected.items():
            got = world_positions(sheet, frame)
            self.assertLess(np.abs(got[[0, 8, 40]] - wanted).max(), 1e-6, f"frame {frame}")
        self.assertLess(world_positions(sheet, 12)[:, 2].min(), 0.95)  # and the rest hangs

    def test_pins_follow_what_deforms_the_mesh(self):
        sheet = add_grid(location=(0, 0, 1))
        sheet.shape_key_add(name="Basis")
        key = sheet.shape_key_add(name="Lifted")
        for point in key.data:
            point.co.z += 0.3 + 0.1 * point.co.x
        key.value = 0
        key.keyframe_insert("value", frame=1)
        key.value = 1
        key.keyframe_insert("value", frame=12)
        corners = [0, 8, 72, 80]
        pin(sheet, {vertex: 1 for vertex in corners})
        sheet.pliant.role = "CLOTH"
        expected = {frame: world_positions(sheet, frame)[corners] for frame in range(1, 13)}
        self.assertGreater(expected[12][0, 2], 1.2)
        self.bake()
        for frame, wanted in expected.items():
            self.assertLess(np.abs(world_positions(sheet, frame)[corners] - wanted).max(), 1e-6, f"frame {frame}")

    def test_weights_below_one_are_springs(self):
        def sag(weight, stiffness):
            bpy.ops.object.select_all(action="SELECT")
            bpy.ops.object.delete()
            sheet = add_grid(location=(0, 0, 1), cells=4)
            pin(sheet, {vertex: weight for vertex in range(25)})
            sheet.pliant.role = "CLOTH"
            sheet.pliant.pin_stiffness = stiffness
            sheet.pliant.use_weight, sheet.pliant.weight = True, 0.25
            self.scene.gravity = (0, 0, -0.98)
            self.scene.frame_end = 400
            self.scene.pliant.steps = 1
            self.bake()
            return 1 - world_positions(sheet, 400)[:, 2].mean()

        # At rest all springs together carry the weight: 0.25 kg · 0.98 m/s² = 25 k s.
        self.assertAlmostEqual(sag(0.5, 2), 0.245 / (25 * 1), delta=2e-4)
        self.assertAlmostEqual(sag(0.25, 2), 0.245 / (25 * 0.5), delta=4e-4)

    def test_a_second_bake_has_the_same_bytes(self):
        sheet = add_grid(location=(0.1, 0, 0.4))
        sheet.pliant.role = "CLOTH"
        box = add_box(location=(0, 0, 0))
        box.pliant.role = "COLLIDER"
        animate_in_circles(box, 12)
        self.bake()
        first = self.bytes_of(sheet)
        self.scene.frame_set(12)  # from where the bake is seen, which must not matter
        self.bake()
        self.assertEqual(self.bytes_of(sheet), first)
        self.assertEqual(self.scene.frame_current, 12)

    def test_turned_scaled_and_parented_objects_land_where_the_plain_one_does(self):
        """Five copies of the same sheet in the world, from different meshes and transforms."""
        wanted = None
        twist = Matrix.Rotation(0.7, 4, (1, 2, 3)) @ Matrix.Diagonal((2, 0.5, 3, 1))
        parent_turn = Matrix.Translation((3, -1, 2)) @ Matrix.Rotation(1.1, 4, "Y") @ Matrix.Scale(0.4, 4)
        for name, turn in (
            ("plain", Matrix.Identity(4)),
            ("turned", Matrix.Rotation(1, 4, "X")),
            ("scaled", twist),
            ("mirrored", Matrix.Diagonal((1, -1.5, 1, 1))),
            ("parented", parent_turn),
        ):
            with self.subTest(name):
                bpy.ops.object.select_all(action="SELECT")
                bpy.ops.object.delete()
                sheet = add_grid(location=(0, 0, 0))
                world = Matrix.Translation((0, 0, 1))
                sheet.data.transform(turn.inverted() @ world)
                if name == "parented":
                    parent = bpy.data.objects.new("Parent", None)
                    bpy.context.collection.objects.link(parent)
                    parent.matrix_world = turn
                    sheet.parent = parent
                else:
                    sheet.matrix_world = turn
                bpy.context.view_layer.update()
                pin(sheet, {0: 1, 8: 1})
                sheet.pliant.role = "CLOTH"
                self.bake()
                got = world_positions(sheet, 12)
                if wanted is None:
                    wanted = got
                self.assertGreater(np.abs(got - world_positions(sheet, 1)).max(), 0.3)
                # A mesh in single precision begins elsewhere by 1e-7 m, which folding cloth makes more of.
                self.assertLess(np.abs(got - wanted).max(), 1e-3)

    def test_a_moving_object_shows_what_stays_in_the_world(self):
        """The transform moves, the cloth without pins does not move with it."""
        sheet = add_grid(location=(0, 0, 1))
        sheet.pliant.role = "CLOTH"
        self.scene.use_gravity = False
        animate_in_circles(sheet, 12)
        start = world_positions(sheet, 1)
        self.bake()
        for frame in (2, 7, 12):
            self.assertLess(np.abs(world_positions(sheet, frame) - start).max(), 1e-6)

    def test_units(self):
        """A sheet of 100 cm in a scene that counts in centimeters falls as one of 1 m."""
        self.scene.unit_settings.scale_length = 0.01
        self.scene.gravity = (0, 0, -981)
        sheet = add_grid(location=(0, 0, 200), size=100)
        sheet.pliant.role = "CLOTH"
        pin(sheet, {0: 1, 8: 1})
        self.bake()
        in_centimeters = world_positions(sheet, 12)
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        self.scene.unit_settings.scale_length = 1
        self.scene.gravity = (0, 0, -9.81)
        sheet = add_grid(location=(0, 0, 2))
        sheet.pliant.role = "CLOTH"
        pin(sheet, {0: 1, 8: 1})
        self.bake()
        self.assertLess(np.abs(in_centimeters / 100 - world_positions(sheet, 12)).max(), 1e-3)

    def test_own_numbers_of_a_material(self):
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        sheet.pliant.sheet = "silk"
        sheet.pliant.use_bending, sheet.pliant.bending = True, 50
        sheet.pliant.use_friction, sheet.pliant.friction = True, 0.25
        sheet.pliant.use_self = False
        self.bake()
        body = self.written_scene()["bodies"][0]
        self.assertEqual(body["material"]["name"], "silk")
        self.assertAlmostEqual(body["material"]["bending"], 5e-5, delta=1e-11)
        self.assertEqual(body["contact"], {"friction": 0.25, "self": False})


class Touching(AddonCase):
    def crossings(self, objects, frame):
        """How many the program finds in the surfaces of these objects together, as Blender shows them."""
        path = os.path.join(self.folder, "seen.obj")
        count = 0
        with open(path, "w", encoding="utf-8") as file:
            for obj in objects:
                positions = world_positions(obj, frame)
                file.writelines("v %r %r %r\n" % tuple(each) for each in positions.tolist())
                obj.data.calc_loop_triangles()
                for triangle in obj.data.loop_triangles:
                    file.write("f %d %d %d\n" % tuple(count + 1 + i for i in triangle.vertices))
                count += len(positions)
        said = subprocess.run([PLIANT, "info", path, "--json"], capture_output=True, text=True, check=False)
        found = json.loads(said.stdout)
        self.assertTrue(found["all_crossings_found"])
        return sum(each["count"] for each in found["defects"] if each["kind"] == "crossings")

    def test_cloth_on_a_moving_collider_has_no_crossings(self):
        self.scene.frame_end = 36
        sheet = add_grid(location=(0, 0, 0.5), cells=14)
        sheet.pliant.role = "CLOTH"
        box = add_box(location=(0, 0, 0), size=0.6)
        box.pliant.role = "COLLIDER"
        animate_in_circles(box, 36)
        self.bake()
        self.assertEqual(self.scene.pliant.messages, "")
        for frame in range(1, 37):
            self.assertEqual(self.crossings([sheet, box], frame), 0, f"frame {frame}")
        # It lies on the box, and was taken along.
        seen = world_positions(sheet, 36)
        self.assertGreater(seen[:, 2].max(), 0.3)
        self.assertLess(seen[:, 2].min(), 0.2)
        # The check sees what crosses: the sheet where it began, with the box moved up into it.
        box.animation_data_clear()
        box.location = (0, 0, 0.5)
        box.rotation_euler = (0, 0, 0)
        self.assertGreater(self.crossings([sheet, box], 1), 0)

    def test_a_collider_in_two_triangles_holds_at_the_distance_of_the_cloth(self):
        floor = add_grid("Floor", cells=1, size=20)
        floor.pliant.role = "COLLIDER"
        sheet = add_grid(location=(0, 0, 0.05), size=0.4)
        sheet.pliant.role = "CLOTH"
        self.scene.frame_end = 24
        self.bake()
        self.assertAlmostEqual(world_positions(sheet, 24)[:, 2].mean(), 0.05 / 4, delta=1e-3)
        self.scene.pliant.distance = 0.03
        self.bake()
        self.assertAlmostEqual(world_positions(sheet, 24)[:, 2].mean(), 0.03, delta=1e-3)

    def test_what_is_hidden_by_its_eye_takes_part_and_what_is_disabled_does_not(self):
        floor = add_grid("Floor", cells=1, size=20)
        floor.pliant.role = "COLLIDER"
        floor.hide_set(True)
        sheet = add_grid(location=(0, 0, 0.05), size=0.4)
        sheet.pliant.role = "CLOTH"
        self.bake()
        self.assertTrue(floor.hide_get())
        self.assertGreater(world_positions(sheet, 12)[:, 2].min(), 0)
        for switch in (lambda: setattr(floor, "hide_viewport", True), self.disable_collection_of(floor)):
            switch()
            self.bake()
            self.assertLess(world_positions(sheet, 12)[:, 2].max(), -0.5)
            floor.hide_viewport = False

    @staticmethod
    def disable_collection_of(obj):
        def switch():
            collection = bpy.data.collections.new("Off")
            bpy.context.scene.collection.children.link(collection)
            bpy.context.collection.objects.unlink(obj)
            collection.objects.link(obj)
            collection.hide_viewport = True

        return switch

    def test_two_simulated_objects_meet(self):
        lower = add_grid("Lower", location=(0, 0, 0.3), size=1)
        lower.pliant.role = "CLOTH"
        pin(lower, {vertex: 1 for vertex in range(81) if vertex % 9 in (0, 8) or vertex // 9 in (0, 8)})
        upper = add_box("Upper", location=(0, 0, 0.5), size=0.2)
        upper.pliant.role = "SOLID"
        upper.pliant.spacing = 0.1
        self.scene.frame_end = 24
        self.bake()
        self.assertGreater(world_positions(upper, 24)[:, 2].min(), 0)  # 2.4 m lower, did it fall
        self.assertEqual(len(world_positions(upper, 24)), 8)

    def test_an_open_surface_cannot_be_filled(self):
        sheet = add_grid()
        sheet.pliant.role = "SOLID"
        self.assertRegex(self.message_of_failure(), r"Sheet|bodies\[0\].*open")


class Weather(AddonCase):
    def test_gravity_and_winds(self):
        sheet = add_grid(location=(0, 0, 1))
        sheet.pliant.role = "CLOTH"
        pin(sheet, {0: 1, 8: 1})
        bpy.ops.object.effector_add(type="WIND", rotation=(math.pi / 2, 0, 0))
        wind = bpy.context.object
        wind.field.strength = 3
        wind.keyframe_insert("field.strength", frame=1)
        wind.field.strength = 9
        wind.keyframe_insert("field.strength", frame=6)
        wind.field.noise = 0.4
        self.scene.keyframe_insert("gravity", frame=8)
        self.scene.gravity = (0, 0, -1)
        self.scene.keyframe_insert("gravity", frame=9)
        self.bake()
        scene = self.written_scene()
        force = scene["forces"][0]
        np.testing.assert_allclose(force["velocity"], (0, -3, 0), atol=1e-6)
        self.assertAlmostEqual(force["gust_strength"], 0.4, places=6)
        winds = [event for event in scene["events"] if event.get("change") == wind.name]
        self.assertEqual([event["step"] for event in winds], [3, 6, 9, 12, 15])
        np.testing.assert_allclose(winds[-1]["velocity"], (0, -9, 0), atol=1e-6)
        gravities = [event for event in scene["events"] if "gravity" in event]
        self.assertEqual([(event["step"], event["gravity"]) for event in gravities], [(24, [0, 0, -1])])
        self.assertLess(world_positions(sheet, 12)[:, 1].min(), -0.6)  # it is blown


class Modifiers(AddonCase):
    def test_what_stands_before_the_bake_is_simulated_and_the_rest_follows(self):
        sheet = add_grid(cells=4, location=(0, 0, 1))
        sheet.modifiers.new("Finer", "SUBSURF").subdivision_type = "SIMPLE"
        sheet.modifiers.new("Thick", "SOLIDIFY")
        array = sheet.modifiers.new("Row", "ARRAY")
        bpy.context.view_layer.objects.active = sheet
        bpy.ops.object.modifier_move_to_index(modifier=array.name, index=0)
        sheet.pliant.role = "CLOTH"
        self.assertEqual(sheet.modifiers.keys(), ["Row", "Pliant", "Finer", "Thick"])
        self.assertFalse(sheet.modifiers["Pliant"].show_viewport)
        self.bake()
        with open(os.path.join(self.bake_folder(), "Sheet.obj"), encoding="utf-8") as file:
            self.assertEqual(sum(line.startswith("v ") for line in file), 50)
        self.assertEqual(len(world_positions(sheet, 12)), 2 * 2 * 81)
        self.assertTrue(all(modifier.show_viewport for modifier in sheet.modifiers))
        sheet.pliant.role = "NONE"
        self.assertIn("Pliant", sheet.modifiers)  # it plays a bake

    def test_a_type_that_was_tried_leaves_nothing(self):
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        sheet.pliant.role = "COLLIDER"
        self.assertEqual(len(sheet.modifiers), 0)

    def test_vertices_that_come_while_it_is_animated(self):
        sheet = add_grid()
        modifier = sheet.modifiers.new("Row", "ARRAY")
        modifier.count = 1
        modifier.keyframe_insert("count", frame=1)
        modifier.count = 3
        modifier.keyframe_insert("count", frame=9)
        sheet.pliant.role = "CLOTH"
        self.assertRegex(
            self.message_of_failure(),
            r'^"Sheet" has 162 vertices at frame \d+ and 81 at the first one; switch off the modifier that changes it$',
        )
        self.assertFalse(sheet.modifiers["Pliant"].show_viewport)
        self.assertEqual(self.scene.frame_current, 1)


class Messages(AddonCase):
    def test_nothing_to_simulate(self):
        add_box().pliant.role = "COLLIDER"
        self.assertEqual(
            self.message_of_failure(), "Nothing is simulated; set the type of an object to Cloth or Soft Body"
        )

    def test_a_mesh_without_faces(self):
        for name, edges in (("Points", ()), ("Wire", [(0, 1)])):
            with self.subTest(name):
                wire = add_mesh(name, [(0, 0, 0), (1, 0, 0)], [], edges)
                wire.pliant.role = "CLOTH"
                self.assertEqual(self.message_of_failure(), f'"{name}" has no faces; give it some, or set its type to None')
                wire.pliant.role = "NONE"

    def test_a_scale_of_zero(self):
        sheet = add_grid(scale=(1, 0, 1))
        sheet.pliant.role = "CLOTH"
        self.assertEqual(self.message_of_failure(), '"Sheet" is scaled to 0 along an axis; give it another scale')

    def test_a_group_of_pins_that_is_gone(self):
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        sheet.pliant.pins = "Shoulders"
        self.assertEqual(
            self.message_of_failure(), '"Sheet": there is no vertex group "Shoulders"; choose another one for the pins'
        )

    def test_an_edge_with_three_faces(self):
        fin = add_mesh("Fin", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)], [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
        fin.pliant.role = "CLOTH"
        self.bake()
        self.assertRegex(self.scene.pliant.messages, "Fin")

    def test_what_crosses_at_the_start(self):
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        add_box(location=(0, 0, 0.1)).pliant.role = "COLLIDER"
        self.bake()
        self.assertRegex(self.scene.pliant.messages, "^'Sheet' crosses 'Box': edge .*; they are let go until they are apart")

    def test_the_program_is_not_there(self):
        add_grid().pliant.role = "CLOTH"
        preferences().program = "/nowhere/pliant"
        self.assertEqual(
            self.message_of_failure(),
            "/nowhere/pliant: no program there; correct its path in the add-on's preferences",
        )
        self.assertFalse(os.path.exists(self.bake_folder()))

    def test_another_program(self):
        other = os.path.join(self.folder, "other")
        with open(other, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho 'other: what is that?' >&2\nexit 4\n")
        os.chmod(other, stat.S_IRWXU)
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        preferences().program = other
        self.assertEqual(sheet.pliant.sheet, "cotton")  # with a list of one
        self.assertEqual(self.message_of_failure(), "other: what is that?")

    def test_a_folder_that_cannot_be_written(self):
        add_grid().pliant.role = "CLOTH"
        blocked = os.path.join(self.folder, "blocked")
        with open(blocked, "w", encoding="utf-8"):
            pass
        self.scene.pliant.folder = os.path.join(blocked, "bake")
        self.assertRegex(self.message_of_failure(), "blocked/bake: Not a directory")

    def test_names_that_files_cannot_have(self):
        names = ["Tuch/1", "Tuch:1", 'say "hi"', "scene", "Ω.\n", "a" * 60]
        for i, name in enumerate(names):
            add_grid(name, cells=2, location=(2 * i, 0, 1)).pliant.role = "CLOTH"
        self.bake()
        for name in names:
            sheet = bpy.data.objects[name]
            self.assertLess(world_positions(sheet, 12)[:, 2].mean(), 0.5, name)
        self.assertEqual(len({bpy.data.objects[name].modifiers["Pliant"].filepath for name in names}), len(names))


class StopAndGoOn(AddonCase):
    def setUp(self):
        super().setUp()
        self.sheet = add_grid(location=(0, 0, 0.4), cells=12)
        self.sheet.pliant.role = "CLOTH"
        add_box().pliant.role = "COLLIDER"
        self.scene.frame_end = 40

    def test_a_bake_that_was_stopped_goes_on_to_the_same_bytes(self):
        self.bake()
        whole = self.bytes_of(self.sheet)
        bake = baking.Bake(bpy.context, resumes=False)
        while not bake.is_done:
            bake.advance()
            if bake.share > 0.1:
                bake.stop()
                break
        while not bake.is_done:
            bake.advance()
        stopped_at = self.scene.pliant.baked_to
        self.assertGreater(stopped_at, 3)
        self.assertLess(stopped_at, 40)
        # What is there can be seen, and is what the whole bake has.
        self.assertEqual(len(self.bytes_of(self.sheet)), 32 + stopped_at * 169 * 12)
        self.assertEqual(self.bytes_of(self.sheet)[32:], whole[32 : 32 + stopped_at * 169 * 12])
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.scene.pliant.baked_to, 40)
        self.assertEqual(self.bytes_of(self.sheet), whole)

    def test_a_bake_whose_program_was_killed_goes_on_to_the_same_bytes(self):
        """As after a crash of the machine: nothing of it is known but its files."""
        self.bake()
        whole = self.bytes_of(self.sheet)
        bpy.ops.pliant.free()
        bake = baking.Bake(bpy.context, resumes=False)
        checkpoint = os.path.join(self.bake_folder(), "run", "checkpoint.pliant")
        while not os.path.exists(checkpoint):
            bake.advance()
        bake._run._process.kill()
        with self.assertRaises(baking.BakeError):
            while not bake.is_done:
                bake.advance()
        self.assertEqual(self.scene.pliant.baked_to, -1)
        self.assertTrue(bpy.ops.pliant.resume.poll())
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.bytes_of(self.sheet), whole)

    def test_another_scene_is_looked_at_when_it_ends(self):
        bake = baking.Bake(bpy.context, resumes=False)
        while bake.is_reading:
            bake.advance()
        bpy.context.window.scene = bpy.data.scenes.new("Other")
        while not bake.is_done:
            bake.advance()
        self.assertEqual((self.scene.pliant.baked_to, bpy.context.scene.pliant.baked_to), (40, -1))

    def test_stopping_while_the_animation_is_read_changes_nothing(self):
        bake = baking.Bake(bpy.context, resumes=False)
        next(bake._parts)
        self.assertFalse(self.sheet.modifiers["Pliant"].show_viewport)
        self.scene.frame_set(7)
        bake.stop()
        self.assertTrue(bake.is_done)
        self.assertEqual(self.scene.frame_current, 1)
        self.assertEqual(self.scene.pliant.baked_to, -1)

    def test_a_later_end(self):
        self.scene.frame_end = 44
        self.bake()
        whole = self.bytes_of(self.sheet)
        self.scene.frame_end = 40
        self.bake()
        self.assertFalse(bpy.ops.pliant.resume.poll())
        self.scene.frame_end = 44
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.bytes_of(self.sheet), whole)

    def test_a_later_end_of_what_is_animated(self):
        animate_in_circles(bpy.data.objects["Box"], 44)
        self.bake()
        self.scene.frame_end = 44
        self.assertRegex(self.message_of_failure(bpy.ops.pliant.resume), "were read up to frame 40; choose Bake")

    def test_free_removes_its_own_files_alone(self):
        self.bake()
        folder = self.bake_folder()
        mine = os.path.join(folder, "notes.txt")
        with open(mine, "w", encoding="utf-8"):
            pass
        self.assertEqual(bpy.ops.pliant.free(), {"FINISHED"})
        self.assertEqual(os.listdir(folder), ["notes.txt"])
        self.assertFalse(self.sheet.modifiers["Pliant"].show_viewport)
        self.assertEqual(self.scene.pliant.baked_to, -1)
        np.testing.assert_allclose(world_positions(self.sheet, 40)[:, 2], 0.4, atol=1e-6)
        os.remove(mine)
        self.bake()
        bpy.ops.pliant.free()
        self.assertFalse(os.path.exists(folder))

    def test_a_bake_that_fails_leaves_the_one_before(self):
        self.bake()
        before = self.bytes_of(self.sheet)
        wire = add_mesh("Wire", [(0, 0, 0), (1, 0, 0)], [], [(0, 1)])
        wire.pliant.role = "CLOTH"
        self.message_of_failure()
        self.assertEqual(self.bytes_of(self.sheet), before)
        self.assertTrue(self.sheet.modifiers["Pliant"].show_viewport)
        self.assertLess(world_positions(self.sheet, 40)[:, 2].min(), 0.2)

    def test_it_is_played_from_a_saved_file_that_was_moved(self):
        self.bake()
        seen = world_positions(self.sheet, 40)
        bpy.ops.wm.save_mainfile()
        moved = os.path.join(self.folder, "elsewhere")
        os.mkdir(moved)
        for name in ("work.blend", "work_pliant"):
            shutil.move(os.path.join(self.folder, name), moved)
        bpy.ops.wm.open_mainfile(filepath=os.path.join(moved, "work.blend"))
        np.testing.assert_array_equal(world_positions(bpy.data.objects["Sheet"], 40), seen)

    def test_a_file_that_is_not_saved_says_so(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("pliant_blender", default_set=True)
        preferences().program = PLIANT
        self.scene = bpy.context.scene
        self.scene.frame_end = 4
        add_grid().pliant.role = "CLOTH"
        self.bake()
        self.assertEqual(
            self.scene.pliant.messages, "The file is not saved, so the bake goes when Blender ends; save it and bake again"
        )


class Package(unittest.TestCase):
    def test_the_file_that_is_installed_has_all_of_it(self):
        """In a Blender of its own, with nothing else to find it by."""
        packed = os.environ["PLIANT_BLENDER_ADDON"]
        with tempfile.TemporaryDirectory() as folder:
            lines = (
                "import bpy",
                f"bpy.ops.preferences.addon_install(filepath={packed!r})",
                "bpy.ops.preferences.addon_enable(module='pliant_blender')",
                "import pliant_blender, bpy",
                f"assert pliant_blender.__file__.startswith({folder!r}), pliant_blender.__file__",
                f"bpy.context.preferences.addons['pliant_blender'].preferences.program = {PLIANT!r}",
                "bpy.data.objects['Cube'].pliant.role = 'CLOTH'",
                "bpy.context.scene.frame_end = 3",
                "assert bpy.ops.pliant.bake() == {'FINISHED'}",
            )
            command = [bpy.app.binary_path, "--background", "--factory-startup", "--python-exit-code", "1"]
            environment = os.environ | {"BLENDER_USER_SCRIPTS": folder}
            done = subprocess.run(
                [*command, "--python-expr", "\n".join(lines)],
                env=environment, capture_output=True, text=True, check=False,
            )  # fmt: skip
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_it_can_be_switched_off_and_on(self):
        for _ in range(2):
            addon_utils.disable("pliant_blender", default_set=True)
            self.assertFalse(hasattr(bpy.types.Object, "pliant"))
            addon_utils.enable("pliant_blender", default_set=True)
            self.assertTrue(hasattr(bpy.types.Object, "pliant"))

    def test_versions_agree(self):
        import pliant_blender

        folder = os.path.dirname(pliant_blender.__file__)
        with open(os.path.join(folder, "blender_manifest.toml"), encoding="utf-8") as file:
            told = re.search(r'^version = "([0-9.]+)"$', file.read(), re.M).group(1)
        self.assertEqual(tuple(map(int, told.split("."))), pliant_blender.bl_info["version"])
        preferences().program = PLIANT
        self.assertRegex(program.version(), re.escape(told))


arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
result = unittest.main(module=__name__, argv=["addon_cases.py", *arguments], exit=False).result
if not result.wasSuccessful() or result.testsRun == 0:
    sys.exit(1)
