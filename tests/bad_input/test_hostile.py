"""The harness finds fault where there is one: programs that end in every wrong way."""
import stat
import unittest

import hostile
from hostile import DONE, INPUT, Case, HostileTest

GOOD = 'echo "pliant: error: thing:1: it is wrong; mend it" >&2; exit 2'
INFO = '{"outcome": "ok"}'

# (what the program does, what is to be found)
PROGRAMS = [
    (GOOD, ""),
    ("exit 2", "0 lines of errors"),
    ("exit 1", "none of the program's"),
    ("kill -SEGV $$", "SIGSEGV"),
    ("exec sleep 60", "still runs"),
    (f"echo a line too many >&2; {GOOD}", "2 lines of errors"),
    ('echo "thing:1: it is wrong; mend it" >&2; exit 2', "does not begin with"),
    ('echo "pliant: error: thing:1: it is wrong" >&2; exit 2', "no remedy"),
    ('echo "pliant: error: it is wrong; mend it" >&2; exit 2', "does not name 'thing'"),
    ('echo "pliant: error: thing: it is strange; mend it" >&2; exit 2', "does not say"),
    ('printf "pliant: error: thing: wrong; \\377\\n" >&2; exit 2', "not UTF-8"),
    ('printf "pliant: error: thing: wrong; \\033[31m\\n" >&2; exit 2', "control characters"),
    ('printf "pliant: error: thing: wrong; \\302\\205\\n" >&2; exit 2', "control characters"),
    ('printf "pliant: error: thing: wrong; mend it" >&2; exit 2', "has no end"),
    ('printf "pliant: error: thing: wrong; %01000d\\n" 0 >&2; exit 2', "a line of"),
    ("exit 0", "not one of (2,)"),
    (f"mkdir out; echo x > out/frames.npy; {GOOD}", "without a sound run.json"),
    (f"mkdir out; echo x > out/run.json.tmp-0; {GOOD}", "leftovers"),
    (f"mkdir out; echo '{INFO}' > out/run.json; {GOOD}", "run.json says 'ok'"),
    ("head -c 200000000 /dev/zero | tail -c 199999999 > /dev/null; " + GOOD, "MiB of memory"),
]

RESULTS = [
    (f"echo '{INFO}' > out/run.json; printf 'a,b\\n1,2\\n' > out/measurements.csv", ""),
    (f"echo '{INFO}' > out/run.json; printf 'a,b\\n1,nan\\n' > out/measurements.csv", "not a finite number"),
    (f"echo '{INFO}' > out/run.json; printf 'a,b\\n1\\n' > out/measurements.csv", "not a finite number"),
    (f"echo '{INFO}' > out/run.json; printf 'v 0 inf 1\\n' > out/frame_00000.obj", "not finite"),
    (f"echo '{INFO}' > out/run.json; cp ../nan.npy out/frames.npy", "not finite"),
    (f"echo '{INFO}' > out/run.json; echo x > out/frames.npy", "cannot be read"),
    ("echo '{\"outcome\": NaN}' > out/run.json", "without a sound run.json"),
    ("echo x > out/run.json", "without a sound run.json"),
    (f"echo '{INFO}' > out/run.json; echo warning of nothing >&2", "an error, though"),
]


class Harness(HostileTest):
    def complaints(self, script, expect):
        program = self.folder / "program.sh"
        program.write_text("#!/bin/bash\nulimit -c 0\n" + script + "\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        self.addCleanup(setattr, hostile, "PLIANT", hostile.PLIANT)
        self.addCleanup(setattr, hostile, "TIME_LIMIT", hostile.TIME_LIMIT)
        hostile.PLIANT, hostile.TIME_LIMIT = str(program), 5 if "sleep" not in script else 0.3
        return "; ".join(self.run_case(Case("", [], expect=expect, place="thing", says="wrong"))[1])

    @unittest.skipIf(hostile.is_sanitized(), "memory is measured of the plain program alone")
    def test_endings(self):
        for script, found in PROGRAMS:
            with self.subTest(script=script):
                complaints = self.complaints(script, (INPUT,))
                self.assertIn(found, complaints)
                self.assertEqual(bool(found), bool(complaints), complaints)

    def test_results(self):
        hostile.numpy.save(self.folder / "nan.npy", hostile.numpy.array([[1, float("nan")]]))
        for script, found in RESULTS:
            with self.subTest(script=script):
                complaints = self.complaints("mkdir out; " + script, (DONE,))
                self.assertIn(found, complaints)
                self.assertEqual(bool(found), bool(complaints), complaints)

    def test_a_table_with_a_fault_fails(self):
        self.complaints(GOOD, (INPUT,))
        with self.assertRaisesRegex(AssertionError, "1 of 2 cases"):
            self.attack([Case("good", [], expect=(INPUT,)), Case("bad", [], expect=(DONE,))])
        with self.assertRaisesRegex(AssertionError, "no case at all"):
            self.attack([])

    def test_the_program_s_help_is_understood(self):
        self.assertIn("run", hostile.sub_commands())
        self.assertIn(("--steps", "INT"), hostile.options_of("run"))
        self.assertIn(("--quiet", ""), hostile.options_of("run"))


if __name__ == "__main__":
    hostile.main()
