"""glTF that `pliant convert` writes, read by a reader of the tests' own: the run's positions at any time."""
import unittest

import numpy

import usd_reader
from export_case import ExportCase
from gltf_reader import Gltf


class GltfExport(ExportCase):
    def convert(self, name, *options):
        self.done = self.pliant("convert", "run", name, "--yes", *options)
        return Gltf(self.folder / name)

    def sizes(self):
        return [numpy.linalg.norm(body[0].max(0) - body[0].min(0))
                for body in map(self.body_frames, range(len(self.bodies)))]

    def sources(self, gltf, number):
        """Our vertex for each of the file's, told by the positions at the start."""
        own = self.body_frames(number)[0]
        rest = gltf.attribute(self.bodies[number]["name"], "POSITION", 0)
        distances = numpy.linalg.norm(rest[:, None] - own[None], axis=2)
        self.assertLess(distances.min(1).max(), 1e-6)
        return distances.argmin(1)

    def check_positions(self, gltf, tolerance, times):
        worst = 0
        for number, (body, size) in enumerate(zip(self.bodies, self.sizes())):
            sources = self.sources(gltf, number)
            for time in times:
                wanted = self.moment(time)[body["first_vertex"] + sources]
                found = gltf.attribute(body["name"], "POSITION", time)
                worst = max(worst, numpy.linalg.norm(found - wanted, axis=1).max() / size)
        self.assertLessEqual(worst, tolerance + 1e-6)
        return worst

    def test_every_frame_when_nothing_may_be_off(self):
        for name in ["all.glb", "all.gltf"]:
            with self.subTest(name):
                gltf = self.convert(name, "--tolerance", 0)
                numpy.testing.assert_allclose(gltf.times(), self.step * numpy.arange(41), atol=1e-6)
                self.check_positions(gltf, 0, self.step * numpy.arange(41))
                self.check_positions(gltf, 0, [0.013, 0.377])

    def test_thinned_within_the_tolerance_and_as_told(self):
        counts = []
        for tolerance in [0.01, 0.03, 0.1]:
            gltf = self.convert("thin.glb", "--tolerance", tolerance)
            keys = gltf.times()
            self.assertEqual(keys[0], 0)
            self.assertAlmostEqual(keys[-1], 0.8, places=6)
            counts.append(len(keys))
            worst = self.check_positions(gltf, tolerance, self.step * numpy.arange(41))
            self.assertGreater(worst, tolerance / 10)
            self.assertIn(f"41 frames, {self.frames.shape[1]} vertices, 0.8 s, 50 frames per second", self.done.stdout)
            self.assertIn(f"{len(keys)} of them kept, the others off by at most {worst:.2g}", self.done.stdout)
        self.assertEqual(counts, sorted(set(counts), reverse=True))
        self.assertEqual(self.done.stderr, "")

    def test_no_more_keyframes_than_asked_for(self):
        for limit in [2, 3, 6]:
            gltf = self.convert("few.glb", "--max-keyframes", limit)
            self.assertLessEqual(len(gltf.times()), limit)
            worst = self.check_positions(gltf, numpy.inf, self.step * numpy.arange(41))
            self.assertIn(f"warning: the error {worst:.2g} is past the tolerance 0.001", self.done.stderr)

    def test_times_begin_at_0_and_a_selection_of_frames_is_kept(self):
        gltf = self.convert("part.glb", "--frames", "10:30:5", "--tolerance", 0)
        numpy.testing.assert_allclose(gltf.times(), [0, 0.1, 0.2, 0.3, 0.4], atol=1e-6)
        first = gltf.attribute("bar", "POSITION", 0)
        numpy.testing.assert_allclose(first, self.body_frames(2)[10], atol=1e-6)

    def test_topology_names_and_what_stands_still(self):
        gltf = self.convert("all.glb")
        self.assertEqual([node["name"] for node in gltf.json["nodes"]], [body["name"] for body in self.bodies])
        self.assertEqual(gltf.json["scenes"][0]["nodes"], [0, 1, 2, 3, 4])
        modes = {name: [part["mode"] for part in gltf.primitives(name)] for name in gltf.nodes}
        self.assertEqual(modes, {"patch": [4], "1 sheet/ä": [4], "bar": [4], "rope": [1], "still": [4]})
        self.assertNotIn("targets", gltf.primitives("still")[0])
        self.assertEqual(len(gltf.json["animations"][0]["channels"]), 4)
        # The patch: 2 + 2 + 1 triangles, cut as fans from the first corner.
        sources = self.sources(gltf, 0)
        triangles = gltf.accessor(gltf.primitives("patch")[0]["indices"])[:, 0].reshape(-1, 3)
        self.assertEqual(sources[triangles].tolist(), [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2], [2, 5, 6]])
        rope = gltf.accessor(gltf.primitives("rope")[0]["indices"])[:, 0].reshape(-1, 2)
        self.assertEqual(rope.tolist(), [[i, i + 1] for i in range(9)])

    def test_texture_coordinates_keep_their_seam(self):
        gltf = self.convert("all.glb")
        part = gltf.primitives("patch")[0]
        uv = gltf.accessor(part["attributes"]["TEXCOORD_0"])
        self.assertEqual(len(uv), 8)  # vertex 2 is there with two of them
        triangles = gltf.accessor(part["indices"])[:, 0].reshape(-1, 3)
        numpy.testing.assert_allclose(uv[triangles[0]], [[0, 1], [0.5, 1], [0.5, 0.5]], atol=1e-7)
        numpy.testing.assert_allclose(uv[triangles[3]], [[0.5, 1], [1, 0.5], [0.25, 0.25]], atol=1e-7)
        self.assertNotIn("TEXCOORD_0", gltf.primitives("bar")[0]["attributes"])

    def test_normals_are_those_of_the_moved_surface(self):
        gltf = self.convert("all.glb", "--tolerance", 0)
        part = gltf.primitives("1 sheet/ä")[0]
        triangles = gltf.accessor(part["indices"])[:, 0].reshape(-1, 3)
        for time in [0, 0.2, 0.8]:
            x = gltf.attribute("1 sheet/ä", "POSITION", time)
            wanted = numpy.zeros_like(x)
            for a, b, c in triangles:
                for vertex in (a, b, c):
                    wanted[vertex] += numpy.cross(x[b] - x[a], x[c] - x[a])
            wanted /= numpy.linalg.norm(wanted, axis=1)[:, None]
            numpy.testing.assert_allclose(gltf.attribute("1 sheet/ä", "NORMAL", time), wanted, atol=1e-4)
        flat = self.convert("flat.glb", "--normals", "flat")
        self.assertEqual(list(flat.primitives("bar")[0]["attributes"]), ["POSITION"])
        self.assertEqual(list(flat.primitives("bar")[0]["targets"][0]), ["POSITION"])

    def test_colors_of_the_scene(self):
        plain = self.convert("plain.glb")
        self.assertEqual(len(plain.json["materials"]), 5)
        self.assertTrue(all(material["doubleSided"] for material in plain.json["materials"]))
        colors = {"front": "#ff8000", "back": "#0000ff"}
        self.pliant("run", "scene.json", "--out", "two", *(f"--set=view.{side}={color}" for side, color in colors.items()))
        self.pliant("convert", "two", "two.glb", "--tolerance", 0.01)
        gltf = Gltf(self.folder / "two.glb")
        linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
        tones = [material["pbrMetallicRoughness"]["baseColorFactor"] for material in gltf.json["materials"]]
        numpy.testing.assert_allclose(tones, [[1, linear, 0, 1], [0, 0, 1, 1], [1, linear, 0, 1]], atol=1e-9)
        self.assertEqual([material["doubleSided"] for material in gltf.json["materials"]], [False, False, True])
        front, back = gltf.primitives("1 sheet/ä")
        self.assertEqual((front["material"], back["material"], gltf.primitives("rope")[0]["material"]), (0, 1, 2))
        triangles = [gltf.accessor(side["indices"])[:, 0].reshape(-1, 3) for side in (front, back)]
        numpy.testing.assert_array_equal(triangles[0][:, [0, 2, 1]], triangles[1])
        self.assertEqual(front["attributes"]["POSITION"], back["attributes"]["POSITION"])
        pairs = [(front["attributes"], back["attributes"]), *zip(front["targets"], back["targets"])]
        for own, other in pairs:
            numpy.testing.assert_array_equal(gltf.accessor(own["NORMAL"]), -gltf.accessor(other["NORMAL"]))
        (self.folder / "two/checkpoint.pliant").write_bytes(b"x")
        done = self.pliant("convert", "two", "two.glb", "--tolerance", 0.01)
        self.assertIn("warning: the colors that the scene gives its bodies and colliders are not known: ", done.stderr)
        self.assertEqual(len(Gltf(self.folder / "two.glb").json["materials"]), 5)
        dressed = ('--set=bodies[bar].appearance={"front": "#ff0000", "back": "#00ff00"}',
                   '--set=bodies[rope].appearance={"front": "#0000ff"}')
        self.pliant("run", "scene.json", "--out", "dressed", *dressed)
        self.pliant("convert", "dressed", "dressed.glb", "--tolerance", 0.01)
        gltf = Gltf(self.folder / "dressed.glb")

        def materials(name):
            return [(gltf.json["materials"][part["material"]]["pbrMetallicRoughness"]["baseColorFactor"][:3],
                     gltf.json["materials"][part["material"]]["doubleSided"]) for part in gltf.primitives(name)]

        self.assertEqual(materials("bar"), [([1, 0, 0], False), ([0, 1, 0], False)])
        self.assertEqual(materials("rope"), [([0, 0, 1], True)])
        (muted, is_double), = materials("1 sheet/ä")
        self.assertTrue(is_double)
        self.assertEqual(muted, plain.json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"][:3])
        self.pliant("convert", "dressed", "bar.glb", "--tolerance", 0.01, "--body", "bar")
        gltf = Gltf(self.folder / "bar.glb")
        self.assertEqual(materials("bar"), [([1, 0, 0], False), ([0, 1, 0], False)])
        self.pliant("convert", "dressed", "dressed.usda")
        root = usd_reader.read(self.folder / "dressed.usda").find("all_sorts")
        for name, kind, color in (("bar", "mesh", [1, 0, 0]), ("rope", "edges", [0, 0, 1])):
            numpy.testing.assert_array_equal(root.find(name, kind).attributes["primvars:displayColor"], [color])
        self.assertNotIn("primvars:displayColor", root.find("patch", "mesh").attributes)
        same = [f"--set=view.{side}=#ff8000" for side in colors]
        self.pliant("run", "scene.json", "--out", "same", *same)
        self.pliant("convert", "same", "same.glb", "--tolerance", 0.01)
        gltf = Gltf(self.folder / "same.glb")
        self.assertEqual([material["doubleSided"] for material in gltf.json["materials"]], [True])
        self.assertEqual(len(gltf.primitives("bar")), 1)

    def test_one_body_and_one_moment(self):
        gltf = self.convert("rope.glb", "--body", "rope", "--time", "0.113")
        self.assertEqual(list(gltf.nodes), ["rope"])
        self.assertNotIn("animations", gltf.json)
        body = self.bodies[3]
        wanted = self.moment(0.113)[body["first_vertex"]:body["first_vertex"] + body["vertices"]]
        numpy.testing.assert_allclose(gltf.attribute("rope", "POSITION", 0), wanted, atol=1e-6)

    def test_mesh_without_motion(self):
        self.pliant("convert", "patch.obj", "patch.glb")
        gltf = Gltf(self.folder / "patch.glb")
        self.assertNotIn("animations", gltf.json)
        self.assertEqual(len(gltf.attribute("patch", "POSITION", 0)), 8)


if __name__ == "__main__":
    unittest.main()
