"""pliant bench at sizes that take no time: what it measures, not how fast it is."""
import csv
import io
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PLIANT = os.environ["PLIANT"]
PHASES = ["projections", "gather", "forward substitution", "backward substitution", "solve", "iteration",
          "step"]
SET_UP = ["mesh", "constraints", "layout", "assembly", "symbolic", "numeric", "repack", "estimate"]
COLUMNS = ["workload", "table", "name", "threads", "min_s", "median_s", "times_eigen", "bytes", "bytes_per_second",
           "share_of_bandwidth"]


class Bench(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def bench(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, "bench", *map(str, arguments)], capture_output=True, text=True, timeout=300,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        if expect == 2:
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("pliant: error: "), done.stderr)
            self.assertEqual(done.stdout, "")
        elif expect == 0:
            self.assertEqual(done.stderr, "")
        return done

    def check_seconds(self, seconds):
        self.assertGreater(seconds["min"], 0)
        self.assertGreaterEqual(seconds["median"], seconds["min"])

    def test_small_workloads_with_every_baseline(self):
        for precision in ["double", "mixed"]:
            with self.subTest(precision):
                self.check_small_workloads(precision)

    def check_small_workloads(self, precision):
        done = self.bench("--workloads", "curtain,curtain-b,bar", "--size", 4, "--repeats", 2, "--threads", "1,2,3",
                          "--precision", precision, "--projections", "without", "--bandwidth", "without", "--json", "b.json", "--csv", "b.csv")
        result = json.loads((self.folder / "b.json").read_text())
        self.assertEqual([w["name"] for w in result["workloads"]], ["curtain", "curtain-b", "bar"])
        self.assertEqual([w["vertices"] for w in result["workloads"]], [16, 16, 5 * 5 * 17])
        self.assertEqual(result["workloads"][0]["constraints"], {"edge_spring": 33, "position": 2})
        self.assertEqual(result["workloads"][1]["constraints"], {"edge_spring": 33, "bending": 4, "position": 2})
        self.assertEqual(result["workloads"][2]["constraints"], {"tetrahedron_strain": 5 * 4 * 4 * 16, "position": 25})
        self.assertEqual(result["levels"], [])
        self.assertEqual(result["projections"], [])
        for workload in result["workloads"]:
            with self.subTest(workload["name"]):
                self.check_workload(workload, result["machine"]["cholmod"] is not None, precision)
                self.assertIn(f"\n{workload['name']}: {workload['vertices']} vertices;", done.stdout)
        self.assertIn("How to read: ", done.stdout)
        self.assertIn(result["machine"]["processor"], done.stdout)
        self.check_csv((self.folder / "b.csv").read_text(), result)

    def test_time_to_error_finds_the_iterations_that_are_enough(self):
        done = self.bench("--time-to-error", "swinging,bar", "--size", 8, "--repeats", 1, "--threads", 1, "--json", "b.json",
                          "--csv", "b.csv")
        result = json.loads((self.folder / "b.json").read_text())
        self.assertEqual((result["workloads"], result["projections"], result["levels"]), ([], [], []))
        self.assertEqual([case["name"] for case in result["time_to_error"]], ["swinging", "bar"])
        for case in result["time_to_error"]:
            self.assertLess(case["uncertainty"], 1e-8)
            self.assertEqual(list(case["methods"]), ["plain", "lbfgs", "anderson", "chebyshev", "xpbd", "xpbd rows"])
            for name, levels in case["methods"].items():
                errors = [level["error"] for level in levels]
                self.assertEqual(errors, sorted([1e-2, 1e-4, 1e-6, case["usual_error"]], reverse=True))
                known = [level["iterations"] for level in levels if level["iterations"] is not None]
                self.assertEqual(known, sorted(known))
                if name == "xpbd":
                    self.assertEqual(known, [])
                    self.assertGreater(case["last_errors"][name], 1e-2)
                else:
                    self.assertEqual(len(known), sum(error > 2 * case["uncertainty"] for error in errors))
                    self.assertIsNone(case["last_errors"][name])
                    self.check_seconds(levels[0]["seconds"])
            if case["usual_error"] > 2 * case["uncertainty"]:
                usual = next(level for level in case["methods"]["lbfgs"] if level["error"] == case["usual_error"])
                self.assertLessEqual(usual["iterations"], 20)
            else:
                self.assertLess(case["usual_error"], 1e-11)
            at_four_digits = errors.index(1e-4)
            fewest = [case["methods"][name][at_four_digits]["iterations"] for name in ("lbfgs", "plain", "xpbd rows")]
            self.assertLess(fewest[0], min(fewest[1:]))
        swinging = result["time_to_error"][0]
        self.assertGreater(swinging["usual_error"], 2 * swinging["uncertainty"])  # that of the bar may be rounding
        self.assertIn("\nswinging: a cloth of W5", done.stdout)
        self.assertIn(", usual ", done.stdout)
        self.assertRegex(done.stdout, r"\n  xpbd  +- not reached  +- not reached  +- not reached  +- not reached  [0-9.e-]+ left")
        rows = list(csv.DictReader(io.StringIO((self.folder / "b.csv").read_text())))
        self.assertIn("time_to_error", {row["table"] for row in rows})

    def test_another_build_is_timed_on_the_same_scenes(self):
        done = self.bench("--workloads", "cloth,bar", "--size", 4, "--repeats", 1, "--threads", "1", "--against",
                          PLIANT, "--json", "-")
        result = json.loads(done.stdout)
        self.assertEqual([(each["name"], each["threads"]) for each in result["against"]],
                         [("cloth", 1), ("bar", 1)])
        for each in result["against"]:
            for program in ("own_step_seconds", "other_step_seconds"):
                self.assertGreater(each[program]["median"], 0)
        text = self.bench("--time-to-error", "bar", "--size", 5, "--repeats", 1, "--threads", 1, "--against", PLIANT).stdout
        self.assertRegex(text, r"\n  the other +\d+ +[0-9.]+ ms")
        wrong = self.bench("--workloads", "curtain", "--size", 4, "--against", "/bin/false", expect=2).stderr
        self.assertIn("--against: /bin/false ended with exit code 1", wrong)
        wrong = self.bench("--workloads", "curtain", "--size", 4, "--against", "/no/such/program", expect=2).stderr
        self.assertIn("--against: /no/such/program cannot be started", wrong)
        self.assertIn("there is no 'waving'", self.bench("--time-to-error", "waving", expect=2).stderr)

    def test_time_to_error_of_built_in_scenes_and_files(self):
        scene = {"pliant": 1, "bodies": [{"name": "rope", "mesh": {"file": "rope.obj"}, "mass": {"total": 1},
                                        "constraints": [
            {"type": "edge_spring", "stiffness": 100}, {"type": "position", "on": [0]}]}]}
        (self.folder / "scenes").mkdir()
        (self.folder / "scenes" / "rope.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0.1 0\nl 1 2\nl 2 3\n")
        (self.folder / "scenes" / "own.json").write_text(json.dumps(scene))
        done = self.bench("--time-to-error", "trampoline,scenes/own.json", "--steps", 3, "--repeats", 1, "--threads", 1,
                          "--json", "-")
        result = json.loads(done.stdout)
        names = ["trampoline", "scenes/own.json"]
        self.assertEqual([case["name"] for case in result["time_to_error"]], names)
        self.assertEqual([case["vertices"] for case in result["time_to_error"]], [725, 3])
        for case in result["time_to_error"]:
            self.assertIn("step 4", case["description"])
            self.assertEqual(list(case["methods"])[:2], ["plain", "lbfgs"])
            self.assertLess(case["uncertainty"], 1e-6)
            self.assertIsNotNone(case["methods"]["lbfgs"][0]["iterations"])
        scene["bodies"][0]["constraints"] = scene["bodies"][0]["constraints"][:1]
        (self.folder / "scenes" / "falling.json").write_text(json.dumps(scene))
        done = self.bench("--time-to-error", "scenes/own.json", "--steps", 3, "--repeats", 1, "--threads", 1,
                          "--against", PLIANT, "--json", "-")
        result = json.loads(done.stdout)
        self.assertEqual([(each["name"], each["iterations"]) for each in result["against"]], [("scenes/own.json", 10)])
        self.assertGreater(result["against"][0]["other_step_seconds"]["median"], 0)
        for wrong, message in ((["scenes/gone.json"], "scenes/gone.json"),
                               (["scenes/falling.json", "--steps", "3"], "step 4 of 'scenes/falling.json' ends where forces"),
                               (["trampoline", "--steps", "-1"], "--steps: -1 is out of range; give 0 to 1000000"),
                               (["hanging", "--steps", "5"], "--steps: the bench's own cases take theirs"),
                               (["towel", "--against", PLIANT], "'towel' does not take plain steps"),
                               (["tramploine"], "there is no 'tramploine'"), (["tramploine"], "trampoline")):
            with self.subTest(wrong):
                self.assertIn(message, self.bench("--time-to-error", *wrong, expect=2).stderr)
        self.assertIn("--steps: it is of --time-to-error", self.bench("--steps", "5", expect=2).stderr)

    def check_workload(self, workload, has_cholmod, precision):
        self.assertEqual([phase["name"] for phase in workload["phases"]], PHASES)
        for phase in workload["phases"]:
            self.check_seconds(phase["seconds"])
            self.assertGreater(phase["times_eigen"], 0)
            self.assertIsNone(phase["share_of_bandwidth"])  # was not measured
        phases = {phase["name"]: phase for phase in workload["phases"]}
        self.assertIsNone(phases["step"]["bytes"])
        sweeps = [phases[name]["bytes"] for name in ("forward substitution", "backward substitution")]
        self.assertEqual(phases["solve"]["bytes"], sum(sweeps))
        self.assertLess(sweeps[1], sweeps[0])  # it reads no diagonal blocks
        self.assertGreater(phases["forward substitution"]["bytes"], workload["factor_entries"] * (8 if precision == "double" else 4))
        self.assertLess(phases["solve"]["seconds"]["min"], phases["iteration"]["seconds"]["median"])
        names = ["Eigen", *(["CHOLMOD simplicial", "CHOLMOD supernodal"] if has_cholmod else []), "textbook",
                 "thesis 3m x 3m"]
        self.assertEqual([each["name"] for each in workload["baselines"]], names)
        for each in workload["baselines"]:
            self.check_seconds(each["seconds"])
            self.assertEqual(each["what"], "solve" if each["name"][0] in "EC" else "iteration")
            self.assertLess(each["difference"], 1e-9 if precision == "double" else 1e-5)
            self.assertGreater(each["set_up_seconds"], 0)
        self.assertEqual(workload["baselines"][0]["times_eigen"], 1)
        self.assertEqual([each["threads"] for each in workload["threads"]], [1, 2, 3])
        for each in workload["threads"]:
            self.assertTrue(each["same_bits"])
            self.check_seconds(each["iteration_seconds"])
        self.assertAlmostEqual(workload["set_up_seconds"]["total"],
                               sum(workload["set_up_seconds"][part] for part in SET_UP))
        for part in SET_UP:
            is_made = part != "estimate" or precision == "mixed"
            self.assertEqual(workload["set_up_seconds"][part] > 0, is_made, part)
        self.assertEqual(workload["repeats"], 2)

    def check_csv(self, text, result):
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(list(rows[0]), COLUMNS)
        for workload in result["workloads"]:
            for phase in workload["phases"]:
                [row] = [row for row in rows if (row["workload"], row["table"], row["name"]) ==
                         (workload["name"], "phase", phase["name"])]
                self.assertEqual(float(row["min_s"]), phase["seconds"]["min"])
                self.assertEqual(float(row["times_eigen"]), phase["times_eigen"])
            for each in workload["baselines"]:
                [row] = [row for row in rows if (row["workload"], row["table"], row["name"]) ==
                         (workload["name"], "baseline_" + each["what"], each["name"])]
                self.assertEqual(float(row["median_s"]), each["seconds"]["median"])

    def test_steps_with_contact_beside_plain_ones(self):
        done = self.bench("--workloads", "falling", "--size", 8, "--repeats", 2, "--threads", 2, "--bandwidth", "without",
                          "--projections", "without", "--json", "b.json", "--csv", "b.csv")
        result = json.loads((self.folder / "b.json").read_text())
        self.assertEqual(result["workloads"], [])
        [cloth] = result["contact"]
        self.assertEqual((cloth["name"], cloth["vertices"], cloth["rounds"]), ("falling", 64, 2))
        plain, colliders, surfaces = cloth["runs"]
        self.assertEqual([run["name"] for run in cloth["runs"]], ["plain", "colliders alone", "surfaces too"])
        for run in cloth["runs"]:
            self.check_seconds(run["step_seconds"])
            self.assertEqual(run["iterations"], 10)  # none is at rest
            self.assertAlmostEqual(run["times_plain"],
                                   run["step_seconds"]["median"] / plain["step_seconds"]["median"])
            for phase in ("local steps", "global steps"):
                self.assertGreater(run["phases"][phase]["median"], 0)
                self.assertLess(run["phases"][phase]["min"], run["step_seconds"]["median"])
        self.assertEqual((plain["contacts"], plain["phases"]["contact, in these"]["median"]), (0, 0))
        self.assertEqual((plain["pairs"], colliders["pairs"]), (0, 0))
        for run in (colliders, surfaces):
            self.assertGreater(run["contacts"], 1)
            self.assertGreater(run["phases"]["contact, in these"]["min"], 0)
        self.assertRegex(done.stdout, r"\n  surfaces too +[0-9.]+ +[0-9.]+ ")
        rows = list(csv.DictReader(io.StringIO((self.folder / "b.csv").read_text())))
        [row] = [row for row in rows if (row["table"], row["name"]) == ("contact", "surfaces too: step")]
        self.assertEqual(float(row["median_s"]), surfaces["step_seconds"]["median"])
        self.assertEqual((row["threads"], cloth["threads"]), ("2", 2))

    def test_projections_alone(self):
        result = json.loads(self.bench("--projections", "only", "--repeats", 1, "--bandwidth", "without",
                                       "--json", "-").stdout)
        self.assertEqual(result["workloads"], [])
        counts = {each["type"]: each["count"] for each in result["projections"]}
        self.assertEqual(counts["edge_spring"], 29601)
        self.assertEqual(counts["triangle_strain"], 19602)
        self.assertEqual(counts["tetrahedron_strain"], 20000)
        self.assertEqual(counts["bending, curved at rest"], 9604)
        self.assertEqual(counts["hinge, curved at rest"], counts["hinge, flat at rest"])
        for each in result["projections"]:
            self.check_seconds(each["seconds"])
            self.assertGreater(each["per_second"], 0)
        rows = csv.DictReader(io.StringIO(self.bench("--projections", "only", "--repeats", 1, "--bandwidth", "without",
                                                     "--csv", "-").stdout))
        self.assertEqual([row["name"] for row in rows], list(counts))

    def test_without_baselines(self):
        done = self.bench("--size", 3, "--repeats", 1, "--threads", 1, "--baselines", "none", "--projections", "without",
                          "--bandwidth", "without", "--backend", "eigen", "--json", "b.json")
        result = json.loads((self.folder / "b.json").read_text())
        self.assertEqual([w["name"] for w in result["workloads"]], ["curtain", "curtain-b"])
        for workload in result["workloads"]:
            self.assertEqual(workload["baselines"], [])
            self.assertEqual(workload["backend"], "eigen")
            self.assertIsNone(workload["phases"][0]["times_eigen"])
        self.assertNotIn("threads: iteration", done.stdout)

    def test_bandwidth(self):
        result = json.loads(self.bench("--size", 3, "--repeats", 1, "--threads", 1, "--baselines", "eigen",
                                       "--projections", "without", "--json", "-").stdout)
        names = [level["name"] for level in result["levels"]]
        self.assertIn(names, [["L2", "L3"], ["L2", "L3", "memory"]])
        for level in result["levels"]:
            self.assertGreater(level["bytes_per_second"], 0)
        for phase in result["workloads"][0]["phases"][:-1]:
            self.assertGreater(phase["share_of_bandwidth"], 0)
        self.assertEqual(result["workloads"][0]["level"], "L2")

    def test_slips_end_in_one_line(self):
        for arguments, wanted in [
            (["--workloads", "W9"], "there is no 'W9'; known: W"),
            (["--workloads", "W2", "--size", 9], "W2 has a size of its own; with --size give curtain"),
            (["--workloads", "bar"], "bar needs its size; give --size"),
            (["--size", 2], "--size: 2 is out of range; give 3 to "),
            (["--size", "x"], "--size: 'x'"),
            (["--repeats", 0], "--repeats: 0 is out of range"),
            (["--threads", "1,x"], "--threads: 'x' is not a number of threads"),
            (["--threads", "0"], "--threads: '0' is not a number of threads"),
            (["--baselines", "eigen,chol"], "unknown baseline 'chol'; did you mean 'cholmod'? (known: all, none, or some of "),
            (["--backend", "lapack"], "--backend"),
            (["--size", 3, "--precision", "single"], "precision"),
            (["--projections", "some"], "--projections"),
            (["--json", "-", "--csv", "-"], "give one of them a file"),
            (["--what"], "--what"),
        ]:
            with self.subTest(arguments):
                self.assertIn(wanted, self.bench("--bandwidth", "without", *arguments, expect=2).stderr)

    def test_a_file_that_cannot_be_written(self):
        done = self.bench("--size", 3, "--repeats", 1, "--projections", "without", "--bandwidth", "without", "--json",
                          "nowhere/b.json", expect=4)
        self.assertIn("nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
