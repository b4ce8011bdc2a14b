"""The command line program as its users meet it: exit codes, files, messages. $PLIANT is the program."""
import json
import os
import pathlib
import signal
import struct
import subprocess
import tempfile
import time
import unittest

from rope_scene import CHAIN

import numpy

PLIANT = os.environ["PLIANT"]


class Run(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"

    def write_scene(self, changes=None, name="scene.json"):
        path = self.folder / name
        path.write_text(json.dumps(CHAIN | (changes or {})))
        return path

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        if expect in (2, 3, 4):
            errors = [line for line in done.stderr.splitlines() if not line.startswith("warning: ")]
            self.assertEqual(len(errors), 1, done.stderr)
            self.assertTrue(errors[0].startswith("pliant: error: "), done.stderr)
        return done

    def run_info(self):
        return json.loads((self.out / "run.json").read_text())

    def rows(self):
        return len((self.out / "measurements.csv").read_text().splitlines()) - 1

    def test_a_run_leaves_its_files(self):
        done = self.pliant("run", self.write_scene(), "--out", self.out)
        self.assertIn("20 of 20 steps", done.stdout)
        self.assertEqual(done.stderr, "")
        frames = numpy.load(self.out / "frames.npy")
        self.assertEqual(frames.shape, (21, 10, 3))
        self.assertEqual(frames.dtype, numpy.float64)
        self.assertTrue(frames.flags["C_CONTIGUOUS"])
        numpy.testing.assert_array_equal(frames[:, 0], numpy.zeros((21, 3)))
        self.assertLess(frames[20, 9, 2], -0.3)
        self.assertEqual(self.rows(), 21)
        mesh = (self.out / "mesh.obj").read_text().splitlines()
        vertices = [[float(x) for x in line.split()[1:]] for line in mesh if line.startswith("v ")]
        numpy.testing.assert_array_equal(vertices, frames[0])
        info = self.run_info()
        self.assertEqual(info["outcome"], "ok")
        self.assertEqual(info["scene"], "scene")
        self.assertEqual(info["counts"], {"vertices": 10, "constraints": {"edge_spring": 9, "position": 1}})
        self.assertEqual(info["totals"]["steps"], 20)
        self.assertEqual(info["totals"]["frames"], 21)
        self.assertEqual(info["used"]["threads"], 1)
        self.assertEqual(info["warnings"], [])
        self.assertEqual([group["name"] for group in info["groups"]], ["hook", "links"])

    def test_options_take_the_place_of_the_scene_s_settings(self):
        done = self.pliant("run", self.write_scene(), "--out", self.out, "--steps", 7, "--iterations", 3, "--time-step",
                           0.01, "--threads", 2, "--every", 3, "--tolerance", 0.5, "--backend", "eigen", "--quiet")
        self.assertEqual(done.stdout, "")
        self.assertEqual(numpy.load(self.out / "frames.npy").shape, (3, 10, 3))
        info = self.run_info()
        settings = {"time_step": 0.01, "iterations": 3, "tolerance": 0.5, "threads": 2, "backend": "eigen"}
        self.assertEqual(info["settings"], info["settings"] | settings)
        files = ["frames.npy", "mesh.obj", "run.json", "measurements.csv", "checkpoint.pliant"]
        self.assertEqual(info["output"], {"format": "npy", "every": 3, "files": files})
        self.assertEqual(info["used"]["backend"], "eigen")

    def test_a_missed_tolerance_is_told_at_the_end(self):
        done = self.pliant("run", self.write_scene(), "--out", self.out, "--steps", 7, "--iterations", 1,
                           "--tolerance", 1e-9, "--quiet")
        self.assertIn("warning: settings.tolerance: missed in 7 steps", done.stderr)
        missed = self.run_info()["missed_tolerance"]
        self.assertEqual(missed["steps"], 7)
        self.assertGreater(missed["worst_residual"], 1e-9)
        done = self.pliant("run", self.write_scene(), "--out", self.out, "--steps", 7, "--tolerance", 1e6, "--quiet")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.run_info()["missed_tolerance"], {"steps": 0, "worst_residual": 0})

    def test_far_from_converged_is_told_with_what_helps(self):
        cloth = {"mesh": {"shape": "grid", "columns": 20, "rows": 20, "plane": "xy"}, "material": "denim",
                 "constraints": [{"type": "position", "on": [380, 399]}]}
        scene = {"pliant": 1, "steps": 40,
                 "settings": {"integrator": "implicit_euler", "acceleration": "none", "iterations": 2},
                 "bodies": [cloth]}
        path = self.folder / "cloth.json"
        path.write_text(json.dumps(scene))
        done = self.pliant("run", path, "--out", self.out, "--quiet")
        self.assertRegex(done.stderr, r"^warning: far from converged: 2 iterations leave 'body 0' .* mm from where a step "
                         r"ends, .*; give --set settings.acceleration=lbfgs\n$")
        worst = self.run_info()["worst_step"]
        self.assertIn(worst["step"], (30, 35))  # the better one
        self.assertEqual(worst["body"], "body 0")
        self.assertGreater(worst["share"], 0.5)
        done = self.pliant("run", path, "--out", self.out, "--quiet", "--set", "settings.acceleration=lbfgs",
                           "--iterations", "automatic")
        self.assertEqual(done.stderr, "")
        info = self.run_info()
        self.assertLess(info["worst_step"]["share"], 0.5)
        self.assertEqual(info["settings"]["iterations"], "automatic")

    def test_a_single_step_that_is_far_from_converged_is_not_told(self):
        cloth = {"mesh": {"shape": "grid", "columns": 20, "rows": 20, "plane": "xy"}, "material": "denim",
                 "constraints": [{"type": "position", "on": [380, 399]}]}
        scene = {"pliant": 1, "settings": {"iterations": 40}, "bodies": [cloth],
                 "events": [{"step": 29, "settings": {"iterations": 1}}, {"step": 31, "settings": {"iterations": 40}}]}
        path = self.folder / "cloth.json"
        path.write_text(json.dumps(scene))
        # Without a step five later, the one that there is counts.
        for steps, looked_at in ((33, 30), (35, 30), (36, 35)):
            done = self.pliant("run", path, "--out", self.out, "--quiet", "--steps", steps)
            worst = self.run_info()["worst_step"]
            self.assertEqual(worst["step"], looked_at)
            self.assertEqual(worst["share"] > 0.5, looked_at == 30, worst)
            self.assertEqual("far from converged" in done.stderr, looked_at == 30)
            text = self.pliant("check", path, "--set", f"steps={steps}").stdout
            self.assertEqual("far from converged" in text, looked_at == 30)
        # As it does where nothing can be said of the later one; its iterations are told, not those of the later one.
        scene["events"][1] = {"step": 31, "settings": {"iterations": 2000}}
        path.write_text(json.dumps(scene))
        done = self.pliant("run", path, "--out", self.out, "--quiet", "--steps", 36)
        self.assertEqual(self.run_info()["worst_step"]["step"], 30)
        text = self.pliant("check", path, "--set", "steps=36").stdout
        for told in (done.stderr, text):
            self.assertIn("far from converged: 1 iteration leaves", told)

    def test_two_runs_give_the_same_frames_and_replace_each_other(self):
        scene = self.write_scene()
        self.pliant("run", scene, "--out", self.out)
        first = (self.out / "frames.npy").read_bytes()
        self.pliant("run", scene, "--out", self.out, "--threads", 3)
        self.assertEqual((self.out / "frames.npy").read_bytes(), first)
        self.pliant("run", scene, "--out", self.out, "--format", "obj", "--steps", 2)
        names = sorted(path.name for path in self.out.iterdir())
        frames = [f"frame_0000{i}.obj" for i in range(3)]
        self.assertEqual(names, ["checkpoint.pliant", *frames, "measurements.csv", "mesh.obj", "run.json"])
        self.pliant("run", scene, "--out", self.out, "--format", "none")
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["checkpoint.pliant", "measurements.csv", "run.json"])

    def test_built_in_scenes(self):
        listing = self.pliant("scenes").stdout
        names = [line.split()[0] for line in listing.splitlines()]
        self.assertLessEqual({"curtain", "curtain_wind", "flag", "torus", "sheet_metal_and_cloth", "chain", "bar"},
                             set(names))
        self.pliant("run", "chain", "--steps", 3)
        self.out = self.folder / "out" / "chain"  # where runs go that do not say where
        self.assertEqual(self.run_info()["scene"], "chain")
        error = self.pliant("run", "curtan", expect=2).stderr
        self.assertIn("did you mean 'curtain'?", error)
        self.assertIn("pliant scenes", self.pliant("run", "xylophone", expect=2).stderr)

    def test_help_and_version(self):
        self.assertRegex(self.pliant("--version").stdout, r"^pliant \d+\.\d+\.\d+(-dev)? \(")
        self.assertIn("Example", self.pliant("run", "--help").stdout)

    def test_slips_of_the_command_line_exit_with_2(self):
        scene = self.write_scene()
        for arguments in [[], ["run"], ["walk"], ["run", scene, "--step", 3], ["run", scene, "--steps", "3x"],
                          ["run", scene, "--steps", -1], ["run", scene, "--format", "png"],
                          ["run", scene, "--iterations", 0], ["run", scene, "--time-step", "nan"],
                          ["run", scene, "--every", 0], ["run", scene, "--threads", -1],
                          ["run", self.folder / "none.json"], ["run", self.folder]]:
            with self.subTest(arguments=arguments):
                self.pliant(*arguments, expect=2)
        self.assertFalse((self.folder / "out").exists())

    def test_a_slip_in_the_scene_leaves_no_output(self):
        scene = self.write_scene({"stepz": 3})
        error = self.pliant("run", scene, "--out", self.out, expect=2).stderr
        self.assertIn("scene.json: stepz: unknown key", error)
        self.assertFalse(self.out.exists())

    def test_a_folder_with_files_of_one_s_own_is_refused(self):
        scene = self.write_scene()
        (self.folder / "mesh.obj").write_text("v 0 0 0\n")
        error = self.pliant("run", scene, "--out", self.folder, expect=4).stderr
        self.assertIn("the run would replace its mesh.obj", error)
        self.assertEqual((self.folder / "mesh.obj").read_text(), "v 0 0 0\n")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["mesh.obj", "scene.json"])

    def test_names_do_not_reach_the_terminal_as_they_are(self):
        scene = self.write_scene({"name": "a\u001b[2J\nb\u009bc\u00e9"})
        done = self.pliant("run", scene, "--out", self.out, "--steps", 1)
        self.assertIn("a [2J b c\u00e9: 1 of 1 steps", done.stdout)

    def test_a_point_cache_in_place_of_the_array(self):
        self.pliant("run", self.write_scene(), "--out", self.out)
        frames = numpy.load(self.out / "frames.npy")
        self.pliant("run", self.write_scene(), "--out", self.out, "--format", "pc2")
        self.assertEqual(sorted(path.name for path in self.out.iterdir()),
                         ["checkpoint.pliant", "frames.pc2", "measurements.csv", "mesh.obj", "run.json"])
        data = (self.out / "frames.pc2").read_bytes()
        self.assertEqual(struct.unpack("<12siiffi", data[:32]), (b"POINTCACHE2\0", 1, 10, 0.0, 1.0, 21))
        points = numpy.frombuffer(data[32:], dtype="<f4").reshape(21, 10, 3)
        numpy.testing.assert_array_equal(points, frames.astype(numpy.float32))

    def test_divergence_exits_with_3_and_leaves_what_came_before(self):
        # An explicit spring far beyond its limit: each step multiplies the displacement by about 1e17.
        scene = self.write_scene({"forces": [{"type": "mouse_spring", "vertex": 5, "anchor": [0, 0, 1],
                                              "stiffness": 1e20}], "settings": {"time_step": 100}})
        error = self.pliant("run", scene, "--out", self.out, expect=3).stderr
        self.assertRegex(error, r"vertex \d+")
        frames = numpy.load(self.out / "frames.npy")
        info = self.run_info()
        self.assertEqual(info["outcome"], "diverged")
        self.assertIn(info["error"], error)
        self.assertEqual(len(frames), info["totals"]["frames"])
        self.assertEqual(len(frames), self.rows())
        self.assertGreater(len(frames), 3)
        self.assertTrue(numpy.isfinite(frames).all())

    def test_output_that_cannot_be_written_exits_with_4(self):
        scene = self.write_scene()
        self.pliant("run", scene, "--out", scene, expect=4)
        self.pliant("run", scene, "--out", "/proc/pliant", expect=4)
        for name, words in [("frames.npy", ["--set", "bodies[0].mesh.links=60"]),
                            ("measurements.csv", ["--format", "none"])]:
            done = subprocess.run(["prlimit", "--fsize=10000", "--", PLIANT, "run", scene, "--out", self.out, "--steps",
                                   "200", *words], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(f"{name}: cannot be written: File too large", done.stderr)
            self.assertEqual(self.run_info()["outcome"], "failed")
            self.assertIn("File too large", self.run_info()["error"])
        with open("/dev/full", "w") as full:
            self.assertEqual(subprocess.run([PLIANT, "scenes"], stdout=full, stderr=subprocess.DEVNULL).returncode, 4)

    def start_endless_run(self, *arguments):
        """Starts a run that would never end, and waits for its first ten frames."""
        process = subprocess.Popen([PLIANT, "run", self.write_scene(), "--out", self.out, "--steps", "100000000",
                                    *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        path = self.out / "frames.npy"
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (path.exists() and path.stat().st_size >= 128 + 10 * 240):
            time.sleep(0.01)
        return process

    def test_an_interrupt_leaves_whole_files(self):
        for sent in [signal.SIGINT, signal.SIGTERM]:
            self.out = self.folder / sent.name
            process = self.start_endless_run("--every", "7")
            process.send_signal(sent)
            self.assertEqual(process.wait(timeout=60), 130)
            frames = numpy.load(self.out / "frames.npy")
            info = self.run_info()
            self.assertEqual(info["outcome"], "interrupted")
            self.assertEqual(len(frames), info["totals"]["frames"])
            self.assertEqual((self.out / "frames.npy").stat().st_size, 128 + 240 * len(frames))
            self.assertEqual(self.rows(), len(frames))
            self.assertEqual(info["totals"]["steps"] // 7 + 1, len(frames))

    def test_a_killed_run_leaves_whole_frames(self):
        process = self.start_endless_run()
        process.kill()
        process.wait()
        frames = numpy.load(self.out / "frames.npy")
        self.assertGreaterEqual(len(frames), 9)
        self.assertTrue(numpy.isfinite(frames).all())
        self.assertEqual(self.run_info()["outcome"], "running")
        self.pliant("run", self.write_scene(), "--out", self.out)  # its files are known to be a run's
        self.assertEqual(self.run_info()["outcome"], "ok")


if __name__ == "__main__":
    unittest.main()
