"""The stubs are those of the lists of today, and the examples keep to them."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import unittest

SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])


class Stubs(unittest.TestCase):
    def test_they_are_up_to_date(self):
        spec = importlib.util.spec_from_file_location("make_stubs", SOURCE / "scripts" / "make_stubs.py")
        make_stubs = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(make_stubs)
        written = (SOURCE / "python" / "pliant" / "__init__.pyi").read_text(encoding="utf-8")
        self.assertEqual(written, make_stubs.stub(), "run scripts/make_stubs.py, as its first lines say")

    def test_the_examples_keep_to_them(self):
        mypy = shutil.which("mypy", path="/usr/bin:" + os.environ["PATH"])
        if mypy is None:
            self.skipTest("mypy is not installed")
        examples = sorted(map(str, (SOURCE / "python" / "examples").glob("*.py")))
        self.assertGreaterEqual(len(examples), 5)
        environment = {**os.environ, "MYPYPATH": str(SOURCE / "python")}
        environment.pop("PYTHONPATH", None)
        for example in examples:
            done = subprocess.run([mypy, "--strict", "--follow-imports=silent", "--cache-dir=mypy_cache",
                                   "--python-executable=/usr/bin/python3", example],
                                  env=environment, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
