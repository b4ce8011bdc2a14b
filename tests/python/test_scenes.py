"""Scenes, their runs and checkpoints."""
import json
import os
import pathlib
import tempfile
import unittest

import numpy as np
import pliant


class Scenes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def test_every_built_in_scene_opens(self):
        self.assertGreater(len(pliant.scene_names()), 20)
        for name in ("curtain", "curtain_wind", "towel"):
            self.assertIn(name, pliant.scene_names())
            with pliant.open_scene(name) as scene:
                self.assertEqual(scene.name, name)

    def test_a_run_has_the_steps_of_the_scene_whoever_counts(self):
        ends = []
        for way in ("run", "step", "recorded", "parts"):
            with pliant.open_scene("curtain_wind", steps=12, iterations=7) as scene:
                self.assertEqual(scene.simulation.settings["iterations"], 7)
                if way == "run":
                    scene.run()
                elif way == "recorded":
                    scene.run(out=self.path / "run")
                elif way == "parts":
                    scene.run(steps=5)
                    scene.run()
                else:
                    for _ in range(scene.steps):
                        scene.step()
                self.assertEqual(scene.simulation.steps_taken, 12)
                ends.append(scene.simulation.positions.copy())
        for end in ends[1:]:
            np.testing.assert_array_equal(end, ends[0])
        frames = np.load(self.path / "run" / "frames.npy")
        np.testing.assert_array_equal(frames[-1], ends[0])
        info = json.loads((self.path / "run" / "run.json").read_text())
        self.assertEqual(info["outcome"], "ok")
        self.assertTrue((self.path / "run" / "measurements.csv").exists())

    def test_events_act(self):
        scene = {"pliant": 1, "steps": 10, "bodies": [
            {"name": "cloth", "mesh": {"shape": "grid"}, "mass": {"total": 1},
             "constraints": [{"type": "edge_spring"}, {"type": "position", "name": "pins", "on": "corners"}]}],
            "events": [{"step": 5, "remove": "pins"}]}
        with pliant.open_scene(scene, set={"bodies[cloth].mass.total": 2}) as made:
            self.assertAlmostEqual(made.simulation.masses.sum(), 2)
            for _ in range(5):
                made.step()
            self.assertIsNotNone(made.simulation.find_group("pins"))
            made.step()
            self.assertIsNone(made.simulation.find_group("pins"))

    def test_a_checkpoint_goes_on_with_the_same_bits(self):
        with pliant.open_scene("curtain_wind", steps=10) as scene:
            scene.run(steps=4)
            saved = scene.save()
            scene.save(self.path / "half.pliant")
            scene.run()
        for source in (saved, self.path / "half.pliant"):
            again = pliant.load_checkpoint(source)
            self.assertEqual(again.simulation.steps_taken, 4)
            again.run()
            np.testing.assert_array_equal(again.simulation.positions, scene.simulation.positions)
        with self.assertRaisesRegex(pliant.Error, "checkpoint"):
            pliant.load_checkpoint(saved[:50])

    def test_a_checkpoint_of_a_scene_with_additions(self):
        def prepare(scene):
            scene.simulation.add(scene.simulation.bodies[0], pliant.EdgeSpring(stiffness=30), name="own")

        with pliant.open_scene("curtain_wind", steps=10) as scene:
            prepare(scene)
            scene.run(steps=4)
            saved = scene.save()
            scene.run()
        with self.assertRaisesRegex(pliant.Error, "add again what the program had added"):
            pliant.load_checkpoint(saved)
        again = pliant.load_checkpoint(saved, prepare=prepare)
        again.run()
        np.testing.assert_array_equal(again.simulation.positions, scene.simulation.positions)

    def test_what_cannot_be_is_told(self):
        (self.path / "file").write_text("")
        for call, kind in [
                (lambda: pliant.open_scene("curtain", itertions=3), "input"),
                (lambda: pliant.open_scene({"pliant": 1}), "input"),
                (lambda: pliant.open_scene("curtain", set={"bodies[sofa].mass": 1}), "input"),
                (lambda: pliant.open_scene("curtain").run(out=self.path / "file", steps=1), "output"),
                (lambda: pliant.open_scene("curtain").run(steps=-1), "input")]:
            with self.assertRaises(pliant.Error) as caught:
                call()
            self.assertEqual(caught.exception.kind, kind)

    def test_a_mesh_by_itself(self):
        pliant.write_mesh(self.path / "cloth.obj", pliant.grid())
        with pliant.open_scene(self.path / "cloth.obj") as scene:
            scene.run(steps=2)
        self.assertEqual(len(pliant.read_mesh(self.path / "cloth.obj", scale=2).vertices), 121)
        self.assertEqual(os.listdir(self.path), ["cloth.obj"])


if __name__ == "__main__":
    unittest.main()
