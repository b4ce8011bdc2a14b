"""scripts/compare_verdicts.py: what it lets pass and what it does not."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(os.environ["PLIANT_SOURCE_DIR"]) / "scripts" / "compare_verdicts.py"


class CompareVerdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def compare(self, known, *verdicts):
        """verdicts: of each report, those of its two claims."""
        (self.folder / "known").write_text(known)
        reports = []
        for i, (first, second) in enumerate(verdicts):
            claims = [{"text": "It is stable", "verdict": first}, {"text": "It is quick", "verdict": second}]
            reports.append(self.folder / f"{i}.json")
            reports[-1].write_text(json.dumps({"chapters": [{"name": "wind", "claims": claims}]}))
        return subprocess.run([sys.executable, SCRIPT, self.folder / "known", *reports], capture_output=True, text=True)

    def test_equal_verdicts_pass(self):
        result = self.compare("", ("holds", "reported"), ("holds", "reported"))
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(result.stdout, "2 claims, 2 seeds: the same verdicts, as known\n")

    def test_a_verdict_that_changes_is_told(self):
        result = self.compare("", ("holds", "holds"), ("holds", "reported"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("wind: the verdict changes with the seed, holds, reported: It is quick", result.stdout)

    def test_failures_have_to_be_known(self):
        self.assertEqual(self.compare("# why\nwind: It is sta\n", ("does not hold", "holds")).returncode, 0)
        result = self.compare("", ("does not hold", "holds"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("does not hold, and is not known not to: It is stable", result.stdout)

    def test_a_known_failure_that_holds_or_is_gone_is_told(self):
        self.assertIn("although listed as a known failure: It is stable",
                      self.compare("wind: It is stable", ("holds", "holds")).stdout)
        self.assertIn("there is no such claim", self.compare("wind: It is blue", ("holds", "holds")).stdout)
        self.assertEqual(self.compare("damping: It is blue", ("holds", "holds")).returncode, 0)


if __name__ == "__main__":
    unittest.main()
