"""Meshes whose shape is the trouble: without extent, doubled, folded onto themselves, enormous, minute, far away. Each with
several constraints, masses and back ends: an error with its place, or numbers that are finite."""
import itertools
import math
import re

import hostile
from hostile import DONE, INPUT, LEGAL, HostileTest, run_scene_case, scene_of

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
TETRAHEDRON = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
TWO = [[0, 1, 2], [0, 2, 3]]


def scaled(points, factor, offset=0.0):
    return [[factor * x + offset for x in point] for point in points]


def mesh(vertices, triangles=(), edges=(), tetrahedra=()):
    lists = {"edges": edges, "triangles": triangles, "tetrahedra": tetrahedra}
    return {"vertices": vertices} | {key: [list(e) for e in value] for key, value in lists.items() if value}


def sheet(n, height=lambda i, j: 0.0):
    vertices = [[i / (n - 1), j / (n - 1), height(i, j)] for j in range(n) for i in range(n)]
    triangles = []
    for j, i in itertools.product(range(n - 1), range(n - 1)):
        a = j * n + i
        triangles += [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]
    return mesh(vertices, triangles)


def moebius(n):
    vertices, triangles = [], []
    for i in range(n):
        u = 2 * math.pi * i / n
        for side in (-0.2, 0.2):
            r = 1 + side * math.cos(u / 2)
            vertices.append([r * math.cos(u), r * math.sin(u), side * math.sin(u / 2)])
    for i in range(n):
        a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        if i == n - 1:
            c, d = 1, 0
        triangles += [[a, b, d], [a, d, c]]
    return mesh(vertices, triangles)


def fan(n, hub=(0.0, 0.0, 0.3)):
    """A vertex with n neighbors all round."""
    ring = [[math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0] for i in range(n)]
    return mesh([list(hub), *ring], [[0, i + 1, (i + 1) % n + 1] for i in range(n)])


def chain(n, step):
    return mesh([[step * i, 0, 0] for i in range(n)], edges=[[i, i + 1] for i in range(n - 1)])


def needle(width):
    return mesh([[0, 0, 0], [1, 0, 0], [1, width, 0], [0, width, 0]], TWO)


MESHES = {
    # Must be refused, and name the element.
    "edge of no length": (mesh([[1, 2, 3]] * 2, edges=[[0, 1]]), "edge 0"),
    "edge of no length far out": (mesh([[1e9, 0, 0], [1e9 + 1e-8, 0, 0]], edges=[[0, 1]]), "edge 0"),
    "triangle on a line": (mesh([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 1, 2]]), "triangle 0"),
    "triangle in a point": (mesh([[1, 1, 1]] * 3, [[0, 1, 2]]), "triangle 0"),
    "triangle with two corners in one place": (mesh([[0, 0, 0], [0, 0, 0], [1, 0, 0]], [[0, 1, 2]]), "triangle 0"),
    "the last triangle is flat": (mesh(SQUARE + [[2, 0, 0]], [*TWO, [0, 1, 4]]), "triangle 2"),
    "tetrahedron in a plane": (mesh(SQUARE, tetrahedra=[[0, 1, 2, 3]]), "tetrahedron 0"),
    "tetrahedron on a line": (mesh([[i, i, i] for i in range(4)], tetrahedra=[[0, 1, 2, 3]]), "tetrahedron 0"),
    "tetrahedron in a point": (mesh([[1, 1, 1]] * 4, tetrahedra=[[0, 1, 2, 3]]), "tetrahedron 0"),
    "inverted tetrahedron": (mesh(TETRAHEDRON, tetrahedra=[[0, 2, 1, 3]]), "tetrahedron 0"),
    "beyond 1e100": (mesh(scaled(SQUARE, 1e101), TWO), "vert"),
    "1e300": (mesh(scaled(SQUARE, 1e300), TWO), "vert"),
    "far away by 1e300": (mesh(scaled(SQUARE, 1, 1e300), TWO), "vert"),
    "all vertices in one place": (mesh([[3, 3, 3]] * 4, TWO), "triangle 0"),
    "all vertices on a line": (mesh([[i, 0, 0] for i in range(4)], TWO), "triangle 0"),
    # Legal, or refused for a reason of its own.
    "one vertex": (mesh([[0, 0, 0]]), ""),
    "two vertices in one place": (mesh([[0, 0, 0]] * 2), ""),
    "a cloud in one place": (mesh([[1e9, 1e9, 1e9]] * 50), ""),
    "one edge": (mesh([[0, 0, 0], [1, 0, 0]], edges=[[0, 1]]), ""),
    "an edge twice": (mesh([[0, 0, 0], [1, 0, 0]], edges=[[0, 1], [1, 0], [0, 1]]), ""),
    "one triangle": (mesh(SQUARE[:3], [[0, 1, 2]]), ""),
    "a triangle twice": (mesh(SQUARE[:3], [[0, 1, 2]] * 2), ""),
    "a triangle and its back": (mesh(SQUARE[:3], [[0, 1, 2], [0, 2, 1]]), ""),
    "a triangle fifty times": (mesh(SQUARE[:3], [[0, 1, 2]] * 50), ""),
    "two sheets in one place": (mesh(SQUARE * 2, [*TWO, *[[a + 4, b + 4, c + 4] for a, b, c in TWO]]), ""),
    "turned over": (mesh(SQUARE, [[0, 1, 2], [0, 3, 2]]), ""),
    "folded shut": (mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]], [[0, 1, 2], [1, 0, 3]]), ""),
    "three pages": (mesh(SQUARE + [[0.5, 0.5, 1]], [*TWO, [0, 2, 4]]), ""),
    "a bow tie": (mesh([[0, 0, 0], [1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0]], [[0, 2, 1], [0, 3, 4]]), ""),
    "isolated vertices": (mesh(SQUARE + [[5, 5, 5], [9, 9, 9]], TWO), ""),
    "an isolated vertex in another's place": (mesh(SQUARE + [[0, 0, 0]], TWO), ""),
    "Moebius": (moebius(10), ""),
    "a closed box of one tetrahedron": (mesh(TETRAHEDRON, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]), ""),
    "a tetrahedron twice": (mesh(TETRAHEDRON, tetrahedra=[[0, 1, 2, 3]] * 2), ""),
    "surface and volume": (mesh(TETRAHEDRON, [[1, 2, 3]], [[0, 1]], [[0, 1, 2, 3]]), ""),
    "a flat tetrahedron": (mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 1e-9]], tetrahedra=[[0, 1, 2, 3]]), ""),
    "1e-100": (mesh(scaled(SQUARE, 1e-100), TWO), ""),
    "1e-160": (mesh(scaled(SQUARE, 1e-160), TWO), ""),
    "1e-200": (mesh(scaled(SQUARE, 1e-200), TWO), ""),
    "denormal": (mesh(scaled(SQUARE, 1e-310), TWO), ""),
    "a solid of 1e-100": (mesh(scaled(TETRAHEDRON, 1e-100), tetrahedra=[[0, 1, 2, 3]]), ""),
    "a solid of 1e-110": (mesh(scaled(TETRAHEDRON, 1e-110), tetrahedra=[[0, 1, 2, 3]]), ""),
    "1e50": (mesh(scaled(SQUARE, 1e50), TWO), ""),
    "1e99": (mesh(scaled(SQUARE, 1e99), TWO), ""),
    "a solid of 1e99": (mesh(scaled(TETRAHEDRON, 1e99), tetrahedra=[[0, 1, 2, 3]]), ""),
    "an edge of 1e99": (chain(3, 1e99), ""),
    "an edge of 1e-300": (chain(3, 1e-300), ""),
    "an edge of the smallest length": (chain(3, 5e-324), ""),
    "far away by 1e9": (mesh(scaled(SQUARE, 1, 1e9), TWO), ""),
    "far away by 1e12": (mesh(scaled(SQUARE, 1, 1e12), TWO), ""),
    "far away by 1e15": (mesh(scaled(SQUARE, 1, 1e15), TWO), ""),
    "far away by 1e99": (mesh(scaled(SQUARE, 1, 1e99), TWO), ""),
    "a needle of 1e-6": (needle(1e-6), ""),
    "a needle of 1e-11": (needle(1e-11), ""),
    "a needle of 2e-12": (needle(2e-12), ""),
    "edges from 1e-6 to 1e6": (mesh([[0, 0, 0], [1e-6, 0, 0], [1e6, 0, 0]], edges=[[0, 1], [1, 2]]), ""),
    "a fan of 3": (fan(3), ""), "a fan of 300": (fan(300), ""), "a flat fan": (fan(12, (0, 0, 0)), ""),
    "a fan from far above": (fan(12, (0, 0, 1e6)), ""), "a fan from its rim": (fan(12, (0.96, 0, 1e-9)), ""),
    "a crumpled sheet": (sheet(6, lambda i, j: 0.5 * (-1) ** (i + j)), ""),
    "a sheet with a spike": (sheet(6, lambda i, j: 1e8 * ((i, j) == (3, 3))), ""),
    "a flat sheet": (sheet(6), ""),
}

# What a body is made of; a soft pin keeps those of one vertex company.
MATERIALS = {
    "nothing": [],
    "springs": [{"type": "edge_spring"}],
    "strain": [{"type": "edge_strain", "measure": "cloth"}, {"type": "triangle_strain"}, {"type": "tetrahedron_strain"}],
    "grain": [{"type": "fibre_strain"}, {"type": "fibre_strain", "angle": 90}, {"type": "fibre_strain", "grain": "edge"}],
    "area and volume": [{"type": "triangle_area"}, {"type": "tetrahedron_volume"}, {"type": "edge_spring", "reduction": "identity"}],
    "bending": [{"type": "edge_spring"}, {"type": "bending"}, {"type": "hinge"}],
    "signed bending": [{"type": "bending", "orientation": "signed"}, {"type": "hinge", "orientation": "signed"}],
    "rope": [{"type": "edge_strain", "min_stretch": 0, "max_stretch": 2}],
}
MASSES = [{"per_vertex": 0.1}, {"total": 1}, {"area_density": 0.2}, {"density": 100}, {"line_density": 0.1}]
WIND = [{"type": "wind"}, {"type": "wind", "model": "thesis", "gust_strength": 1}]


def is_possible(shape, constraint):
    kind = constraint["type"]
    if kind in ("triangle_strain", "triangle_area", "fibre_strain"):
        return "triangles" in shape
    if kind in ("hinge", "bending"):
        return len(shape.get("triangles", [])) > 1
    if kind.startswith("tetrahedron_"):
        return "tetrahedra" in shape
    if constraint.get("measure") == "cloth":
        return "triangles" in shape
    return kind != "edge_spring" and kind != "edge_strain" or len(shape) > 1


def body_scene(shape, constraints, mass, start=None, **more):
    body = {"mass": mass}
    if start is not None:
        body["start_positions"] = start
    forces = WIND if "triangles" in shape else []
    possible = [constraint for constraint in constraints if is_possible(shape, constraint)]
    return scene_of(shape, *possible, body=body, forces=forces, **more)


class Geometry(HostileTest):
    def test_shapes_with_every_material(self):
        self.attack(run_scene_case(f"{name} of {material}", body_scene(shape, constraints, MASSES[0]),
                                   expect=(INPUT,) if says else LEGAL, says=says)
                    for name, (shape, says) in MESHES.items() for material, constraints in MATERIALS.items())

    def test_shapes_with_every_mass(self):
        self.attack(run_scene_case(f"{name}, {mass}", body_scene(shape, MATERIALS["springs"], mass))
                    for name, (shape, says) in MESHES.items() if not says for mass in MASSES)

    def test_pinned_and_by_both_back_ends(self):
        pins = [{"type": "position", "on": [0]}], [{"type": "position", "on": "all"}], [
            {"type": "position", "hold": "soft", "on": "all"}], [{"type": "line", "on": "all", "direction": [1, 1, 1e-3]}], [
            {"type": "drag", "stencils": [[0]], "stiffness": 1e6, "targets": [1e3, 0, 0]}]
        materials = MATERIALS["bending"] + MATERIALS["strain"]
        self.attack(run_scene_case(f"{name}, {pin[0]['type']}, {backend}",
                                   body_scene(shape, pin + materials, MASSES[0], settings={"threads": 1, "backend": backend}))
                    for name, (shape, says) in MESHES.items() if not says for pin in pins for backend in ("eigen", "cholmod"))

    def test_selections_of_strange_shapes(self):
        selections = ["all", "boundary", "corners", {"nearest": [0, 0, 0]}, {"box": {"min": [0, 0, 0], "max": [0, 0, 0]}},
                      {"half_space": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]
        self.attack(run_scene_case(f"{name}, {on}", body_scene(shape, [{"type": "position", "on": on}], MASSES[0]))
                    for name, (shape, says) in MESHES.items() if not says for on in selections)

    def test_crushed_and_mirrored_starts(self):
        def starts(points):
            yield "a point", [[1, 1, 1]] * len(points)
            yield "a line", [[x, 0, 0] for x, _, _ in points]
            yield "a plane", [[x, y, 0] for x, y, _ in points]
            yield "mirrored", scaled(points, -1)
            yield "1e50 times", scaled(points, 1e50)
            yield "1e-50 times", scaled(points, 1e-50)
            yield "1e99 away", scaled(points, 1, 1e99)
        everything = [constraint for name in ("springs", "strain", "signed bending") for constraint in MATERIALS[name]]
        shapes = ["Moebius", "a flat sheet", "a crumpled sheet", "a tetrahedron twice", "one edge", "a fan of 3", "three pages"]
        self.attack(run_scene_case(f"{name} in {what}", body_scene(MESHES[name][0], everything, MASSES[0], start, steps=5))
                    for name in shapes for what, start in starts(MESHES[name][0]["vertices"]))

    def test_solids_of_every_shape(self):
        def solid_scene(shape, solid, **more):
            body = {"mass": {"density": 100}, "solid": solid} | more
            return scene_of(shape, {"type": "tetrahedron_strain"}, body=body, steps=2)
        # Of a mesh that nobody would call closed; what is closed may be done, whatever it is.
        self.attack(run_scene_case(f"{name}, {spacing}", solid_scene(shape, {"spacing": spacing}),
                                   expect=(INPUT,) if says or "tetrahedra" in shape or "triangles" not in shape else LEGAL)
                    for name, (shape, says) in MESHES.items() for spacing in (0.3, 1e-4))
        ball = {"shape": "sphere", "subdivisions": 2}
        refused = {
            "finer than memory": ({"spacing": 1e-9}, r"asks for 1e\+27 cubes .* 2e\+06 are allowed; give 0\.008\d m or more"),
            "a denormal": ({"spacing": 1e-310}, "are allowed"), "nothing": ({"spacing": 0}, "out of range"),
            "less than nothing": ({"spacing": -0.1}, "out of range"), "text": ({"spacing": "fine"}, "number"),
            "larger than the body": ({"spacing": 1e30}, "largest side"), "no spacing": ({}, "spacing"), "a list": ([], "object"),
            "a misspelt key": ({"spacing": 0.2, "spacings": 1}, "spacings"), "a number": (0.1, "object")}
        self.attack(run_scene_case(name, solid_scene(ball, solid), expect=(INPUT,), says=says)
                    for name, (solid, says) in refused.items())
        self.attack([
            run_scene_case("open", solid_scene({"shape": "cylinder"}, {"spacing": 0.1}), expect=(INPUT,),
                           says=r"a loop of 24 edges, 1\.57 m long, about \(.*\), with the vertices 0, .* and 1 more such"),
            run_scene_case("thin", solid_scene({"shape": "pillow"}, {"spacing": 0.5}), expect=(INPUT,)),
            run_scene_case("by the vertex", solid_scene(ball, {"spacing": 0.2}, mass={"per_vertex": 1}), expect=(INPUT,),
                           says="density"),
            run_scene_case("animated", solid_scene(ball, {"spacing": 0.2}, animation={}), expect=(INPUT,), says="animated"),
            run_scene_case("at a point", solid_scene(ball, {"spacing": 0.2}, start_positions=[[1, 1, 1]] * 162), expect=(DONE,)),
            run_scene_case("turned inside out",
                           solid_scene(mesh(TETRAHEDRON, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]), {"spacing": 0.2}),
                           expect=(DONE,))])

    def test_many_bodies_at_once(self):
        scene = scene_of({"shape": "grid"}, steps=1)
        scene["bodies"] = [{"mesh": shape, "mass": {"per_vertex": 0.1}} for name, (shape, says) in MESHES.items()
                           if not says and not re.search(r"denormal|\de|smallest", name)]
        self.attack([run_scene_case("all", scene, expect=(DONE,)),
                     run_scene_case("all, as OBJ", scene | {"output": {"format": "obj"}}, expect=(DONE,))])


if __name__ == "__main__":
    hostile.main()
