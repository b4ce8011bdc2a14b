"""What a scene takes in beside meshes: other scenes, and vertex maps; and values by --set."""
import io

import numpy

import hostile
from hostile import DONE, INPUT, Case, HostileTest, run_scene_case, scene_of

BODY = scene_of({"shape": "chain", "links": 2}, {"type": "edge_spring"})
BASE = {"base.json": BODY}


def including(what, **more):
    return {"pliant": 1, "include": what} | more


def nest(levels, copies):
    """Scenes that include the next one several times, down to one with a body."""
    files = {f"level{i}.json": including([f"level{i + 1}.json"] * copies) for i in range(levels)}
    return files | {f"level{levels}.json": {"pliant": 1, "bodies": [body_named(levels)]}}


def body_named(name):
    return {"name": f"body {name}", "mesh": {"shape": "chain", "links": 1}, "mass": {"total": 1}}


INCLUDES = {
    # (what is included, files beside the scene, what is said; empty: legal)
    "a scene": ("base.json", BASE, ""),
    "a built-in scene": ("chain", {}, ""),
    "nothing": ("nothing.json", {}, "nothing.json"),
    "itself": ("scene.json", {}, "scene.json"),
    "itself by another name": ("./../" + "x/../" * 10 + "scene.json", {}, "scene"),
    "itself through a link": ("link.json", {"link.json": lambda path: path.symlink_to("scene.json")}, "link.json|scene.json"),
    "two in a ring": ("a.json", {"a.json": including("b.json"), "b.json": including("a.json")}, "a.json|b.json"),
    "back to the scene": ("a.json", {"a.json": including("scene.json")}, "a.json|scene.json"),
    "the same twice": (["base.json", "base.json"], BASE, "name"),
    "ten thousand times": (["base.json"] * 10000, BASE, "name|include"),
    "ten thousand times nothing": (["empty.json"] * 10000, {"empty.json": {"pliant": 1}}, "body|include"),
    "sixteen deep": ("level0.json", nest(14, 1), ""),
    "hundreds deep": ("level0.json", nest(300, 1), "deep|include"),
    "twice at each of ten levels": ("level0.json", nest(10, 2), "name|include"),
    "ten times at each of ten levels": ("level0.json", nest(10, 10), "name|include"),
    "a folder": ("folder", {"folder": lambda path: path.mkdir()}, "folder"),
    "a pipe": ("pipe", {"pipe": lambda path: hostile.os.mkfifo(path)}, "pipe"),
    "a device": ("/dev/zero", {}, "/dev/zero"),
    "an empty name": ("", {}, "include"),
    "a name with a NUL": ("base.json\0", BASE, "include"),
    "a name with a newline": ("base\n.json", BASE, "include"),
    "a long name": ("b" * 100000, {}, "include"),
    "a mesh": ("a.obj", {"a.obj": "v 0 0 0\n"}, "a.obj"),
    "half a scene": ("half.json", {"half.json": '{"pliant": 1, "bodies": ['}, r"half\.json:1"),
    "a list": ("list.json", {"list.json": [BODY]}, "list.json"),
    "another version": ("old.json", {"old.json": {"pliant": 2}}, "old.json"),
    "no version": ("old.json", {"old.json": {"bodies": []}}, "old.json"),
    "a slip": ("slip.json", {"slip.json": dict(BODY, stepz=1)}, r"slip\.json: stepz"),
    "a slip within": ("slip.json", {"slip.json": scene_of({"shape": "chain", "lnks": 1})}, r"slip\.json: bodies\[0\]\.mesh\.lnks"),
    "no mesh there": ("a/slip.json", {"a/slip.json": scene_of({"file": "b.obj"}), "b.obj": "v 0 0 0\n"}, r"a/b\.obj"),
    "null": (None, {}, "include"), "a number": (1, {}, "include"), "an empty list": ([], BASE, "include|body|bodies"),
    "a list in a list": ([["base.json"]], BASE, "include"), "an empty object": ({}, {}, "include"),
    "an unknown key": ({"file": "base.json", "sets": {}}, BASE, "sets"),
    "an empty set": ({"file": "base.json", "set": {}}, BASE, ""),
    "set to what is not there": ({"file": "base.json", "set": {"bodies[7].mass": 1}}, BASE, "bodies"),
    "set the version": ({"file": "base.json", "set": {"pliant": 3}}, BASE, "pliant"),
    "set an include": ({"file": "base.json", "set": {"include": "base.json"}}, BASE, "include|base"),
    "set a deep value": ({"file": "base.json", "set": {"steps": eval("[" * 60 + "]" * 60)}}, BASE, "steps"),
}

PATHS = ["", "=", "=1", "x", "x=1", "steps", "steps=", "steps=1=2", "steps=x", "steps=[", "steps={}", "steps=1 2", "steps=NaN", "steps=1e999",
         "steps=null", " steps=1", "steps =1", "steps= 1", "steps[0]=1", "steps.x=1", "bodies=1", "bodies[]=1", "bodies[0]=1", "bodies[1]=1",
         "bodies[-1]={}", "bodies[0=1", "bodies0]=1", "bodies[99999999999999999999]=1", "bodies[2147483648]=1", "bodies[18446744073709551616]=1",
         "bodies[0x0]=1", "bodies[+0].mass.total=1", "bodies[00].mass.total=1", "bodies[thing].mass.total=1", "bodies[nothing].mass.total=1",
         "bodies[thing.mass.total=1", "bodies[thing].constraints[0].stiffness=-1", "bodies[0].constraints[0].stifness=1",
         "bodies[0].mesh.links=1000000000", "bodies..mass=1", ".=1", "..=1", "[=1", "]=1", "[]=1", "[0]=1", "bodies[0][0]=1", "bodies[0][mass]=1",
         "bodies.0.mass.total=1", "settings.time_step=0", "settings.iterations=1e1", "settings.thread=1", "name=\x1b[31m", "name=\"\\u001b[31m\"",
         "name=\"\\ud800\"", "name=\"", "description=" + "x" * 100000, "x" * 100000 + "=1", "a." * 10000 + "b=1", "[0]" * 10000 + "=1",
         "steps=" + "[" * 100000, "steps=" + "9" * 400, "pliant=2", "include=scene.json", "include=\"scene.json\"", "gravity=null",
         "gravity=[0,0]", "bodies=[]", "bodies[0]=null", "bodies[0].name=x", "bodies[0].mesh={\"file\": \"/dev/zero\"}", b"name=\xff", b"\xff=1",
         "steps=1\n", "ste\nps=1", "$schema=x", "set=1", "bodies[0].mass={\"total\": 1, \"total\": 2}", "moves[0].step=1", "output.every=0"]


def npy(array):
    stream = io.BytesIO()
    numpy.save(stream, array, allow_pickle=True)
    return stream.getvalue()


# Vertex maps for a mesh of four vertices: (name, contents, whether that is legal).
MAPS = [
    ("map.txt", "0\n0.5\n1\n0.25\n", True), ("map.csv", "# a comment\n0\n\n0.5 # half\r\n1\r0.25", True), ("map.txt", "\ufeff0\n1\n0\n1\n", True),
    ("map.npy", npy(numpy.array([0, 0.5, 1, 0.25])), True), ("map.npy", npy(numpy.array([0, 1, 1, 0], dtype="u1")), True),
    ("map.npy", npy(numpy.array([0, 1, 1, 0], dtype="?")), True), ("map.npy", npy(numpy.array([0, 1, 1, 0], dtype="f4")), True),
    ("map.txt", "", False), ("map.txt", "\n\n", False), ("map.txt", "0\n1\n0\n", False), ("map.txt", "0\n1\n0\n1\n0\n", False),
    ("map.txt", "0\nx\n0\n1\n", False), ("map.txt", "0\nnan\n0\n1\n", False), ("map.txt", "0\ninf\n0\n1\n", False),
    ("map.txt", "0\n1e999\n0\n1\n", False), ("map.txt", "0\n0,5\n0\n1\n", False), ("map.txt", "0 1 0 1\n", False), ("map.txt", "0;1;0;1\n", False),
    ("map.txt", "0\n\0\n0\n1\n", False), ("map.txt", "0x1\n1\n1\n1\n", False), ("map.txt", b"\xff\xfe0\0\n\0", False), ("map.txt", "x" * 1000000, False),
    ("map.txt", "9" * 1000000, False), ("map.txt", " " * 1000000, False), ("map.npy", b"\x93NUMPY", False),
    ("map.npy", npy(numpy.array([0, 1, 0, 1], dtype=">f8")), False), ("map.npy", npy(numpy.array([[0, 1], [0, 1]])), False),
    ("map.npy", npy(numpy.array([0, 1, 0, numpy.nan])), False), ("map.npy", npy(numpy.array([0, 1, 0, numpy.inf])), False),
    ("map.npy", npy(numpy.array([0, 1, 0, 1j])), False), ("map.npy", npy(numpy.array(["a", "b", "c", "d"])), False),
    ("map.npy", npy(numpy.array([{}, [], 1, None], dtype=object)), False), ("map.npy", npy(numpy.zeros(0)), False),
    ("map.npy", npy(numpy.zeros(())), False), ("map.npy", npy(numpy.arange(4))[:-1], False), ("map.npy", npy(numpy.arange(4)) + b"\0", False),
]


class IncludesAndMaps(HostileTest):
    def test_includes(self):
        self.attack(run_scene_case(f"{name}", including(what), files=files, place="", expect=(INPUT,) if says else (DONE,), says=says)
                    for name, (what, files, says) in INCLUDES.items())

    def test_includes_are_checked_like_runs(self):
        self.attack(Case(f"check {name}", ["check", "scene.json"], files | {"scene.json": including(what)},
                         expect=(INPUT,) if says else (DONE,), says=says) for name, (what, files, says) in INCLUDES.items())

    def test_values_by_set(self):
        scene = {"scene.json": BODY}
        self.attack((Case(f"--set {path!r:.40}", ["run", "scene.json", "--out", "out", "--set", path], scene, expect=(DONE, INPUT))
                     for path in PATHS),
                    (Case(f"check --set {path!r:.40}", ["check", "scene.json", "--set", path], scene, expect=(DONE, INPUT))
                     for path in PATHS[::3]),
                    [Case("many", ["run", "scene.json", "--out", "out", *["--set", "steps=1"] * 5000], scene, expect=(DONE, INPUT)),
                     Case("none", ["run", "scene.json", "--set"], scene, expect=(INPUT,), out="none")])

    def test_maps(self):
        def scenes(map_):
            mesh = {"shape": "grid", "columns": 2, "rows": 2}
            yield scene_of(mesh, {"type": "position", "on": {"map": map_, "above": 0.5}})
            yield scene_of(mesh, {"type": "position", "hold": "soft", "stiffness": {"map": map_, "from": 10, "to": 500}})
        self.attack(run_scene_case(f"{contents!r:.40}", scene, files={name: contents}, expect=(DONE,) if is_legal else (INPUT,))
                    for name, contents, is_legal in MAPS for scene in scenes({"file": name}))
        self.attack(run_scene_case(f"map {map_!r:.40}", scene, files={"map.txt": "0\n0.5\n1\n0.25\n"}, expect=(INPUT,))
                    for map_ in [None, 1, "map.txt", [], {}, {"file": 1}, {"file": "nothing.txt"}, {"file": ""}, {"file": "/dev/zero"}, {"file": "."},
                                 {"file": "map.txt\0"}, {"file": "map.txt", "name": "x"}, {"name": "nothing"}, {"files": "map.txt"}]
                    for scene in scenes(map_))

    def test_limits_of_maps(self):
        mesh = {"shape": "grid", "columns": 2, "rows": 2}
        values = [-1e308, -1, 0, 1e-320, 0.5, 1, 1e308, "x", None]
        def scenes():
            for a in values:
                yield scene_of(mesh, {"type": "position", "on": {"map": {"file": "map.txt"}, "above": a}})
                yield scene_of(mesh, {"type": "position", "on": {"map": {"file": "map.txt"}, "below": a}})
                for b in values:
                    yield scene_of(mesh, {"type": "position", "on": {"map": {"file": "map.txt"}, "above": a, "below": b}})
                    yield scene_of(mesh, {"type": "edge_spring", "stiffness": {"map": {"file": "map.txt"}, "from": a, "to": b}})
        self.attack(run_scene_case(f"{scene['bodies'][0]['constraints'][0]}", scene, files={"map.txt": "0\n0.5\n1\n0.25\n"})
                    for scene in scenes())


if __name__ == "__main__":
    hostile.main()
