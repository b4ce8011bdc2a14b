"""The man page: every command and option stands in it, and what formats it has nothing to say against it."""
import os
import re
import shutil
import subprocess
import unittest

PLIANT = os.environ["PLIANT"]
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "COMMANDS", "OPTIONS", "EXIT STATUS", "FILES", "ENVIRONMENT", "EXAMPLES",
            "SEE ALSO"]


def pliant(*arguments):
    return subprocess.run([PLIANT, *arguments], capture_output=True, text=True, check=True).stdout


def names_in_help(text):
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE))


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = pliant("man")

    def formatted(self, *command):
        if not shutil.which(command[0]):
            self.skipTest(command[0] + " is not installed")
        done = subprocess.run(command, input=self.page, capture_output=True, text=True, check=False,
                              env=os.environ | {"MANWIDTH": "100", "LC_ALL": "C.UTF-8", "MANROFFSEQ": ""})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return re.sub(r".\x08|\x1b\[[0-9;]*m", "", done.stdout)

    def test_sections(self):
        self.assertEqual(re.findall(r"^\.SH (.*)$", self.page, re.MULTILINE), SECTIONS)

    def test_all_that_the_help_has_is_there(self):
        plain = self.page.replace("\\-", "-")
        commands = re.findall(r"^  (\w+)  ", pliant("--help").split("Subcommands:")[1].split("Examples:")[0], re.MULTILINE)
        self.assertIn("completion", commands)
        self.assertNotIn("man", commands)
        for command in commands:
            section = plain.split(f".SS pliant {command}\n")[1].split("\n.S")[0]
            for name in names_in_help(pliant(command, "--help")):
                self.assertIn(f"\\fB{name}\\fP", section, command)

    def test_groff_has_no_warnings(self):
        text = self.formatted("groff", "-man", "-Tutf8", "-ww", "-Kutf8")
        self.assertIn("pliant resume out/curtain --steps 900", text)

    def test_man_has_no_warnings(self):
        text = self.formatted("man", "--warnings", "-E", "UTF-8", "-l", "-")
        self.assertIn("SYNOPSIS", text)

    def test_mandoc_finds_no_errors(self):
        self.formatted("mandoc", "-Tlint", "-Werror")


if __name__ == "__main__":
    unittest.main()
