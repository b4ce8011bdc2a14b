"""Messages, baking that is stopped and goes on, and the file that is installed."""
import os
import re
import shutil
import stat
import subprocess
import tempfile
import unittest

import addon_utils
import bpy
import numpy as np
from pliant_blender import bake as baking
from pliant_blender import baked_files, program

from support import PLIANT, AddonCase, add_box, add_grid, add_mesh, animate_in_circles, preferences, world_positions


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
                expected = f'"{name}" has no faces; give it some, or set its type to None'
                self.assertEqual(self.message_of_failure(), expected)
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
            self.message_of_failure(), '"Sheet" has no vertex group "Shoulders"; choose another one for the pins'
        )

    def test_an_edge_with_three_faces(self):
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
        fin = add_mesh("Fin", corners, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
        fin.pliant.role = "CLOTH"
        self.bake()
        self.assertRegex(self.scene.pliant.messages, "Fin")

    def test_what_crosses_at_the_start(self):
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        add_box(location=(0, 0, 0.1)).pliant.role = "COLLIDER"
        self.bake()
        told = self.scene.pliant.messages
        self.assertRegex(told, "^'Sheet' crosses 'Box': edge .*; they are let go until they are apart")

    def test_the_program_is_not_there(self):
        add_grid().pliant.role = "CLOTH"
        preferences().program = "/nowhere/pliant"
        self.assertEqual(
            self.message_of_failure(),
            "/nowhere/pliant: no program there; correct its path in the add-on's preferences",
        )
        self.assertIsNone(self.bake_folder())
        self.assertEqual(os.listdir(self.folder), ["work.blend"])

    def test_another_program(self):
        other = os.path.join(self.folder, "other")
        with open(other, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho 'other: what is that?' >&2\nexit 4\n")
        os.chmod(other, stat.S_IRWXU)
        sheet = add_grid()
        sheet.pliant.role = "CLOTH"
        preferences().program = other
        self.assertEqual(sheet.pliant.sheet, "cotton")  # with a list of one
        self.assertEqual(self.message_of_failure(), f"{other} is not Pliant: other: what is that?")
        preferences().program = shutil.which("true")
        self.assertRegex(self.message_of_failure(), "/true is not Pliant; give its path in the add-on's preferences$")

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
        stopped_at = self.baked_to()
        self.assertGreater(stopped_at, 3)
        self.assertLess(stopped_at, 40)
        # What is there can be seen, and is what the whole bake has.
        self.assertEqual(len(self.bytes_of(self.sheet)), 32 + stopped_at * 169 * 12)
        self.assertEqual(self.bytes_of(self.sheet)[32:], whole[32 : 32 + stopped_at * 169 * 12])
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.baked_to(), 40)
        self.assertEqual(self.bytes_of(self.sheet), whole)

    def test_a_bake_whose_program_was_killed_goes_on_to_the_same_bytes(self):
        """As after a crash of the machine: nothing of it is known but its files."""
        self.bake()
        whole = self.bytes_of(self.sheet)
        bpy.ops.pliant.free()
        bake = baking.Bake(bpy.context, resumes=False)
        checkpoint = os.path.join(baked_files.new_folder(self.scene), "run", "checkpoint.pliant")
        while not os.path.exists(checkpoint):
            bake.advance()
        bake._run._process.kill()
        with self.assertRaises(baking.BakeError):
            while not bake.is_done:
                bake.advance()
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
        self.assertEqual((self.baked_to(), baked_files.baked_range(bpy.context.scene)), (40, None))

    def test_a_bake_goes_on_without_its_modifier(self):
        self.bake()
        whole = self.bytes_of(self.sheet)
        self.sheet.modifiers.remove(self.sheet.modifiers["Pliant"])
        self.scene.frame_end = 42
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.bytes_of(self.sheet)[32 : len(whole)], whole[32:])
        self.assertTrue(self.sheet.modifiers["Pliant"].show_viewport)

    def test_stopping_while_the_animation_is_read_changes_nothing(self):
        bake = baking.Bake(bpy.context, resumes=False)
        next(bake._parts)
        self.assertFalse(self.sheet.modifiers["Pliant"].show_viewport)
        self.scene.frame_set(7)
        bake.stop()
        self.assertTrue(bake.is_done)
        self.assertEqual(self.scene.frame_current, 1)
        self.assertEqual(self.baked_to(), -1)

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
        before = self.bytes_of(self.sheet)
        self.assertRegex(self.message_of_failure(bpy.ops.pliant.resume), "are animated after frame 40, .*; use Bake to")
        self.assertEqual((self.bytes_of(self.sheet), self.baked_to()), (before, 40))

    def test_a_later_end_in_which_something_moves_is_refused(self):
        """Though it has stood still before; the object's own transform may move, since the cloth does not go by it."""
        animate_late = {
            "wind": lambda: self.key_late(self.wind(), "field.strength", 0.0, 5.0),
            "gravity": lambda: self.key_late(self.scene, "gravity", (0, 0, -9.81), (0, 0, 2)),
            "collider": lambda: self.key_late(bpy.data.objects["Box"], "location", (0, 0, 0), (0, 0, 1)),
        }
        for name, animate in animate_late.items():
            with self.subTest(name):
                animate()
                self.scene.frame_end = 40
                self.bake()
                self.scene.frame_end = 44
                self.assertRegex(self.message_of_failure(bpy.ops.pliant.resume), "are animated after frame 40")
                bpy.data.objects["Box"].animation_data_clear()
                self.scene.animation_data_clear()
                for obj in [obj for obj in bpy.data.objects if obj.field and obj.field.type == "WIND"]:
                    bpy.data.objects.remove(obj)
        self.scene.gravity = (0, 0, -9.81)
        self.scene.frame_end = 44
        self.key_late(self.sheet, "location", (0, 0, 0.4), (1, 2, 3))
        self.bake()
        whole = self.bytes_of(self.sheet)
        self.scene.frame_end = 40
        self.bake()
        self.scene.frame_end = 44
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.bytes_of(self.sheet), whole)

    @staticmethod
    def wind():
        bpy.ops.object.effector_add(type="WIND")
        return bpy.context.object

    @staticmethod
    def key_late(owner, path, before, after):
        """A key at frame 40 and another at 44."""
        block, name = (owner.field, path.split(".")[1]) if "." in path else (owner, path)
        for frame, value in ((40, before), (44, after)):
            setattr(block, name, value)
            owner.keyframe_insert(path, frame=frame)

    def test_free_removes_its_own_files_alone(self):
        self.bake()
        folder = self.bake_folder()
        mine = os.path.join(folder, "notes.txt")
        with open(mine, "w", encoding="utf-8"):
            pass
        self.assertEqual(bpy.ops.pliant.free(), {"FINISHED"})
        self.assertEqual(os.listdir(folder), ["notes.txt"])
        self.assertFalse(self.sheet.modifiers["Pliant"].show_viewport)
        self.assertEqual(self.baked_to(), -1)
        np.testing.assert_allclose(world_positions(self.sheet, 40)[:, 2], 0.4, atol=1e-6)
        os.remove(mine)
        os.rmdir(folder)
        self.bake()
        bpy.ops.pliant.free()
        self.assertEqual([name for name in os.listdir(self.folder) if "pliant" in name], [])

    def files(self):
        """All that is there, with what is in it."""
        found = {}
        for place, _, names in os.walk(self.folder):
            for name in names:
                with open(os.path.join(place, name), "rb") as file:
                    found[os.path.join(place, name)] = file.read()
        return found

    def assert_same_files(self, before):
        now = self.files()
        self.assertEqual(sorted(now), sorted(before))
        self.assertEqual([name for name in now if now[name] != before[name]], [])

    def test_a_bake_that_fails_leaves_the_one_before(self):
        """When the scene is read, when the program refuses it, and when it is cancelled."""
        self.bake()
        before = self.files()
        wire = add_mesh("Wire", [(0, 0, 0), (1, 0, 0)], [], [(0, 1)])
        wire.pliant.role = "CLOTH"
        self.message_of_failure()
        self.assert_same_files(before)
        wire.pliant.role = "NONE"
        opened = add_grid("Open")
        opened.pliant.role = "SOLID"
        self.message_of_failure()
        self.assert_same_files(before)
        opened.pliant.role = "NONE"
        bake = baking.Bake(bpy.context, resumes=False)
        next(bake._parts)
        bake.stop()
        self.assert_same_files(before)
        self.assertTrue(self.sheet.modifiers["Pliant"].show_viewport)
        self.assertLess(world_positions(self.sheet, 40)[:, 2].min(), 0.2)
        self.scene.frame_end = 42
        self.assertEqual(bpy.ops.pliant.resume(), {"FINISHED"})
        self.assertEqual(self.baked_to(), 42)
        self.bake()
        self.assertEqual([place for place, _ in baked_files.bakes_in(os.path.dirname(self.bake_folder()))],
                         [self.bake_folder()])  # fmt: skip

    def test_files_of_the_user_stay(self):
        """Though they have names that a bake has."""
        self.scene.pliant.folder = "//"
        names = ["scene.json", "Sheet.obj", "bake.json"]
        for name in names:
            with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                file.write("{}")
        self.bake()
        bpy.ops.pliant.free()
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["work.blend", *names]))
        for name in names:
            with open(os.path.join(self.folder, name), encoding="utf-8") as file:
                self.assertEqual(file.read(), "{}")

    def test_scenes_have_bakes_of_their_own(self):
        """In one folder that was chosen, also where their names are alike in files, and as copies."""
        self.scene.pliant.folder = os.path.join(self.folder, "bakes")
        self.scene.name = "A/1"
        self.bake()
        bpy.ops.scene.new(type="FULL_COPY")
        copy = bpy.context.scene
        copy.name = "A:1"
        self.assertIsNone(baked_files.baked_range(copy))  # though it plays the same files
        self.assertFalse(bpy.ops.pliant.free.poll())
        copy.frame_end = 20
        self.bake()
        self.assertEqual((baked_files.baked_range(copy).last, self.baked_to()), (20, 40))
        self.assertEqual(bpy.ops.pliant.free(), {"FINISHED"})
        self.assertEqual((baked_files.baked_range(copy), self.baked_to()), (None, 40))
        bpy.context.window.scene = self.scene
        self.assertLess(world_positions(self.sheet, 40)[:, 2].min(), 0.2)
        self.scene.name = "renamed"
        self.assertEqual(self.baked_to(), 40)
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(self.folder, "second.blend"))
        self.assertEqual(self.baked_to(), -1)  # the bake belongs to the first file, and is played here
        self.assertLess(world_positions(self.sheet, 40)[:, 2].min(), 0.2)

    def test_objects_that_were_renamed_meanwhile(self):
        twin = add_grid("Twin", location=(0, 3, 2), cells=12)
        twin.pliant.role = "CLOTH"
        bake = baking.Bake(bpy.context, resumes=False)
        while bake.is_reading:
            bake.advance()
        self.scene.name = "other"
        self.sheet.name, twin.name = "x", "Sheet"
        self.sheet.name = "Twin"
        add_grid("Gone", cells=2)
        while not bake.is_done:
            bake.advance()
        self.assertEqual(bake.baked.last, 40)
        self.assertLess(world_positions(twin, 40)[:, 2].max(), 1)
        self.assertGreater(world_positions(self.sheet, 40)[:, 2].max(), 0.2)

    def test_an_object_that_is_gone_meanwhile(self):
        bake = baking.Bake(bpy.context, resumes=False)
        while bake.is_reading:
            bake.advance()
        bpy.data.objects.remove(self.sheet)
        while not bake.is_done:
            bake.advance()
        self.assertRegex(self.scene.pliant.messages, r'^"Sheet" is gone; its cache is /.*Sheet.pc2$')

    def test_a_modifier_of_that_name_and_one_that_was_renamed(self):
        self.sheet.modifiers.remove(self.sheet.modifiers["Pliant"])
        self.sheet.modifiers.new("Pliant", "SMOOTH")
        self.bake()
        self.assertEqual([each.type for each in self.sheet.modifiers], ["SMOOTH", "MESH_CACHE"])
        self.sheet.modifiers[1].name = "mine"
        whole = self.bytes_of(self.sheet)
        self.bake()
        self.assertEqual([each.type for each in self.sheet.modifiers], ["SMOOTH", "MESH_CACHE"])
        self.assertEqual(self.bytes_of(self.sheet), whole)

    def test_it_matters_not_at_which_frame_one_stands(self):
        bpy.ops.object.effector_add(type="WIND")
        wind = bpy.context.object
        wind.field.strength = 2
        for frame, noise, bending in ((1, 0.2, 5), (30, 0.9, 500)):
            wind.field.noise = noise
            wind.keyframe_insert("field.noise", frame=frame)
            self.sheet.pliant.use_bending = True
            self.sheet.pliant.bending = bending
            self.sheet.keyframe_insert("pliant.bending", frame=frame)
        self.bake()
        whole = self.bytes_of(self.sheet)
        self.scene.frame_set(30, subframe=0.5)
        self.bake()
        self.assertEqual(self.bytes_of(self.sheet), whole)
        self.assertEqual((self.scene.frame_current, self.scene.frame_subframe), (30, 0.5))

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
            self.scene.pliant.messages,
            "The file is not saved, so the bake goes when Blender ends; save it and bake again",
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
