"""What `pliant convert` reads beside meshes: point caches and the folders of runs; and what it is asked to write."""
import functools
import io
import itertools
import json
import pathlib
import random
import re
import struct
import tempfile
import zlib

import numpy

import hostile
from hostile import (DONE, INPUT, LEGAL, OUTPUT, Case, HostileTest, options_of, run_program, scene_of, write_file)
from meshes import VERTICES, obj

FRAMES = 3
EXTREMES = [0, 1, -1, 2**31 - 1, -2**31, 2**16, 0x7f800000, 0x7fc00000, 0x7149f2ca]  # the last three: inf, nan, 1e30


def numbers(order):
    return b"".join(struct.pack(order + "3f", *(x + 0.1 * frame for x in vertex))
                    for frame in range(FRAMES) for vertex in VERTICES)


def pc2():
    return b"POINTCACHE2\0" + struct.pack("<iiffi", 1, len(VERTICES), 0, 1, FRAMES) + numbers("<")


def mdd():
    return struct.pack(">ii", FRAMES, len(VERTICES)) + struct.pack(f">{FRAMES}f", 0, 0.1, 0.2) + numbers(">")


def npy(array):
    stream = io.BytesIO()
    numpy.save(stream, array)
    return stream.getvalue()


def frames(kind="<f8"):
    return numpy.array([[[x + 0.1 * frame for x in vertex] for vertex in VERTICES] for frame in range(FRAMES)], dtype=kind)


CACHES = {"pc2": pc2(), "mdd": mdd(), "npy": npy(frames())}

# Arrays that are no frames, or of another kind.
ARRAYS = {
    "two dimensions": frames()[0], "one dimension": frames().reshape(-1), "four dimensions": frames()[None], "none": numpy.float64(1),
    "no frame": frames()[:0], "no vertex": frames()[:, :0], "two coordinates": frames()[:, :, :2], "complex": frames().astype("c16"),
    "integers": frames().astype("i8"), "truth values": frames().astype("?"), "half": frames("<f2"), "texts": frames().astype("U9"),
    "long double": frames().astype("g"), "records": numpy.zeros((3, 4, 3), dtype=[("x", "f8")]), "times": frames().astype("M8[s]"),
    "Fortran": numpy.asfortranarray(frames()), "big end first": frames(">f8"), "float32": frames("<f4"),
    "NaN": frames() * numpy.nan, "infinite": frames() + numpy.inf, "1e300": frames() + 1e300, "denormal": frames() * 1e-310,
}
HEADERS = [
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4, 3), }", "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4, 3)",
    "{'descr': '<f8', 'shape': (3, 4, 3), }", "{'descr': '<f8', 'fortran_order': False, 'shape': (-3, 4, 3), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (4611686018427387904, 4, 3), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (18446744073709551617, 4, 3), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (2147483648, 2147483648, 3), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4, 3, ), }", "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 4, 3), }",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 0, 3), }", "{'descr': '<f8', 'fortran_order': maybe, 'shape': (3, 4, 3), }",
    "{'descr': '|O', 'fortran_order': False, 'shape': (3, 4, 3), }", "{'descr': '<f99', 'fortran_order': False, 'shape': (3, 4, 3), }",
    "{" * 1000, "", "x" * 10000, "{'shape': " + "(" * 1000, "{'descr': '<f8', 'descr': '<f4', 'fortran_order': False, 'shape': (3, 4, 3), }",
]


def npy_of_header(text, version=b"\x01\x00"):
    head = text.encode().ljust(-(-(len(text) + 11) // 64) * 64 - 10)
    length = struct.pack("<H" if version[0] == 1 else "<I", len(head) % 65536)
    return b"\x93NUMPY" + version + length + head + frames().tobytes()


@functools.cache
def run_folder():
    """The files of a small run, by name."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_file(folder / "scene.json", scene_of({"shape": "grid", "columns": 3, "rows": 3}, {"type": "edge_spring"}))
        ending = run_program(["run", "scene.json", "--out", "out"], folder)
        assert ending.code == DONE, ending.stderr
        return {path.name: path.read_bytes() for path in (folder / "out").iterdir()}


def cut(contents):
    """Every length of what is short, and 150 of what is long."""
    lengths = range(len(contents)) if len(contents) < 300 else [*range(100), *range(100, len(contents), len(contents) // 50)]
    return ((f"the first {n} bytes", contents[:n]) for n in lengths)


def changed_bytes(contents, seed):
    draw = random.Random(seed)
    for place in range(min(len(contents), 160)):
        byte = draw.choice([0, 1, 0x7f, 0x80, 0xff, contents[place] ^ 1 << draw.randrange(8)])
        yield f"byte {place} is {byte}", contents[:place] + bytes([byte]) + contents[place + 1:]


def changed_words(contents, count=16):
    """Each of the first four-byte numbers replaced, in either order of bytes."""
    for place in range(0, 4 * count, 4):
        for value in EXTREMES if place < 32 else EXTREMES[-3:]:
            for order in "<>":
                word = struct.pack(order + "I", value & 0xffffffff)
                yield f"{value} at {place} {order}", contents[:place] + word + contents[place + 4:]


def wrong_files(contents):
    yield from (("empty", b""), ("a byte more", contents + b"\0"), ("twice", contents * 2), ("NULs", b"\0" * len(contents)),
                ("ones", b"\xff" * len(contents)), ("text", b"frame 1\n" * 20), ("turned round", contents[::-1]))
    yield from cut(contents)


def converted(name, files, source, out="out.obj", *options, **more):
    """The error names the input, the mesh or the output."""
    names = "|".join([re.escape(source), "thing", re.escape(out)])
    options = (*options, "--yes") if out.endswith("glb") else options
    return Case(name, ["convert", source, out, *options], files, **({"expect": LEGAL, "says": names, "out": "none"} | more))


def cache_case(name, suffix, contents, *options, **more):
    """To one format or another, with the mesh that it moves or, where that can be, every other time without."""
    file = f"cache.{suffix}"
    out = ("out.glb", "out.mdd", "out##.obj", "out.usda")[len(name) % 4]
    mesh = () if out == "out.mdd" and zlib.crc32(name.encode()) % 2 else ("--mesh", "thing.obj")
    return converted(f"{suffix}: {name} to {out}", {file: contents, "thing.obj": obj()}, file, out, *mesh, *options, **more)


class Caches(HostileTest):
    def test_sound(self):
        self.attack([*(cache_case(f"sound{' ' * i}", suffix, contents, expect=(DONE,)) for suffix, contents in CACHES.items()
                       for i in range(4)),
                     *(cache_case(name, "npy", npy(ARRAYS[name]), expect=(DONE,)) for name in ("float32", "denormal"))])

    def test_wrong_files(self):
        self.attack(cache_case(name, suffix, wrong) for suffix, contents in CACHES.items() for name, wrong in wrong_files(contents))

    def test_cut_files_are_refused(self):
        self.attack(cache_case(name, suffix, wrong, expect=(INPUT,)) for suffix, contents in CACHES.items() for name, wrong in
                    cut(contents))

    def test_other_bytes_and_numbers(self):
        self.attack((cache_case(name, suffix, wrong) for suffix, contents in CACHES.items()
                     for name, wrong in changed_bytes(contents, seed=3)),
                    (cache_case(name, suffix, wrong) for suffix, contents in CACHES.items() if suffix != "npy"
                     for name, wrong in changed_words(contents)))

    def test_other_arrays(self):
        self.attack((cache_case(name, "npy", npy(array)) for name, array in ARRAYS.items()),
                    (cache_case(f"header {text:.60}", "npy", npy_of_header(text, version))
                     for text in HEADERS for version in (b"\x01\x00", b"\x02\x00", b"\x03\x00", b"\x00\x00", b"\xff\xff")))

    def test_a_mesh_of_another_size(self):
        more = obj() + b"v 1 1 1\n"
        self.attack(Case(f"{suffix}", ["convert", f"cache.{suffix}", out, "--mesh", "more.obj"],
                         {f"cache.{suffix}": contents, "more.obj": more}, expect=(INPUT,), says="5|4")
                    for suffix, contents in CACHES.items() for out in ("out.glb", "out.usda", "out.ply"))

    def test_counts_of_what_is_not_there(self):
        """Memory is for what the file holds, not for what it says."""
        many = 2**31 - 1
        self.attack([cache_case("counts", "pc2", b"POINTCACHE2\0" + struct.pack("<iiffi", 1, many, 0, 1, many), expect=(INPUT,)),
                     cache_case("counts", "mdd", struct.pack(">ii", many, many), expect=(INPUT,)),
                     cache_case("frames", "mdd", struct.pack(">ii", many, 1) + bytes(1000), expect=(INPUT,)),
                     cache_case("no vertices", "pc2", b"POINTCACHE2\0" + struct.pack("<iiffi", 1, 0, 0, 1, many), expect=(INPUT,)),
                     cache_case("no vertices", "mdd", struct.pack(">ii", 10**6, 0) + bytes(4 * 10**6), expect=(INPUT,))])


class Runs(HostileTest):
    def run_case_of(self, name, changes, out="out.glb", **more):
        files = {f"run/{file}": contents for file, contents in (run_folder() | changes).items() if contents is not None}
        return converted(name, files, "run", out, **more)

    def test_sound(self):
        self.attack(self.run_case_of(out, {}, out, expect=(DONE,)) for out in ("out.glb", "out.usda", "out.pc2", "f##.ply"))

    def test_wrong_files(self):
        names = sorted(run_folder())
        self.assertIn("run.json", names)
        self.attack((self.run_case_of(f"without {file}", {file: None}) for file in names),
                    (self.run_case_of(f"{file} {name}", {file: wrong}) for file in names for name, wrong in wrong_files(run_folder()[file])),
                    (self.run_case_of(f"{file} {name}", {file: wrong}) for file in names
                     for name, wrong in changed_bytes(run_folder()[file], seed=5)))

    def test_other_values_in_run_json(self):
        info = json.loads(run_folder()["run.json"])
        def changes():
            for key in info:
                for value in (None, "", "x", -1, 0, 1e308, 2**63, [], {}, [{}], [None], True):
                    yield f"{key} = {value}", info | {key: value}
                yield f"without {key}", {k: v for k, v in info.items() if k != key}
                for inner in info[key] if isinstance(info[key], dict) else ():
                    for value in (None, "x", -1, 1e308, 2**40, []):
                        yield f"{key}.{inner} = {value}", info | {key: info[key] | {inner: value}}
            for key in info["bodies"][0]:
                for value in (None, "x", -1, 0, 1, 2**31, 1e308, []):
                    yield f"bodies[0].{key} = {value}", info | {"bodies": [info["bodies"][0] | {key: value}]}
        self.attack(self.run_case_of(name, {"run.json": json.dumps(change)}) for name, change in changes())


class Resumed(HostileTest):
    """A run goes on from its folder, or says which of its files is not as it was left."""

    def resumed(self, name, changes, steps=4, **more):
        files = {f"run/{file}": contents for file, contents in (run_folder() | changes).items() if contents is not None}
        return Case(name, ["resume", "run", "--steps", steps], files, **({"out": "none", "place": "run"} | more))

    def test_sound(self):
        self.attack([self.resumed("as it was", {}, expect=(DONE,)), self.resumed("no more steps", {}, steps=2),
                     self.resumed("fewer steps", {}, steps=1, expect=(INPUT,))])

    def test_a_checkpoint_that_was_cut_or_changed_is_refused_by_name(self):
        checkpoint = run_folder()["checkpoint.pliant"]
        draw = random.Random(9)
        flipped = ((f"byte {i} flipped", checkpoint[:i] + bytes([checkpoint[i] ^ 1 << draw.randrange(8)]) + checkpoint[i + 1:])
                   for i in range(len(checkpoint)))
        lengths = ((f"the first {n} bytes", checkpoint[:n]) for n in range(0, len(checkpoint), 3))
        others = [("empty", b""), ("twice", checkpoint * 2), ("a byte more", checkpoint + b"\0"), ("text", b"{}")]
        self.attack(self.resumed(name, {"checkpoint.pliant": contents}, expect=(INPUT,), place="checkpoint.pliant")
                    for name, contents in itertools.chain(flipped, lengths, others))

    def test_other_files_that_were_cut_or_changed(self):
        names = sorted(set(run_folder()) - {"checkpoint.pliant"})
        self.attack((self.resumed(f"without {file}", {file: None}, expect=(DONE, INPUT)) for file in run_folder()),
                    (self.resumed(f"{file} {name}", {file: wrong}, expect=(DONE, INPUT)) for file in names
                     for name, wrong in list(wrong_files(run_folder()[file]))[::4]),
                    (self.resumed(f"{file} {name}", {file: wrong}, expect=(DONE, INPUT)) for file in names
                     for name, wrong in list(changed_bytes(run_folder()[file], seed=6))[::4]))


class Written(HostileTest):
    FILES = {"thing.obj": obj(), "cache.pc2": pc2(), "full.obj": lambda path: path.symlink_to("/dev/full"),
             "pipe.obj": lambda path: hostile.os.mkfifo(path), "folder.obj": lambda path: path.mkdir()}

    def test_places(self):
        outs = ["", ".", "/", "out", "out.", ".obj", "out.xyz", "out.obj.gz", "nowhere/out.obj", "thing.obj", "./thing.obj", "full.obj",
                "pipe.obj", "folder.obj", "/dev/null", "/dev/full", "/proc/x.obj", "thing.obj/x.obj", "a" * 256 + ".obj",
                "a/" * 3000 + "x.obj", "\x1b[31m.obj", "two\nlines.obj", b"\xff.obj", "#.obj", "#" * 200 + ".obj", "nowhere/##.obj", "##.glb",
                "##", "a#b#.obj", "OUT.OBJ", "-", "out.glb", "out.gltf"]
        self.attack(Case(f"{source} to {out!r:.40}", ["convert", source, out], self.FILES, expect=(DONE, INPUT, OUTPUT), out="none")
                    for source in ("thing.obj", "cache.pc2") for out in outs)

    def test_options(self):
        values = ["", "x", "0", "-1", "1e-320", "1e308", "-1e308", "nan", "inf", "1e999", "0.5", "2147483648", "9223372036854775807",
                  "9" * 400, "0:1:0", "5:1", "-9:9", "::", ":::", "1:2:3:4", "0:9223372036854775807:9223372036854775807", "\x1b", "all"]
        self.attack(Case(f"{name} {value!r:.40} to {out}", ["convert", "cache.pc2", out, f"{name}={value}"], self.FILES,
                         expect=(DONE, INPUT, OUTPUT), out="none")
                    for name, kind in options_of("convert") if kind for value in values for out in ("out.glb", "out.usda", "out.ply"))


if __name__ == "__main__":
    hostile.main()
