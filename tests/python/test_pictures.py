"""Pictures of a moment: by the program, and plain ones."""
import os
import struct
import tempfile
import unittest
import xml.etree.ElementTree as xml

import numpy as np
import pliant
from pliant._picture import scene_of
from pliant._simulation import SCENE_NAMES

PROGRAM = os.environ.get("PLIANT", "pliant")
PATHS = "{http://www.w3.org/2000/svg}g/{http://www.w3.org/2000/svg}path"


def with_colliders():
    simulation = pliant.Simulation()
    sheet = pliant.grid(columns=5, rows=4)
    simulation.add_body(sheet, name="sheet", area_density=0.2, start=sheet.vertices + [0, 0, 1])
    colliders = [
        simulation.add(pliant.SphereCollider(center=(1, 0, 0), radius=0.3)),
        simulation.add(pliant.CapsuleCollider(from_=(0.5, 0, -0.2), to=(0.8, 0.3, 0.1), radius=0.05)),
        simulation.add(pliant.BoxCollider(center=(-1, 0, 0), size=(0.2, 0.3, 0.4), rounding=0.02, rotation=(0, 30, 20))),
        simulation.add(pliant.PlaneCollider(position=(0, 0, -1), normal=(0.1, 0, 1))),
    ]
    return simulation, colliders


def moved(simulation, colliders):
    """All of them turned by 40 degrees more, and away from where they began."""
    half = np.radians(20)
    for collider in colliders:
        (x, y, z), (w, *v) = simulation.pose(collider)
        turn = np.array([np.sin(half), 0, 0])
        rotation = (w * np.cos(half) - turn @ v, *(np.cos(half) * np.array(v) + w * turn + np.cross(turn, v)))
        simulation.set_target(collider, (x + 0.1, y - 0.2, z + 0.3), rotation)
    simulation.step()


class PlainPictures(unittest.TestCase):
    def paths(self, simulation, **options):
        picture = simulation.picture(program="", **options)
        self.assertEqual(picture.format, "svg")
        return xml.fromstring(picture.data.decode()).findall(PATHS)

    def test_it_has_every_triangle_and_edge(self):
        simulation = pliant.Simulation()
        simulation.add_body(pliant.grid(columns=5, rows=4), area_density=0.2)
        self.assertEqual(len(self.paths(simulation)), 24)
        simulation.add_body(pliant.chain(links=7), total=1)
        self.assertEqual(len(self.paths(simulation)), 31)
        bar = pliant.bar(cells=[3, 2, 1])
        simulation.add_body(bar, density=1000)
        self.assertEqual(len(self.paths(simulation)), 31 + 2 * 2 * (3 * 2 + 2 * 1 + 1 * 3))

    def test_bodies_are_in_the_picture_and_fill_it(self):
        simulation = pliant.Simulation()
        simulation.add_body(pliant.grid(columns=5, rows=4), area_density=0.2)
        numbers = [float(each) for path in self.paths(simulation, size=(300, 200))
                   for each in path.get("d").translate(str.maketrans("MLZ", "   ")).split()]
        x, y = np.array(numbers[0::2]), np.array(numbers[1::2])
        self.assertTrue(0 < x.min() and x.max() < 300 and 0 < y.min() and y.max() < 200)
        self.assertGreater(max(np.ptp(x) / 300, np.ptp(y) / 200), 0.85)

    def test_what_is_nearer_is_drawn_later(self):
        simulation = pliant.Simulation()
        for y in (0.0, -1.0):  # the eye is on the side of -y
            sheet = pliant.grid(columns=2, rows=2)
            simulation.add_body(sheet, area_density=0.2, start=sheet.vertices + [0, y, 0])
        fills = [path.get("fill") for path in self.paths(simulation)]
        self.assertEqual(fills[0], fills[1])
        self.assertEqual(fills[2], fills[3])
        self.assertGreater(int(fills[0][1:3], 16), int(fills[0][5:7], 16))  # the first body is red and farther away
        self.assertLess(int(fills[2][1:3], 16), int(fills[2][5:7], 16))

    def test_colliders_are_drawn(self):
        simulation, colliders = with_colliders()
        triangles = 24 + sum(len(simulation.collider_surface(each).triangles) for each in colliders)
        self.assertEqual(len(self.paths(simulation)), triangles)
        self.assertGreater(triangles, 500)

    def test_what_is_wrong(self):
        simulation, _ = with_colliders()
        for options, message in (
            ({"size": 3}, "size: found 3; give the width and the height"),
            ({"size": (8, 100)}, "8 x 100 is out of range"),
            ({"color": "stretch"}, "drawn by the program pliant alone"),
        ):
            with self.subTest(message), self.assertRaisesRegex(pliant.Error, message):
                simulation.picture(program="", **options)

    def test_it_is_shown_and_saved(self):
        simulation, _ = with_colliders()
        picture = simulation.picture(program="no such program")
        self.assertEqual(list(picture._repr_mimebundle_()), ["image/svg+xml"])
        with tempfile.TemporaryDirectory() as folder:
            picture.save(os.path.join(folder, "a.svg"))
            with open(os.path.join(folder, "a.svg"), "rb") as file:
                self.assertEqual(file.read(), picture.data)
            with self.assertRaisesRegex(pliant.Error, "give a name with .svg"):
                picture.save(os.path.join(folder, "a.png"))


class SurfacesOfColliders(unittest.TestCase):
    def test_they_are_where_the_collider_is(self):
        simulation, colliders = with_colliders()
        moved(simulation, colliders)
        sphere = simulation.collider_surface(colliders[0])
        np.testing.assert_allclose(np.linalg.norm(sphere.vertices - [1.1, -0.2, 0.3], axis=1), 0.3, atol=1e-12)
        plane = simulation.collider_surface(colliders[3], 2)
        position, _ = simulation.pose(colliders[3])
        self.assertLess(np.abs(np.linalg.svd(plane.vertices - position)[1][2]), 1e-12)
        self.assertGreater(np.ptp(plane.vertices, axis=0).max(), 2)
        for wrong in (0, -1, np.nan, np.inf):
            with self.assertRaisesRegex(pliant.Error, "size: .* is out of range"):
                simulation.collider_surface(colliders[0], wrong)
        simulation.remove(colliders[0])
        with self.assertRaisesRegex(pliant.Error, "does not exist"):
            simulation.collider_surface(colliders[0])

    def test_the_scene_of_a_picture_has_everything_where_it_is(self):
        simulation, colliders = with_colliders()
        moved(simulation, colliders)
        with pliant.open_scene(scene_of(simulation, SCENE_NAMES)) as scene:
            shown = scene.simulation
            np.testing.assert_array_equal(shown.positions, simulation.positions)
            self.assertEqual(len(shown.colliders), 4)
            for here, there in zip(colliders, shown.colliders):
                wanted, found = simulation.collider_surface(here, 3), shown.collider_surface(there, 3)
                kind = type(simulation.options(here))
                if kind is pliant.SphereCollider:  # it may be turned
                    radii = np.linalg.norm(found.vertices - wanted.vertices.mean(axis=0), axis=1)
                    np.testing.assert_allclose(radii, 0.3, atol=1e-9)
                elif kind is pliant.PlaneCollider:  # its sides may lie otherwise
                    normal = np.linalg.svd(wanted.vertices - wanted.vertices[0])[2][2]
                    np.testing.assert_allclose((found.vertices - wanted.vertices[0]) @ normal, 0, atol=1e-9)
                elif kind is pliant.CapsuleCollider:  # it may be turned about its axis
                    np.testing.assert_allclose(found.vertices.mean(axis=0), wanted.vertices.mean(axis=0), atol=1e-9)
                    wide = [np.linalg.svd(each.vertices - each.vertices.mean(axis=0))[2][0] for each in (wanted, found)]
                    self.assertAlmostEqual(abs(wide[0] @ wide[1]), 1, places=9)
                else:
                    np.testing.assert_allclose(found.vertices, wanted.vertices, atol=1e-9)


class PicturesByTheProgram(unittest.TestCase):
    def png(self, what, **options):
        try:
            picture = what.picture(program=PROGRAM, **options)
        except pliant.Error as error:
            if "OpenGL" in str(error):
                self.skipTest(str(error))
            raise
        self.assertEqual((picture.format, picture.data[:8]), ("png", b"\x89PNG\r\n\x1a\n"))
        return picture.data, struct.unpack(">II", picture.data[16:24])

    def test_of_a_simulation(self):
        simulation, colliders = with_colliders()
        first, size = self.png(simulation, size=(96, 64))
        self.assertEqual(size, (96, 64))
        self.assertNotEqual(self.png(simulation, size=(96, 64), color="speed")[0], first)
        moved(simulation, colliders)
        self.assertNotEqual(self.png(simulation, size=(96, 64))[0], first)
        with self.assertRaisesRegex(pliant.Error, "'energy' needs a scene; give none, stretch or speed"):
            simulation.picture(program=PROGRAM, color="energy")

    def test_of_a_scene_at_its_moment(self):
        with pliant.open_scene("chain") as scene:
            first, _ = self.png(scene, size=(96, 64), color="energy")
            scene.run(steps=20)
            self.assertNotEqual(self.png(scene, size=(96, 64), color="energy")[0], first)
            self.assertEqual(scene.simulation.steps_taken, 20)
            with self.assertRaisesRegex(pliant.Error, "^picture: --color: a checkpoint does not hold what touches"):
                scene.picture(program=PROGRAM, color="contact_force")
            with self.assertRaisesRegex(pliant.Error, "^picture: --color: .*heat"):
                scene.picture(program=PROGRAM, color="heat")


if __name__ == "__main__":
    unittest.main()
