"""A banner of silk is let go at a corner after two seconds: looks at how far steps are from converged follow."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

PLIANT = os.environ["PLIANT"]
RELEASE = 120  # step


def banner(*more_events, columns=20, rows=40, size=(0.5, 1.0), **settings):
    """Hung by its upper edge, of which it loses all but a corner."""
    top = columns * (rows - 1)
    return {"pliant": 1, "steps": RELEASE + 30, "settings": settings,
            "bodies": [{"name": "banner", "material": "silk",
                        "mesh": {"shape": "grid", "columns": columns, "rows": rows, "plane": "xz", "size": size},
                        "constraints": [{"type": "position", "name": "corner", "on": [top]},
                                        {"type": "position", "name": "edge",
                                         "on": list(range(top + 1, top + columns))}]}],
            "events": [{"step": RELEASE, "remove": "edge"}, *more_events]}


class FollowedEvents(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def pliant(self, *arguments):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def write(self, scene, name="banner"):
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(scene))
        return path

    def run_scene(self, scene, name="banner", *options):
        out = self.folder / name
        done = self.pliant("run", self.write(scene, name), "--out", out, "--quiet", *options)
        return numpy.load(out / "frames.npy"), done.stderr

    def iterations(self, name):
        with open(self.folder / name / "measurements.csv", encoding="utf-8") as file:
            return [int(row["iterations"]) for row in csv.DictReader(file)]

    def test_automatic_iterations_fall_as_fast_as_many(self):
        frames, told = self.run_scene(banner(iterations="automatic"), "automatic")
        self.assertEqual(told, "")
        taken = self.iterations("automatic")
        self.assertLess(taken[RELEASE], 10)
        self.assertGreaterEqual(taken[RELEASE + 1], 20)
        many = banner({"step": RELEASE, "settings": {"iterations": 200}}, iterations="automatic")
        reference, _ = self.run_scene(many, "many")
        numpy.testing.assert_array_equal(frames[RELEASE], reference[RELEASE])

        def fall(frames, steps):  # of the other corner
            return frames[RELEASE, -1, 2] - frames[RELEASE + steps, -1, 2]

        for steps in (15, 30):  # a quarter and half a second
            self.assertAlmostEqual(fall(frames, steps) / fall(reference, steps), 1, delta=0.01)

    def test_a_run_taken_up_between_the_event_and_the_looks_after_it_has_the_same_bits(self):
        scene = banner(iterations="automatic")
        end = RELEASE + 40
        whole, _ = self.run_scene(scene, "whole", "--steps", end)
        taken = self.iterations("whole")
        self.assertLess(taken[RELEASE + 31], taken[RELEASE + 30])  # which the third look after the event has found
        self.run_scene(scene, "parts", "--steps", RELEASE + 8)
        self.pliant("resume", self.folder / "parts", "--steps", end, "--quiet")
        numpy.testing.assert_array_equal(numpy.load(self.folder / "parts" / "frames.npy"), whole)
        self.assertEqual(self.iterations("parts"), self.iterations("whole"))

    def test_run_and_check_say_that_it_is_far_from_converged_then(self):
        few = {"iterations": 2, "acceleration": "none"}
        scene = banner(columns=30, rows=15, size=[2.0, 1.0], **few)
        path = self.write(scene)
        _, told = self.run_scene(scene)
        expected = r"far from converged in step 13\d, after an event: 2 iterations leave 'banner' .*"
        self.assertRegex(told, rf"^warning: {expected}; give --set settings.acceleration=lbfgs\n$")
        worst = json.loads((self.folder / "banner" / "run.json").read_text())["worst_step"]
        self.assertIn(worst["step"], (RELEASE + 10, RELEASE + 15))  # the better one
        self.assertGreater(worst["share"], 0.5)

        text = self.pliant("check", path).stdout
        self.assertRegex(text, rf"\nwarning: {expected}\n")
        self.assertRegex(text, r"\n  how exact after events, in step 13\d: 2 iterations leave 'banner' ")
        motion = json.loads(self.pliant("check", path, "--json").stdout)["motion"]
        self.assertEqual(motion["steps"], 30)
        self.assertLess(motion["step_error"]["share"], 0.5)
        self.assertEqual(motion["after_event"]["step"], worst["step"])
        self.assertAlmostEqual(motion["after_event"]["share"], worst["share"], places=6)

        more = banner(columns=30, rows=15, size=[2.0, 1.0])
        _, told = self.run_scene(more)
        self.assertEqual(told, "")
        text = self.pliant("check", self.write(more)).stdout
        self.assertNotIn("far from converged", text)
        self.assertIn("how exact after events, in step 130: 20 iterations", text)

        del scene["events"]
        _, told = self.run_scene(scene)
        self.assertEqual(told, "")
        text = self.pliant("check", self.write(scene)).stdout
        self.assertNotIn("far from converged", text)
        self.assertNotIn("after events", text)

    def test_what_events_do_without_changing_what_holds_is_not_looked_at(self):
        scene = banner(columns=30, rows=15, size=[2.0, 1.0], iterations=2, acceleration="none")
        scene["events"] = [{"step": RELEASE, "settings": {"damping": 1}}]
        self.assertNotIn("after events", self.pliant("check", self.write(scene)).stdout)


if __name__ == "__main__":
    unittest.main()
