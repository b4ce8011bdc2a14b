"""pliant sweep --list and --collect: the runs of a sweep by programs of others. $PLIANT is the program."""
import csv
import fcntl
import io
import json
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from rope_scene import CHAIN

PLIANT = os.environ["PLIANT"]
STIFFNESS = "bodies[rope].constraints[links].stiffness"
ITERATIONS = "settings.iterations"
# An explicit spring far beyond its limit diverges after a few steps of 100 s; a soft one does not.
DIVERGING = {"forces": [{"type": "mouse_spring", "vertex": 5, "anchor": [0, 0, 1], "stiffness": 1}],
             "settings": {"time_step": 100, "threads": 1}}
SPRING = "forces[mouse_spring].stiffness"


def is_time(name):
    return name.startswith("ms_") or name == "wall_seconds"


def without_times(text):
    """A table without its columns of times."""
    rows = list(csv.reader(io.StringIO(text)))
    kept = [i for i, name in enumerate(rows[0]) if not is_time(name)]
    return [[row[i] for i in kept] for row in rows]


def untimed(folder):
    """All files of a sweep, times apart. Its page is made of the others."""
    files = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or name == "index.html" or is_time(path.stem):
            continue
        if path.suffix == ".csv":
            files[name] = without_times(path.read_text())
        elif path.name == "run.json":
            info = json.loads(path.read_text())
            info["totals"].pop("wall_seconds")
            files[name] = info
        else:
            files[name] = path.read_bytes()
    return files


class SweepList(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name).resolve()
        self.out = self.folder / "listed"
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()

    def write_scene(self, changes=None, name="scene.json"):
        (self.folder / name).write_text(json.dumps(CHAIN | (changes or {})))
        return name

    def pliant(self, *words, expect=0):
        done = subprocess.run([PLIANT, *map(str, words)], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def sweep(self, *words, expect=0):
        return self.pliant("sweep", "--out", self.out.name, *words, expect=expect)

    def lines(self, *words):
        done = self.sweep(*words, "--list")
        self.assertEqual(done.stderr, "")
        self.assertTrue(done.stdout.endswith("\n"))
        return done.stdout.splitlines()

    def run_line(self, line):
        """Runs a line in another folder than it was made in."""
        return subprocess.run(["/bin/sh", "-c", line], capture_output=True, text=True, timeout=120, cwd=self.elsewhere)

    def run_lines(self, lines, expect=0):
        for line in lines:
            done = self.run_line(line)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (expect, "", ""))

    def plain(self, *words, expect=0):
        """What the same sweep leaves without lists, in a folder of the same name, which checkpoints hold."""
        if self.out.exists():
            self.out.rename(self.folder / "kept")
        self.sweep(*words, "--jobs", 2, "--threads", 1, expect=expect)
        files = untimed(self.out)
        shutil.rmtree(self.out)
        if (self.folder / "kept").exists():
            (self.folder / "kept").rename(self.out)
        return files

    def rows(self):
        with open(self.out / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def written(self):
        """When each run was written."""
        return {path.parent.name: path.stat().st_mtime_ns for path in self.out.glob("runs/*/run.json")}

    def kill_group(self, process):
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()

    def wait_for_run(self, name):
        """Waits until no process writes in the folder of a run."""
        folder = os.open(self.out / "runs" / name, os.O_RDONLY)
        fcntl.flock(folder, fcntl.LOCK_EX)
        os.close(folder)

    def test_the_same_bytes_as_a_plain_sweep(self):
        words = [self.write_scene(), "--vary", f"{STIFFNESS}=100:10000:3log", "--vary", f"{ITERATIONS}=2,10", "--format",
                 "npy", "--set", "gravity=[0,0,-9]"]
        lines = self.lines(*words)
        self.assertEqual(len(lines), 6)
        self.assertFalse((self.out / "sweep.csv").exists())
        self.run_lines(reversed(lines))
        done = self.sweep(*words, "--collect")
        self.assertIn("scene: 6 runs: 6 ok\n", done.stdout)
        self.assertEqual(done.stderr, "")
        self.assertEqual(untimed(self.out), self.plain(*words))
        # What a plain sweep makes of the same runs has the same bytes, its page and plots of times as well.
        before = {path: path.read_bytes() for path in self.out.rglob("*") if path.is_file()}
        self.assertIn("6 were there before", self.sweep(*words, "--threads", 1).stdout)
        self.assertEqual({path: path.read_bytes() for path in self.out.rglob("*") if path.is_file()}, before)

    def test_what_has_ended_is_left_alone(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2,4,6"]
        lines = self.lines(*words)
        self.run_lines(lines[:2])
        before = self.written()
        self.assertEqual(set(before), {"0001", "0002"})
        self.assertEqual(self.lines(*words), lines)
        self.run_lines(lines)
        after = self.written()
        self.assertEqual({name: after[name] for name in before}, before)
        done = self.sweep(*words)
        self.assertIn("3 runs: 3 ok; 3 were there before", done.stdout)
        self.assertEqual(self.written(), after)
        # Values may be added: the runs that are there keep their folders, and each line its run.
        more = self.lines(words[0], "--vary", f"{ITERATIONS}=3,2,4,6")
        self.assertEqual(more[1:], lines)
        self.run_lines(more)
        self.assertEqual(self.written() | after, self.written())
        self.sweep(words[0], "--vary", f"{ITERATIONS}=3,2,4,6", "--collect")
        self.assertEqual([row["run"] for row in self.rows()], ["0004", "0001", "0002", "0003"])

    def test_killed_and_begun_again(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2,3,4,5"]
        lines = self.lines(*words)
        for sent in [signal.SIGTERM, signal.SIGINT, signal.SIGKILL]:
            # The same run with more steps than anyone waits for.
            endless = lines[1].replace(f"--set={ITERATIONS}", f"--steps=100000000 --set={ITERATIONS}")
            process = subprocess.Popen(["/bin/sh", "-c", endless], start_new_session=True)
            self.addCleanup(self.kill_group, process)
            table = self.out / "runs" / "0002" / "measurements.csv"
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and not (table.exists() and table.stat().st_size > 5000):
                time.sleep(0.01)
            os.killpg(process.pid, sent)
            self.assertNotEqual(process.wait(timeout=60), 0)
            self.wait_for_run("0002")
            done = self.sweep(*words, "--collect", expect=130)
            self.assertIn(f"run 0002 ({ITERATIONS}=3) has not begun or has not ended", done.stderr)
            table.unlink()
        self.run_lines(lines)
        self.sweep(*words, "--collect")
        self.assertEqual(untimed(self.out), self.plain(*words))

    def test_a_line_waits_for_a_run_whose_starter_was_killed(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2,3"]
        line = self.lines(*words)[0]
        # The run alone, as it goes on when nothing of its line is left.
        run = [PLIANT, "run", "--quiet", f"--out={self.out.name}/runs/0001", "--format=none", f"--set={ITERATIONS}=2"]
        for steps, ends in [(60_000, True), (100_000_000, False)]:
            shutil.rmtree(self.out / "runs" / "0001", ignore_errors=True)
            process = subprocess.Popen([*run, f"--steps={steps}", "scene.json"], cwd=self.folder)
            self.addCleanup(process.wait)
            self.addCleanup(process.kill)  # which comes first
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline and not (self.out / "runs" / "0001" / "measurements.csv").exists():
                time.sleep(0.01)
            again = subprocess.Popen(["/bin/sh", "-c", line], cwd=self.elsewhere)
            time.sleep(0.1)
            has_ended = again.poll() is not None  # it may have, where all is over within that time
            self.assertTrue(not has_ended or (ends and process.poll() is not None))
            if not ends:
                process.kill()
            process.wait(timeout=100)
            self.assertEqual(again.wait(timeout=100), 0)
            info = json.loads((self.out / "runs" / "0001" / "run.json").read_text())
            self.assertEqual((info["outcome"], info["totals"]["steps"]), ("ok", steps if ends else 20))

    def test_runs_that_do_not_end_well(self):
        words = [self.write_scene(DIVERGING), "--vary", f"{SPRING}=1,1e20,2,3"]
        lines = self.lines(*words)
        done = self.run_line(lines[1])
        self.assertEqual((done.returncode, done.stdout, done.stderr), (3, "", ""))
        self.assertEqual(self.run_line(lines[1]).returncode, 0)  # an outcome as well
        mine = self.out / "runs" / "0003" / "measurements.csv"
        mine.parent.mkdir()
        mine.write_text("mine\n")
        self.assertEqual(self.run_line(lines[2]).returncode, 4)
        self.run_lines(lines[:1])
        done = self.sweep(*words, "--collect", expect=130)
        for says in (f"warning: run 0002 ({SPRING}=1e20) diverged: ", f"warning: run 0003 ({SPRING}=2) failed: ",
                     f"warning: run 0004 ({SPRING}=3) has not", "start the commands of --list again"):
            self.assertIn(says, done.stderr)
        self.assertIn("4 runs: 1 ok, 1 diverged, 1 failed, 1 waiting", done.stdout)
        self.run_lines(lines[3:])
        self.sweep(*words, "--collect", "--quiet", expect=4)
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok", "diverged", "failed", "ok"])
        self.assertIn("measurements.csv", self.rows()[2]["message"])
        self.assertEqual(mine.read_text(), "mine\n")
        # A plain sweep tells, and leaves, the same of them.
        before = untimed(self.out)
        self.sweep(*words, expect=4)
        self.assertEqual(untimed(self.out), before)
        self.sweep(*words, "--collect", expect=4)
        self.assertEqual(untimed(self.out), before)
        mine.unlink()
        self.run_lines(lines)
        self.sweep(*words, "--collect", expect=3)
        self.assertEqual(untimed(self.out), self.plain(*words, expect=3))

    def test_a_run_that_a_signal_ended(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2,3"]
        for line in self.lines(*words):
            self.run_line(line)
        info = self.out / "runs" / "0002" / "run.json"
        info.write_text(info.read_text().replace('"ok"', '"running"'))
        log = self.out / "runs" / "0002.log"
        for code, outcome, message in [(137, "failed", "ended by signal 9 (Killed)"), (130, "waiting", ""),
                                       (143, "waiting", ""), (2, "failed", "exit code 2")]:
            log.write_text(f"exit code {code}\n")
            self.sweep(*words, "--collect", expect=130 if outcome == "waiting" else 2)
            self.assertEqual((self.rows()[1]["outcome"], self.rows()[1]["message"]), (outcome, message))

    def test_files_that_were_cut_are_written_anew(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2,3"]
        lines = self.lines(*words)
        self.run_lines(lines)
        whole = untimed(self.out)["runs/0002/measurements.csv"]
        for mode, code in (("--list", 0), ("--collect", 130)):
            table = self.out / "runs" / "0002" / "measurements.csv"
            table.write_bytes(table.read_bytes()[:-7])
            before = self.written()
            self.sweep(*words, mode, expect=code)
            self.run_lines(lines)
            self.assertEqual(self.written()["0001"], before["0001"])
            self.assertEqual(untimed(self.out)["runs/0002/measurements.csv"], whole)
        self.sweep(*words, "--collect")

    def test_strange_names(self):
        bodies = json.loads(json.dumps(CHAIN["bodies"]))
        bodies[0]["constraints"][1]["name"] = "li'nks $HOME `date` \"x\" \\"
        name = "-scene 'a' \"b\" $c;é.json"
        self.write_scene({"bodies": bodies}, name)
        self.folder = self.folder / "-a folder's"
        self.folder.mkdir()
        self.out = self.folder / "-o'u\"t $1 {} *"
        shutil.move(self.folder.parent / name, self.folder / name)
        words = ["--vary", "bodies[0].constraints[li'nks $HOME `date` \"x\" \\].stiffness=10,1e3", "--vary",
                 "name='{}',\"{1} & %\",!x #", "--", name]
        words.insert(-2, f"--out={self.out.name}")
        lines = self.pliant("sweep", "--list", *words).stdout.splitlines()
        self.assertEqual(len(lines), 6)
        self.run_lines(lines)
        self.pliant("sweep", "--collect", *words)
        self.assertEqual([row["outcome"] for row in self.rows()], ["ok"] * 6)
        self.assertEqual({row["name"] for row in self.rows()}, {"'{}'", "{1} & %", "!x #"})
        error = self.pliant("sweep", "--list", "--vary", "name=a,b\nc", "--out=new", "--", name, expect=2).stderr
        self.assertIn("has a line break", error)
        self.assertFalse((self.folder / "new" / "sweep.json").exists())

    def test_a_log_is_made_anew(self):
        words = [self.write_scene(DIVERGING), "--vary", f"{SPRING}=1e20,1"]
        lines = self.lines(*words)
        mine = self.folder / "mine"
        mine.write_text("mine\n")
        (self.out / "runs" / "0001.log").symlink_to(mine)
        self.assertEqual(self.run_line(lines[0]).returncode, 3)
        self.assertEqual(mine.read_text(), "mine\n")

    def test_threads(self):
        scene = self.write_scene()
        for more, says in [([], "--threads=1"), (["--threads", 3], "--threads=3")]:
            for line in self.lines(scene, "--vary", f"{ITERATIONS}=2,3", *more):
                self.assertIn(f" {says} ", line)
        self.out = self.folder / "varied"
        for line in self.lines(scene, "--vary", "settings.threads=1,2"):
            self.assertNotIn("--threads", line)

    def test_programs_that_start_lines(self):
        words = [self.write_scene(), "--vary", f"{ITERATIONS}=2:13:12"]
        starters = {"xargs": ["xargs", "-d", "\n", "-n", "1", "-P", "2", "sh", "-c"]}
        if shutil.which("parallel"):
            starters["parallel"] = ["parallel", "--will-cite", "-j", "2"]
        plain = self.plain(*words)
        for name, starter in starters.items():
            with self.subTest(name):
                lines = self.lines(*words, "--restart")
                subprocess.run(starter, input="\n".join(lines) + "\n", text=True, check=True, timeout=120,
                               cwd=self.elsewhere, env=os.environ | {"HOME": str(self.folder)})
                self.sweep(*words, "--collect")
                self.assertEqual(untimed(self.out), plain)

    def test_refusals(self):
        scene = self.write_scene()
        words = [scene, "--vary", f"{ITERATIONS}=2,3"]
        for options, says in [(["--list", "--collect"], "--list: --collect "),
                              (["--list", "--dry-run"], "--list: --dry-run "),
                              (["--list", "--jobs", 2], "--list: --jobs "),
                              (["--list", "--quiet"], "--list: --quiet "),
                              (["--collect", "--dry-run"], "--collect: --dry-run "),
                              (["--collect", "--jobs", 2], "--collect: --jobs "),
                              (["--collect", "--restart"], "--collect: --restart "),
                              (["--collect"], "there is no sweep to collect")]:
            error = self.sweep(*words, *options, expect=2).stderr
            self.assertIn(says, error)
            self.assertEqual(error.count("\n"), 1)
            self.assertFalse(self.out.exists())
        self.run_lines(self.lines(*words))
        for mode in ("--list", "--collect"):
            self.assertIn("rather than --steps 5", self.sweep(*words, "--steps", 5, mode, expect=2).stderr)
        self.write_scene({"steps": 10})
        self.assertIn("another text", self.sweep(*words, "--collect", expect=2).stderr)
        self.run_lines(self.lines(*words, "--restart"))
        self.sweep(*words, "--collect")
        self.assertEqual([row["steps_done"] for row in self.rows()], ["10", "10"])

    def test_each_line_is_words_of_a_shell(self):
        line = self.lines(self.write_scene(), "--vary", f"{ITERATIONS}=2,3")[1]
        words = shlex.split(line)
        self.assertIn(f"--out={self.out.name}/runs/0002", words)
        self.assertIn(f"--set={ITERATIONS}=3", words)
        self.assertIn(str(pathlib.Path(PLIANT).resolve()), words)


if __name__ == "__main__":
    unittest.main()
