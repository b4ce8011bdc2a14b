"""pliant plot: what runs measured over time, as a page, a drawing or numbers. $PLIANT is the program."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
import xml.dom.minidom

PLIANT = os.environ["PLIANT"]
CHAIN = {"pliant": 1, "steps": 20, "settings": {"threads": 1},
         "bodies": [{"mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]}, "mass": {"per_vertex": 0.1},
                     "constraints": [{"type": "position", "on": [0]},
                                     {"type": "edge_spring", "name": "links", "stiffness": 1000}]}]}


class Plot(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "chain.json").write_text(json.dumps(CHAIN))
        for name, iterations in (("few", 2), ("many", 30)):
            self.pliant("run", "chain.json", "--out", f"out/{name}", "--iterations", iterations, "--quiet")

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def measured(self, name, column):
        with open(self.folder / "out" / name / "measurements.csv", newline="") as file:
            return [row[column] for row in csv.DictReader(file)]

    def test_a_page_of_a_run(self):
        self.assertEqual(self.pliant("plot", "out/few", "--out", "few.html").stdout, "few.html: 6 plots of a run\n")
        page = (self.folder / "few.html").read_text()
        for text in ("<title>few", "21 records, ok", "total energy", "Total speed", "Time of a step"):
            self.assertIn(text, page)
        self.assertNotIn("http://", page.replace("http://www.w3.org/2000/svg", ""))  # asks for nothing from elsewhere

    def test_a_drawing_and_its_numbers(self):
        self.pliant("plot", "out/few", "out/many", "--out", "total.svg", "--columns", "total")
        drawing = (self.folder / "total.svg").read_text()
        xml.dom.minidom.parseString(drawing)
        for text in ("few", "many", "total energy", "time"):
            self.assertIn(text, drawing)
        self.pliant("plot", "out/few", "--out", "energy.csv", "--columns", "kinetic,total")
        with open(self.folder / "energy.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], ["series", "time [s]", "value [J]"])
        self.assertEqual(len(rows), 1 + 2 * 21)
        for series, column in (("kinetic energy", "kinetic"), ("total energy", "total")):
            drawn = [(float(row[1]), float(row[2])) for row in rows if row[0] == series]
            measured = zip(self.measured("few", "time"), self.measured("few", column))
            self.assertEqual(drawn, [(float(time), float(value)) for time, value in measured])

    def test_every_column_that_a_run_writes_has_a_name_in_words(self):
        scene = {**CHAIN, "steps": 3, "contact": {}, "colliders": [{"type": "plane", "name": "floor"}],
                 "forces": [{"type": "wind", "velocity": [1, 0, 0]}]}
        scene["bodies"] = [*scene["bodies"], {"mesh": {"shape": "grid"}, "material": "cotton",
                                              "transform": {"translate": [0, 0, 1]}}]
        (self.folder / "all.json").write_text(json.dumps(scene))
        self.pliant("run", "all.json", "--out", "out/all", "--quiet")
        with open(self.folder / "out/all/measurements.csv", newline="") as file:
            columns = next(csv.reader(file))
        self.assertGreater(len(columns), 30)
        for column in columns[2:]:
            self.pliant("plot", "out/all", "--out", "a.csv", "--columns", column)
            label = (self.folder / "a.csv").read_text().splitlines()[1].split(",")[0]
            self.assertNotIn("_", label)
            if column not in ("objective", "iterations", "ms_contact"):  # one word is the name of these
                self.assertIn(" ", label, column)

    def test_measurements_are_not_replaced(self):
        before = (self.folder / "out/few/measurements.csv").read_bytes()
        for run in ("out/few", "out/few/measurements.csv"):
            done = self.pliant("plot", run, "--columns", "total", "--out", "out/few/../few/measurements.csv", expect=2)
            self.assertIn("is what is to be plotted; give another name", done.stderr)
        self.assertEqual((self.folder / "out/few/measurements.csv").read_bytes(), before)

    def test_a_run_that_still_goes_on(self):
        table = self.folder / "out" / "few" / "measurements.csv"
        text = table.read_text()
        table.write_text(text[:len(text) // 2])  # in the middle of a row
        (self.folder / "out" / "few" / "run.json").unlink()
        self.pliant("plot", "out/few", "--out", "few.html")
        self.pliant("plot", table, "--out", "few.svg", "--columns", "total")

    def test_slips(self):
        for words, message in (
                (["out/few", "--out", "few.png"], "--out: 'few.png' has no known ending; give .html, .svg or .csv"),
                (["out/few", "--out", "few.svg"], "plots do not go into one drawing; give --columns of one unit"),
                (["out/few", "--out", "few.svg", "--columns", "ms_totl"], "unknown column 'ms_totl'; did you mean 'ms_total'"),
                (["out/none", "--out", "few.svg"], "out/none is not there; give the folder of a run"),
                (["out", "--out", "few.svg"], "out/measurements.csv is not there; give the folder of a run"),
                (["chain.json", "--out", "few.svg"], "chain.json: it has no column 'time'"),
                (["out/few", "--from", "7", "--out", "few.html"], "nothing was measured then; the records are from 0 to"),
                (["out/few"] * 9 + ["--out", "few.html"], "9 runs in one plot cannot be told apart; give at most 8"),
                ([], "'runs' is missing")):
            with self.subTest(words):
                done = self.pliant("plot", *words, expect=2)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("no-folder", self.pliant("plot", "out/few", "--out", "no-folder/a.html", expect=4).stderr)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["chain.json", "out"])


if __name__ == "__main__":
    unittest.main()
