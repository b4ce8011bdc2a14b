"""Point caches and sequences that `pliant convert` writes, read by code of the tests' own."""
import struct
import unittest

import numpy

from export_case import ExportCase


def read_pc2(path):
    data = path.read_bytes()
    magic, version, vertices, start, rate, frames = struct.unpack("<12siiffi", data[:32])
    assert (magic, version) == (b"POINTCACHE2\0", 1)
    return start, rate, numpy.frombuffer(data[32:], "<f4").reshape(frames, vertices, 3)


def read_mdd(path):
    data = path.read_bytes()
    frames, vertices = struct.unpack(">ii", data[:8])
    times = numpy.frombuffer(data, ">f4", frames, 8)
    return times, numpy.frombuffer(data[8 + 4 * frames:], ">f4").reshape(frames, vertices, 3)


def read_obj(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = numpy.array([line[1:] for line in lines if line and line[0] == "v"], float)
    return vertices, [line for line in lines if line and line[0] in "fl"]


class CacheExport(ExportCase):
    def convert(self, *arguments):
        self.pliant("convert", *arguments)
        return self.folder / arguments[1]

    def test_pc2_has_a_frame_for_each_of_the_run(self):
        start, rate, points = read_pc2(self.convert("run", "a.pc2"))
        self.assertEqual((start, rate), (0, 1))
        numpy.testing.assert_array_equal(points, self.frames.astype(numpy.float32))

    def test_pc2_at_another_rate(self):
        _, _, points = read_pc2(self.convert("run", "a.pc2", "--fps", 24))
        self.assertEqual(len(points), 20)
        for frame, found in enumerate(points):
            numpy.testing.assert_allclose(found, self.moment(frame / 24), atol=1e-6)

    def test_mdd_has_the_times(self):
        times, points = read_mdd(self.convert("run", "a.mdd", "--frames", "5::3"))
        numpy.testing.assert_allclose(times, 0.02 * 3 * numpy.arange(12), atol=1e-7)
        numpy.testing.assert_array_equal(points, self.frames[5::3].astype(numpy.float32))

    def test_npy_has_the_bits(self):
        numpy.testing.assert_array_equal(numpy.load(self.convert("run", "a.npy")), self.frames)

    def test_from_cache_to_cache_and_back(self):
        single = self.frames.astype(numpy.float32)
        self.convert("run", "a.mdd")
        self.convert("a.mdd", "b.pc2")
        self.convert("b.pc2", "c.npy", "--in-fps", 50)
        numpy.testing.assert_array_equal(numpy.load(self.folder / "c.npy"), single)
        numpy.save(self.folder / "d.npy", single)
        times, points = read_mdd(self.convert("d.npy", "e.mdd", "--in-fps", 10))
        numpy.testing.assert_allclose(times, 0.1 * numpy.arange(41), rtol=1e-6)
        numpy.testing.assert_array_equal(points, single)

    def test_a_cache_with_its_mesh(self):
        self.convert("run", "a.mdd")
        vertices, elements = read_obj(self.convert("a.mdd", "a.obj", "--mesh", "run/mesh.obj", "--time", 0.31))
        numpy.testing.assert_allclose(vertices, self.moment(0.31), atol=1e-6)
        self.assertEqual(elements, read_obj(self.folder / "run/mesh.obj")[1])

    def test_a_cache_in_another_unit_with_y_up(self):
        x, y, z = numpy.moveaxis(self.frames, 2, 0)
        numpy.save(self.folder / "y.npy", 1000 * numpy.stack([x, z, -y], axis=2))
        self.convert("y.npy", "z.npy", "--up", "y", "--scale", 0.001)
        numpy.testing.assert_allclose(numpy.load(self.folder / "z.npy"), self.frames, atol=1e-12)

    def test_sequences(self):
        for extension in ["obj", "ply", "off", "stl"]:
            pattern = f"{extension}/x_###_a.{extension}"
            (self.folder / extension).mkdir(exist_ok=True)
            done = self.pliant("convert", "run", pattern, "--frames", "0:40:10")
            self.assertIn("5 files", done.stdout)
            names = sorted(path.name for path in (self.folder / extension).iterdir())
            self.assertEqual(names, [f"x_00{i}_a.{extension}" for i in range(5)])
        for i in range(5):
            numpy.testing.assert_array_equal(read_obj(self.folder / f"obj/x_00{i}_a.obj")[0], self.frames[10 * i])

    def test_frames_of_every_format_of_a_run_convert_to_the_same(self):
        for kind in ["obj", "ply", "pc2"]:
            with self.subTest(kind):
                self.pliant("run", "scene.json", "--out", kind + "_run", "--format", kind, "--every", 4)
                found = numpy.load(self.convert(kind + "_run", kind + ".npy"))
                wanted = self.frames[::4]
                numpy.testing.assert_array_equal(found, wanted.astype(numpy.float32) if kind == "pc2" else wanted)
                times, _ = read_mdd(self.convert(kind + "_run", kind + ".mdd"))
                numpy.testing.assert_allclose(times, 0.08 * numpy.arange(11), atol=1e-6)


if __name__ == "__main__":
    unittest.main()
