"""pliant experiment: the list, the report, the figures that an independent program gave, and what is refused."""
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
ALL = ["wind", "explicit_euler", "torus", "damping", "sheet_metal", "hand", "torque", "start", "performance",
       "convergence", "resolution", "iterations", "integrators", "contact"]
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
