"""What the tests of exports share: a scene of bodies of every kind, its run, and the program."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

PLIANT = os.environ["PLIANT"]
SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])

# Two quadrilaterals and a pentagon; texture coordinates with a seam at vertices 2 and 5.
PATCH = """v 0 0 2
v 1 0 2
v 1 1 2
v 0 1 2
v 2 0 2
v 2 1 2
v 1.5 1.5 2
vt 0 0
vt .5 0
vt .5 .5
vt 0 .5
vt 1 0
vt 1 .5
vt .25 .75
f 1/1 2/2 3/3 4/4
f 2/2 5/5 6/6 3/7
f 3/3 6/6 7/7
"""

# In the order of the vertices: a cloth with texture, a sheet, a solid, a rope, and a body that does not move.
SCENE = {
    "pliant": 1,
    "name": "all sorts",
    "steps": 40,
    "settings": {"threads": 1, "time_step": 0.02},
    "bodies": [
        {"name": "patch", "mesh": {"file": "patch.obj"}, "mass": {"total": 1},
         "constraints": [{"type": "edge_spring", "stiffness": 300}, {"type": "position", "on": [0, 3]}]},
        {"name": "1 sheet/ä", "mesh": {"shape": "grid", "columns": 7, "rows": 5, "size": [1, 0.7]},
         "mass": {"area_density": 0.2},
         "constraints": [{"type": "edge_spring", "stiffness": 800}, {"type": "position", "on": [0, 6]}]},
        {"name": "bar", "mesh": {"shape": "bar", "cells": [3, 1, 1]}, "mass": {"density": 100},
         "constraints": [{"type": "edge_spring", "stiffness": 3000}, {"type": "position", "on": [0, 1]}]},
        {"name": "rope", "mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]}, "mass": {"per_vertex": 0.1},
         "constraints": [{"type": "edge_spring", "stiffness": 1000}, {"type": "position", "on": [0]}]},
        {"name": "still", "mesh": {"shape": "grid", "columns": 3, "rows": 2, "size": [1, 1]},
         "mass": {"total": 1}, "constraints": [{"type": "position", "on": "all"}]},
    ],
}


class ExportCase(unittest.TestCase):
    """A folder with a run of the scene in `run/`; its frames in self.frames, its bodies in self.bodies."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / "patch.obj").write_text(PATCH)
        (cls.folder / "scene.json").write_text(json.dumps(SCENE))
        cls.pliant("run", "scene.json", "--out", "run")
        cls.frames = numpy.load(cls.folder / "run/frames.npy")
        cls.step = 0.02
        cls.bodies = json.loads((cls.folder / "run/run.json").read_text())["bodies"]

    @classmethod
    def pliant(cls, *arguments, expect=0):
        # Drivers of graphics cards leak.
        environment = os.environ | ({"ASAN_OPTIONS": "detect_leaks=0"} if arguments[0] == "render" else {})
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=cls.folder, env=environment)
        assert done.returncode == expect, (arguments, done.returncode, done.stdout, done.stderr)
        if expect:
            errors = [line for line in done.stderr.splitlines() if not line.startswith("warning: ")]
            assert len(errors) == 1 and errors[0].startswith("pliant: error: "), done.stderr
        return done

    def body_frames(self, number):
        first, count = self.bodies[number]["first_vertex"], self.bodies[number]["vertices"]
        return self.frames[:, first:first + count]

    def moment(self, seconds):
        """All positions at a time, linear between the frames of the run."""
        frame = min(seconds / self.step, len(self.frames) - 1)
        low = min(int(frame), len(self.frames) - 2)
        return (low + 1 - frame) * self.frames[low] + (frame - low) * self.frames[low + 1]
