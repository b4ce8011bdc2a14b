"""What the command line says of slips, and its colors: on a terminal, in a pipe, on request."""
import json
import os
import pty
import subprocess
import tempfile
import unittest

PLIANT = os.environ["PLIANT"]
ENVIRONMENT = {key: value for key, value in os.environ.items() if key not in ("NO_COLOR", "TERM")} | {"TERM": "xterm"}


def pliant(*arguments, environment=ENVIRONMENT):
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run([PLIANT, *arguments], capture_output=True, text=True, env=environment, cwd=folder, timeout=60,
                              check=False)


def on_terminal(*arguments, environment=ENVIRONMENT):
    """What a terminal gets of both streams."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([PLIANT, *arguments], stdout=theirs, stderr=theirs, stdin=theirs, env=environment) as process:
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the other end was closed
                break
            if not part:
                break
            text += part
        process.wait()
    os.close(ours)
    return text.decode()


class Slips(unittest.TestCase):
    def refused(self, arguments, message):
        done = pliant(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, f"pliant: error: {message}\n")

    def test_what_is_near_is_suggested_and_nothing_else(self):
        for arguments, message in [
            (["veiw"], "unknown command 'veiw'; did you mean 'view'?"),
            (["xylophone"], "unknown command 'xylophone'; see pliant --help"),
            (["s"], "unknown command 's'; did you mean 'sweep', 'scenes' or 'schema'?"),
            (["run", "chain", "--stpes", "3"], "unknown option '--stpes'; did you mean '--steps'?"),
            (["run", "chain", "--stpes=3"], "unknown option '--stpes'; did you mean '--steps'?"),
            (["run", "chain", "--xylophone"], "unknown option '--xylophone'; see pliant run --help"),
            (["run", "curtian"], "unknown scene 'curtian': neither a file nor a built-in scene; did you mean 'curtain'?"),
            (["run", "xylophone"], "unknown scene 'xylophone': neither a file nor a built-in scene; `pliant scenes` lists those"),
            (["run", "chain", "--format", "pyl"], "--format: unknown value 'pyl'; did you mean 'ply'? "
                                                  "(known: npy, pc2, obj, ply, none); see pliant run --help"),
            (["experiment", "dampign"], None),
        ]:
            with self.subTest(arguments):
                if message is not None:
                    self.refused(arguments, message)
                else:
                    self.assertIn("unknown experiment 'dampign'; did you mean 'damping'?", pliant(*arguments).stderr)

    def test_what_is_missing_or_too_much_is_named(self):
        for arguments, message in [
            ([], "no command is given; see pliant --help"),
            (["run"], "'scene' is missing; see pliant run --help"),
            (["render", "chain"], "--out is missing; see pliant render --help"),
            (["run", "chain", "--out"], "--out: its value is missing; see pliant run --help"),
            (["render", "chain", "--size=", "--out", "x.png"],
             "--size: its value is missing; put one behind the '=', or leave --size out"),
            (["render", "--size=", "chain", "--out", "x.png"],
             "--size: its value is missing; put one behind the '=', or leave --size out"),
            (["render", "chain", "--timing=3"], "--timing takes no value; see pliant render --help"),
            (["scenes", "chain"], "unexpected argument 'chain'; see pliant scenes --help"),
        ]:
            with self.subTest(arguments):
                self.refused(arguments, message)

    def test_scenes_for_programs(self):
        scenes = json.loads(pliant("scenes", "--json").stdout)
        lines = pliant("scenes").stdout.splitlines()
        self.assertEqual([f"{scene['name']} {scene['description']}" for scene in scenes],
                         [" ".join(line.split(maxsplit=1)) for line in lines])
        self.assertIn("curtain", [scene["name"] for scene in scenes])


class Colors(unittest.TestCase):
    def test_none_in_a_pipe(self):
        for arguments in [["rnu"], ["check", "chain"]]:
            done = pliant(*arguments)
            self.assertNotIn("\x1b", done.stdout + done.stderr)

    def test_on_a_terminal(self):
        self.assertIn("\x1b[1;31mpliant: error:\x1b[0m unknown command", on_terminal("rnu"))
        self.assertIn("\x1b[32mThe scene is sound.\x1b[0m", on_terminal("check", "chain"))

    def test_not_where_they_are_unwanted(self):
        for more in [{"NO_COLOR": "1"}, {"TERM": "dumb"}]:
            with self.subTest(more):
                self.assertNotIn("\x1b", on_terminal("check", "chain", environment=ENVIRONMENT | more))
        self.assertIn("\x1b", on_terminal("check", "chain", environment=ENVIRONMENT | {"NO_COLOR": ""}))
        self.assertNotIn("\x1b", on_terminal("--ansi=never", "check", "chain"))

    def test_on_request_in_a_pipe_too(self):
        for words in [["--ansi=always"], ["--ansi", "always"]]:
            self.assertTrue(pliant(*words, "rnu").stderr.startswith("\x1b[1;31mpliant: error:\x1b[0m"))
            self.assertIn("\x1b[32m", pliant(*words, "check", "chain").stdout)
        self.assertEqual(pliant("--ansi=sometimes", "scenes").returncode, 2)


if __name__ == "__main__":
    unittest.main()
