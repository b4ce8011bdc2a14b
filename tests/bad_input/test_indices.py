"""Indices that point nowhere, or twice to the same place: in meshes, stencils, selections, forces and moves."""
import itertools

import hostile
from hostile import DONE, INPUT, LEGAL, HostileTest, run_scene_case, scene_of
from meshes import known_formats, mesh_cases

BAD = [-1, -2, 4, 5, 2**31 - 1, 2**31, -2**31, 2**32, 2**32 + 1, 2**63 - 1, 2**63, -2**63, 2**64, 10**30, 0.5, 1e0, 1e300, "0", None,
       True, [0], {}]
FOUR = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
WHOLE = {"vertices": FOUR, "edges": [[0, 1], [1, 2]], "triangles": [[0, 1, 2], [0, 2, 3]], "tetrahedra": [[0, 1, 2, 3]]}
SIZES = {"edges": 2, "triangles": 3, "tetrahedra": 4}
# Vertices of a stencil of each type.
STENCILS = {"position": 1, "line": 1, "edge_spring": 2, "edge_strain": 2, "hinge": 4, "triangle_strain": 3, "fibre_strain": 3,
            "triangle_bending": 3, "tetrahedron_strain": 4, "drag": 2, "bending": 4, "plane": 1, "half_space": 1, "triangle_area": 3,
            "tetrahedron_volume": 4, "triangle_neo_hookean": 3, "triangle_stvk": 3, "tetrahedron_neo_hookean": 4,
            "tetrahedron_stvk": 4}
EXTRAS = {"line": {"direction": [0, 0, 1]}, "plane": {"normal": [0, 0, 1]}, "half_space": {"normal": [0, 0, 1]},
          "bending": {"cotangents": [[1, 1, 1]], "areas": 1}}

V = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
OBJ = {
    "index 0": ("f 0 1 2", r"thing\.obj:5: .*index 0"),
    "too large": ("f 1 2 5", r"thing\.obj:5: vertex 5 is out of range"),
    "too far back": ("f 1 2 -5", r"thing\.obj:5: vertex -5 is out of range"),
    "2^31": ("f 1 2 2147483648", r"thing\.obj:5: "),
    "2^32 + 1": ("f 4294967297 2 3", r"thing\.obj:5: "),
    "2^63": ("f 1 2 9223372036854775808", r"thing\.obj:5: "),
    "-2^63": ("f 1 2 -9223372036854775808", r"thing\.obj:5: "),
    "thirty digits": ("f 1 2 " + "9" * 30, r"thing\.obj:5: "),
    "a fraction": ("f 1 2 3.5", r"thing\.obj:5: "),
    "a power": ("f 1 2 1e0", r"thing\.obj:5: "),
    "a letter": ("f 1 2 a", r"thing\.obj:5: "),
    "no corner": ("f", r"thing\.obj:5: a face with 0 corners"),
    "one corner": ("f 1", r"thing\.obj:5: a face with 1 corners"),
    "two corners": ("f 1 2", r"thing\.obj:5: a face with 2 corners"),
    "a corner twice": ("f 1 2 1", r"thing\.obj:5: a face with vertex 1"),
    "a corner twice, once from behind": ("f 1 2 3 -3", r"thing\.obj:5: a face with vertex 2"),
    "a texture that is not there": ("f 1/1 2/1 3/1", r"thing\.obj:5: texture coordinate 1 is out of range"),
    "a texture 0": ("f 1/0 2 3", r"thing\.obj:5: "),
    "a normal that is not there": ("f 1//1 2//1 3//1", r"thing\.obj:5: normal 1 is out of range"),
    "slashes alone": ("f / / /", r"thing\.obj:5: "),
    "slashes behind": ("f 1/ 2/ 3//", r""),
    "four parts": ("f 1/1/1/1 2 3", r"thing\.obj:5: "),
    "a line of one": ("l 1", r"thing\.obj:5: a line with 1"),
    "a line of none": ("l", r"thing\.obj:5: a line with 0"),
    "a line to itself": ("l 1 1", r"thing\.obj:5: "),
    "a line out of range": ("l 1 9", r"thing\.obj:5: "),
    "a line there and back": ("l 1 2 1", r""),
    "points": ("p 1 2 9", r""),
    "curves": ("cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nend", r"thing\.obj:7: .*curv"),
    "the triangle twice": ("f 1 2 3\nf 1 2 3", r""),
    "the triangle turned over": ("f 1 2 3\nf 3 2 1", r""),
    "an index of what comes later": ("f 1 2 5\nv 0 0 1", r""),
    "continued": ("f 1 \\\n 2 \\\n 9", r"thing\.obj:7: "),
}


def body_scene(mesh, *constraints, **more):
    return scene_of(mesh, *constraints, body={"mass": {"per_vertex": 1}}, **more)


def elements_with(size, bad):
    """Lists of indices with the bad one in each place, of a wrong length, or with a vertex twice."""
    for place in range(size):
        yield [*range(place), bad, *range(place + 1, size)]


def wrong_elements(size):
    for bad in BAD:
        yield from elements_with(size, bad)
    yield from ([], list(range(size))[:-1], [0, 1, 2, 3, 3][:size + 1], [0] * size, [0, *range(size - 1)])


class Indices(HostileTest):
    def test_meshes_in_the_scene(self):
        self.attack((run_scene_case(f"{kind} {element}", body_scene(WHOLE | {kind: [element]}), expect=(INPUT,), says=kind[:4])
                     for kind, size in SIZES.items() for element in wrong_elements(size)),
                    (run_scene_case(f"{kind} behind others", body_scene(WHOLE | {kind: WHOLE[kind] * 3 + [[0, 9, 1, 2][:size]]}),
                                    expect=(INPUT,), says=kind[:4]) for kind, size in SIZES.items()),
                    [run_scene_case("sound", body_scene(WHOLE), expect=(DONE,)),
                     run_scene_case("no vertex", body_scene({"vertices": []}), expect=(INPUT,))])

    def test_stencils(self):
        def scene(name, stencils):
            return body_scene(WHOLE, {"type": name, "stencils": stencils} | EXTRAS.get(name, {}))
        self.attack((run_scene_case(f"{name} {stencil}", scene(name, [stencil]), expect=(INPUT,))
                     for name, size in STENCILS.items() for stencil in wrong_elements(size)
                     if stencil != list(range(size)) and not (name == "drag" and stencil in ([0], [0, 1, 2]))),
                    (run_scene_case(f"{name} sound", scene(name, [list(range(size))])) for name, size in STENCILS.items()),
                    (run_scene_case(f"{name} {many}", scene(name, many)) for name, size in STENCILS.items()
                     for many in ([list(range(size))] * 50, [], [[]], list(range(size)), [[list(range(size))]])))

    def test_selections_forces_and_moves(self):
        pin = {"type": "position", "name": "pin", "hold": "soft", "on": [0, 1]}
        force = {"type": "test_force", "force": [0, 0, 1]}
        move = {"group": "pin", "step": 0, "target": [0, 0, 0]}
        bad = [value for value in BAD if value != [0]]
        self.attack((run_scene_case(f"on {on}", body_scene(WHOLE, {"type": "position", "on": on}), expect=(INPUT,))
                     for value in BAD for on in ([value], [0, value, 1])),
                    (run_scene_case(f"on {on}", body_scene(WHOLE, {"type": "position", "on": on}))
                     for on in ([], [0, 0, 0], [0] * 1000, [3, 2, 1, 0])),
                    (run_scene_case(f"{key} {value}", body_scene(WHOLE, forces=[force | {key: value}]), expect=(INPUT,))
                     for key in ("vertex", "vertices") for value in bad + [[value] for value in BAD]),
                    (run_scene_case(f"vertex {value}", body_scene(WHOLE, forces=[
                        {"type": "mouse_spring", "vertex": value, "anchor": [0, 0, 0]}]), expect=(INPUT,)) for value in BAD),
                    (run_scene_case(f"index {value}", body_scene(WHOLE, pin, moves=[move | {"index": value}]),
                                    expect=(INPUT,)) for value in [2, [2], *bad]))

    def test_what_is_pinned_twice(self):
        pins = [{"type": "position", "on": [0]}, {"type": "position", "on": "all"}, {"type": "position", "stencils": [0, 0]},
                {"type": "position", "stencils": [1, 0, 1]}]
        self.attack(run_scene_case(f"{pair}", body_scene(WHOLE, *pair)) for pair in itertools.product(pins, pins))

    def test_obj(self):
        self.attack(case for name, (text, says) in OBJ.items()
                    for case in mesh_cases(name, "obj", V + text + "\n", expect=(INPUT,) if says else (DONE,), says=says))

    def test_polygons(self):
        def polygon(corners):
            rows = [f"v {i} {i * i % 97} {i % 7}" for i in range(corners)]
            return "\n".join(rows) + "\nf " + " ".join(str(i + 1) for i in range(corners)) + "\n"
        strain = [{"type": "edge_spring"}, {"type": "triangle_strain"}, {"type": "hinge"}]
        self.attack(case for corners in (3, 4, 100, 10000)
                    for case in mesh_cases(f"{corners} corners", "obj", polygon(corners), strain))


if __name__ == "__main__":
    hostile.main()
