"""No scene file costs more than 40 times its size in memory, or 10 s, whatever it is filled with.

A value takes at least 16 bytes, a list or an object some 60 besides, and the shortest text of one is two characters. As
texts are limited to 32 MB and 10 million values, none needs more than 1 GB; the largest tell."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

PLIANT = os.environ["PLIANT"]
SIZE = 8_000_000
LARGEST = 32 << 20
CONSTANT = 24_000_000  # the program itself
SANITIZED = "asan" in PLIANT or "tsan" in PLIANT

GRID = '"mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1}'


def filled(before, unit, after, size=SIZE):
    return before + unit * ((size - len(before) - len(after)) // len(unit)) + unit.rstrip(",") + after


def in_list(unit, size=SIZE):
    return filled('{"pliant": 1, "bodies": [', unit, "]}", size)


def in_body(key, unit):
    return filled('{"pliant": 1, "bodies": [{' + GRID + ', ' + key + '[', unit, "]}]}")


def in_constraint(key, unit):
    return in_body('"constraints": [{"type": "edge_spring", ' + key, unit)[:-3] + "}]}]}"


CASES = {
    "empty lists": in_list("[],"),
    "numbers": in_list("0,"),
    "numbers with a fraction": in_list("1e1,"),
    "objects": in_list("{},"),
    "texts": in_list('"",'),
    "short texts": in_list('"a",'),
    "texts of 520 bytes": in_list('"' + "x" * 520 + '",'),
    "lists of one": in_list("[0],"),
    "objects of one": in_list('{"":0},'),
    "deep lists": in_list("[" * 50 + "]" * 50 + ","),
    "opened only": '{"pliant": 1, "x": ' + "[" * SIZE,
    "one text": filled('{"pliant": 1, "name": "', "x", '"}'),
    "one text of escapes": filled('{"pliant": 1, "name": "', "\\n", '"}'),
    "one number": filled('{"pliant": ', "1", "}"),
    "one word": "x" * SIZE,
    "spaces": " " * SIZE,
    "lines": "\n" * SIZE,
    "keys": '{"pliant": 1,' + ",".join(f'"{i:x}":0' for i in range(SIZE // 10)) + "}",
    "equal keys": filled('{"pliant": 1, ', '"k":0,', "}"),
    "masses": filled('{"pliant": 1, "bodies": [{"mesh": {"shape": "grid"}, "mass": {"each": [', "1,", "]}}]}"),
    "vertices": filled('{"pliant": 1, "bodies": [{"mesh": {"vertices": [', "[0,0,0],", ']}, "mass": {"total": -1}}]}'),
    "velocities": in_body('"velocities": ', "[0,0,0],"),
    "selections": in_constraint('"on": ', "0,"),
    "stiffnesses": in_constraint('"stiffness": ', "1,"),
    "stencils": in_constraint('"stencils": ', "[0,0],"),
    "names": in_list('{"name":"a"},'),
}


LARGEST_CASES = {
    "largest: empty lists": in_list("[],", LARGEST - 1000),
    "largest: deep lists": in_list("[" * 50 + "]" * 50 + ",", LARGEST - 1000),
    "largest: short texts": in_list('"a",', LARGEST - 1000),
    "largest: lines": "\n" * LARGEST,
    "too large": " " * (LARGEST + 1),
}

# A process of its own, since the peak of a child counts what its parent held when it was forked.
MEASURE = """
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
sys.stderr.buffer.write(done.stderr)
print(done.returncode, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)
"""


def run(path):
    """Exit code, seconds, peak memory [bytes] and message of a run."""
    begin = time.monotonic()
    done = subprocess.run([sys.executable, "-c", MEASURE, PLIANT, "run", path, "--steps", "0", "--format", "none",
                           "--out", f"{path}.out"], capture_output=True, text=True)
    code, memory = map(int, done.stdout.split())
    return code, time.monotonic() - begin, memory, done.stderr


class Memory(unittest.TestCase):
    def attack(self, cases, most_memory, most_seconds):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.json"
            for name, text in cases.items():
                with self.subTest(name):
                    path.write_text(text)
                    code, seconds, memory, message = run(path)
                    print(f"{name:24} {(memory - CONSTANT) / len(text):6.2f} x  {seconds:5.2f} s  {message[:100].strip()}")
                    self.assertEqual(code, 2, message)
                    self.assertEqual(message.count("\n"), 1)
                    self.assertLess(len(message), 2000)
                    self.assertLess(seconds, most_seconds)
                    if not SANITIZED:
                        self.assertLess(memory, most_memory(text))

    def test_scenes_filled_with_anything(self):
        self.attack(CASES, lambda text: 40 * len(text) + CONSTANT, 10)

    def test_the_largest_scenes(self):
        self.attack(LARGEST_CASES, lambda text: 1 << 30, 60)

    def test_a_text_past_the_limit_is_not_parsed(self):
        self.attack({"too large": LARGEST_CASES["too large"]}, lambda text: 3 * len(text) + CONSTANT, 10)


if __name__ == "__main__":
    unittest.main()
