"""pliant convert as its users meet it: what it refuses, and with which words; and what assimp makes of its files."""
import json
import os
import shutil
import subprocess
import unittest

import numpy

from export_case import PATCH, PLIANT, ExportCase


# OpenGL's drivers keep memory to the end of the program.
DRAWING = os.environ | {"ASAN_OPTIONS": "detect_leaks=0"}


class Convert(ExportCase):
    def error(self, *arguments, code=2):
        return self.pliant("convert", *arguments, expect=code).stderr

    def copy_of_run(self, name):
        shutil.copytree(self.folder / "run", self.folder / name)
        return self.folder / name

    def vertices(self, name):
        lines = (self.folder / name).read_text().splitlines()
        return numpy.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)

    def test_mesh_to_mesh_in_another_unit_with_another_axis_up(self):
        patch = self.vertices("patch.obj")
        self.pliant("convert", "patch.obj", "a.obj", "--scale", 0.001)
        numpy.testing.assert_allclose(self.vertices("a.obj"), patch / 1000, rtol=1e-15)
        self.pliant("convert", "patch.obj", "a.obj", "--up", "y")
        x, y, z = patch.T
        numpy.testing.assert_array_equal(self.vertices("a.obj"), numpy.stack([x, -z, y], axis=1))
        self.pliant("convert", "patch.obj", "A.PLY")
        self.pliant("convert", "A.PLY", "b.off")
        self.pliant("convert", "b.off", "c.obj")
        numpy.testing.assert_array_equal(self.vertices("c.obj"), patch)
        self.pliant("convert", "c.obj", "d.stl")
        self.pliant("convert", "d.stl", "e.obj")
        self.assertEqual(len(self.vertices("e.obj")), 7)  # merged again
        self.assertIn("--up", self.error("patch.obj", "a.obj", "--up", "w"))
        for scale in ["0", "-1", "nan", "1e999", "x"]:
            self.error("patch.obj", "a.obj", "--scale", scale)
        self.assertIn("leave out", self.error("run", "a.glb", "--scale", 2))

    def test_names_that_say_nothing(self):
        for arguments in [["run", "a.fbx"], ["run", "a"], ["patch.obj", "b.png"]]:
            with self.subTest(arguments=arguments):
                self.assertIn("meshes: obj, ply, off, stl, msh, mesh, vtu; animations: gltf, glb, usda, pvd, pc2, mdd, npy",
                              self.error(*arguments))
        self.assertIn("a point cache (.pc2, .mdd, .npy) nor a mesh (.obj, .ply, .off, .stl, .msh, .mesh, .vtu, .vtk, "
                      ".node, .ele)",
                      self.error("scene.json", "a.glb"))
        self.assertIn("no such file", self.error("none.obj", "a.glb"))
        self.assertIn("no run.json", self.error(self.folder, "a.glb"))
        (self.folder / "many").mkdir()
        (self.folder / "many/run.json").write_text("[" + "{}," * 1000000 + "{}]")
        self.assertIn("run.json: holds more values than a run writes", self.error("many", "a.glb"))
        self.pliant("convert", expect=2)
        self.pliant("convert", "run", expect=2)

    def test_the_input_is_never_replaced(self):
        (self.folder / "link.obj").symlink_to("patch.obj")
        shutil.copy(self.folder / "run/frames.npy", self.folder / "own.npy")
        for arguments in [["patch.obj", "patch.obj"], ["patch.obj", "./link.obj"], ["own.npy", "own.npy"],
                          ["own.npy", "run/mesh.obj", "--mesh", "run/mesh.obj", "--time", 0],
                          ["run", "run/frames.npy"], ["run", "run/mesh.obj", "--time", 0]]:
            with self.subTest(arguments=arguments):
                self.assertIn("this would replace the input", self.error(*arguments))
        self.assertEqual((self.folder / "patch.obj").read_text(), PATCH)
        run = self.folder / "frames_run"
        self.pliant("run", "scene.json", "--out", run, "--format", "obj", "--steps", 3)
        before = (run / "frame_00001.obj").read_bytes()
        self.assertIn("this would replace the input", self.error(run, run / "frame_#####.obj", "--frames", 1))
        shutil.copy(self.folder / "patch.obj", self.folder / "patch_00.obj")
        self.assertIn("this would replace the input", self.error("patch_00.obj", "patch_##.obj"))
        self.assertEqual((run / "frame_00001.obj").read_bytes(), before)

    def test_what_does_not_go_together(self):
        self.assertIn("--mesh", self.error("run/frames.npy", "a.glb"))
        self.assertIn("leave out --mesh", self.error("run", "a.glb", "--mesh", "patch.obj"))
        self.assertIn("not a point cache", self.error("patch.obj", "a.glb", "--mesh", "patch.obj"))
        self.assertIn("the mesh has 7 vertices, but the cache", self.error("run/frames.npy", "a.glb", "--mesh", "patch.obj"))
        self.assertIn("leave it out", self.error("run", "a.pc2", "--tolerance", 0.1))
        self.assertIn("41 frames do not fit a file of one", self.error("run", "a.obj"))
        self.assertIn("one run of #", self.error("run", "a_##_##.obj"))
        error = self.error("run", "a.glb", "--body", "rop")
        self.assertIn("rop: no body of this name", error)
        self.assertIn("patch, 1 sheet/ä, bar, rope, still", error)

    def answer(self, text, *arguments):
        """On a terminal, where that is typed."""
        ours, theirs = os.openpty()
        with subprocess.Popen([PLIANT, "convert", *arguments], cwd=self.folder, stdin=theirs, stderr=theirs,
                              stdout=subprocess.PIPE) as program:
            os.close(theirs)
            os.write(ours, text.encode())
            code = program.wait(timeout=60)
        os.close(ours)
        return code

    def test_frames_are_left_out_when_the_user_says_so(self):
        run = ["run/frames.npy", "thin.glb", "--mesh", "run/mesh.obj"]
        error = self.error(*run)
        self.assertRegex(error, r"thin.glb: \d+ of 41 frames would be kept, the others off by at most [\d.e-]+ of the body's "
                                r"size; agree with --yes, or choose --tolerance or --max-keyframes "
                                r"\('--tolerance 0 --max-keyframes 41' keeps all\)")
        self.assertEqual(self.answer("n\n", *run), 2)
        self.assertEqual(self.answer("\n", *run), 2)
        self.assertFalse((self.folder / "thin.glb").exists())
        self.assertEqual(self.answer("y\n", *run), 0)
        asked = (self.folder / "thin.glb").read_bytes()
        for options in [["--yes"], ["--tolerance", 0.001], ["--max-keyframes", 256]]:
            (self.folder / "thin.glb").unlink()
            self.pliant("convert", *run, *options)
            self.assertEqual((self.folder / "thin.glb").read_bytes(), asked)
        self.pliant("convert", "run", "still.glb", "--body", "still", "--frames", "0:1")  # nothing is lost: 2 of 2

    def test_frames_and_times_out_of_range(self):
        for frames in ["41", "-42", "0:41", "3:2", "0:40:0", "0:40:-1", "1:2:3:4", "x", "", "1.5", "99999999999999999999"]:
            with self.subTest(frames=frames):
                self.error("run", "a.npy", f"--frames={frames}")
        for option in ["--time=-0.1", "--time=0.81", "--time=nan", "--fps=0", "--fps=-3", "--fps=inf", "--fps=1e12",
                       "--tolerance=-1", "--tolerance=nan", "--max-keyframes=1", "--in-fps=0"]:
            with self.subTest(option=option):
                source = ["run/frames.npy", "a.glb", "--mesh", "run/mesh.obj"] if "in-fps" in option else ["run", "a.glb"]
                self.error(*source, option)
        self.assertFalse((self.folder / "a.glb").exists())
        for frames, count in [("-1", 1), ("0", 1), (":", 41), ("::40", 2), ("-3:-1", 3), ("40:", 1), ("::99999999999", 1)]:
            self.pliant("convert", "run", "part.npy", f"--frames={frames}")
            self.assertEqual(len(numpy.load(self.folder / "part.npy")), count)
        numpy.testing.assert_array_equal(numpy.load(self.folder / "part.npy")[0], self.frames[0])

    def test_output_that_cannot_be_written(self):
        for out in ["none/a.glb", "/proc/a.usda", "/dev/full"]:
            self.error("run", out, code=2 if out == "/dev/full" else 4)
        (self.folder / "full.mdd").symlink_to("/dev/full")
        self.error("run", "full.mdd", code=4)
        left = {path.name for path in self.folder.iterdir() if ".tmp" in path.name}
        self.assertEqual(left, set())

    def test_frames_that_do_not_fit_run_json(self):
        for form in ("npy", "pc2", "obj", "ply"):
            self.pliant("run", "scene.json", "--out", "fits", "--format", form)
            self.pliant("convert", "fits", "fits.npy")
            other = self.folder / "other"
            for words, expected in [(["--iterations", 3], "its last frame is another than the one that run.json knows"),
                                    (["--steps", 30], "it holds 31 frames, and run.json says 41")]:
                with self.subTest(form, words=words):
                    self.pliant("run", "scene.json", "--out", other, "--format", form, *words)
                    if form in ("obj", "ply") and "--steps" in words:
                        expected = f"frame_00031.{form}: no such file"
                    shutil.copytree(self.folder / "fits", self.folder / "mixed", dirs_exist_ok=True)
                    for path in (self.folder / "mixed").glob("frame*"):
                        path.unlink()
                    for path in other.glob("frame*"):
                        shutil.copy(path, self.folder / "mixed")
                    for command, environment in ((["convert", "mixed", "a.glb"], None),
                                                 (["render", "mixed", "--out", "a.png"], DRAWING)):
                        done = subprocess.run([PLIANT, *command], cwd=self.folder, env=environment,
                                              capture_output=True, text=True)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertIn(expected, done.stderr)
                        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.pliant("resume", "fits", "--steps", 42)
            self.pliant("convert", "fits", "fits.npy")
        # Other vertices, in the frames and in the mesh.
        scene = json.loads((self.folder / "scene.json").read_text())
        (self.folder / "one.json").write_text(json.dumps(scene | {"bodies": scene["bodies"][:1], "forces": []}))
        self.pliant("run", "one.json", "--out", "one")
        shutil.copytree(self.folder / "run", self.folder / "mixed", dirs_exist_ok=True)
        for name in ("frames.npy", "mesh.obj"):
            shutil.copy(self.folder / "one" / name, self.folder / "mixed")
        self.assertIn("its frames have ", self.error("mixed", "a.glb"))

    def test_runs_that_were_cut_off_or_damaged(self):
        info = json.loads((self.folder / "run/run.json").read_text())

        # Killed while frame 12 was being recorded, its row still missing.
        run = self.copy_of_run("killed")
        (run / "run.json").write_text(json.dumps(info | {"outcome": "running", "totals": {"frames": 0}}))
        lines = (run / "measurements.csv").read_text().splitlines(keepends=True)
        (run / "measurements.csv").write_text("".join(lines[:13]) + lines[13][:7])
        data = (run / "frames.npy").read_bytes()
        head = data[:128].replace(b"(41, ", b"(13, ")
        (run / "frames.npy").write_bytes(head + data[128:128 + 14 * self.frames[0].nbytes - 5])
        self.pliant("convert", run, "killed.npy")
        numpy.testing.assert_array_equal(numpy.load(self.folder / "killed.npy"), self.frames[:12])

        def damaged(name, text, expected):
            shutil.rmtree(self.folder / "damaged", ignore_errors=True)
            run = self.copy_of_run("damaged")
            (run / name).write_text(text)
            error = self.error(run, "a.glb")
            self.assertIn(name, error)
            self.assertIn(expected, error)

        damaged("run.json", "{", "not JSON")
        damaged("run.json", "[]", "is not an object")
        damaged("run.json", json.dumps(info | {"bodies": []}), "and run.json says 0")
        damaged("run.json", json.dumps(info | {"bodies": info["bodies"][1:]}), "bodies[0]")
        damaged("run.json", json.dumps(info | {"bodies": [info["bodies"][0] | {"vertices": -1}]}), "bodies[0]: vertices")
        damaged("run.json", json.dumps(info | {"settings": {"time_step": 0}}), "time_step")
        damaged("measurements.csv", "", "measurements.csv:1")
        damaged("measurements.csv", "step,time,x\n0,0,\n1,nan,\n", "measurements.csv:3")
        damaged("measurements.csv", "step,time,x\n0,0,\n1,0,\n", "measurements.csv:3")
        damaged("measurements.csv", "step,time,x\n0,0,\n", "1 rows for 41 frames")
        damaged("mesh.obj", PATCH, "has 7 vertices")
        mesh = (self.folder / "run/mesh.obj").read_text()
        damaged("mesh.obj", mesh + "l 1 20\n", "vertex 1 to vertex 20, which are of two bodies")
        damaged("frames.npy", "x", "frames.npy")
        run = self.copy_of_run("nothing")
        (run / "mesh.obj").unlink()
        self.assertIn("mesh.obj: no such file", self.error(run, "a.glb"))
        self.pliant("run", "scene.json", "--out", "none_run", "--format", "none", "--steps", 1)
        self.assertIn("no frames", self.error("none_run", "a.glb"))

    def test_steps_of_changing_length(self):
        run = self.copy_of_run("uneven")
        lines = (run / "measurements.csv").read_text().splitlines()
        times = 0.02 * numpy.arange(41) ** 1.5
        rows = [",".join([str(i), repr(float(time)), *line.split(",")[2:]])
                for i, (time, line) in enumerate(zip(times, lines[1:]))]
        (run / "measurements.csv").write_text("\n".join([lines[0], *rows]) + "\n")
        self.assertIn("not evenly spaced", self.error(run, "a.pc2"))
        self.pliant("convert", run, "a.pc2", "--fps", 10)
        self.assertIn("not evenly spaced", self.pliant("convert", run, "a.mdd").stdout)
        found = numpy.frombuffer((self.folder / "a.mdd").read_bytes(), ">f4", 41, 8)
        numpy.testing.assert_allclose(found, times, rtol=1e-6)

    def test_names_do_not_reach_the_terminal_as_they_are(self):
        name = "a\x1b[2J.npy"
        self.assertIn("a [2J.npy", self.pliant("convert", "run", name).stdout)
        self.assertNotIn("\x1b", self.error("\x1b[2J.obj", "a.glb"))


@unittest.skipUnless(shutil.which("assimp"), "assimp is missing; scripts/setup.sh installs it")
class Assimp(ExportCase):
    def info(self, name):
        done = subprocess.run(["assimp", "info", name], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        counts = {}
        for line in done.stdout.splitlines():
            key, colon, value = line.partition(":")
            if colon and value.split() and value.split()[0].isdigit():
                counts[key.strip()] = int(value.split()[0])
        return counts

    def test_animations_open(self):
        for name in ["a.glb", "a.gltf"]:
            self.pliant("convert", "run", name)
            counts = self.info(name)
            self.assertEqual(counts["Meshes"], 5)
            self.assertEqual(counts["Animations"], 1)
            # 5 of the patch, 48 of the sheet, 28 of the bar, 9 of the rope, 4 of what stands still
            self.assertEqual(counts["Faces"], 5 + 48 + 28 + 9 + 4)

    def test_meshes_open(self):
        for extension in ["obj", "ply", "off", "stl"]:
            with self.subTest(extension):
                name = f"m.{extension}"
                self.pliant("convert", "patch.obj", name)
                self.assertEqual(self.info(name)["Faces"], 5)  # which it cuts into triangles


if __name__ == "__main__":
    assert os.path.exists(PLIANT)
    unittest.main()
