"""The cells of the notebooks run, without Jupyter, and what is kept in them was run."""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import sys
import unittest

os.environ["MPLBACKEND"] = "Agg"
os.environ["PATH"] = os.path.dirname(os.environ.get("PLIANT", "")) + os.pathsep + os.environ["PATH"]
FOLDER = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"]) / "python" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))

if importlib.util.find_spec("matplotlib") is None:
    print("skipped: matplotlib is not installed (Debian's package python3-matplotlib)")
    sys.exit(77)


def code_cells(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in cells if cell["cell_type"] == "code"]


def printed(cell):
    return "".join("".join(each["text"]) for each in cell["outputs"] if each["output_type"] == "stream")


class Notebooks(unittest.TestCase):
    def test_cells_run_and_print_as_much_as_they_did(self):
        self.assertEqual(len(NOTEBOOKS), 2)
        for path in NOTEBOOKS:
            shown = []
            names = {"display": shown.append}
            for number, cell in enumerate(code_cells(path)):
                with self.subTest(notebook=path.name, cell=number):
                    text = io.StringIO()
                    with contextlib.redirect_stdout(text):
                        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), names)
                    self.assertEqual(text.getvalue().count("\n"), printed(cell).count("\n"))

    def test_what_they_hold_is_whole(self):
        for path in NOTEBOOKS:
            cells = code_cells(path)
            with self.subTest(path.name):
                self.assertTrue(all(cell["execution_count"] for cell in cells))
                kinds = [kind for cell in cells for each in cell["outputs"] for kind in each.get("data", {})]
                self.assertGreaterEqual(kinds.count("image/png"), 2)
                self.assertFalse([1 for cell in cells for each in cell["outputs"] if each["output_type"] == "error"])
                self.assertNotIn("/home/", path.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
