"""Small files that ask for much: what is read must cost time and memory in proportion to the file."""
import json
import math
import unittest

import hostile
from hostile import DONE, INPUT, LEGAL, Case, HostileTest, run_scene_case, scene_of
from meshes import known_formats, mesh_cases

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
GRID = {"shape": "grid", "columns": 300, "rows": 300}
LINK = {"mesh": {"shape": "chain", "links": 1}, "mass": {"total": 1}}
PIN = {"type": "position", "name": "pin", "on": [0]}

# What the simulation itself takes beside the file: about a kilobyte a vertex and a constraint.
SIMULATED = 1000


def allowed(size, simulated):
    """What stands for the size of the input [bytes]."""
    return size + SIMULATED * simulated // hostile.MEMORY_FACTOR


def names(count):
    return " ".join(f"n{i}" for i in range(count))


def polygon(corners):
    rows = [f"v {i} {i * i % 97} {i % 7}" for i in range(corners)]
    return "\n".join(rows) + "\nf " + " ".join(str(i + 1) for i in range(corners)) + "\n"


# OBJ texts: (text, vertices and elements that are simulated).
OBJ = {
    "many names in one g": (lambda: TRIANGLE + f"g {names(100000)}\nf 1 2 3\n", 4),
    "many groups of many faces": (lambda: TRIANGLE + f"g {names(3000)}\n" + "f 1 2 3\n" * 30000, 30000),
    "many groups": (lambda: TRIANGLE + "".join(f"g n{i}\nf 1 2 3\n" for i in range(100000)), 100000),
    "many groups in turn": (lambda: TRIANGLE + "".join(f"g {names(200)} m{i}\nf 1 2 3\n" for i in range(500)), 500),
    "many objects": (lambda: TRIANGLE + "".join(f"o n{i}\nf 1 2 3\n" for i in range(100000)), 100000),
    "a long name": (lambda: TRIANGLE + "o " + "n" * 5000000 + "\nf 1 2 3\n", 4),
    "one line of 5 MB": (lambda: TRIANGLE + "l " + "1 2 " * 1250000, 1250000),
    "a polygon of 100,000 corners": (lambda: polygon(100000), 200000),
    "faces of 5 MB": (lambda: TRIANGLE + "f 1 2 3\n" * 600000, 600000),
    "vertices of 5 MB": (lambda: "v 0 0 0\n" * 600000, 600000),
    "faces ahead of their vertices": (lambda: "f 1 2 3\n" * 300000 + TRIANGLE, 300000),
    "faces of what never comes": (lambda: TRIANGLE + "f 7 8 9\n" * 300000, 4),
    "5 MB of texture coordinates": (lambda: "vt 0 0\n" * 600000 + TRIANGLE, 4),
    "5 MB of continued lines": (lambda: TRIANGLE + "f 1 2 3 " + "\\\n" * 2500000, 4),
    "5 MB of comment": (lambda: TRIANGLE + "#" * 5000000, 4),
    "5 MB of unknown words": (lambda: TRIANGLE + "x y z\n" * 800000, 4),
    "5 MB without a line end": (lambda: "v " + "1" * 5000000, 4),
    "5 MB in one word": (lambda: "x" * 5000000, 4),
    "5 MB of blanks": (lambda: " " * 5000000, 4),
    "5 MB of NULs": (lambda: "\0" * 5000000, 4),
    "20 MB of faces": (lambda: TRIANGLE + "f 1 2 3\n" * 2500000, 2500000),
}


def fan(n):
    ring = [[math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0] for i in range(n)]
    return {"vertices": [[0, 0, 0.3], *ring], "triangles": [[0, i + 1, (i + 1) % n + 1] for i in range(n)]}


def bending(size):
    return {"type": "bending", "stencils": [list(range(size))], "cotangents": [[1] * (size - 1)], "areas": 1}


# Scenes: (scene, vertices and constraints that are simulated).
SCENES = {
    "the vertices nearest to many points": (lambda: scene_of(GRID, {"type": "position", "on": {"nearest": [[0, 0, 0]] * 100000}}),
                                            90000),
    "nearest to points far away": (lambda: scene_of(GRID, {"type": "position", "on": {"nearest": [
        [1e99, i, 0] for i in range(50000)]}}), 90000),
    "many constraints without names": (lambda: scene_of({"shape": "grid"}, *[{"type": "drag", "stencils": [0]}] * 20000), 20000),
    "many named constraints": (lambda: scene_of({"shape": "grid"}, *[{"type": "drag", "name": str(i), "stencils": [0]}
                                                                     for i in range(10000)]), 10000),
    "many pins, each its own group": (lambda: scene_of({"shape": "grid", "columns": 100, "rows": 100}, *[
        {"type": "position", "name": str(i), "on": [i]} for i in range(10000)]), 10000),
    "many pins of one vertex, each its own group": (lambda: scene_of({"shape": "grid", "columns": 150, "rows": 150}, *[
        {"type": "position", "on": [i]} for i in range(20000)], steps=1), 20000),
    "many groups that events add": (lambda: scene_of({"shape": "grid"}, events=[
        {"step": 0, "add": {"type": "drag", "stencils": [0]}}] * 10000, steps=1), 10000),
    "many bodies": (lambda: {"pliant": 1, "steps": 1, "bodies": [LINK] * 20000}, 40000),
    "many named bodies": (lambda: {"pliant": 1, "steps": 1, "bodies": [LINK | {"name": str(i)} for i in range(20000)]}, 40000),
    "many moves": (lambda: scene_of({"shape": "grid"}, PIN, moves=[{"group": "pin", "step": 0, "over": 1, "offset": [0, 0, 1]}]
                                    * 50000), 50000),
    "many moves one after the other": (lambda: scene_of({"shape": "grid"}, PIN, moves=[
        {"group": "pin", "step": i, "target": [0, 0, i]} for i in range(50000)]), 50000),
    "many forces": (lambda: scene_of({"shape": "grid"}, forces=[{"type": "test_force", "vertex": 0, "force": [0, 0, 1]}] * 50000),
                    50000),
    "a constraint over many vertices": (lambda: scene_of({"shape": "grid", "columns": 400, "rows": 400}, bending(100000)), 160000),
    "a constraint over 2,000 vertices": (lambda: scene_of({"shape": "grid", "columns": 50, "rows": 50}, bending(2000)), 200000),
    "a vertex with many neighbors": (lambda: scene_of(fan(2000), {"type": "bending"}), 200000),
    "many vertices in the scene": (lambda: scene_of({"vertices": [[0, 0, 0]] * 400000}), 400000),
    "a triangle many times": (lambda: scene_of({"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]] * 300000},
                                               {"type": "triangle_strain"}), 300000),
    "a stencil many times": (lambda: scene_of({"vertices": [[0, 0, 0], [1, 0, 0]]}, {"type": "edge_spring", "stencils": [[0, 1]] *
                                                                                     500000}), 500000),
    "a selection many times": (lambda: scene_of(GRID, {"type": "position", "on": [0] * 2000000}), 90000),
    "many masses": (lambda: scene_of({"shape": "chain"}, body={"mass": {"each": [1] * 2000000}}), 10),
    "many start positions": (lambda: scene_of({"shape": "chain"}, body={"start_positions": [[0, 0, 0]] * 500000}), 10),
    "many unknown keys": (lambda: {"pliant": 1} | {f"key{i}": 0 for i in range(300000)}, 0),
    "a name of 5 MB": (lambda: scene_of({"shape": "chain"}, body={"name": "n" * 5000000}), 10),
    "a type of 5 MB": (lambda: scene_of({"shape": "n" * 5000000}), 10),
    "a mesh file of 5 MB of name": (lambda: scene_of({"file": "n" * 5000000}), 10),
}

# Shapes that no machine holds, or that take long to say so.
SHAPES = [("grid", {"columns": 10**9, "rows": 2}), ("grid", {"columns": 46340, "rows": 46340}), ("grid", {"columns": 2**31 - 1, "rows": 1}),
          ("torus", {"major_segments": 10**6, "minor_segments": 2000}), ("sphere", {"subdivisions": 40}), ("cylinder", {"segments": 40000, "rows": 40000}), ("bar", {"cells": [1200, 1200, 1200]}),
          ("bar", {"cells": [2**31 - 1] * 3}), ("chain", {"links": 2 * 10**9})]


@unittest.skipIf(hostile.is_sanitized(), "time and memory are measured of programs without a sanitizer")
class Cost(HostileTest):
    def test_obj(self):
        def cases():
            for name, (make, simulated) in OBJ.items():
                text = make().encode()
                yield from mesh_cases(name, "obj", text, input_size=allowed(len(text), simulated))
        self.attack(cases())

    def test_scenes(self):
        def cases():
            for name, (make, simulated) in SCENES.items():
                text = json.dumps(make())
                yield run_scene_case(name, text, input_size=allowed(len(text), simulated))
        self.attack(cases())

    def test_shapes_that_no_machine_holds(self):
        """Under a limit, so that a program that tries nevertheless does not take the whole machine along."""
        self.attack(run_scene_case(f"{name} {options}", scene_of({"shape": name} | options, {"type": "edge_spring"}), expect=(INPUT,),
                                   launcher=["prlimit", f"--as={4 << 30}", "--"], input_size=400 << 20, place="",
                                   plain_only=True) for name, options in SHAPES)


if __name__ == "__main__":
    hostile.main()
