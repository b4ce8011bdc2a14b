"""A mesh file in the place of a scene: what is made of it, what is said of that, and that its run is one like others."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PLIANT = os.environ["PLIANT"]
QUAD = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n"
BOX = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + \
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
SOLID = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
1
1 4 0 1 2 3 4
$EndElements
"""


class MeshAlone(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def pliant(self, *arguments, expect=0, cwd=None):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=cwd or self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def check(self, *arguments):
        return json.loads(self.pliant("check", *arguments, "--json").stdout)

    def test_each_kind_becomes_what_it_is(self):
        kinds = {"quad.obj": (QUAD, "cloth of 4 vertices", {"position", "fibre_strain", "triangle_strain", "triangle_bending"}),
                 "box.obj": (BOX, "a skin of 8 vertices", {"position", "triangle_strain", "hinge"}),
                 "rope.obj": ("v 0 0 0\nv 1 0 0\nv 1 0 1\nl 1 2 3\n", "ropes of 3 vertices", {"position", "edge_spring"}),
                 "solid.msh": (SOLID, "a soft solid of 4 vertices", {"position", "tetrahedron_strain"})}
        for name, kind in kinds.items():
            text, description, types = kind
            with self.subTest(name):
                info = self.check(self.write(name, text))
                self.assertIn(description, info["description"])
                self.assertEqual(set(info["constraints"]), types)
                self.assertEqual(info["forces"], ["gravity"])

    def test_what_was_assumed_is_printed_unless_it_shall_be_quiet(self):
        self.write("quad.obj", QUAD)
        text = self.pliant("run", "quad.obj", "--steps", 3, "--set", "bodies[0].mass.total=2").stdout
        for line in ["quad.obj: cloth of 4 vertices, pinned at the highest vertices", "size      1 x 0 x 1 m",
                     "mass      2 kg", "pins      3 of type position", "material  cotton", "warp      2 of type fibre_strain, stiffness 1102 N/m, 5512 once taut",
                     "forces    gravity; no wind", "steps     3 of 0.01667 s, 20 iterations each"]:
            self.assertIn(line, text)
        self.assertIn("mass      0.1238 kg", self.pliant("check", "quad.obj").stdout)
        self.assertEqual(self.pliant("run", "quad.obj", "--steps", 3, "--quiet").stdout, "")
        self.assertNotIn("mass      ", self.pliant("run", "chain", "--steps", 1).stdout)

    def test_scale_and_axis(self):
        self.write("big.obj", QUAD.replace("1", "20").replace("f 20", "f 1"))
        assumed = self.pliant("check", "big.obj").stdout
        self.assertIn("its 20 units are taken as 1 m", assumed)
        self.assertIn("1 x 0 x 1 m", assumed)
        self.assertIn("2 x 2 x 0 m", self.pliant("check", "big.obj", "--scale", "0.1", "--up", "y").stdout)
        error = self.pliant("check", "chain", "--scale", "0.1", expect=2).stderr
        self.assertIn("--scale, --up, --drop-loose: these are for a mesh by itself", error)
        self.assertIn("no such file", self.pliant("run", "nothing.obj", expect=2).stderr)

    def test_its_scene_file_gives_the_same_run(self):
        self.write("quad.obj", QUAD)
        (self.folder / "quad.json").write_text(self.pliant("check", "quad.obj", "--scene").stdout)
        for source, out in [("quad.obj", "a"), ("quad.json", "b")]:
            self.pliant("run", source, "--steps", 20, "--out", out)
        self.assertEqual((self.folder / "a/frames.npy").read_bytes(), (self.folder / "b/frames.npy").read_bytes())

    def test_it_can_be_resumed_from_anywhere(self):
        self.write("quad.obj", QUAD)
        self.pliant("run", "quad.obj", "--steps", 20, "--out", "whole")
        self.pliant("run", "quad.obj", "--steps", 5, "--out", "part")
        self.pliant("resume", self.folder / "part", "--steps", 20, cwd="/")
        self.assertEqual((self.folder / "whole/frames.npy").read_bytes(), (self.folder / "part/frames.npy").read_bytes())

    def test_vertices_of_no_element_have_a_little_mass(self):
        info = self.check(self.write("loose.obj", QUAD + "v 0.5 0 0.5\n"))
        self.assertAlmostEqual(info["bodies"][0]["mass"], 0.1238 * (1 + 1e-3 / 4), delta=1e-12)
        self.assertEqual(info["bodies"][0]["vertices"], 5)

    def test_loose_vertices_are_named_and_dropped(self):
        self.write("loose.obj", "v 0.5 0 0.5\n" + QUAD.replace("f 1 2 3 4", "f 2 3 4 5"))
        warning = self.pliant("check", "loose.obj").stderr
        self.assertIn("bodies[0].material: 1 vertex in no element (0): each gets a thousandth of the mean mass", warning)
        for command in [["run", "--steps", 2, "--out", "out"], ["check"]]:
            done = self.pliant(*command, "loose.obj", "--drop-loose")
            self.assertIn("left out 1 vertex that no element has; the other 4 are numbered anew", done.stderr)
        self.write("quad.obj", QUAD)
        self.pliant("run", "quad.obj", "--steps", 2, "--out", "plain")
        self.assertEqual((self.folder / "plain/frames.npy").read_bytes(), (self.folder / "out/frames.npy").read_bytes())

    def test_a_sweep_of_a_mesh_takes_its_import(self):
        self.write("loose.obj", QUAD + "v 0.5 0 0.5\n")
        self.pliant("sweep", "loose.obj", "--drop-loose", "--scale", 2, "--steps", 2, "--out", "sweep", "--format", "npy",
                    "--vary", "settings.iterations=2,5")
        runs = sorted((self.folder / "sweep").glob("runs/*/run.json"))
        self.assertEqual([json.loads(run.read_text())["bodies"][0]["vertices"] for run in runs], [4, 4])

    def test_ropes_beside_cloth_have_a_little_of_its_mass(self):
        info = self.check(self.write("both.obj", QUAD + "v 0.5 0 -1\nl 1 5\n"))
        self.assertAlmostEqual(info["bodies"][0]["mass"], 0.3 * 1.001, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
