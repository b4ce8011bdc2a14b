"""pliant render, as its users meet it: pictures and films of scenes and runs, without a display."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "recorder"))
import png_file  # noqa: E402

PLIANT = os.environ["PLIANT"]
# The drivers keep memory to the end of the program.
ENVIRONMENT = os.environ | {"ASAN_OPTIONS": "detect_leaks=0"}


def read_png(path):
    """Width, height and the rows of RGB of a PNG file."""
    pixels = png_file.read(path.read_bytes())
    return pixels.shape[1], pixels.shape[0], [row.tobytes() for row in pixels]


def colors(rows):
    return {bytes(row[i:i + 3]) for row in rows for i in range(0, len(row), 3)}


def wait_until_caught(process, number):
    """However long the program takes to start: before it catches a signal, one would end it."""
    for _ in range(6000):
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        caught = next(int(line.split()[1], 16) for line in status.splitlines() if line.startswith("SigCgt"))
        if caught >> (number - 1) & 1:
            return
        time.sleep(0.01)


class Render(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def pliant(self, *arguments, expect=0, environment=None):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                              cwd=self.folder, env=ENVIRONMENT | (environment or {}))
        if done.returncode == 2 and "OpenGL: " in done.stderr and expect == 0:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, expect, done.stderr)
        if expect in (2, 4):
            self.assertIn("pliant: error: ", done.stderr)
        return done

    def render(self, *arguments, expect=0, environment=None):
        return self.pliant("render", *arguments, expect=expect, environment=environment)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_a_picture_of_the_last_step(self):
        done = self.render("curtain", "--steps", 4, "--out", "c.png", "--size", "160x90", "--set", "view.shadow=false")
        self.assertIn("c.png: 160 x 90 pixels, drawn by ", done.stdout)
        width, height, rows = read_png(self.folder / "c.png")
        self.assertEqual((width, height), (160, 90))
        self.assertGreater(len(colors(rows)), 100)
        self.assertEqual(self.files(), ["c.png"])
        first = (self.folder / "c.png").read_bytes()
        self.render("curtain", "--steps", 4, "--out", "again.png", "--size", "160x90", "--set", "view.shadow=false")
        self.assertEqual((self.folder / "again.png").read_bytes(), first)
        self.render("curtain", "--steps", 8, "--out", "later.png", "--size", "160x90", "--set", "view.shadow=false")
        self.assertNotEqual((self.folder / "later.png").read_bytes(), first)

    def test_the_view_of_the_scene_and_the_options_count(self):
        self.render("chain", "--steps", 1, "--out", "c.png", "--set", "view.size=[64, 48]", "--set",
                    "view.background=[0, 0, 1]", "--set", "view.ground=false")
        width, height, rows = read_png(self.folder / "c.png")
        self.assertEqual((width, height), (64, 48))
        self.assertEqual(bytes(rows[0][:3]), b"\0\0\xff")
        for color in ("stretch", "energy", "speed", "gap", "contact_force"):
            self.render("chain", "--steps", 3, "--out", f"{color}.png", "--size", "96x64", "--color", color)
            self.assertGreater(len(colors(read_png(self.folder / f"{color}.png")[2])), 50)

    def test_numbered_pictures_and_a_sheet(self):
        self.render("chain", "--steps", 8, "--out", "c.png", "--size", "64x48", "--frames", 3)
        self.assertEqual(self.files(), ["c-0000.png", "c-0001.png", "c-0002.png"])
        self.render("chain", "--steps", 8, "--out", "sheet.png", "--size", "64x48", "--frames", 4, "--sheet")
        width, height, _ = read_png(self.folder / "sheet.png")
        self.assertEqual((width, height), (2 * 32 + 3 * 2, 2 * 24 + 3 * 2))

    def test_timing_tells_what_each_pass_takes(self):
        def passes(*options):
            told = self.render("chain", "--steps", 8, "--out", "c.png", "--size", "64x48", "--frames", 3, "--timing",
                               *options).stdout
            self.assertIn("in the median of 2 pictures", told)
            rows = [line.split(maxsplit=1) for line in told.splitlines() if line[:1] == " "][1:]
            times = {name: float(time) for time, name in rows}
            self.assertGreater(times["in all"], 0)
            self.assertGreaterEqual(times["in all"] * 1.5 + 1, max(times.values()))
            return times

        self.assertIn("light on what is seen", passes())
        self.assertNotIn("light on what is seen", passes("--set", "view.quality=low"))
        self.assertNotIn("in the median", self.render("chain", "--steps", 2, "--out", "c.png", "--size", "64x48").stdout)

    def test_a_turntable_goes_around_once(self):
        # All is held, so that nothing but the camera moves.
        scene = {"pliant": 1, "steps": 6, "settings": {"time_step": 0.125}, "gravity": None,
                 "bodies": [{"mesh": {"shape": "grid", "columns": 3, "rows": 3, "plane": "xz"}, "mass": {"total": 1}}],
                 "view": {"shadow": False, "ground": False, "camera": {"azimuth": 0, "elevation": 0}}}
        (self.folder / "still.json").write_text(json.dumps(scene))
        options = ("--size", "96x96", "--frames", 4, "--fps", 8)

        def widths(*more):
            self.render("still.json", "--out", "t.png", *options, *more)
            pictures = [read_png(self.folder / f"t-000{i}.png")[2] for i in range(4)]
            background = bytes(pictures[0][0][:3])
            return [sum(bytes(rows[48][i:i + 3]) != background for i in range(0, 3 * 96, 3)) for rows in pictures]

        still = widths()
        self.assertEqual(still, [still[0]] * 4)
        front, side, back, other_side = widths("--turntable")
        self.assertGreater(front, 30)
        self.assertLess(side, 4)
        self.assertAlmostEqual(back, front, delta=2)
        self.assertLess(other_side, 4)
        moved = ["--set", 'view.camera={"keyframes": [{"time": 0, "position": [0.5, -9, 0.5], "target": [0.5, 0, 0.5]}, '
                          '{"time": 0.75, "position": [0.5, -3, 0.5], "target": [0.5, 0, 0.5]}]}']
        nearer = widths(*moved)
        self.assertEqual(nearer, sorted(nearer))
        self.assertGreater(nearer[3], 2 * nearer[0])
        front, side, back, other_side = widths(*moved, "--turntable")  # it goes around all the same
        self.assertGreater(front, 1.5 * side)
        self.assertAlmostEqual(back, front, delta=2)
        self.assertAlmostEqual(other_side, side, delta=2)

    def test_films_have_a_frame_for_every_thirtieth_of_a_second(self):
        if shutil.which("ffmpeg") is None or shutil.which("ffprobe") is None:
            self.skipTest("ffmpeg is not installed")
        for name in ("film.mp4", "film.webm", "film.gif"):
            with self.subTest(name):
                self.render("chain", "--steps", 20, "--out", name, "--size", "64x48")
                said = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0",
                                       "-show_entries", "stream=width,height,nb_read_frames", "-of", "csv=p=0",
                                       self.folder / name], capture_output=True, text=True, check=True).stdout
                self.assertEqual(said.strip(), "64,48,11")  # 20 steps of 1/60 s, and the start
        self.assertEqual(self.files(), ["film.gif", "film.mp4", "film.webm"])

    def test_a_webp_moves_where_pictures_are_shown(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("ffmpeg is not installed")
        self.render("chain", "--steps", 18, "--out", "film.webp", "--size", "64x48", "--fps", 20)
        film = (self.folder / "film.webp").read_bytes()
        self.assertEqual((film[:4], film[8:16]), (b"RIFF", b"WEBPVP8X"))
        self.assertEqual([1 + int.from_bytes(film[at:at + 3], "little") for at in (24, 27)], [64, 48])
        self.assertEqual(film.count(b"ANMF"), 7)  # 18 steps of 1/60 s, and the start
        self.assertEqual(self.files(), ["film.webp"])

    def test_a_run_is_rendered_as_its_scene(self):
        self.pliant("run", "chain", "--steps", 10, "--out", "run", "--quiet")
        self.render("run", "--out", "run.png", "--size", "96x64")
        self.render("run", "--out", "run.png", "--size", "96x64")
        self.assertGreater(len(colors(read_png(self.folder / "run.png")[2])), 20)
        self.render("run", "--out", "blue.png", "--set", "view.background=[0, 0, 1]", "--set", "view.ground=false",
                    "--size", "96x64")
        self.assertEqual(bytes(read_png(self.folder / "blue.png")[2][0][:3]), b"\0\0\xff")
        for words in (["--steps", 3], ["--set", "gravity=[0, 0, 1]"]):
            error = self.render("run", "--out", "run.png", *words, expect=2).stderr
            self.assertIn("a run is shown as it was recorded", error)
        error = self.render("run", "--out", "e.png", "--color", "energy", expect=2).stderr
        self.assertIn("color: a run does not say the energy", error)
        error = self.render("run", "--out", "e.png", "--color", "gap", expect=2).stderr
        self.assertIn("color: a run does not say what its vertices touch; give its scene", error)
        self.render("run", "--out", "s.png", "--color", "speed", "--size", "96x64")

    def test_without_ffmpeg_there_are_pictures_and_a_hint(self):
        (self.folder / "empty").mkdir()
        done = self.render("chain", "--steps", 4, "--out", "film.mp4", "--size", "32x32",
                           environment={"PATH": str(self.folder / "empty")})
        self.assertIn("ffmpeg", done.stderr)
        self.assertIn("film-0000.png", done.stdout)
        self.assertEqual(self.files(), ["empty", "film-0000.png", "film-0001.png", "film-0002.png"])

    def test_the_last_step_is_shown_whatever_the_frames(self):
        for steps in (0, 30, 100):
            self.render("curtain", "--steps", steps, "--time-step", 0.001, "--out", f"{steps}.png", "--size", "96x64",
                        "--set", "view.camera.position=[3, -3, 1]", "--set", "view.camera.target=[0, 0, 0]")
        pictures = {(self.folder / f"{steps}.png").read_bytes() for steps in (0, 30, 100)}
        self.assertEqual(len(pictures), 3)

    def test_a_checkpoint_is_its_moment_and_goes_on_where_it_is_told(self):
        size = ("--size", "96x64")
        self.pliant("run", "chain", "--steps", 10, "--out", "run", "--quiet")
        self.render("run/checkpoint.pliant", "--out", "now.png", *size)
        self.render("chain", "--steps", 10, "--frames", 1, "--out", "whole.png", *size)
        self.pliant("run", "chain", "--steps", 20, "--out", "later", "--quiet")
        self.render("later/checkpoint.pliant", "--out", "later.png", *size)
        now, later = ((self.folder / name).read_bytes() for name in ("now.png", "later.png"))
        self.assertNotEqual(now, later)
        done = self.render("run/checkpoint.pliant", "--steps", 40, "--frames", 3, "--sheet", "--out", "on.png", *size)
        self.assertIn("3 frames", done.stdout)
        for words, remedy in ((("--out", "a.mp4"), "give --out a .png, or --steps"),
                              (("--out", "a.png", "--set", "gravity=null"), "change the scene file, and run it"),
                              (("--out", "a.png", "--backend", "eigen"), "change the scene file, and run it"),
                              (("--out", "a.png", "--color", "gap"), "give another color, or --steps 11"),
                              (("--out", "a.png", "--color", "contact_force"), "give another color, or --steps 11"),
                              (("--out", "a.png", "--steps", 5), "10 have been taken")):
            self.assertIn(remedy, self.render("run/checkpoint.pliant", *words, expect=2).stderr)

    def test_a_run_whose_scene_is_gone_is_shown_all_the_same(self):
        self.pliant("run", "chain", "--steps", 4, "--out", "run", "--quiet")
        (self.folder / "run" / "checkpoint.pliant").write_text("damaged")
        done = self.render("run", "--out", "run.png", "--size", "96x64")
        self.assertIn("note: the view of the scene is not known", done.stderr)
        self.render("run", "--out", "run.png", "--set", "view.ground=false", expect=2)

    def test_a_narrow_picture_has_no_legend(self):
        self.render("curtain", "--steps", 5, "--out", "c.png", "--size", "60x400", "--color", "speed", "--set",
                    "view.ground=false")
        self.assertGreater(len(colors(read_png(self.folder / "c.png")[2])), 30)

    def test_slips_name_the_option(self):
        for words, message in ((["--out", "film.avi"], "--out: 'film.avi' has no known ending"),
                               (["--out", "film"], "--out: 'film' has no known ending"),
                               (["--out", "c.png", "--size", "640"], "--size: '640' is not a size"),
                               (["--out", "c.png", "--size", "8x8"], "--size: '8x8' is not a size"),
                               (["--out", "c.png", "--size", "99999999999x9"], "--size: '99999999999x9' is not a size"),
                               (["--out", "c.png", "--fps", "0"], "--fps: '0' is out of range; give a whole number from 1 up to 240"),
                               (["--out", "c.png", "--fps", "2.5"], "--fps: '2.5' is not a number of that kind; give a whole"),
                               (["--out", "c.png", "--samples", "99"], "--samples: '99' is out of range; give a whole"),
                               (["--out", "c.png", "--frames", "0"], "--frames: '0' is out of range; give a whole"),
                               (["--out", "c.mp4", "--sheet"], "--sheet: the frames of a sheet are one picture"),
                               (["--out", "c.png", "--turntable"], "--turntable: a single picture does not turn"),
                               (["--out", "c.mp4", "--steps", "0", "--turntable"], "--turntable: all frames show the same time")):
            with self.subTest(words):
                self.assertIn(message, self.render("chain", *words, expect=2).stderr)
        self.assertIn("neither a file nor a built-in scene", self.render("chian", "--out", "c.png", expect=2).stderr)
        self.assertIn("no-folder", self.render("chain", "--steps", 1, "--size", "32x32", "--out", "no-folder/c.png",
                                               expect=4).stderr)
        self.assertEqual(self.files(), [])

    def test_without_opengl_that_is_said(self):
        done = self.render("chain", "--steps", 1, "--out", "c.png", expect=2,
                           environment={"__EGL_VENDOR_LIBRARY_DIRS": str(self.folder)})
        self.assertIn("OpenGL: ", done.stderr)
        self.assertIn("install libegl1 and libgl1-mesa-dri", done.stderr)
        self.assertEqual(self.files(), [])

    def test_an_interrupt_leaves_no_film(self):
        command = [PLIANT, "render", "curtain", "--steps", "100000", "--out", "film.mp4", "--size", "64x48"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   cwd=self.folder, env=ENVIRONMENT)
        wait_until_caught(process, signal.SIGINT)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("interrupted: nothing was written", said)
        # In the middle of a step that would take hours.
        process = subprocess.Popen([PLIANT, "render", "curtain", "--iterations", "100000000", "--out", "film.mp4"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                   env=ENVIRONMENT)
        wait_until_caught(process, signal.SIGTERM)
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("interrupted: ", said)
        self.assertEqual(self.files(), [])

    def start_film(self):
        """A render that ffmpeg works for, and the number of ffmpeg's process."""
        process = subprocess.Popen([PLIANT, "render", "curtain", "--steps", "600", "--out", "film.mp4", "--samples", "1"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder,
                                   env=ENVIRONMENT)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline and process.poll() is None:
            for child in children.read_text().split():
                if pathlib.Path(f"/proc/{child}/comm").read_text() == "ffmpeg\n":
                    return process, int(child)
            time.sleep(0.005)
        self.fail("no ffmpeg was started")

    def test_a_killed_render_leaves_nothing(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("ffmpeg is not installed")
        for signals in ([signal.SIGINT, signal.SIGINT], [signal.SIGKILL]):
            with self.subTest(signals=signals):
                process, ffmpeg = self.start_film()
                time.sleep(0.2)
                for sent in signals:
                    process.send_signal(sent)
                self.assertIn(process.wait(timeout=60), (-signals[-1], 130))
                deadline = time.monotonic() + 60
                while time.monotonic() < deadline and pathlib.Path(f"/proc/{ffmpeg}").exists():
                    time.sleep(0.01)
                self.assertEqual(self.files(), [])

    def test_the_next_render_removes_what_a_killed_one_left(self):
        names = ["c.png.pliant.tmp-0", "c-0007.png.pliant.tmp-2"]
        for name in [*names, "notes.pliant.tmp-0"]:
            (self.folder / name).write_text("half")
        self.render("chain", "--steps", 1, "--out", "c.png", "--size", "32x32")
        self.assertEqual(self.files(), ["c.png", "notes.pliant.tmp-0"])


if __name__ == "__main__":
    unittest.main()
