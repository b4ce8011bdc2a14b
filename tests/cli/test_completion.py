"""Completion in real shells: what they offer for the beginning of a line."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PLIANT = os.environ["PLIANT"]

BASH = r"""
source script
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_pliant
printf '%s\n' "${COMPREPLY[@]}"
"""

# zsh completes on a terminal alone: here it has one of its own. $1 is the line, $2 what is waited for.
ZSH = r"""
zmodload zsh/zpty
typeset -g seen=''
wait_for() {
  local part i
  for i in {1..300}; do
    while zpty -rt shell part; do seen+=$part; done
    [[ $seen == *$1* ]] && return 0
    sleep 0.1
  done
  return 1
}
zpty -b shell zsh -f -i
zpty -w shell "PS1=; stty columns 200; autoload -Uz compinit; compinit -u -d $PWD/dump; source $PWD/script"
zpty -w shell "LISTMAX=1000; bindkey '^I' list-choices; cd $PWD/place; print REA''DY"
wait_for READY
seen=''
zpty -wn shell "$1"$'\t'
wait_for "$2"
print -r -- "$seen"
zpty -d shell
"""


class Completion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "place").mkdir()
        (self.folder / "place/shirt one.obj").write_text("")

    def script(self, shell):
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")
        text = subprocess.run([PLIANT, "completion", shell], capture_output=True, text=True, check=True).stdout
        (self.folder / "script").write_text(text)

    def shell(self, *command, cwd="."):
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder / cwd, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def bash(self, *words):
        return self.shell("bash", "-c", BASH.replace("source script", "source ../script"), "bash", "pliant", *words,
                          cwd="place").splitlines()

    def test_bash(self):
        self.script("bash")
        self.assertEqual(self.bash("ren"), ["render"])
        self.assertIn("sweep", self.bash(""))
        self.assertNotIn("man", self.bash(""))
        self.assertEqual(self.bash("--an"), ["--ansi"])
        self.assertEqual(self.bash("--ansi", "n"), ["never"])
        self.assertEqual(self.bash("--ansi", "never", "inf"), ["info"])
        self.assertEqual(self.bash("run", "curtain_"), ["curtain_wind"])
        self.assertIn("shirt one.obj", self.bash("run", ""))
        self.assertIn("chain", self.bash("run", ""))
        self.assertEqual(self.bash("run", "chain", "--form"), ["--format"])
        self.assertEqual(self.bash("run", "chain", "--format", "p"), ["pc2", "ply"])
        self.assertEqual(self.bash("run", "chain", "--format", "=", "p"), ["pc2", "ply"])
        self.assertEqual(self.bash("run", "chain", "--format", "="), ["npy", "pc2", "obj", "ply", "none"])
        self.assertEqual(self.bash("run", "chain", "--steps", ""), [""])
        self.assertEqual(self.bash("render", "chain", "--out", "sh"), ["shirt one.obj"])
        self.assertEqual(self.bash("render", "chain", "--colo"), ["--color", "--colour"])
        self.assertEqual(self.bash("experiment", "damp"), ["damping"])
        self.assertEqual(self.bash("completion", "f"), ["fish"])

    def test_every_shell_reads_its_script(self):
        for shell in ["bash", "zsh", "fish"]:
            with self.subTest(shell):
                self.script(shell)
                self.shell(shell, "-n", "script")

    def fish(self, line):
        answer = self.shell("fish", "--no-config", "-c", 'source ../script; complete -C "$argv[1]"', line, cwd="place")
        return [offer.split("\t")[0] for offer in answer.splitlines()]

    def test_fish(self):
        self.script("fish")
        self.assertEqual(self.fish("pliant ren"), ["render"])
        self.assertIn("--ansi", self.fish("pliant --"))
        self.assertEqual(self.fish("pliant run curtain_"), ["curtain_wind"])
        self.assertIn("shirt one.obj", " ".join(self.fish("pliant run s")).replace("\\", ""))
        self.assertEqual(self.fish("pliant run chain --format p"), ["pc2", "ply"])
        self.assertEqual(self.fish("pliant render chain --shading f"), ["flat"])

    def test_zsh(self):
        self.script("zsh")
        for line, offered in [("pliant ren", "Make a picture or a film"), ("pliant run c", "curtain_wind"),
                              ("pliant run s", "one.obj"), ("pliant run --f", "--format"),
                              ("pliant run chain --format ", "pc2")]:
            with self.subTest(line):
                self.assertIn(offered, self.shell("zsh", "-f", "-c", ZSH, "zsh", line, offered))


if __name__ == "__main__":
    unittest.main()
