"""pliant sweep: the product of settings, its table, its plots, and going on where one has stopped. $PLIANT is the program."""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from rope_scene import CHAIN
import xml.dom.minidom

PLIANT = os.environ["PLIANT"]
STIFFNESS = "bodies[rope].constraints[links].stiffness"
ITERATIONS = "settings.iterations"
# An explicit spring far beyond its limit diverges after a few steps of 100 s; a soft one does not.
DIVERGING = {"forces": [{"type": "mouse_spring", "vertex": 5, "anchor": [0, 0, 1], "stiffness": 1}],
             "settings": {"time_step": 100}}


class Sweep(unittest.TestCase):
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
        return done

    def sweep(self, scene, *arguments, expect=0):
        done = self.pliant("sweep", scene, *arguments, "--out", self.out, expect=expect)
        if expect in (2, 4) and not self.out.exists():
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("pliant: error: "), done.stderr)
        return done

    def rows(self):
        with open(self.out / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def written(self):
        """When each run was written."""
        return {path.parent.name: path.stat().st_mtime_ns for path in self.out.glob("runs/*/run.json")}

    def test_the_product_of_two_values(self):
        done = self.sweep(self.write_scene(), "--vary", f"{STIFFNESS}=100:10000:3log", "--vary", f"{ITERATIONS}=2,10",
                          "--jobs", 2)
        self.assertIn("scene: 6 runs: 6 ok", done.stdout)
        rows = self.rows()
        self.assertEqual([(row[STIFFNESS], row[ITERATIONS]) for row in rows],
                         [(stiffness, iterations) for stiffness in ("100", "1000", "10000") for iterations in ("2", "10")])
        self.assertEqual([row["run"] for row in rows], [f"{i:04}" for i in range(1, 7)])
        self.assertEqual({row["outcome"] for row in rows}, {"ok"})
        self.assertEqual({row["steps_done"] for row in rows}, {"20"})
        self.assertEqual([row["iterations_mean"] for row in rows], ["2", "10"] * 3)
        self.assertEqual(sorted(path.name for path in (self.out / "runs").iterdir()),
                         [f"{i:04}" for i in range(1, 7)])  # no empty logs
        plots = {path.stem for path in (self.out / "plots").iterdir()}
        self.assertLessEqual({"total_end", "iterations_mean", "energy_over_time"}, plots)
        for path in (self.out / "plots").iterdir():
            xml.dom.minidom.parse(str(path))
        self.assertIn("<svg", (self.out / "index.html").read_text())

    def test_the_figures_are_those_of_the_measurements(self):
        scene = self.write_scene()
        self.sweep(scene, "--vary", f"{ITERATIONS}=3,7", "--every", 2)
        self.pliant("run", scene, "--set", f"{ITERATIONS}=7", "--every", 2, "--format", "none", "--out", "alone")
        with open(self.folder / "alone" / "measurements.csv", newline="") as file:
            alone = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        texts = self.rows()[1]
        row = {key: float(value) for key, value in texts.items() if value and key not in ("outcome", "message")}
        self.assertEqual({key.split("_")[0] for key, value in texts.items() if not value and key != "message"},
                         {"contacts", "deepest", "backtracks", "refactorizations", "pairs", "active", "shortened",
                          "momentum", "energy", "smallest", "lag", "let"})  # nothing touches
        elastic = [line["elastic_hook"] + line["elastic_links"] for line in alone]
        self.assertEqual(len(alone), 11)
        self.assertEqual(row["total_end"], alone[-1]["total"])
        self.assertEqual(row["other_potential_end"], alone[-1]["other_potential"])
        self.assertEqual(row["other_potential_max"], max(line["other_potential"] for line in alone))
        self.assertEqual(row["speed_sum_max"], max(line["speed_sum"] for line in alone))
        self.assertAlmostEqual(row["kinetic_mean"], sum(line["kinetic"] for line in alone) / 11, places=12)
        self.assertAlmostEqual(row["elastic_mean"], sum(elastic) / 11, places=12)
        # The start is no step: it has neither iterations nor a residual.
        self.assertEqual(row["iterations_mean"], 7)
        self.assertAlmostEqual(row["residual_mean"], sum(line["residual"] for line in alone[1:]) / 10, places=12)
        late = [line["speed_sum"] for line in alone if line["time"] >= alone[-1]["time"] * 2 / 3 - 1e-12]
        self.assertAlmostEqual(row["speed_sum_late"], sum(late) / len(late), places=9)

    def test_the_figures_of_contact(self):
        scene = self.folder / "drop.json"
        scene.write_text(json.dumps({
            "pliant": 1, "steps": 40, "settings": {"time_step": 0.02},
            "bodies": [{"name": "sheet", "mesh": {"shape": "grid", "columns": 6, "rows": 6}, "mass": {"total": 1},
                        "transform": {"translate": [0, 0, 0.5]},
                        "constraints": [{"type": "edge_spring", "stiffness": 500}]}],
            "colliders": [{"type": "plane", "name": "floor"}]}))
        self.sweep(scene, "--vary", "bodies[sheet].transform.translate[2]=0.2,99", "--vary", "steps=30,40")
        rows = self.rows()
        self.assertEqual([row["outcome"] for row in rows], ["ok"] * 4)
        with open(self.out / "runs" / "0002" / "measurements.csv", newline="") as file:
            steps = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)][1:]
        self.assertGreater(float(rows[1]["contacts_end"]), 0)
        self.assertEqual(float(rows[1]["contacts_end"]), steps[-1]["contacts"])
        self.assertEqual(float(rows[1]["deepest_max"]), max(step["deepest"] for step in steps))
        self.assertGreater(float(rows[1]["deepest_max"]), 0)
        for name in ("backtracks", "refactorizations"):
            self.assertAlmostEqual(float(rows[1][name + "_mean"]), sum(step[name] for step in steps) / 40, places=12)
        self.assertEqual(float(rows[3]["contacts_end"]), 0)  # the floor is far below
        self.assertEqual(float(rows[3]["deepest_max"]), 0)
        plots = {path.stem: path.read_text() for path in (self.out / "plots").iterdir()}
        self.assertIn("contacts_end", plots)
        self.assertIn("[m]", plots["deepest_max"])

    def test_what_has_ended_is_not_run_again(self):
        scene = self.write_scene()
        self.sweep(scene, "--vary", f"{ITERATIONS}=2,4")
        before = self.written()
        done = self.sweep(scene, "--vary", f"{ITERATIONS}=4,3,2")
        self.assertIn("3 runs: 3 ok; 2 were there before", done.stdout)
        self.assertEqual([(row[ITERATIONS], row["run"]) for row in self.rows()],
                         [("4", "0002"), ("3", "0003"), ("2", "0001")])
        after = self.written()
        self.assertEqual({name: after[name] for name in before}, before)
        self.sweep(scene, "--vary", f"{ITERATIONS}=3")  # the others stay, for another time
        self.assertEqual([row["run"] for row in self.rows()], ["0003"])
        self.sweep(scene, "--vary", f"{ITERATIONS}=2,3,4")
        self.assertEqual([row["run"] for row in self.rows()], ["0001", "0003", "0002"])
        self.assertEqual(self.written(), after)

    def test_slips_are_known_before_anything_runs(self):
        scene = self.write_scene()
        for words, says in [(["--vary", f"{ITERATIONS}=2,many"], f"--vary {ITERATIONS}=many: found a string"),
                            (["--vary", "settings.iteratons=2,3"], "unknown key"),
                            (["--vary", f"{ITERATIONS}="], "there are no values"),
                            (["--vary", f"{ITERATIONS}"], "there is no '='"),
                            (["--vary", "=1,2"], "there is no path"),
                            (["--vary", f"{ITERATIONS}=1,,2"], "a value without text"),
                            (["--vary", f"{ITERATIONS}=1,2,1"], "the value 1 comes twice"),
                            (["--vary", f"{ITERATIONS}=1:5"], "is not a range"),
                            (["--vary", f"{ITERATIONS}=1:5:1"], "is not a range"),
                            (["--vary", f"{ITERATIONS}=0:5:3log"], "above 0"),
                            (["--vary", f"{ITERATIONS}=1", "--vary", f"{ITERATIONS}=2"], "comes twice"),
                            (["--vary", f"{STIFFNESS}=1,2", "--vary", "bodies[0].constraints[1].stiffness=3,4"],
                             "takes the place of"),
                            (["--vary", f"{ITERATIONS}=1", "--iterations", 3], "--iterations sets the same value"),
                            (["--vary", "steps=1,2", "--set", "steps=3"], "--set sets the same value"),
                            (["--vary", "gravity=1:2:200", "--vary", "steps=1:200:200"], "more than 10000"),
                            (["--vary", "steps=" + "[" * 60000], ""),
                            ([], "--vary")]:
            with self.subTest(words=str(words)[:80]):
                self.assertIn(says, self.sweep(scene, *words, expect=2).stderr)
        self.assertIn("neither a file", self.sweep("nothing.json", "--vary", "steps=1,2", expect=2).stderr)
        self.assertFalse(self.out.exists())

    def test_a_dry_run_lists_and_writes_nothing(self):
        scene = self.write_scene()
        done = self.sweep(scene, "--vary", f"{ITERATIONS}=2,4", "--vary", "steps=1,2", "--dry-run")
        self.assertEqual([line.split("waiting")[1].strip() for line in done.stdout.splitlines()[:4]],
                         [f"{ITERATIONS}={i}, steps={n}" for i in (2, 4) for n in (1, 2)])
        self.assertFalse(self.out.exists())

    def test_a_run_that_diverges_is_a_row(self):
        scene = self.write_scene(DIVERGING)
        words = ["--vary", "forces[mouse_spring].stiffness=1,1e20"]
        self.sweep(scene, *words, expect=3)
        ok, diverged = self.rows()
        self.assertEqual((ok["outcome"], diverged["outcome"]), ("ok", "diverged"))
        self.assertLess(int(diverged["steps_done"]), 20)
        self.assertIn("vertex 5", diverged["message"])
        before = self.written()
        self.sweep(scene, *words, expect=3)  # an outcome as well
        self.assertEqual(self.written(), before)

    def test_a_run_that_fails_is_a_row_and_the_others_go_on(self):
        scene = self.write_scene()
        words = ["--vary", f"{ITERATIONS}=2,3,4"]
        (self.out / "runs" / "0002").mkdir(parents=True)
        (self.out / "runs" / "0002" / "measurements.csv").write_text("mine\n")
        error = self.sweep(scene, *words, expect=4).stderr  # of no sweep, so nothing of it is touched
        self.assertIn("no sweep wrote it", error)
        (self.out / "runs").rename(self.folder / "mine")
        self.sweep(scene, *words)
        for name in ["0002", "0003"]:
            for path in (self.out / "runs" / name).iterdir():
                path.unlink()
            (self.out / "runs" / name / "measurements.csv").write_text("mine\n")
        done = self.sweep(scene, *words, expect=4)
        self.assertIn(f"run 0002 ({ITERATIONS}=3) failed: ", done.stderr)
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok", "failed", "failed"])
        self.assertIn("measurements.csv", self.rows()[1]["message"])
        self.assertEqual((self.out / "runs" / "0002" / "measurements.csv").read_text(), "mine\n")
        for name in ["0002", "0003"]:
            (self.out / "runs" / name / "measurements.csv").unlink()
        self.sweep(scene, *words)  # tried again
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok"] * 3)

    def test_files_that_were_cut_are_written_anew(self):
        scene = self.write_scene()
        words = ["--vary", f"{ITERATIONS}=2,3,4,5"]
        self.sweep(scene, *words)
        table = [{key: value for key, value in row.items() if "ms" not in key and key != "wall_seconds"}
                 for row in self.rows()]
        measurements = self.out / "runs" / "0001" / "measurements.csv"
        measurements.write_bytes(measurements.read_bytes()[:-7])
        shutil.rmtree(self.out / "runs" / "0002")
        info = self.out / "runs" / "0003" / "run.json"
        info.write_text(info.read_text().replace('"ok"', '"running"'))  # as it is when a run is killed
        before = self.written()
        done = self.sweep(scene, *words)
        self.assertIn("1 were there before", done.stdout)
        self.assertEqual(self.written()["0004"], before["0004"])
        again = [{key: row[key] for key in table[0]} for row in self.rows()]
        self.assertEqual(again, table)

    def test_what_cannot_be_compared_is_refused(self):
        scene = self.write_scene()
        words = ["--vary", f"{ITERATIONS}=2,3"]
        self.sweep(scene, *words)
        table = (self.out / "sweep.csv").read_bytes()
        for more, says in [(["--steps", 5], "--steps 5"), (["--set", "gravity=null"], "gravity=null"),
                           (["--vary", "steps=5,6"], "vary settings.iterations"), (["--every", 2], "--every 2")]:
            with self.subTest(more=more):
                error = self.sweep(scene, *words, *more, expect=2).stderr
                self.assertIn(says, error)
                self.assertIn("--restart", error)
        self.write_scene({"steps": 10})
        self.assertIn("another text", self.sweep(scene, *words, expect=2).stderr)
        self.assertEqual((self.out / "sweep.csv").read_bytes(), table)
        self.sweep(scene, *words, "--restart")
        self.assertEqual([row["steps_done"] for row in self.rows()], ["10", "10"])
        (self.out / "sweep.json").write_text("[]")
        self.assertIn("not written by a sweep", self.sweep(scene, *words, expect=4).stderr)

    def test_a_folder_that_cannot_be_written(self):
        scene = self.write_scene()
        for out in ["/proc/sweep", scene]:
            error = self.pliant("sweep", scene, "--vary", "steps=1,2", "--out", out, expect=4).stderr
            self.assertEqual(error.count("\n"), 1, error)
        self.out.mkdir()
        (self.out / "sweep.csv").write_text("mine\n")
        self.assertIn("no sweep wrote it", self.sweep(scene, "--vary", "steps=1,2", expect=4).stderr)
        self.assertEqual((self.out / "sweep.csv").read_text(), "mine\n")

    def test_strange_names(self):
        bodies = json.loads(json.dumps(CHAIN["bodies"]))
        bodies[0]["name"] = 'a, "rope" = x'
        bodies[0]["constraints"][1]["name"] = 'li,nks\n"'
        scene = self.write_scene({"bodies": bodies}, 'scene, "x" 1.json')
        self.out = self.folder / 'o,u"t 1'
        path = 'bodies[0].constraints[li,nks\n"].stiffness'
        self.sweep(scene, "--vary", f"{path}=10,1e3", "--vary", "gravity=[0,0,-1], [0,0,-2]", "--vary",
                   'name=a,"b,\\" c"')
        rows = self.rows()
        self.assertEqual(len(rows), 8)
        self.assertEqual(list(rows[0])[1:4], [path, "gravity", "name"])
        self.assertEqual({row["gravity"] for row in rows}, {"[0,0,-1]", "[0,0,-2]"})
        self.assertEqual({row["name"] for row in rows}, {"a", 'b," c'})
        self.assertEqual({row["outcome"] for row in rows}, {"ok"})

    def start(self, *arguments, scene=None):
        """Starts a sweep that would never end, and waits for its second run to be under way."""
        process = subprocess.Popen([PLIANT, "sweep", self.write_scene(scene).name, "--jobs", "1", "--out", self.out, *arguments],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        self.addCleanup(process.stderr.close)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (self.out / "runs" / "0002" / "measurements.csv").exists():
            time.sleep(0.01)
        return process

    def end_run(self, name, sent):
        """Sends a signal to the process of a run."""
        option = f"--out={self.out}/runs/{name}".encode()
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                if option in path.read_bytes().split(b"\0"):
                    os.kill(int(path.parent.name), sent)
            except OSError:  # one that has ended meanwhile
                continue

    def test_an_interrupt_keeps_what_has_ended(self):
        for sent in [signal.SIGINT, signal.SIGTERM]:
            with self.subTest(sent=sent):
                self.out = self.folder / sent.name
                process = self.start("--vary", "steps=5,100000000,6")
                process.send_signal(sent)
                self.assertEqual(process.wait(timeout=60), 130)
                self.assertEqual([row["outcome"] for row in self.rows()], ["ok", "waiting", "waiting"])
                self.assertIn("interrupted: ", process.stderr.read())
                before = self.written()
                done = self.sweep(self.folder / "scene.json", "--vary", "steps=5,6")
                self.assertIn("2 runs: 2 ok; 1 were there before", done.stdout)
                self.assertEqual(self.written()["0001"], before["0001"])

    def test_one_sweep_at_a_time_has_a_folder(self):
        process = self.start("--vary", "steps=5,100000000")
        scene = self.folder / "scene.json"
        self.assertIn(f"out: process {process.pid} (", self.sweep(scene, "--vary", "steps=5,6", expect=4).stderr)
        process.kill()
        process.wait()
        # Its run goes on, and still has the folder.
        error = self.sweep(scene, "--vary", "steps=5,6", expect=4).stderr
        self.assertRegex(error, rf"out: what process {process.pid} \(.* started still writes here; wait until it ends")
        self.end_run("0002", signal.SIGKILL)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            done = subprocess.run([PLIANT, "sweep", scene, "--vary", "steps=5,6", "--out", self.out, "--quiet"],
                                  capture_output=True, text=True, timeout=120)
            if done.returncode != 4:
                break
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_a_scene_that_is_changed_meanwhile_ends_the_sweep(self):
        process = self.start("--vary", "steps=5,3000000,6")
        self.write_scene({"steps": 10})
        self.end_run("0002", signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 2)
        self.assertIn("has changed since the sweep began", process.stderr.read())
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok", "waiting", "waiting"])

    def test_a_mesh_that_is_changed_meanwhile_ends_the_sweep(self):
        mesh = self.folder / "rope.obj"
        text = "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 3 0 0\nf 1 2 3\nf 2 4 3\n"
        mesh.write_text(text)
        body = CHAIN["bodies"][0] | {"mesh": {"file": "rope.obj"}}
        process = self.start("--vary", "steps=5,3000000,6", scene={"bodies": [body]})
        mesh.write_text(text.replace("v 3 0 0", "v 4 0 0"))
        self.end_run("0002", signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 2)
        self.assertIn("rope.obj: has changed since the sweep began", process.stderr.read())
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok", "waiting", "waiting"])
        self.assertIn("of another", self.sweep("scene.json", "--vary", "steps=5,6", expect=2).stderr)
        mesh.write_text(text)
        self.assertIn("1 were there before", self.sweep("scene.json", "--vary", "steps=5,6").stdout)

    def test_the_scaling_of_threads(self):
        self.sweep(self.write_scene(), "--vary", "settings.threads=1,2")
        for name, threads in [("0001", 1), ("0002", 2)]:
            info = json.loads((self.out / "runs" / name / "run.json").read_text())
            self.assertEqual(info["settings"]["threads"], threads)

    def test_no_numbers_and_many_series(self):
        scene = self.write_scene()
        self.sweep(scene, "--vary", "settings.start=prediction,positions")
        self.assertEqual({path.stem for path in (self.out / "plots").iterdir()},
                         {"energy_over_time", "speed_over_time"})
        self.assertIn("nothing can be drawn over it", (self.out / "index.html").read_text())
        self.out = self.folder / "many"
        self.sweep(scene, "--vary", "steps=1,2", "--vary", f"{STIFFNESS}=100:10000:12log", "--quiet")
        plots = {path.stem for path in (self.out / "plots").iterdir()}
        self.assertLessEqual({"total_end", "total_end-2"}, plots)
        self.assertNotIn("total_end-3", plots)
        self.assertNotIn("energy_over_time", plots)
        self.sweep(scene, "--vary", "steps=1,2", "--vary", f"{STIFFNESS}=100", "--quiet")
        self.assertNotIn("total_end-2", {path.stem for path in (self.out / "plots").iterdir()})


if __name__ == "__main__":
    unittest.main()
