"""What runs, resumes and sweeps may touch in a folder: never what a scene reads, nothing behind a link, and all of what a
killed one has left half-written. $PLIANT is the program."""
import fcntl
import json
import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import time
import unittest

PLIANT = os.environ["PLIANT"]
ROPE = "".join(f"v {i} 0 0\n" for i in range(10)) + "".join(f"l {i} {i + 1}\n" for i in range(1, 10))
BODY = {
    "mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]},
    "mass": {"per_vertex": 0.1},
    "constraints": [{"type": "position", "on": [0]}, {"type": "edge_spring", "stiffness": 1000}],
}
SCENE = {"pliant": 1, "steps": 5, "settings": {"threads": 1}, "bodies": [BODY]}
FILES = {"checkpoint.pliant", "frames.npy", "measurements.csv", "mesh.obj", "run.json"}


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"
        self.mine = self.folder / "mine"
        self.mine.write_text("mine\n")
        self.scene = self.write("scene.json", SCENE)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def contents(self, folder=None):
        return {path.relative_to(self.folder): (os.readlink(path) if path.is_symlink() else path.read_bytes())
                for path in sorted((folder or self.folder).rglob("*")) if path.is_symlink() or path.is_file()}

    def refused(self, *arguments, expect, says):
        """The command fails in one line, and no file is another one afterwards."""
        before = self.contents()
        error = self.pliant(*arguments, expect=expect).stderr
        self.assertEqual(error.count("\n"), 1, error)
        self.assertIn(says, error)
        self.assertEqual(self.contents(), before)


class Inputs(Folder):
    def refused_run(self, scene, name, *options):
        self.refused("run", scene, "--out", self.out, *options, expect=2,
                     says=f"the run would replace this file, which its scene reads, by its own {name}; give another")

    def test_a_mesh(self):
        self.pliant("run", self.scene, "--out", self.out)
        scene = self.write("mesh.json", SCENE | {"bodies": [BODY | {"mesh": {"file": "out/mesh.obj"}}]})
        self.refused_run(scene, "mesh.obj")
        self.refused_run(scene, "mesh.obj", "--format", "none")  # would remove it, with all of the earlier run

    def test_a_mesh_by_another_name(self):
        self.pliant("run", self.scene, "--out", self.out)
        for make in (os.link, os.symlink):
            make(self.out / "mesh.obj", self.folder / "rope.obj")
            scene = self.write("mesh.json", SCENE | {"bodies": [BODY | {"mesh": {"file": "rope.obj"}}]})
            self.refused_run(scene, "mesh.obj")
            (self.folder / "rope.obj").unlink()

    def test_a_map(self):
        weights = self.write("weights.txt", "".join(f"{i / 9}\n" for i in range(10)))
        spring = {"type": "edge_spring", "stiffness": {"map": {"file": "weights.txt"}, "from": 10, "to": 500}}
        scene = self.write("map.json", SCENE | {"bodies": [BODY | {"constraints": [spring]}]})
        self.out.mkdir()
        os.link(weights, self.out / "mesh.obj")
        self.refused_run(scene, "mesh.obj")

    def test_a_point_cache(self):
        self.pliant("run", self.scene, "--out", self.out, "--format", "pc2")
        pin = {"type": "position", "name": "pin", "on": [0]}
        body = BODY | {"constraints": [pin, BODY["constraints"][1]]}
        events = [{"step": 1, "follow": "pin", "file": "out/frames.pc2"}]
        scene = self.write("follow.json", SCENE | {"bodies": [body], "events": events})
        self.refused_run(scene, "frames.pc2")

    def test_the_scene_and_what_it_includes(self):
        self.out.mkdir()
        scene = self.write("out/run.json", SCENE)
        self.refused_run(scene, "run.json")
        self.write("scene2.json", {"pliant": 1, "include": ["out/run.json"]})
        self.refused_run(self.folder / "scene2.json", "run.json")

    def test_what_is_not_in_the_way(self):
        self.out.mkdir()
        self.write("out/mesh.obj", ROPE)
        scene = self.write("out/scene.json", SCENE | {"bodies": [BODY | {"mesh": {"file": "mesh.obj"}}]})
        self.pliant("run", scene, "--out", self.out, "--format", "none")
        self.assertEqual((self.out / "mesh.obj").read_text(), ROPE)


class Links(Folder):
    def test_a_run_follows_none(self):
        for name in FILES | {".pliant-lock"}:
            with self.subTest(name):
                shutil.rmtree(self.out, ignore_errors=True)
                self.pliant("run", self.scene, "--out", self.out)
                (self.out / name).unlink(missing_ok=True)
                (self.out / name).symlink_to(self.mine)
                if name != ".pliant-lock":
                    self.refused("run", self.scene, "--out", self.out, expect=4,
                                 says=f"out/{name}: cannot be written: it is a link to another place; remove the link")
                else:
                    self.pliant("run", self.scene, "--out", self.out)
                self.assertEqual(self.mine.read_text(), "mine\n")

    def test_a_resume_follows_none(self):
        for make in (os.symlink, os.link):
            for name in sorted(FILES | {"frames.npy.pliant.tmp-0", "run.json.pliant.tmp-0", "checkpoint.pliant.pliant.tmp-0"}):
                with self.subTest(name, make=make.__name__):
                    shutil.rmtree(self.out, ignore_errors=True)
                    self.pliant("run", self.scene, "--out", self.out)
                    target = self.folder / "target"
                    target.unlink(missing_ok=True)
                    if name in FILES:
                        os.rename(self.out / name, target)  # what is behind the link is as good as the file itself
                    else:
                        target.write_text("mine\n")
                    before = target.read_bytes()
                    make(target, self.out / name)
                    grows = name in ("frames.npy", "measurements.csv")
                    if name in FILES and (make is os.symlink or grows):
                        self.refused("resume", self.out, "--steps", 9, expect=4, says=f"out/{name}: cannot be written: ")
                    else:  # a file is replaced as a whole, a leftover is no more than removed
                        self.pliant("resume", self.out, "--steps", 9)
                    self.assertEqual(target.read_bytes(), before)

    def test_a_copy_by_hard_links_is_left_alone(self):
        self.pliant("run", self.scene, "--out", self.out)
        copy = self.folder / "copy"
        shutil.copytree(self.out, copy, copy_function=os.link)
        before = self.contents(self.out)
        self.refused("resume", copy, "--steps", 9, expect=4, says="put a copy in its place")
        self.pliant("run", self.scene, "--out", copy, "--steps", 7)  # makes all files anew
        self.assertEqual(self.contents(self.out), before)

    def sweep(self, *more, expect=0):
        return self.pliant("sweep", self.scene, "--vary", "steps=2,3", "--out", self.out, *more, expect=expect)

    def test_a_sweep_follows_none(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        names = ["sweep.json", "sweep.csv", "index.html", "runs", "plots", "runs/0001", "plots/total_end.svg"]
        for name in names:
            for words in ([], ["--restart"]):
                if name == "runs/0001" and words:
                    continue  # the link goes
                with self.subTest(name, words=words):
                    shutil.rmtree(self.out, ignore_errors=True)
                    shutil.rmtree(elsewhere)
                    self.sweep()
                    kept = elsewhere / "kept"
                    elsewhere.mkdir()
                    os.rename(self.out / name, kept)
                    (self.out / name).symlink_to(kept)
                    before = self.contents(elsewhere)
                    error = self.sweep(*words, expect=4).stderr
                    self.assertIn(f"out/{name}: cannot be written: it is a link to another place", error)
                    self.assertEqual(self.contents(elsewhere), before)

    def test_a_sweep_makes_its_logs_anew(self):
        self.sweep()
        for make in (os.symlink, os.link):
            log = self.out / "runs" / "0001.log"
            log.unlink(missing_ok=True)
            make(self.mine, log)
            info = self.out / "runs" / "0001" / "run.json"
            info.write_text(info.read_text().replace('"ok"', '"interrupted"'))
            self.sweep()
            self.assertEqual(self.mine.read_text(), "mine\n")

    def test_the_runs_of_a_sweep_follow_none(self):
        self.sweep()
        run = self.out / "runs" / "0001"
        (run / "run.json").unlink()
        (run / "run.json").symlink_to(self.mine)
        self.assertIn("run.json: cannot be written: it is a link", self.sweep(expect=4).stderr)
        self.assertEqual(self.mine.read_text(), "mine\n")


class Leftovers(Folder):
    NAMES = ["frame_00099.obj.pliant.tmp-0", "run.json.pliant.tmp-3", "checkpoint.pliant.pliant.tmp-0"]

    def leave(self, names):
        for name in names:
            (self.out / name).write_text("half")

    def test_the_next_run_or_resume_removes_them(self):
        self.pliant("run", self.scene, "--out", self.out)
        for words in (["run", self.scene, "--out", self.out], ["resume", self.out, "--steps", 9]):
            self.leave([*self.NAMES, "notes.pliant.tmp-0"])
            self.pliant(*words)
            self.assertEqual(set(os.listdir(self.out)), FILES | {"notes.pliant.tmp-0"})
            (self.out / "notes.pliant.tmp-0").unlink()
        shutil.rmtree(self.out)
        self.out.mkdir()
        self.leave(self.NAMES)  # of a run that was killed before it had a run.json
        self.pliant("run", self.scene, "--out", self.out)
        self.assertEqual(set(os.listdir(self.out)), FILES)

    def test_what_another_process_writes_stays(self):
        self.pliant("run", self.scene, "--out", self.out)
        self.leave(self.NAMES)
        with open(self.out / self.NAMES[0]) as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            self.pliant("run", self.scene, "--out", self.out)
            self.assertEqual(set(os.listdir(self.out)), FILES | {self.NAMES[0]})
        self.pliant("run", self.scene, "--out", self.out)
        self.assertEqual(set(os.listdir(self.out)), FILES)

    def test_killed_runs_leave_nothing_behind(self):
        chance = random.Random(3)
        for attempt in range(12):
            words = ["run", self.scene, "--out", self.out, "--format", "obj", "--checkpoint", "1", "--steps", "100000000"]
            if attempt % 3 == 1 and (self.out / "checkpoint.pliant").exists():
                words = ["resume", self.out, "--checkpoint", "1", "--steps", "100000000"]
            process = subprocess.Popen([PLIANT, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.02, 0.3))
            process.kill()
            process.wait()
        self.pliant("run", self.scene, "--out", self.out)
        self.assertEqual(set(os.listdir(self.out)), FILES)


if __name__ == "__main__":
    unittest.main()
