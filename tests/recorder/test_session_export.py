"""`pliant convert` of what the window has recorded: the same bodies, frames, colliders and looks as of a run."""
import base64
import json
import unittest

import numpy

import usd_reader
from export_case import ExportCase

STEPS = 30


class SessionExport(ExportCase):
    extra = {"colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, -2], "radius": 0.5}]}

    def refused(self, *arguments):
        return self.pliant(*arguments, expect=2).stderr

    def session(self, name, actions):
        """As Ctrl R saves it, of the scene from its start."""
        scene = json.loads((self.folder / "scene.json").read_text()) | self.extra
        (self.folder / "with_ball.json").write_text(json.dumps(scene))
        self.pliant("run", "with_ball.json", "--steps", 0, "--out", "start", "--quiet")
        start = base64.b64encode((self.folder / "start" / "checkpoint.pliant").read_bytes()).decode()
        (self.folder / name).write_text(json.dumps({
            "pliant_session": 1, "scene": "all sorts", "steps": STEPS, "actions": actions, "checksums": [],
            "start": start}))

    def test_without_actions_it_is_the_run(self):
        self.session("still.session", [])
        self.pliant("run", "with_ball.json", "--steps", STEPS, "--out", "same", "--quiet")
        for ending in ("mdd", "usda", "glb"):
            self.pliant("convert", "still.session", f"session.{ending}", "--yes")
            self.pliant("convert", "same", f"run.{ending}", "--yes")
        self.assertEqual((self.folder / "session.mdd").read_bytes(), (self.folder / "run.mdd").read_bytes())
        session, run = (json.loads(read[20:20 + int.from_bytes(read[12:16], "little")]) for read in
                        ((self.folder / f"{name}.glb").read_bytes() for name in ("session", "run")))
        for kind in ("materials", "accessors", "meshes"):
            self.assertEqual(len(session[kind]), len(run[kind]), kind)
        self.assertEqual(sorted(node["name"] for node in session["nodes"] if "mesh" in node),
                         sorted(node["name"] for node in run["nodes"] if "mesh" in node))
        self.assertIn("ball", [node["name"] for node in session["nodes"]])
        session, run = (usd_reader.read(self.folder / f"{name}.usda") for name in ("session", "run"))

        def shape(prim):
            return prim.kind, sorted(prim.attributes), [(name, shape(child)) for name, child in prim.children.items()]

        def bodies(root):
            top = next(iter(root.children.values()))
            return [shape(child) for child in top.children.values()]

        self.assertEqual(bodies(session), bodies(run))

    def test_what_was_done_is_in_it(self):
        self.session("moved.session", [{"step": 0, "do": "move_collider", "collider": 0, "target": [0.25, 0, -2]},
                                       {"step": 5, "do": "drop_collider", "collider": 0},
                                       {"step": 10, "do": "unpin", "vertex": 0}])
        told = self.pliant("convert", "moved.session", "moved.usda").stdout
        self.assertIn(f"{STEPS + 1} frames", told)
        root = usd_reader.read(self.folder / "moved.usda")

        def find(prim, name):
            for child_name, child in prim.children.items():
                found = child if child_name == name else find(child, name)
                if found is not None:
                    return found
            return None

        samples = find(root, "ball").samples["xformOp:translate"]
        first, last = samples[min(samples)], samples[max(samples)]
        numpy.testing.assert_allclose(first, [0, 0, -2], atol=1e-9)
        numpy.testing.assert_allclose(last, [0.25, 0, -2], atol=1e-7)
        patch = find(root, "patch")
        points = (patch if "points" in patch.samples else next(iter(patch.children.values()))).samples["points"]
        corner = numpy.array([points[time][0] for time in sorted(points)])
        self.assertEqual(numpy.ptp(corner[:11], axis=0).max(), 0)  # pinned as long as it was
        self.assertLess(corner[-1][2], corner[0][2] - 0.1)

    def test_what_was_moved_before_the_first_step_begins_there(self):
        self.session("begun.session", [{"step": 0, "do": "move_collider", "collider": 0, "target": [0, 1, -2]},
                                       {"step": 0, "do": "drop_collider", "collider": 0}])
        self.pliant("convert", "begun.session", "begun.usda")
        text = (self.folder / "begun.usda").read_text()
        ball = text[text.index('"ball"'):]
        places = {line.strip() for line in ball[:ball.index("def ", 10) if "def " in ball[10:] else None].splitlines()
                  if "double3 xformOp:translate" in line}
        self.assertEqual(len(places), 1, places)
        self.assertIn("(0, 1, -2)", places.pop())

    def test_one_body_a_sequence_and_a_moment(self):
        self.session("still.session", [])
        self.pliant("convert", "still.session", "rope.pc2", "--body", "rope")
        self.pliant("convert", "still.session", "f_##.ply")
        self.assertEqual(len(list(self.folder.glob("f_*.ply"))), STEPS + 1)
        self.pliant("convert", "still.session", "now.obj", "--time", 0.2)
        self.assertTrue((self.folder / "now.obj").exists())
        self.pliant("convert", "still.session", "paraview.pvd")

    def test_what_is_wrong_is_said(self):
        self.session("still.session", [])
        refused = self.refused("convert", "still.session", "x.glb", "--scale", 2)
        self.assertIn("still.session: a session has its own meshes", refused)
        content = json.loads((self.folder / "still.session").read_text())
        (self.folder / "cut.session").write_text(json.dumps(content | {"start": content["start"][:400]}))
        self.assertIn("cut.session", self.refused("convert", "cut.session", "x.glb", "--yes"))
        self.assertIn("none.session", self.refused("convert", "none.session", "x.glb", "--yes"))
        self.assertFalse((self.folder / "x.glb").exists())


if __name__ == "__main__":
    unittest.main()
