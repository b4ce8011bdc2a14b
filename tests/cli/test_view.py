"""pliant view, as its users meet it: what it says where there is no display, no OpenGL, no scene, and how it ends."""
import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PLIANT = os.environ["PLIANT"]
# The drivers keep memory to the end of the program.
ENVIRONMENT = os.environ | {"ASAN_OPTIONS": "detect_leaks=0"}
WITHOUT_DISPLAY = {key: value for key, value in ENVIRONMENT.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
QUAD = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n"


def view(*arguments, environment=ENVIRONMENT):
    return subprocess.run([PLIANT, "view", *map(str, arguments)], capture_output=True, text=True, env=environment,
                          timeout=600, check=False)


class WithoutDisplay(unittest.TestCase):
    def test_it_says_so_and_names_the_command_that_needs_none(self):
        result = view("flag", environment=WITHOUT_DISPLAY)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("there is no display", result.stderr)
        self.assertIn("`pliant render`", result.stderr)

    def test_a_display_that_is_not_there_is_named(self):
        result = view("flag", environment=WITHOUT_DISPLAY | {"DISPLAY": ":9876"})
        self.assertEqual(result.returncode, 2)
        self.assertIn(":9876", result.stderr)
        self.assertIn("`pliant render`", result.stderr)


@unittest.skipUnless(shutil.which("Xvfb"), "Xvfb is not installed")
class WithDisplay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        read_end, write_end = os.pipe()
        cls.server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "900x700x24", "-noreset"],
                                      pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as pipe:
            number = pipe.readline().strip()
        cls.folder = pathlib.Path(tempfile.mkdtemp()).resolve()
        cls.environment = WITHOUT_DISPLAY | {"DISPLAY": ":" + number, "XDG_STATE_HOME": str(cls.folder / "state"),
                                             "XDG_CACHE_HOME": str(cls.folder / "cache")}

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait()
        shutil.rmtree(cls.folder)

    def refuse(self, *arguments, says, environment=None):
        result = view(*arguments, environment=environment or self.environment)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for text in says:
            self.assertIn(text, result.stderr)

    def test_what_cannot_be_shown_is_refused(self):
        broken = self.folder / "broken.json"
        broken.write_text('{ "pliant": 1, "bodies": [ { } ] }')
        empty = self.folder / "empty.obj"
        empty.write_text("")
        self.refuse("nothing_of_the_kind", says=["neither a file nor a built-in scene"])
        self.refuse(broken, says=["bodies[0]"])
        self.refuse(empty, says=["empty"])
        self.refuse(self.folder, says=["run.json"])
        self.refuse("flag", "--size", "3", says=["--size"])
        self.refuse("flag", "--samples", "17", says=["--samples"])
        self.refuse("flag", "--set", "nonsense=1", says=["nonsense"])
        mesh = self.folder / "quad.obj"
        mesh.write_text(QUAD)
        self.refuse(mesh, "--set", "nonsense=1", says=["nonsense"])
        self.refuse("flag", "--scale", "2", says=["--scale", "mesh"])

    def test_without_opengl_it_says_what_is_missing(self):
        self.refuse("flag", says=["OpenGL", "`pliant render`"],
                    environment=self.environment | {"MESA_GL_VERSION_OVERRIDE": "2.1"})

    def start(self, *arguments, cwd=None):
        return subprocess.Popen([PLIANT, "view", *map(str, arguments)], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, cwd=cwd)

    def wait_for_window(self, process, name):
        while process.poll() is None:
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", name], env=self.environment,
                                   capture_output=True, text=True, check=False)
            if found.stdout.strip():
                return found.stdout.split()[0]
            time.sleep(0.05)
        self.fail(process.stderr.read())

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_an_interrupt_ends_it_and_so_does_its_key(self):
        process = self.start("flag")
        self.wait_for_window(process, "flag - Pliant")
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate()
        self.assertEqual((process.returncode, errors), (130, ""))
        process = self.start("chain")
        window = self.wait_for_window(process, "chain - Pliant")
        while process.poll() is None:
            subprocess.run(["xdotool", "windowfocus", window, "key", "ctrl+q"], env=self.environment,
                           stderr=subprocess.DEVNULL, check=False)
            time.sleep(0.1)
        _, errors = process.communicate()
        self.assertEqual((process.returncode, errors), (0, ""))

    def open_and_close(self, what, title):
        process = self.start(what, "--paused")
        self.wait_for_window(process, title)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=120)
        self.assertEqual((process.returncode, errors), (130, ""))

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_what_was_opened_is_remembered_newest_first(self):
        recent = self.folder / "state" / "pliant" / "recent.json"
        recent.unlink(missing_ok=True)
        one, two, gone = (self.folder / name for name in ("one.obj", "two.obj", "gone.obj"))
        for mesh in (one, two, gone):
            mesh.write_text(QUAD)

        def remembered():
            return json.loads(recent.read_text())

        self.open_and_close(one, "one")
        self.open_and_close("flag", "flag")  # a built-in scene is in the list anyway
        self.assertEqual(remembered(), [str(one)])
        self.open_and_close(gone, "gone")
        gone.unlink()
        self.open_and_close(two, "two")
        self.open_and_close(os.path.relpath(one), "one")
        self.assertEqual(remembered(), [str(one), str(two), str(gone)])  # gone with a disk, perhaps
        link = self.folder / "elsewhere" / "link.obj"
        link.parent.mkdir(exist_ok=True)
        link.symlink_to(two)
        self.open_and_close(link, "link")
        self.assertEqual(remembered()[0], str(link))  # a scene looks for its files beside the link
        for nonsense in ("", "[[[", '{"a": 1}', '[1, null, ["x"], "/nowhere"]', "\xff\0"):
            recent.write_text(nonsense, encoding="latin-1")
            self.open_and_close(two, "two")
            self.assertEqual(remembered()[0], str(two))

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_what_was_shown_has_a_small_picture_for_the_list_of_scenes(self):
        mesh = self.folder / "seen.obj"
        mesh.write_text(QUAD)
        pictures = self.folder / "cache" / "pliant" / "pictures"
        before = set(pictures.glob("*"))
        new = set()
        for wait in (2, 4, 8, 16):  # it has a picture once one was drawn
            process = self.start(mesh, "--paused")
            self.wait_for_window(process, "seen")
            time.sleep(wait)
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=120)
            new = set(pictures.glob("*")) - before
            if new:
                break
        self.assertEqual(len(new), 1)
        content = new.pop().read_bytes()
        self.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", content[16:24]), (256, 160))
        self.assertGreater(len(content), 2000)  # something is to be seen in it

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_where_nothing_can_be_remembered_all_works(self):
        occupied = self.folder / "occupied"
        occupied.write_text("a file where a folder would be")
        mesh = self.folder / "quad.obj"
        mesh.write_text(QUAD)
        before = self.environment
        try:
            # Without its own cache the driver has nothing to complain of.
            nowhere = {"XDG_STATE_HOME": str(occupied), "XDG_CACHE_HOME": str(occupied),
                       "MESA_SHADER_CACHE_DISABLE": "true"}
            type(self).environment = before | nowhere
            self.open_and_close(mesh, "quad")
        finally:
            type(self).environment = before
        self.assertEqual(occupied.read_text(), "a file where a folder would be")

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_a_session_is_saved_replayed_shown_and_filmed(self):
        process = self.start("curtain_wind", cwd=self.folder)
        window = self.wait_for_window(process, "curtain_wind")
        time.sleep(1)
        keys = ["xdotool", "windowfocus", window, "key", "ctrl+r"]
        subprocess.run(keys, env=self.environment, timeout=60, check=True)
        session = self.folder / "curtain_wind-1.session"
        deadline = time.monotonic() + 120
        while not session.exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertTrue(session.exists())
        recent = self.folder / "state" / "pliant" / "recent.json"
        while not (recent.exists() and str(session) in recent.read_text()) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual(json.loads(recent.read_text())[0], str(session))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=120)

        def run(command, *arguments):
            return subprocess.run([PLIANT, command, *map(str, arguments)], capture_output=True, text=True,
                                  env=self.environment, timeout=600, check=False)

        replayed = run("replay", session)
        self.assertEqual(replayed.returncode, 0, replayed.stderr)
        self.assertRegex(replayed.stdout, r"^curtain_wind: \d+ steps and 0 actions in .* s; the same bits as when")
        content = json.loads(session.read_text())
        content["checksums"][-1][1] ^= 1
        wrong = self.folder / "wrong.session"
        wrong.write_text(json.dumps(content))
        replayed = run("replay", wrong, "--quiet")
        self.assertEqual((replayed.returncode, replayed.stdout), (5, ""))
        self.assertIn(f"error: the replay differs from the recording, from step {content['steps']} on",
                      replayed.stderr)
        content["start"] = content["start"][:-40]
        wrong.write_text(json.dumps(content))
        for command in ("replay", "view", "render"):
            more = ["--out", self.folder / "wrong.png"] if command == "render" else []
            result = run(command, wrong, *more)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("wrong.session", result.stderr)
        picture = self.folder / "session.png"
        result = run("render", session, "--out", picture, "--size", "160x120", "--samples", 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(picture.exists())
        result = run("render", session, "--out", picture, "--steps", 3)
        self.assertEqual(result.returncode, 2)
        self.assertIn("a recorded session comes again as it was", result.stderr)

        process = self.start(session, cwd=self.folder)
        self.wait_for_window(process, "curtain_wind")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130)

    @unittest.skipUnless(shutil.which("xdotool"), "xdotool is not installed")
    def test_a_mesh_and_a_run_are_shown(self):
        mesh = self.folder / "shown.obj"
        mesh.write_text(QUAD)
        process = self.start(mesh)
        self.assertIn("cloth of 4 vertices", process.stdout.readline())  # at once, not when it ends
        self.assertIn("size      1 x 0 x 1 m", process.stdout.readline())
        self.wait_for_window(process, "shown - Pliant")
        process.terminate()
        process.communicate()
        run = self.folder / "run"
        subprocess.run([PLIANT, "run", "flag", "--steps", "5", "--out", run, "--quiet"], check=True)
        process = self.start(run, "--color", "speed")
        self.wait_for_window(process, "Pliant")
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, 130)


if __name__ == "__main__":
    sys.exit(unittest.main())
