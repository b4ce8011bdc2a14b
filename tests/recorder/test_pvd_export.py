"""What `pliant convert` writes for ParaView, read by a reader of the tests' own: every position to the bit, and the
values of vertices as they follow from the frames and the scene."""
import shutil
import subprocess
import unittest

import numpy

import vtu_reader
from export_case import PLIANT, ExportCase


def springs(edges, count, stretches):
    """The mean over the edges at each vertex."""
    sums, counts = numpy.zeros(count), numpy.zeros(count)
    for end in edges.T:
        numpy.add.at(sums, end, stretches)
        numpy.add.at(counts, end, 1)
    return sums / numpy.maximum(counts, 1)


class PvdExport(ExportCase):
    def convert(self, *options, source="run", out="out.pvd"):
        self.pliant("convert", source, out, *options)
        frames = vtu_reader.collection(self.folder / out)
        self.assertEqual(sorted(path for _, path in frames), sorted((self.folder / (out[:-4] + "_frames")).iterdir()))
        return [time for time, _ in frames], [vtu_reader.Grid(path) for _, path in frames]

    def test_every_position_of_every_frame_at_its_time(self):
        times, grids = self.convert()
        numpy.testing.assert_allclose(times, numpy.arange(41) * 0.02, rtol=1e-14)
        for grid, frame in zip(grids, self.frames):
            numpy.testing.assert_array_equal(grid.points, frame)
            self.assertEqual(grid.cells, grids[0].cells)

    def test_cells_and_bodies(self):
        _, (grid, *_) = self.convert()
        first = {body["name"]: body["first_vertex"] for body in self.bodies}
        self.assertEqual(grid.cells[:3], [(9, (0, 1, 2, 3)), (9, (1, 4, 5, 2)), (5, (2, 5, 6))])
        bar = [corners for kind, corners in grid.cells if kind == 10]
        self.assertGreaterEqual(len(bar), 15)  # each of three boxes has five or six
        self.assertEqual({v for corners in bar for v in corners}, set(range(first["bar"], first["rope"])))
        rope = [corners for kind, corners in grid.cells if kind == 3]
        self.assertEqual(rope, [(first["rope"] + i, first["rope"] + i + 1) for i in range(9)])
        for number, body in enumerate(self.bodies):
            begin = body["first_vertex"]
            self.assertEqual(set(grid.point_data["body"][begin:begin + body["vertices"]]), {number})

    def test_values_follow_from_the_frames(self):
        times, grids = self.convert()
        self.assertEqual(list(grids[0].point_data), ["body", "velocity", "stretch", "energy"])
        numpy.testing.assert_array_equal(grids[0].point_data["velocity"], 0 * self.frames[0])
        for i in range(1, len(grids)):
            velocities = (self.frames[i] - self.frames[i - 1]) / (times[i] - times[i - 1])
            numpy.testing.assert_array_equal(grids[i].point_data["velocity"], velocities.astype(numpy.float32))
        rope = self.bodies[3]["first_vertex"] + numpy.arange(10)
        edges = numpy.stack([rope[:-1], rope[1:]], axis=1)
        lengths = numpy.linalg.norm(self.frames[:, edges[:, 1]] - self.frames[:, edges[:, 0]], axis=2)
        pinned = rope[0]
        for grid, length in zip(grids, lengths):
            count = len(grid.points)
            expected = springs(edges, count, length / lengths[0] - 1)[rope]
            numpy.testing.assert_allclose(grid.point_data["stretch"][rope], expected, atol=1e-5)
            energies = numpy.zeros(count)
            for end in edges.T:
                numpy.add.at(energies, end, 1000 / 4 * (length - lengths[0]) ** 2)
            free = rope[rope != pinned]
            numpy.testing.assert_allclose(grid.point_data["energy"][free], energies[free], rtol=1e-4, atol=1e-9)
        self.assertGreater(grids[-1].point_data["energy"][rope].max(), 1e-3)

    def test_energies_are_those_that_the_run_measured(self):
        table = numpy.genfromtxt(self.folder / "run/measurements.csv", delimiter=",", names=True, encoding="utf-8")
        measured = sum(table[name] for name in table.dtype.names if name.startswith("elastic"))
        _, grids = self.convert()
        summed = [grid.point_data["energy"].astype(float).sum() for grid in grids]
        numpy.testing.assert_allclose(summed[1:], measured[1:], rtol=1e-4)

    def test_one_body_and_some_frames_have_the_same_values(self):
        times, all_grids = self.convert()
        some_times, some = self.convert("--body", "bar", "--frames", "20:40:10", out="bar.pvd")
        self.assertEqual(some_times, times[20::10])
        first, count = self.bodies[2]["first_vertex"], self.bodies[2]["vertices"]
        for grid, whole in zip(some, all_grids[20::10]):
            numpy.testing.assert_array_equal(grid.points, whole.points[first:first + count])
            for name in ("stretch", "energy", "velocity"):
                numpy.testing.assert_array_equal(grid.point_data[name], whole.point_data[name][first:first + count])
            self.assertEqual({kind for kind, _ in grid.cells}, {10})

    def test_a_frame_is_read_back_as_a_mesh(self):
        self.convert("--body", "bar", "--frames", "3", out="one.pvd")
        self.pliant("convert", "one_frames/frame_00000.vtu", "again.ply")
        self.pliant("convert", "one_frames/frame_00000.vtu", "again.vtu")
        grid, again = vtu_reader.Grid(self.folder / "one_frames/frame_00000.vtu"), vtu_reader.Grid(self.folder / "again.vtu")
        numpy.testing.assert_array_equal(again.points, grid.points)
        self.assertEqual(again.cells, grid.cells)
        self.assertEqual(list(again.point_data), ["body", "stretch", "energy"])
        for name, values in again.point_data.items():
            numpy.testing.assert_array_equal(values, grid.point_data[name].astype(float))

    def test_a_point_cache_and_a_run_without_its_scene_have_what_the_frames_say(self):
        _, (grid, *_) = self.convert("--mesh", "run/mesh.obj", "--in-fps", 50, source="run/frames.npy", out="cache.pvd")
        self.assertEqual(list(grid.point_data), ["body", "velocity", "stretch"])
        self.assertEqual({kind for kind, _ in grid.cells}, {3, 5, 9})
        shutil.copytree(self.folder / "run", self.folder / "lost")
        (self.folder / "lost/checkpoint.pliant").write_bytes(b"none")
        warned = self.pliant("convert", "lost", "lost.pvd").stderr
        self.assertIn("warning: the scene is not known, so neither tetrahedra nor energies are written", warned)
        self.assertIn("give its mesh by --mesh", self.pliant("convert", "run/frames.npy", "a.pvd", expect=2).stderr)

    def test_names_are_escaped(self):
        name = "a & <b> \"c\" 'd' ä.pvd"
        times, _ = self.convert("--frames", "0:1", out=name)
        self.assertEqual(len(times), 2)

    def test_frames_are_replaced_together_or_not_at_all(self):
        self.convert(out="twice.pvd")
        self.convert("--frames", "0:2", out="twice.pvd")
        folder = self.folder / "twice_frames"
        (folder / "mine.txt").write_text("mine")
        before = (self.folder / "twice.pvd").read_bytes()
        self.assertIn("it holds other files, mine.txt for one", self.pliant("convert", "run", "twice.pvd", expect=4).stderr)
        self.assertEqual((self.folder / "twice.pvd").read_bytes(), before)
        self.assertEqual(len(list(folder.iterdir())), 4)
        (folder / "mine.txt").unlink()
        self.assertIn("would replace the input",
                      self.pliant("convert", "twice_frames/frame_00000.vtu", "twice.pvd", expect=2).stderr)
        done = subprocess.run([PLIANT, "convert", "frame_00000.vtu", "../twice.pvd"], cwd=folder, capture_output=True, text=True)
        self.assertIn("would replace the input", done.stderr)
        self.assertIn("files hold all frames", self.pliant("convert", "run", "a.pvd", "--tolerance", 0.1, expect=2).stderr)
        self.pliant("convert", "run", "none/a.pvd", expect=4)
        self.assertEqual([path.name for path in self.folder.iterdir() if ".tmp" in path.name], [])

    def test_vtk_reads_the_same(self):
        try:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        except ImportError:
            self.skipTest("no python3-vtk9")
        _, grids = self.convert(out="vtk.pvd")
        for frame in (0, 40):
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(self.folder / f"vtk_frames/frame_{frame:05}.vtu"))
            reader.Update()
            read = reader.GetOutput()
            numpy.testing.assert_array_equal(vtk_to_numpy(read.GetPoints().GetData()), self.frames[frame])
            self.assertEqual([read.GetCellType(i) for i in range(read.GetNumberOfCells())],
                             [kind for kind, _ in grids[frame].cells])
            for name, values in grids[frame].point_data.items():
                numpy.testing.assert_array_equal(vtk_to_numpy(read.GetPointData().GetArray(name)), values)


if __name__ == "__main__":
    unittest.main()
