"""What is simulated, and how it lands in Blender."""
import json
import math
import os
import subprocess

import bpy
import numpy as np
from mathutils import Matrix

from support import PLIANT, AddonCase, add_box, add_grid, animate_in_circles, pin, world_positions


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

    def test_texture_coordinates_give_the_grain(self):
        """Each corner has its own, of a mesh whose faces have seams between them."""
        bpy.ops.mesh.primitive_cube_add(location=(0, 0, 1))
        cube = bpy.context.object
        cube.pliant.role = "CLOTH"
        self.bake()
        with open(os.path.join(self.bake_folder(), f"{cube.name}.obj"), encoding="utf-8") as file:
            lines = [line.split() for line in file]
        places = [tuple(map(float, words[1:])) for words in lines if words[0] == "vt"]
        written = {
            tuple((int(v) - 1, places[int(vt) - 1]) for v, vt in (word.split("/") for word in words[1:]))
            for words in lines
            if words[0] == "f"
        }
        cube.data.calc_loop_triangles()
        uvs = cube.data.uv_layers.active.data
        expected = {
            tuple((vertex, tuple(uvs[loop].uv)) for vertex, loop in zip(each.vertices, each.loops))
            for each in cube.data.loop_triangles
        }
        self.assertEqual(written, expected)
        self.assertEqual(len(places), 14)

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
        self.scene.pliant.iterations = 40  # with 20 it says that the 30th step is far from converged
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
        # The same of its collection.
        collection = bpy.data.collections.new("Stage")
        bpy.context.scene.collection.children.link(collection)
        bpy.context.collection.objects.unlink(floor)
        collection.objects.link(floor)
        layer = bpy.context.view_layer.layer_collection.children["Stage"]
        layer.hide_viewport = True
        self.bake()
        self.assertTrue(layer.hide_viewport)
        self.assertGreater(world_positions(sheet, 12)[:, 2].min(), 0)
        for owner, switch in ((floor, "hide_viewport"), (collection, "hide_viewport"), (layer, "exclude")):
            setattr(owner, switch, True)
            self.bake()
            self.assertLess(world_positions(sheet, 12)[:, 2].max(), -0.5)
            setattr(owner, switch, False)

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
        self.assertRegex(self.message_of_failure(), r"^scene.json: bodies\[0\].solid: Sheet: the surface is open: ")


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

    def test_what_renders_would_show_otherwise_is_told(self):
        sheet = add_grid(cells=4)
        finer = sheet.modifiers.new("Finer", "SUBSURF")
        sheet.modifiers.new("Bent", "CAST")
        sheet.pliant.role = "CLOTH"
        self.bake()
        self.assertRegex(self.scene.pliant.messages, '^"Sheet": the modifier "Finer" above Pliant differs between ')
        finer.render_levels = finer.levels
        self.bake()
        self.assertEqual(self.scene.pliant.messages, "")

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
