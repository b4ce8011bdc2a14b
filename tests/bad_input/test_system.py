"""A system that gives less than is asked for: files that are none, places that cannot be written, full disks, closed
streams, limits, strange environments and names."""
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
import unittest

import numpy

import hostile
from hostile import (DONE, INPUT, INTERRUPTED, OUTPUT, PLIANT, SOURCE, Case, HostileTest, run_program, run_scene_case,
                     scene_of, sub_commands)

SCENE = scene_of({"shape": "grid", "columns": 4, "rows": 4}, {"type": "edge_spring"}, steps=3)
FILES = {"scene.json": SCENE}
RUN = ["run", "scene.json", "--out", "out"]


# ---- makers of what is no file

def folder(path):
    path.mkdir()


def fifo(path):
    os.mkfifo(path)


def unix_socket(path):
    here = os.getcwd()
    os.chdir(path.parent)  # a socket's name is short
    try:
        with socket.socket(socket.AF_UNIX) as there:
            there.bind(path.name)
    finally:
        os.chdir(here)


def link_to(target):
    return lambda path: path.symlink_to(target)


def sparse(size):
    def make(path):
        with open(path, "wb") as file:
            file.truncate(size)
    return make


NO_FILES = {"a folder": folder, "a pipe": fifo, "a socket": unix_socket, "a dangling link": link_to("nowhere"),
            "a link to itself": link_to("thing"), "a link into a loop": link_to("thing/thing"), "nothing": None,
            "/dev/zero": link_to("/dev/zero"), "/dev/null": link_to("/dev/null"), "/dev/full": link_to("/dev/full"),
            "/dev/urandom": link_to("/dev/urandom"), "/dev/tty": link_to("/dev/tty"), "/dev/stdin": link_to("/dev/stdin"),
            "/proc/self/mem": link_to("/proc/self/mem"), "/proc/kmsg": link_to("/proc/kmsg"), "/proc": link_to("/proc"),
            "/proc/cpuinfo": link_to("/proc/cpuinfo"), "/sys/kernel/notes": link_to("/sys/kernel/notes"),
            "a hole of 100 MB": sparse(100 << 20)}


def shell(script):
    """Runs the rest of the command line as "$@"."""
    return ["bash", "-c", script, "bash"]


def limited(limits):
    return ["prlimit", *limits.split(), "--"]


class Files(HostileTest):
    def cases(self, name, make):
        files = {} if make is None else {"thing": make}
        yield Case(f"{name} as a scene", ["run", "thing", "--out", "out"], files, expect=(INPUT,), place="thing")
        yield run_scene_case(f"{name} as a mesh", scene_of({"file": "thing"}), files=files, expect=(INPUT,), says="thing")
        for command in set(sub_commands()) - {"run", "scenes", "schema"}:
            yield Case(f"{name} for {command}", [command, "thing"], files, expect=(INPUT, OUTPUT))

    def test_what_is_no_file(self):
        self.attack(case for name, make in NO_FILES.items() for case in self.cases(name, make))

    @unittest.skipIf(hostile.is_sanitized(), "a sanitizer has no memory that ends")
    def test_a_hole_larger_than_the_memory(self):
        self.attack(case for case in self.cases("a hole of 1 PB", sparse(1 << 43)))

    def test_meshes_in_strange_places(self):
        places = ["", ".", "..", "/", "thing.obj/", "./././thing.obj/x", "/dev/null/x", "~/thing.obj", "http://example.org/thing.obj",
                  "a" * 255 + ".obj", "a" * 256, "a/" * 3000 + "thing.obj", "a" * 1000000, "\n", "two\nlines.obj", "\x1b[31mred.obj",
                  "\u202egpj.obj", "\u0085", "thing.obj\0", "\0", "nothing.obj\0.obj", "%s", "{}", "$HOME", "`id`", "\ud800", "C:\\thing.obj",
                  "\\\\server\\thing.obj", "-", "--help", "*", "thing.OBJ", " thing.obj", "thing.obj "]
        files = {"thing.obj": "v 0 0 0\n"}
        self.attack(run_scene_case(f"mesh in {place!r:.40}", json.dumps(scene_of({"file": place})), files=files, expect=(INPUT,))
                    for place in places)

    def test_names_of_scenes(self):
        names = ["two\nlines", "\x1b[31mred", "tab\t", "\u202ertl", " blanks  ", "-dash", "--dashes", "'quotes\"", "%n%s", "{}", "\\", "a" * 250,
                 "ü", "\U0001f9f5", b"\xff\xfe", b"\xc3", "colon:1", "comma,", "*?[", "$(id)", "~", "#", "trailing.", "..json"]
        wrong = dict(SCENE, stepz=1)
        def cases():
            for name in names:
                text = os.fsdecode(name)
                path = text if not text.startswith("-") else "./" + text
                yield Case(f"scene {name!r:.40}", ["run", path, "--out", "out"], {text: SCENE}, expect=(DONE,))
                yield Case(f"scene {name!r:.40} by default", ["run", path], {text: SCENE}, expect=(DONE,), out="elsewhere")
                yield Case(f"wrong scene {name!r:.40}", ["run", path], {text: wrong}, expect=(INPUT,), says="stepz: unknown key")
        self.attack(cases())

    def test_names_in_the_scene(self):
        names = ["two\nlines", "\x1b[31mred", "\r", "\u0085\u009b", "\u202ertl", "a,b", "\"", "", " ", "\0", "x" * 100000,
                 "\U0001f9f5" * 300, "{}", "%s%n", "../../x", "/etc/passwd"]
        def scenes(name):
            yield scene_of({"shape": "grid"}, {"type": "bending"}, body={"name": name})  # warns of what is left out
            yield scene_of({"shape": "grid"}, {"type": "bending", "name": name}, body={"name": "b"})
            yield scene_of({"shape": "grid"}, name=name, description=name)
            yield scene_of({"shape": "grid"}, output={"format": "obj"}, body={"name": name})
            yield scene_of({"shape": "grid"}, {"type": name})
            yield scene_of({"shape": name})
            yield scene_of({"shape": "grid"}, forces=[{"type": "wind", "body": name}])
            yield scene_of({"shape": "grid"}, {"type": "position", "name": name, "on": [0]}, {"type": "edge_spring", "name": name})
        self.attack(run_scene_case(f"name {name!r:.40} in {i}", scene, expect=(DONE, INPUT)) for name in names
                    for i, scene in enumerate(scenes(name)))

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("setpriv"), "only root can become someone else")
    def test_what_may_not_be_read_or_written(self):
        someone = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--"]
        if subprocess.run([*someone, PLIANT, "--version"], capture_output=True).returncode != 0:
            self.skipTest("others may not run the program")
        def closed(contents):
            def make(path):
                path.write_text(contents)
                path.chmod(0)
            return make
        def closed_folder(path):
            path.mkdir()
            (path / "scene.json").write_text(json.dumps(SCENE))
            path.chmod(0)
        def opened(path):
            path.parent.chmod(0o777)
        self.attack([
            Case("scene", RUN, {"scene.json": closed(json.dumps(SCENE))}, expect=(INPUT,), says="permission", place="scene.json",
                 launcher=someone),
            Case("mesh", RUN, {"scene.json": scene_of({"file": "a.obj"}), "a.obj": closed("v 0 0 0\n")}, expect=(INPUT,),
                 says="a.obj.*permission", launcher=someone),
            Case("folder", ["run", "closed/scene.json"], {"closed": closed_folder}, expect=(INPUT,), says="permission",
                 launcher=someone),
            Case("nowhere to write", RUN, {"scene.json": SCENE}, expect=(OUTPUT,), place="out", launcher=someone),
            Case("a folder of another's", RUN, {"scene.json": SCENE, "out": folder, "open": opened}, expect=(OUTPUT,),
                 place="out", launcher=someone),
            Case("fine", RUN, {"scene.json": SCENE, "open": opened}, expect=(DONE,), launcher=someone)])


class Output(HostileTest):
    def test_places_that_are_no_folder(self):
        def written(path):
            path.write_text("mine")
        makers = {"a file": written, "a pipe": fifo, "a dangling link": link_to("nowhere/out"), "a loop": link_to("out"),
                  "a device": link_to("/dev/null"), "a full device": link_to("/dev/full"), "/proc": link_to("/proc")}
        self.attack((Case(name, RUN, FILES | {"out": make}, expect=(OUTPUT,), place="out") for name, make in makers.items()),
                    (Case(f"--out {place!r:.40}", ["run", "scene.json", "--out", place], FILES, expect=(OUTPUT,))
                     for place in ["/proc/out", "/dev/null/out", "scene.json", "scene.json/out", "a" * 256, "a/" * 3000, "/sys/x",
                                   "\x1b[31m" * 60]))

    def test_files_that_are_no_files(self):
        makers = {"a folder": folder, "a pipe": fifo, "a full device": link_to("/dev/full"),
                  "a link to itself": lambda path: path.symlink_to(path.name), "a link to nowhere": link_to("nowhere/x")}
        def cases():
            for name in ("frames.npy", "measurements.csv", "run.json"):
                for what, make in makers.items():
                    if name != "run.json" or what not in ("a folder", "a link to itself"):  # those are replaced
                        yield Case(f"{name} is {what}", RUN, FILES | {f"out/{name}": make}, expect=(OUTPUT,), says="cannot be written")
        self.attack(cases())

    def test_the_results_of_before_stay_when_the_scene_is_wrong(self):
        folder = self.folder
        hostile.write_file(folder / "scene.json", SCENE)
        self.assertEqual(run_program(RUN, folder).code, DONE)
        before = {path.name: path.read_bytes() for path in (folder / "out").iterdir()}
        self.assertLessEqual({"frames.npy", "measurements.csv", "run.json"}, set(before))
        for wrong in ("", "{}", dict(SCENE, steps=-1), scene_of({"file": "nothing.obj"})):
            hostile.write_file(folder / "scene.json", wrong)
            self.assertEqual(run_program(RUN, folder).code, INPUT)
            self.assertEqual({path.name: path.read_bytes() for path in (folder / "out").iterdir()}, before)

    @unittest.skipUnless(os.geteuid() == 0, "only root can mount")
    def test_full_and_read_only_disks(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", disk], capture_output=True).returncode != 0:
            self.skipTest("mounting is not permitted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        out = ["run", "scene.json", "--out", disk / "out"]
        self.attack([Case("full", [*out, "--steps", "1000"], FILES, expect=(OUTPUT,), says="[Nn]o space"),
                     Case("full, OBJ", [*out, "--steps", "1000", "--format", "obj"], FILES, expect=(OUTPUT,), says="[Nn]o space"),
                     Case("full, no frames", [*out, "--steps", "1000", "--format", "none"], FILES, expect=(OUTPUT,),
                          says="[Nn]o space", place="measurements.csv")])
        self.assertFalse([path for path in disk.rglob("*") if ".tmp-" in path.name])
        (disk / "filler").write_bytes(b"x" * (os.statvfs(disk).f_bavail * os.statvfs(disk).f_frsize))
        self.attack([Case("full from the first byte", ["run", "scene.json", "--out", disk / "another"], FILES, expect=(OUTPUT,))])
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        self.attack([Case("read-only", ["run", "scene.json", "--out", disk / "other"], FILES, expect=(OUTPUT,), says="[Rr]ead-only")])

    def test_file_size_limits(self):
        """The limit holds for files, and the standard error goes through a pipe."""
        def launcher(size):
            return shell(f'prlimit --fsize={size} "$@" 2>&1 >&- | cat >&2; exit ${{PIPESTATUS[0]}}')
        self.attack(Case(f"{size} bytes, {form}", [*RUN, "--steps", "30", "--format", form], FILES, expect=(DONE, OUTPUT),
                         launcher=launcher(size))
                    for size in (0, 1, 127, 128, 129, 511, 512, 1000, 4096, 20000) for form in ("npy", "obj", "none"))


class Streams(HostileTest):
    def test_closed_streams(self):
        self.attack((Case(f"{streams} {words[0]}", words, FILES, expect=(DONE, OUTPUT), launcher=shell(f'exec "$@" {streams}'))
                     for streams in ("<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-", ">&- 2>&-", "> /dev/full", "2> /dev/full")
                     for words in (RUN, ["scenes"], ["--version"], ["--help"])),
                    (Case(f"{streams}, wrong", ["run", "x"], FILES, expect=(INPUT, OUTPUT), launcher=shell(f'exec "$@" {streams}'),
                          streams={"stderr": subprocess.DEVNULL})
                     for streams in ("2>&-", "<&- >&- 2>&-", "2> /dev/full")))

    def test_a_pipe_that_nobody_reads_is_no_news(self):
        """The reader has gone, as `pliant scenes | head -1` has it: nothing is said of it."""
        for words in (["scenes"], ["--help"], RUN, *([command, "--help"] for command in sub_commands())):
            with self.subTest(words=words):
                reader, writer = os.pipe()
                os.close(reader)
                hostile.write_file(self.folder / "scene.json", SCENE)
                ending = run_program(words, self.folder, Case("", words, streams={"stdout": writer}))
                os.close(writer)
                self.assertEqual(ending.stderr, b"")
                self.assertIn(ending.code, (DONE, OUTPUT))

    def test_errors_into_a_pipe_that_nobody_reads(self):
        reader, writer = os.pipe()
        os.close(reader)
        ending = run_program(["run", "x"], self.folder, Case("", [], streams={"stderr": writer}))
        os.close(writer)
        self.assertEqual(ending.code, INPUT)

    def test_standard_output_into_the_scene_is_not_read(self):
        self.attack([Case("scene from a pipe", ["run", "/dev/stdin"], expect=(INPUT,), launcher=shell('echo {} | "$@"')),
                     Case("scene from a closed stream", ["run", "/dev/stdin"], expect=(INPUT,), launcher=shell('"$@" <&-'))])


class Environment(HostileTest):
    ENVIRONMENTS = {
        "empty": {}, "no HOME": None, "no PATH": {"HOME": "/"}, "HOME is no place": {"HOME": "/nowhere"}, "HOME is empty": {"HOME": ""},
        "an unknown locale": {"LC_ALL": "xx_XX.UTF-8"}, "a locale of nonsense": {"LC_ALL": "\x1b" * 1000, "LANG": "%s"},
        "C": {"LC_ALL": "C"}, "TMPDIR is no place": {"TMPDIR": "/nowhere"}, "no terminal": {"TERM": ""},
        "one thread": {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
        "nonsense threads": {"OPENBLAS_NUM_THREADS": "-1", "GOTO_NUM_THREADS": "1e9"},
        "a thousand threads": {"OPENBLAS_NUM_THREADS": "1000", "OMP_NUM_THREADS": "1000"},
        "memory filled with ones": {"MALLOC_PERTURB_": "255"}, "memory filled with 1": {"MALLOC_PERTURB_": "1"},
        "large": {f"VARIABLE_{i}": "x" * 1000 for i in range(1000)},
    }

    def frames(self, environment=None, launcher=()):
        """Those of a run with everything in it, to the bit."""
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            path = pathlib.Path(name)
            hostile.write_file(path / "scene.json", scene_of(
                {"shape": "grid", "columns": 5, "rows": 5}, {"type": "triangle_strain"}, {"type": "bending"}, {"type": "hinge"},
                {"type": "position", "on": [0, 4]}, forces=[{"type": "wind", "gust_strength": 0.5}], steps=5))
            ending = run_program(RUN, path, Case("", RUN, environment=environment, launcher=list(launcher)))
            self.assertEqual((ending.code, ending.stderr.replace(b"warning", b"")[:1]), (DONE, b":"), ending.stderr)
            table = (path / "out" / "measurements.csv").read_text().splitlines()
            self.assertEqual({row.count(",") for row in table}, {table[0].count(",")})
            return (path / "out" / "frames.npy").read_bytes()

    def test_the_same_result_in_every_environment(self):
        expected = self.frames()
        for name, changes in self.ENVIRONMENTS.items():
            with self.subTest(environment=name):
                if changes is None:
                    environment = {key: value for key, value in os.environ.items() if key != "HOME"}
                else:
                    environment = changes
                self.assertEqual(self.frames(environment), expected)

    @unittest.skipUnless(shutil.which("localedef"), "no localedef to make a locale with")
    def test_a_locale_with_decimal_commas(self):
        locales = self.folder / "locales"
        locales.mkdir()
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locales / "de_DE.UTF-8"], capture_output=True)
        if not (locales / "de_DE.UTF-8").exists():
            self.skipTest(f"no German locale can be made: {made.stderr}")
        german = {"LOCPATH": str(locales), "LC_ALL": "de_DE.UTF-8"}
        said = subprocess.run(["bash", "-c", "printf %.1f 1,5"], env=german, capture_output=True, text=True).stdout
        self.assertEqual(said, "1,5")
        self.assertEqual(self.frames(german), self.frames())
        mesh = {"mesh.obj": "v 0.5 0.25 1e-3\nv 1.5 0 0\nv 0 1.5 0\nf 1 2 3\n"}
        self.attack([run_scene_case("points", scene_of({"file": "mesh.obj"}), files=mesh, environment=german, expect=(DONE,)),
                     run_scene_case("OBJ frames", scene_of({"file": "mesh.obj"}, output={"format": "obj"}), files=mesh,
                                    environment=german, expect=(DONE,)),
                     Case("option", [*RUN, "--time-step", "0.01"], FILES, environment=german, expect=(DONE,)),
                     Case("comma", [*RUN, "--time-step", "0,01"], FILES, environment=german, expect=(INPUT,)),
                     run_scene_case("comma in OBJ", scene_of({"file": "mesh.obj"}), files={"mesh.obj": "v 0,5 0 0\n"},
                                    environment=german, expect=(INPUT,), says="0,5")])

    def test_a_folder_that_is_gone(self):
        gone = shell('mkdir gone && cd gone && rmdir ../gone && exec "$@"')
        self.attack([Case("scene in it", RUN, launcher=gone, expect=(INPUT,)),
                     Case("output in it", ["run", "chain", "--steps", "1"], launcher=gone, expect=(OUTPUT,)),
                     Case("nothing in it", ["scenes"], launcher=gone, expect=(DONE,))])


class Limits(HostileTest):
    def test_address_space(self):
        """Libraries may not even load; then the loader says so with its own 127."""
        self.attack(Case(f"{size} MB, {words[1]}", words, FILES, expect=(DONE, INPUT), launcher=limited(f"--as={size << 20}"),
                         plain_only=True)
                    for size in (100, 120, 140, 160, 180, 200, 250, 300, 400, 500, 700, 1000)
                    for words in (RUN, ["run", "curtain", "--steps", "1", "--out", "out"], [*RUN, "--threads", "64"]))

    def test_other_limits(self):
        limits = ["--nofile=4", "--nofile=5", "--nofile=6", "--nofile=10", "--stack=65536", "--stack=131072", "--stack=1000000",
                  "--stack=unlimited", "--core=0", "--memlock=0", "--nproc=1", "--data=100000000", "--rss=1000000", "--nice=0"]
        self.attack(Case(limit, words, FILES, expect=(DONE, INPUT, OUTPUT), launcher=limited(limit), plain_only=True)
                    for limit in limits for words in (RUN, [*RUN, "--format", "obj"], [*RUN, "--threads", "8"], ["scenes"]))

    def test_processor_time(self):
        self.attack([Case("one second", [*RUN, "--steps", "100000000", "--every", "1000000"], FILES, expect=(INTERRUPTED,),
                          launcher=limited("--cpu=1:3"), plain_only=True)])

    def test_deep_scene_on_a_small_stack(self):
        self.attack([run_scene_case("deep", "[" * 1000000, launcher=limited("--stack=65536"), expect=(INPUT,), plain_only=True)])


if __name__ == "__main__":
    hostile.main()
