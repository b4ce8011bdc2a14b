"""The module and the library are one: the first example has the bits of the one in C++; names and values are checked."""
import os
import pathlib
import runpy
import subprocess
import tempfile
import unittest

import numpy as np
import pliant

SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])


class FirstSteps(unittest.TestCase):
    def test_has_the_bits_of_cpp(self):
        program = os.environ.get("PLIANT_FIRST_STEPS")
        if program is None:
            self.skipTest("the examples in C++ are not built")
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                subprocess.run([program], check=True, capture_output=True)
                written = pathlib.Path("curtain.obj").read_bytes()
                os.remove("curtain.obj")
                runpy.run_path(str(SOURCE / "python" / "examples" / "first_steps.py"))
                self.assertEqual(pathlib.Path("curtain.obj").read_bytes(), written)
            finally:
                os.chdir(before)

    def test_meshes_come_from_arrays(self):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        mesh = pliant.Mesh(vertices, tetrahedra=[[0, 1, 2, 3]])
        np.testing.assert_array_equal(mesh.vertices, vertices)
        np.testing.assert_array_equal(mesh.tetrahedra, [[0, 1, 2, 3]])
        self.assertEqual(pliant.Mesh(vertices, [[0, 1, 2]]).triangles.shape, (1, 3))
        self.assertEqual(len(pliant.Mesh(vertices, edges=[[0, 1], [2, 3]]).edges), 2)

    def test_wrong_meshes_are_refused(self):
        vertices = np.eye(3)
        for arguments, words in [
                (dict(vertices=[[0, 0]]), "Mesh: vertices"),
                (dict(vertices=vertices, triangles=[[0, 1, 7]]), "7"),
                (dict(vertices=vertices, triangles=[[0, 1]]), "k x 3"),
                (dict(vertices=vertices, triangles=[[0.0, 1.0, 2.5]]), "Mesh: triangles"),
                (dict(vertices=vertices * np.nan, triangles=[[0, 1, 2]]), "finite")]:
            with self.subTest(words), self.assertRaisesRegex(pliant.Error, words) as caught:
                pliant.Mesh(**arguments)
            self.assertEqual(caught.exception.kind, "input")

    def test_a_body_needs_a_mass(self):
        simulation = pliant.Simulation()
        with self.assertRaisesRegex(pliant.Error, "without a mass"):
            simulation.add_body(pliant.grid())
        with self.assertRaisesRegex(pliant.Error, "area_density"):
            simulation.add_body(pliant.grid(), area_densty=0.2)
        for mass in [dict(per_vertex=0.1), dict(total=1), dict(area_density=0.2), dict(each=np.full(121, 0.1)),
                     dict(total=1, area_density=1)]:
            simulation.add_body(pliant.grid(), **mass)
        self.assertEqual(simulation.positions.shape, (5 * 121, 3))
        self.assertAlmostEqual(simulation.masses[-121:].sum(), 2)

    def test_a_step_that_diverges_says_so(self):
        simulation = pliant.Simulation()
        body = simulation.add_body(pliant.grid(), area_density=0.2)
        simulation.add(body, pliant.EdgeSpring())
        simulation.add(pliant.Gravity(acceleration=(0, 0, -1e308)))
        with self.assertRaises(pliant.Error) as caught:
            for _ in range(5):
                simulation.step()
        self.assertEqual(caught.exception.kind, "diverged")
        self.assertNotIn("\n", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
