"""One writer a folder: of two runs, a run and a resume, or two resumes, one works and the other leaves. $PLIANT is the
program; PLIANT_RACES is how often each pair races."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import numpy

PLIANT = os.environ["PLIANT"]
RACES = int(os.environ.get("PLIANT_RACES", "3"))
ENDLESS = "100000000"
SCENE = {
    "pliant": 1,
    "steps": 5,
    "settings": {"threads": 1},
    "bodies": [{
        "mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]},
        "mass": {"per_vertex": 0.1},
        "constraints": [{"type": "position", "on": [0]}, {"type": "edge_spring", "stiffness": 1000}],
    }],
}


class OneWriter(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"
        self.scene = self.folder / "scene.json"
        self.scene.write_text(json.dumps(SCENE))

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def start(self, *arguments):
        process = subprocess.Popen([PLIANT, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, cwd=self.folder)
        self.addCleanup(process.stderr.close)
        return process

    def wait_for_one(self, processes):
        """The processes, first the one that has ended."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            for process in processes:
                if process.poll() is not None:
                    return [process, *(other for other in processes if other is not process)]
            time.sleep(0.002)
        self.fail("neither has ended")

    def wait_until_running(self):
        """An interrupt before that ends a program at once."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            path = self.out / "run.json"
            if path.exists() and json.loads(path.read_text())["outcome"] == "running":
                return
            time.sleep(0.002)

    def race(self, *commands):
        for _ in range(RACES):
            shutil.rmtree(self.out, ignore_errors=True)
            if any("resume" in command for command in commands):
                self.pliant("run", self.scene, "--out", self.out)
            loser, winner = self.wait_for_one([self.start(*command) for command in commands])
            errors = loser.stderr.read()
            self.assertEqual(loser.returncode, 4, errors)
            self.assertRegex(errors, rf"^pliant: error: .*/out: process {winner.pid} \(.*pliant (run|resume) .*{ENDLESS}.*"
                             r"\) writes here; wait until it ends, or give another folder\n$")
            self.assertIsNone(winner.poll())
            self.wait_until_running()
            winner.send_signal(signal.SIGINT)
            self.assertEqual(winner.wait(timeout=60), 130, winner.stderr.read())
            info = json.loads((self.out / "run.json").read_text())
            frames = numpy.load(self.out / "frames.npy")
            self.assertEqual((info["outcome"], info["totals"]["frames"]), ("interrupted", len(frames)))
            self.assertEqual(len((self.out / "measurements.csv").read_text().splitlines()), len(frames) + 1)
            self.assertEqual({path.name for path in self.out.iterdir()},
                             {"checkpoint.pliant", "frames.npy", "measurements.csv", "mesh.obj", "run.json"})

    def test_two_runs(self):
        command = ["run", self.scene, "--out", self.out, "--steps", ENDLESS]
        self.race(command, command)

    def test_a_run_and_a_resume(self):
        self.race(["run", self.scene, "--out", self.out, "--steps", ENDLESS], ["resume", self.out, "--steps", ENDLESS])

    def test_two_resumes(self):
        command = ["resume", self.out, "--steps", ENDLESS]
        self.race(command, command)

    def test_the_second_writes_nothing_and_a_killed_one_is_no_obstacle(self):
        first = self.start("run", self.scene, "--out", self.out, "--steps", ENDLESS)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (self.out / "frames.npy").exists():
            time.sleep(0.005)
        os.kill(first.pid, signal.SIGSTOP)
        os.waitpid(first.pid, os.WUNTRACED)  # stopped, no write under way
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        for words in (["run", self.scene, "--out", self.out], ["resume", self.out]):
            self.assertIn(f"process {first.pid} ", self.pliant(*words, expect=4).stderr)
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir()}, before)
        os.kill(first.pid, signal.SIGKILL)
        first.wait()
        self.pliant("run", self.scene, "--out", self.out)
        self.assertNotIn(".pliant-lock", os.listdir(self.out))

    def test_a_note_that_is_a_link_is_not_followed(self):
        self.out.mkdir()
        mine = self.folder / "mine"
        mine.write_text("1\nnothing\n")
        (self.out / ".pliant-lock").symlink_to(mine)
        self.pliant("run", self.scene, "--out", self.out)
        self.assertEqual(mine.read_text(), "1\nnothing\n")
        self.assertNotIn(".pliant-lock", os.listdir(self.out))


if __name__ == "__main__":
    unittest.main()
