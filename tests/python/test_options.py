"""Every type of the lists, and every option of each, by name."""
import inspect
import os
import pathlib
import unittest

import numpy as np
import pliant

TRIANGLE = [[0, 1, 11]]
SAMPLES = {  # of options without a default that can be named
    "Values": 1.0, "Points": (0.0, 0.0, 1.0), "Lists": [[1.0]], "Stencils": TRIANGLE, "Selection": "boundary",
    "Vector": (0.0, 0.0, 1.0), "Sequence[BodyId]": [], "float | None": 0.5, "BodyId": pliant.BodyId(0)}


def sample(field):
    return SAMPLES[field["type"]] if field["default"] is None else field["default"]


def python_name(field):
    return "from_" if field["name"] == "from" else field["name"]


class Options(unittest.TestCase):
    def test_there_are_types_of_every_kind(self):
        kinds = [described["kind"] for described in pliant.TYPES.values()]
        for kind, least in [("constraint", 16), ("force", 5), ("collider", 4), ("shape", 11), ("settings", 9)]:
            self.assertGreaterEqual(kinds.count(kind), least, kind)

    def test_every_option_is_taken_and_told(self):
        count = 0
        for name, described in pliant.TYPES.items():
            if described["kind"] not in ("constraint", "force", "collider"):
                continue
            made = getattr(pliant, name)
            self.assertEqual(made.__name__, name)
            for field in described["fields"]:
                count += 1
                with self.subTest(type=name, option=field["name"]):
                    value = sample(field)
                    options = made(**{python_name(field): value})
                    self.assertIs(getattr(options, python_name(field)), value)
                    self.assertIn(f"{name}({python_name(field)}=", repr(options))
                    self.assertIn(f"    {python_name(field)}: ", made.__doc__)
                    self.assertIn(f"[{field['unit']}]" if field["unit"] else "", made.__doc__)
                    self.assertIn(python_name(field), inspect.signature(made).parameters)
        self.assertGreater(count, 100)

    def test_every_shape_is_made_with_every_option(self):
        for name, described in pliant.TYPES.items():
            if described["kind"] != "shape":
                continue
            shape = getattr(pliant, described["scene_name"])
            with self.subTest(shape=name):
                given = {field["name"]: field["default"] for field in described["fields"]}
                np.testing.assert_array_equal(shape(**given).vertices, shape().vertices)

    def test_every_setting_is_taken_and_told(self):
        for field in pliant.TYPES["SolverSettings"]["fields"]:
            simulation = pliant.Simulation(**{field["name"]: field["default"]})
            self.assertEqual(simulation.settings[field["name"]], field["default"], field["name"])
            simulation.set_settings(**{field["name"]: field["default"]})
        simulation.set_settings(iterations=33)
        self.assertEqual(simulation.settings["iterations"], 33)
        self.assertEqual(pliant.Simulation(iterations="automatic").settings["iterations"], -1)

    def test_every_type_can_be_added_and_told_again(self):
        """On a mesh that has all kinds of elements."""
        cloth, bar = pliant.grid(), pliant.bar(cells=[2, 2, 2])
        shift = len(cloth.vertices)
        mesh = pliant.Mesh(np.vstack([cloth.vertices, bar.vertices + [0, 2, 0]]), cloth.triangles,
                           tetrahedra=bar.tetrahedra + shift)
        needed = {"Drag": dict(stencils=[[0]]), "TestForce": dict(vertices=[0], force=(0, 0, 1)), "MouseSpring": dict(vertices=[0]),
                  "Attachment": dict(on=[0], to_on=[5]), "Line": dict(direction=(0, 0, 1)),
                  "OnPlane": dict(normal=(0, 0, 1)), "InHalfSpace": dict(normal=(0, 0, 1))}
        for name, described in pliant.TYPES.items():
            if described["kind"] not in ("constraint", "force", "collider"):
                continue
            with self.subTest(type=name):
                simulation = pliant.Simulation()
                closed = name == "Pressure"
                body = simulation.add_body(pliant.sphere() if closed else mesh, per_vertex=0.01)
                given = dict(needed.get(name, {}))
                if name == "Attachment":
                    given["to"] = body
                made = getattr(pliant, name)(**given)
                added = simulation.add(made) if described["kind"] == "collider" else simulation.add(body, made)
                again = simulation.options(added)
                self.assertIs(type(again), type(made))
                simulation.replace(added, again)
                self.assertEqual(simulation.options(added), again)
                simulation.step()
                simulation.remove(added)

    def test_wrong_names_and_values_say_what_to_do(self):
        for make, words in [
                (lambda: pliant.EdgeSpring(stifness=1), "EdgeSpring: unknown option 'stifness'; did you mean 'stiffness'"),
                (lambda: pliant.EdgeSpring(stiffness=-1), "EdgeSpring: stiffness: -1 is out of range"),
                (lambda: pliant.EdgeSpring(stiffness=float("nan")), "stiffness"),
                (lambda: pliant.EdgeSpring(stiffness="soft"), "EdgeSpring: stiffness: found 'soft'; give a number"),
                (lambda: pliant.Position(hold="hart"), "Position: hold: unknown choice 'hart'; did you mean 'hard'"),
                (lambda: pliant.Position(targets=[1, 2]), "three numbers"),
                (lambda: pliant.Position(on=[0.5]), "vertex indices"),
                (lambda: pliant.Gravity(acceleration="down"), r"three numbers \[m/s²\]"),
                (lambda: pliant.Simulation(itertions=3), "did you mean 'iterations'"),
                (lambda: pliant.Simulation(iterations=0), "iterations"),
                (lambda: pliant.Simulation(iterations=True), "iterations"),
                (lambda: pliant.Simulation(iterations=2.5), "whole number"),
                (lambda: pliant.grid(colums=3), "did you mean 'columns'"),
                (lambda: pliant.grid(columns=1), "columns"),
                (lambda: pliant.open_scene("curtin"), "did you mean 'curtain'"),
                (lambda: pliant.read_mesh("nowhere.obj"), "nowhere.obj")]:
            with self.subTest(words), self.assertRaisesRegex(pliant.Error, words) as caught:
                make()
            self.assertEqual(caught.exception.kind, "input")
            self.assertNotIn("\n", str(caught.exception))

    def test_shapes_say_what_they_are(self):
        page = (pathlib.Path(os.environ["PLIANT_SOURCE_DIR"]) / "docs/scenes/bodies.md").read_text(encoding="utf-8")
        shapes = [described["scene_name"] for described in pliant.TYPES.values() if described["kind"] == "shape"]
        self.assertIn("grid", shapes)
        for shape in shapes:
            first = getattr(pliant, shape).__doc__.splitlines()[0]
            self.assertTrue(first)
            self.assertIn(f"### `{shape}`\n\n{first}", page)

    def test_selections_are_those_of_scenes_or_masks(self):
        simulation = pliant.Simulation()
        body = simulation.add_body(pliant.grid(), total=1)
        x = simulation.positions
        for on, count in [("all", 121), ("boundary", 40), ("corners", 4), (x[:, 2] > 0.95, 11), ([3, 4], 2),
                          ({"box": {"min": [-1, -1, 0.95], "max": [2, 1, 2]}}, 11), (np.arange(5), 5)]:
            pins = simulation.add(body, pliant.Position(on=on))
            self.assertEqual(len(simulation.targets(pins)), count)
            simulation.remove(pins)
        for on, words in [(x[:5, 2] > -1, "one for each"), ({"boxx": 1}, "did you mean 'box'"), ([999], "999"),
                          (np.zeros(121, bool), "selects no vertex"), ("everywhere", "everywhere")]:
            with self.assertRaisesRegex(pliant.Error, words):
                simulation.add(body, pliant.Position(on=on))
        self.assertEqual(simulation.groups, [])


if __name__ == "__main__":
    unittest.main()
