"""USD that `pliant convert` writes, read by a reader of the tests' own: every number of the run."""
import unittest

import numpy

import usd_reader
from export_case import ExportCase

NAMES = ["patch", "_1_sheet___", "bar", "rope", "still"]


class UsdExport(ExportCase):
    def convert(self, *options, source="run"):
        self.pliant("convert", source, "out.usda", *options)
        return usd_reader.read(self.folder / "out.usda")

    def points(self, prim):
        """(times, frames × points × 3)"""
        samples = prim.samples["points"]
        self.assertEqual(prim.types["points"], "point3f[]")
        extents = prim.samples["extent"]
        self.assertEqual(list(extents), list(samples))
        for time, points in samples.items():
            numpy.testing.assert_array_equal(extents[time], [numpy.min(points, 0), numpy.max(points, 0)])
        return numpy.array(list(samples)), numpy.array(list(samples.values()))

    def test_every_position_of_every_frame(self):
        stage = self.convert()
        self.assertEqual(stage.metadata, stage.metadata | {
            "defaultPrim": "all_sorts", "metersPerUnit": 1, "upAxis": "Z", "startTimeCode": 0, "endTimeCode": 40,
            "timeCodesPerSecond": 50, "framesPerSecond": 50})
        root = stage.find("all_sorts")
        self.assertEqual(root.kind, "Xform")
        self.assertEqual(list(root.children), NAMES)
        for number, name in enumerate(NAMES):
            with self.subTest(name):
                body = root.find(name)
                self.assertEqual(body.kind, "Xform")
                self.assertEqual(body.metadata["customData"]["name"], self.bodies[number]["name"])
                kind = "edges" if name == "rope" else "mesh"
                self.assertEqual(list(body.children), [kind])
                times, points = self.points(body.find(kind))
                numpy.testing.assert_array_equal(times, numpy.arange(41))
                numpy.testing.assert_array_equal(points.astype(numpy.float32),
                                                 self.body_frames(number).astype(numpy.float32))

    def test_faces_texture_and_curves(self):
        root = self.convert().find("all_sorts")
        patch = root.find("patch", "mesh")
        self.assertEqual(patch.kind, "Mesh")
        self.assertEqual(patch.attributes["faceVertexCounts"], [4, 4, 3])
        self.assertEqual(patch.attributes["faceVertexIndices"], [0, 1, 2, 3, 1, 4, 5, 2, 2, 5, 6])
        self.assertEqual(patch.attributes["subdivisionScheme"], "none")
        self.assertIn("subdivisionScheme", patch.uniform)
        self.assertEqual(patch.types["primvars:st"], "texCoord2f[]")
        self.assertEqual(patch.interpolation["primvars:st"], "faceVarying")
        numpy.testing.assert_allclose(patch.attributes["primvars:st"],
                                      [[0, 0], [.5, 0], [.5, .5], [0, .5], [.5, 0], [1, 0], [1, .5], [.25, .75],
                                       [.5, .5], [1, .5], [.25, .75]])
        bar = root.find("bar", "mesh")
        self.assertEqual(set(bar.attributes["faceVertexCounts"]), {3})
        self.assertEqual(len(bar.attributes["faceVertexCounts"]), 2 * (2 + 4 * 3))
        self.assertNotIn("primvars:st", bar.attributes)
        rope = root.find("rope", "edges")
        self.assertEqual(rope.kind, "BasisCurves")
        self.assertEqual(rope.attributes["curveVertexCounts"], [10])
        self.assertEqual((rope.attributes["type"], rope.attributes["wrap"]), ("linear", "nonperiodic"))
        self.assertEqual(rope.interpolation["widths"], "constant")
        self.assertGreater(rope.attributes["widths"][0], 0)

    def test_thinned_only_when_asked_for(self):
        root = self.convert("--tolerance", 0.05).find("all_sorts")
        for number, name in enumerate(NAMES):
            frames = self.body_frames(number)
            size = numpy.linalg.norm(frames[0].max(0) - frames[0].min(0))
            times, points = self.points(root.find(name, "edges" if name == "rope" else "mesh"))
            self.assertLess(len(times), 41)
            flat = points.reshape(len(times), -1)
            between = numpy.stack([numpy.interp(numpy.arange(41), times, column) for column in flat.T], axis=1)
            errors = numpy.linalg.norm(between.reshape(frames.shape) - frames, axis=2)
            self.assertLessEqual(errors.max(), 0.05 * size + 1e-6)

    def test_another_rate_and_uneven_frames(self):
        stage = self.convert("--fps", 24)
        self.assertEqual(stage.metadata["timeCodesPerSecond"], 24)
        times, points = self.points(stage.find("all_sorts", "rope", "edges"))
        numpy.testing.assert_array_equal(times, numpy.arange(20))  # up to 19/24 s, the last before 0.8 s
        first = self.bodies[3]["first_vertex"]
        for frame in range(20):
            numpy.testing.assert_allclose(points[frame], self.moment(frame / 24)[first:first + 10], atol=1e-6)

    def test_a_single_moment_has_no_time_samples(self):
        stage = self.convert("--time", 0.4, "--body", "bar")
        mesh = stage.find("bar", "bar", "mesh")
        self.assertEqual(mesh.samples, {})
        self.assertEqual(stage.metadata["endTimeCode"], 0)
        numpy.testing.assert_array_equal(numpy.float32(mesh.attributes["points"]),
                                         self.body_frames(2)[20].astype(numpy.float32))

    def test_points_alone(self):
        (self.folder / "points.obj").write_text("v 0 0 0\nv 1 2 3\n")
        mesh = self.convert(source="points.obj").find("points", "points", "points")
        self.assertEqual(mesh.kind, "Points")
        self.assertEqual(mesh.attributes["points"], [(0, 0, 0), (1, 2, 3)])


if __name__ == "__main__":
    unittest.main()
