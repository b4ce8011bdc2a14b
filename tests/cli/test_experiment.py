"""pliant experiment: the list, the report, the figures that an independent program gave, and what is refused."""
import csv
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PLIANT = os.environ["PLIANT"]
# OpenGL's drivers keep memory to the end of the program.
ENVIRONMENT = os.environ | {"ASAN_OPTIONS": "detect_leaks=0"}
ALL = ["wind", "explicit_euler", "torus", "damping", "sheet_metal", "wave_front", "folds", "hand", "torque", "start",
       "twitching", "reduction", "performance", "convergence", "resolution", "iterations", "integrators", "contact"]
# Those that are compared with the figures of an independent program and take a few seconds.
QUICK = ["damping", "sheet_metal", "torque"]


def pliant(*arguments, **options):
    return subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, env=ENVIRONMENT, **options)


class Experiment(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_without_names_they_are_listed(self):
        result = pliant("experiment", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([line.split()[0] for line in result.stdout.splitlines()], ALL)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_unknown_name_is_refused_with_the_nearest(self):
        result = pliant("experiment", "dampin", "--out", self.folder / "report")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"unknown experiment 'dampin'; did you mean 'damping'\? \(known: all, .*damping")
        self.assertFalse((self.folder / "report").exists())

    def test_a_report_that_cannot_be_written_is_refused_before_anything_is_measured(self):
        (self.folder / "report").write_text("a file")
        result = pliant("experiment", "all", "--out", self.folder / "report")
        self.assertEqual(result.returncode, 4)
        self.assertEqual(result.stdout, "")

    def test_a_page_of_someone_else_stays(self):
        (self.folder / "index.html").write_text("mine")
        result = pliant("experiment", "start", "--out", self.folder)
        self.assertEqual(result.returncode, 4)
        self.assertIn("no experiment wrote this page", result.stderr)
        self.assertEqual((self.folder / "index.html").read_text(), "mine")
        self.assertEqual(pliant("experiment", "start", "--out", "", cwd=self.folder).returncode, 2)

    def test_an_interrupt_leaves_a_report_that_says_so(self):
        out = self.folder / "report"
        process = subprocess.Popen([PLIANT, "experiment", "sheet_metal", "iterations", "--out", out, "--no-pictures"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        # The first chapter is printed, then its report is written, while the second has begun.
        while "independent" not in process.stdout.readline():
            self.assertIsNone(process.poll())
        while not (out / "report.json").exists():
            self.assertIsNone(process.poll())
        process.terminate()
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("interrupted: 1 of 2 experiments are in the report", errors)
        report = json.loads((out / "report.json").read_text())
        self.assertEqual([chapter["name"] for chapter in report["chapters"]], ["sheet_metal"])
        self.assertIn("This run was interrupted: 1 of 2", report["introduction"])

    def test_the_report_has_every_figure_within_a_tenth_of_the_independent_one(self):
        out = self.folder / "a" / "report"
        result = pliant("experiment", *QUICK, "--out", out, "--no-pictures")
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads((out / "report.json").read_text())
        self.assertEqual([chapter["name"] for chapter in report["chapters"]], QUICK)
        compared = 0
        for chapter in report["chapters"]:
            for claim in chapter["claims"]:
                self.assertIn(claim["verdict"], ["holds", "reported"], claim)
            for table in chapter["tables"]:
                if "independent program" not in table["columns"]:
                    continue
                for what, measured, known, _ in table["rows"]:
                    self.assertAlmostEqual(float(measured) / float(known), 1, delta=0.1, msg=what)
                    compared += 1
        self.assertEqual(compared, 20 + 4 + 16)
        self.assertEqual({"Pliant", "Processor", "Compiler"} - set(report["facts"]), set())
        page = (out / "index.html").read_text()
        self.assertIn("Fig. 6.4 to 6.6", page)
        self.assertEqual(re.findall(r'(?:src|href)="(?!#|data:)[^"]*"', page), [], "the page asks for other files")
        self.assertEqual(page.count('<svg class="plot'), sum(len(chapter["plots"]) for chapter in report["chapters"]))
        for chapter in report["chapters"]:
            for claim in chapter["claims"]:
                self.assertIn(f'>{claim["verdict"]}', page)
        self.assertRegex(result.stdout.splitlines()[-2], r"^\d+ claims: \d+ hold, 0 do not hold, 2 reported$")

    def test_figures_are_files_as_well(self):
        out = self.folder / "report"
        programs = self.folder / "programs"
        programs.mkdir()
        stand_in = programs / "rsvg-convert"
        stand_in.write_text('#!/bin/sh\n[ "$1 $2 $3" = "--format pdf --output" ] && echo "%PDF of $5" > "$4"\n')
        stand_in.chmod(0o755)
        path = f"{programs}:{os.environ['PATH']}"
        result = subprocess.run([PLIANT, "experiment", "reduction", "--out", out, "--no-pictures"], text=True,
                                capture_output=True, env=ENVIRONMENT | {"PATH": path})
        self.assertEqual(result.returncode, 0, result.stderr)
        chapter = json.loads((out / "report.json").read_text())["chapters"][0]
        for claim in chapter["claims"]:
            self.assertEqual(claim["verdict"], "holds", claim)
        figures = sorted(path.name for path in (out / "figures").iterdir())
        self.assertEqual(figures, ["reduction-1.csv", "reduction-1.pdf", "reduction-1.svg", "reduction-2.csv",
                                   "reduction-2.pdf", "reduction-2.svg"])
        self.assertEqual((out / "figures" / "reduction-2.pdf").read_text(),
                         f"%PDF of {out}/figures/reduction-2.svg\n")
        with (out / "figures" / "reduction-2.csv").open(newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], ["series", "iterations", "largest error of a vertex [m]"])
        series = chapter["plots"][1]["series"]
        self.assertEqual([(name, float(x), float(y)) for name, x, y in rows[1:]],
                         [(each["name"], x, y) for each in series for x, y in zip(each["x"], each["y"])])

    def test_without_rsvg_convert_the_pdfs_are_left_out_with_a_word(self):
        nothing = self.folder / "nothing"
        nothing.mkdir()
        result = subprocess.run([PLIANT, "experiment", "reduction", "--out", self.folder / "report", "--no-pictures"],
                                text=True, capture_output=True, env=ENVIRONMENT | {"PATH": str(nothing)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("there is no rsvg-convert here", result.stderr)
        self.assertEqual(list((self.folder / "report" / "figures").glob("*.pdf")), [])
        self.assertEqual(len(list((self.folder / "report" / "figures").glob("*.svg"))), 2)

    def test_a_seed_changes_figures_and_no_verdict(self):
        found = []
        for seed in ["0", "1"]:
            out = self.folder / seed
            result = pliant("experiment", "sheet_metal", "--seed", seed, "--out", out, "--no-pictures")
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads((out / "report.json").read_text())
            self.assertEqual(report["facts"]["Seed"], seed)
            found.append(report["chapters"][0])
        self.assertNotEqual(found[0]["plots"], found[1]["plots"])
        self.assertEqual(*[[claim["verdict"] for claim in chapter["claims"]] for chapter in found])

    def test_every_claim_says_whose_it_is_by_a_source_of_the_report(self):
        out = self.folder / "report"
        pliant("experiment", "sheet_metal", "wave_front", "--out", out, "--no-pictures")
        report = json.loads((out / "report.json").read_text())
        for chapter in report["chapters"]:
            for claim in chapter["claims"]:
                self.assertNotEqual(claim["verdict"], "does not hold", claim)
                self.assertTrue(not claim["by"] or any(claim["by"].startswith(name) for name in report["sources"]),
                                claim)
        bands = [series for series in report["chapters"][1]["plots"][0]["series"] if "low" in series]
        self.assertGreater(len(bands), 0)
        for series in bands:
            for low, middle, high in zip(series["low"], series["y"], series["high"]):
                self.assertLessEqual(low, middle)
                self.assertLessEqual(middle, high)

    def test_pictures_are_in_the_page(self):
        result = pliant("experiment", "sheet_metal", "--out", self.folder / "report", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        if "pictures are left out" in result.stderr:
            self.skipTest("no OpenGL here")
        page = (self.folder / "report" / "index.html").read_text()
        self.assertEqual(page.count("data:image/png;base64,iVBOR"), 1)
        self.assertEqual(len(result.stdout.splitlines()), 2)


if __name__ == "__main__":
    unittest.main()
