"""Runs that are stopped, killed and taken up again, as their users meet them. $PLIANT is the program."""
import csv
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest

import numpy

PLIANT = os.environ["PLIANT"]

SCENE = {
    "pliant": 1,
    "steps": 120,
    "settings": {"threads": 1, "iterations": 4},
    "bodies": [{
        "name": "rope",
        "mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]},
        "mass": {"per_vertex": 0.1},
        "constraints": [
            {"type": "position", "name": "hook", "on": [0]},
            {"type": "edge_spring", "name": "links", "stiffness": 1000},
        ],
    }],
    "events": [
        {"step": 10, "move": "hook", "offset": [0, 0.3, 0], "over": 1},
        {"step": 40, "add": {"type": "drag", "name": "hand", "stencils": [[9]], "stiffness": 20}},
        {"step": 70, "remove": "hand"},
    ],
}
TIMES = ("ms_local", "ms_global", "ms_total")


class Resume(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.scene = self.folder / "scene.json"
        self.scene.write_text(json.dumps(SCENE))

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def run_whole(self, *options):
        self.pliant("run", self.scene, "--out", "whole", *options)
        return self.folder / "whole"

    def rows(self, folder):
        with open(folder / "measurements.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        for row in rows:
            for name in TIMES:
                del row[name]
        return rows

    def assert_same(self, folder, whole, frames="frames.npy"):
        names = {path.name for path in whole.iterdir()}
        self.assertEqual({path.name for path in folder.iterdir()}, names)
        for name in names - {"run.json", "measurements.csv"}:
            self.assertEqual((folder / name).read_bytes(), (whole / name).read_bytes(), name)
        self.assertEqual(self.rows(folder), self.rows(whole))

    def test_more_steps_for_a_run_that_ended(self):
        for form in ["npy", "pc2", "obj", "ply", "none"]:
            with self.subTest(form=form):
                whole = self.run_whole("--format", form, "--every", "3")
                out = self.folder / "part"
                self.pliant("run", self.scene, "--out", out, "--format", form, "--every", "3", "--steps", 50)
                done = self.pliant("resume", out, "--steps", 120)
                self.assertIn("120 of 120 steps, from step 50 on", done.stdout)
                # The texts of the two checkpoints differ in --steps alone.
                (out / "checkpoint.pliant").write_bytes((whole / "checkpoint.pliant").read_bytes())
                self.assert_same(out, whole)
                info = json.loads((out / "run.json").read_text())
                self.assertEqual((info["outcome"], info["resumed_from"], info["steps"]), ("ok", 50, 120))
                shutil.rmtree(out)

    def test_an_interrupted_run_goes_on(self):
        scene = SCENE | {"steps": 100000000}
        self.scene.write_text(json.dumps(scene))
        for sent in [signal.SIGINT, signal.SIGTERM]:
            out = self.folder / sent.name
            process = subprocess.Popen([PLIANT, "run", self.scene, "--out", out], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            self.wait_for_frames(out, 90)
            process.send_signal(sent)
            _, errors = process.communicate(timeout=60)
            self.assertEqual((process.returncode, errors), (130, ""))
            steps = json.loads((out / "run.json").read_text())["totals"]["steps"]
            self.pliant("resume", out, "--steps", steps + 20)
            whole = self.run_whole("--steps", str(steps + 20))
            self.assertEqual((out / "frames.npy").read_bytes(), (whole / "frames.npy").read_bytes())
            self.assertEqual(self.rows(out), self.rows(whole))

    def wait_for_frames(self, out, count):
        path = out / "frames.npy"
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (path.exists() and path.stat().st_size >= 128 + count * 240):
            time.sleep(0.005)

    def test_killed_at_random_moments_every_frame_is_whole_and_the_run_goes_on(self):
        chance = random.Random(7)
        self.scene.write_text(json.dumps(SCENE | {"steps": 100000000}))
        longest = self.folder / "longest"
        taken = 0
        for attempt in range(50):
            form = ["npy", "pc2", "obj", "ply"][attempt % 4]
            out = self.folder / f"run{attempt}"
            process = subprocess.Popen([PLIANT, "run", self.scene, "--out", out, "--checkpoint", "7", "--format", form],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            if attempt == 48:  # once far into the run, however slow the machine is
                self.wait_for_frames(out, 20)
            time.sleep(chance.uniform(0.005, 0.12))
            process.kill()
            process.wait()
            if not (out / "run.json").exists():
                continue
            self.assert_whole(out, form)
            if (out / "checkpoint.pliant").exists() and form == "npy":
                self.pliant("resume", out, "--steps", self.last_step(out) + 8)
                frames = numpy.load(out / "frames.npy")
                if len(frames) > taken:
                    taken = len(frames)
                    shutil.copytree(out, longest, dirs_exist_ok=True)
            shutil.rmtree(out)
        self.assertGreater(taken, 8)
        whole = self.run_whole("--steps", str(taken - 1))
        numpy.testing.assert_array_equal(numpy.load(longest / "frames.npy"), numpy.load(whole / "frames.npy"))

    def last_step(self, out):
        return len(numpy.load(out / "frames.npy")) - 1

    def assert_whole(self, out, form):
        json.loads((out / "run.json").read_text())
        if form == "npy" and (out / "frames.npy").exists() and (out / "frames.npy").stat().st_size > 0:
            self.assertTrue(numpy.isfinite(numpy.load(out / "frames.npy")).all())
        if form == "pc2" and (out / "frames.pc2").exists() and (out / "frames.pc2").stat().st_size > 0:
            data = (out / "frames.pc2").read_bytes()
            vertices, count = struct.unpack_from("<i8xi", data, 16)
            self.assertEqual(vertices, 10)
            self.assertGreaterEqual(len(data), 32 + count * vertices * 12)
            positions = numpy.frombuffer(data, "<f4", count * vertices * 3, 32)
            self.assertTrue(numpy.isfinite(positions).all())
        for path in out.glob("frame_*.obj"):
            lines = path.read_text().splitlines()
            self.assertEqual(sum(line.startswith("v ") for line in lines), 10, path.name)
            self.assertEqual(sum(line.startswith("l ") for line in lines), 9, path.name)
        for path in out.glob("frame_*.ply"):
            done = self.pliant("info", path, "--json")
            self.assertEqual(json.loads(done.stdout)["vertices"], 10, path.name)

    def test_a_run_goes_on_from_any_folder(self):
        body = SCENE["bodies"][0] | {"mesh": {"file": "rope.obj"}}
        (self.folder / "rope.obj").write_text("".join(f"v {i} 0 0\n" for i in range(10)) +
                                              "".join(f"l {i} {i + 1}\n" for i in range(1, 10)))
        self.scene.write_text(json.dumps(SCENE | {"bodies": [body]}))
        self.pliant("run", "scene.json", "--out", "out", "--steps", 20)
        self.pliant("run", "scene.json", "--out", "whole")
        process = subprocess.run([PLIANT, "resume", self.folder / "out", "--steps", "120"], cwd="/",
                                 capture_output=True, text=True, timeout=60)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual((self.folder / "out" / "frames.npy").read_bytes(),
                         (self.folder / "whole" / "frames.npy").read_bytes())

    def test_a_run_is_moved_together_with_its_files(self):
        home = self.folder / "home"
        (home / "meshes").mkdir(parents=True)
        rope = "".join(f"v {i} 0 0\n" for i in range(10)) + "".join(f"l {i} {i + 1}\n" for i in range(1, 10))
        (home / "meshes" / "rope.obj").write_text(rope)
        bodies = [SCENE["bodies"][0] | {"mesh": {"file": "meshes/rope.obj"}}]
        (home / "scene.json").write_text(json.dumps(SCENE | {"bodies": bodies}))
        self.pliant("run", "home/scene.json", "--out", "home/out/a", "--steps", 20)
        self.pliant("run", "home/scene.json", "--out", "whole")
        whole = (self.folder / "whole" / "frames.npy").read_bytes()
        for place, steps in [("second", 50), ("far/third", 120)]:  # what was moved and taken up may be moved again
            new = self.folder / place
            new.parent.mkdir(exist_ok=True)
            home.rename(new)
            home = new
            self.pliant("resume", home / "out" / "a", "--steps", steps)
        self.assertEqual((home / "out" / "a" / "frames.npy").read_bytes(), whole)
        # The run alone, without its mesh; then with another mesh.
        alone = self.folder / "alone" / "out" / "a"
        shutil.copytree(home / "out" / "a", alone)
        shutil.copytree(home / "out" / "a", self.folder / "copy")
        self.pliant("resume", "copy", "--steps", 121)  # the mesh is where it was
        home.rename(self.folder / "gone")
        error = self.pliant("resume", alone, "--steps", 122, expect=2).stderr
        self.assertIn("far/third/meshes/rope.obj: no such file, nor, since this run was moved, ", error)
        self.assertIn("alone/meshes/rope.obj as it was; put the file in one of these places", error)
        self.assertEqual(error.count("\n"), 1)
        (self.folder / "alone" / "meshes").mkdir()
        (self.folder / "alone" / "meshes" / "rope.obj").write_text(rope.replace("v 5 0 0", "v 5 1 0"))
        self.assertIn("put the file in one of", self.pliant("resume", alone, "--steps", 122, expect=2).stderr)
        (self.folder / "alone" / "meshes" / "rope.obj").write_text(rope)
        self.pliant("resume", alone, "--steps", 122)

    def test_a_moved_run_takes_no_file_of_another_place(self):
        """One mesh by a relative path, which was moved, one by an absolute path, which was not."""
        home = self.folder / "home"
        home.mkdir()
        rope = "".join(f"v {i} 0 0\n" for i in range(10)) + "".join(f"l {i} {i + 1}\n" for i in range(1, 10))
        for path in (home / "a.obj", self.folder / "b.obj"):
            path.write_text(rope)
        body = SCENE["bodies"][0] | {"constraints": [{"type": "edge_spring", "stiffness": 1000}]}
        bodies = [body | {"name": name, "mesh": {"file": file}}
                  for name, file in [("a", "a.obj"), ("b", str(self.folder / "b.obj"))]]
        (home / "scene.json").write_text(json.dumps({"pliant": 1, "steps": 9, "bodies": bodies}))
        self.pliant("run", "home/scene.json", "--out", "home/out")
        home.rename(self.folder / "new")
        self.pliant("resume", "new/out", "--steps", 12)
        (self.folder / "b.obj").unlink()
        error = self.pliant("resume", "new/out", "--steps", 13, expect=2).stderr
        self.assertIn("b.obj: no such file", error)

    def test_what_cannot_go_on_says_why(self):
        error = self.pliant("resume", self.folder, expect=2).stderr
        self.assertIn("checkpoint.pliant: no such file", error)
        out = self.run_whole()
        error = self.pliant("resume", out, "--steps", 5, expect=2).stderr
        self.assertIn("5 steps in all were asked for, but 120 have been taken", error)
        (out / "frames.npy").write_bytes(b"mine")
        error = self.pliant("resume", out, "--steps", 130, expect=2).stderr
        self.assertIn("frames.npy: not 121 frames of 10 vertices", error)
        self.assertEqual((out / "frames.npy").read_bytes(), b"mine")
        (out / "checkpoint.pliant").write_bytes((out / "checkpoint.pliant").read_bytes()[:-1])
        error = self.pliant("resume", out, "--steps", 130, expect=2).stderr
        self.assertIn("checkpoint.pliant: this checkpoint is cut off", error)

    def test_a_refused_resume_leaves_the_run_as_it_was(self):
        whole = self.run_whole("--format", "obj", "--steps", 6)
        before = (whole / "run.json").read_bytes()
        (whole / "frame_00003.obj").rename(self.folder / "kept.obj")
        error = self.pliant("resume", whole, "--steps", 9, expect=2).stderr
        self.assertIn("frame_00003.obj: no such file", error)
        self.assertEqual((whole / "run.json").read_bytes(), before)
        (self.folder / "kept.obj").rename(whole / "frame_00003.obj")
        self.pliant("resume", whole, "--steps", 9)

    def test_a_run_that_fails_leaves_its_last_step_to_be_taken_up(self):
        body = {"mesh": {"shape": "chain", "links": 2}, "mass": {"per_vertex": 1e-9},
                "constraints": [{"type": "edge_spring"}]}
        force = {"type": "test_force", "vertex": 0, "force": [1e100, 0, 0], "frames": [4, 9]}
        self.scene.write_text(json.dumps({"pliant": 1, "steps": 9, "bodies": [body], "forces": [force]}))
        error = self.pliant("run", self.scene, "--out", "out", expect=3).stderr
        self.assertIn("vertex 0", error)
        error = self.pliant("resume", "out", expect=3).stderr
        self.assertIn("vertex 0", error)
        frames = numpy.load(self.folder / "out" / "frames.npy")
        self.assertEqual(len(frames), json.loads((self.folder / "out" / "run.json").read_text())["totals"]["frames"])

    def endless_step(self):
        """A run inside its first step, which takes a thousand million iterations."""
        scene = SCENE | {"settings": {"threads": 1, "iterations": 10**9}}
        self.scene.write_text(json.dumps(scene))
        process = subprocess.Popen([PLIANT, "run", self.scene, "--out", "out"], cwd=self.folder, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        while not (self.folder / "out" / "measurements.csv").exists():
            time.sleep(0.01)
        time.sleep(0.3)
        return process

    def test_an_endless_step_is_given_up(self):
        process = self.endless_step()
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=60), 130, process.stderr.read())
        info = json.loads((self.folder / "out" / "run.json").read_text())
        self.assertEqual((info["outcome"], info["totals"]["frames"]), ("interrupted", 1))
        self.assertTrue((self.folder / "out" / "checkpoint.pliant").exists())

    def test_a_second_signal_ends_at_once(self):
        process = self.endless_step()
        process.send_signal(signal.SIGINT)
        time.sleep(0.3)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), -signal.SIGTERM)

    def test_the_end_of_processor_time_counts_as_an_interrupt(self):
        scene = SCENE | {"settings": {"threads": 1, "iterations": 10**9}}
        self.scene.write_text(json.dumps(scene))
        process = subprocess.run(["prlimit", "--cpu=1:20", "--", PLIANT, "run", self.scene, "--out", "out"],
                                 cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(process.returncode, 130, process.stderr)

    def test_a_closed_pipe_is_quiet(self):
        for arguments in (["schema"], ["scenes"], ["--help"]):
            process = subprocess.Popen([PLIANT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            process.stdout.close()
            self.assertEqual(process.stderr.read(), b"")
            process.stderr.close()
            self.assertIn(process.wait(timeout=60), (0, 4))


if __name__ == "__main__":
    unittest.main()
