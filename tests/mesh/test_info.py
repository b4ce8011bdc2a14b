#!/usr/bin/env python3
"""`pliant info`: what it says of meshes, against numbers computed here with NumPy; files of other programs' layouts
written here byte by byte; exit codes."""
import json
import os
import struct
import subprocess
import sys
import tempfile

import numpy as np

PLIANT = os.environ["PLIANT"]
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


def info(*arguments):
    return subprocess.run([PLIANT, "info", *arguments], capture_output=True, text=True)


def description(*arguments):
    result = info("--json", *arguments)
    check(result.returncode == 0, f"{arguments}: {result.stderr}")
    return json.loads(result.stdout)


def wavy_ball(n=12):
    """A closed surface of quads between two poles of triangles, its vertices and polygons."""
    angles = np.linspace(0, np.pi, n + 2)[1:-1]
    turns = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
    radius = 1 + 0.1 * np.cos(3 * turns)[None, :] * np.sin(angles)[:, None]
    directions = np.stack(
        [np.outer(np.sin(angles), np.cos(turns)), np.outer(np.sin(angles), np.sin(turns)),
         np.outer(np.cos(angles), np.ones(2 * n))], axis=-1)
    rows = (radius[..., None] * directions).reshape(-1, 3)
    vertices = np.vstack([[0, 0, 1], rows, [0, 0, -1]])
    polygons = []
    for j in range(2 * n):
        k = (j + 1) % (2 * n)
        polygons.append([0, 1 + j, 1 + k])
        for i in range(n - 1):
            a, b = 1 + 2 * n * i, 1 + 2 * n * (i + 1)
            polygons.append([a + j, b + j, b + k, a + k])
        last = 1 + 2 * n * (n - 1)
        polygons.append([last + j, len(vertices) - 1, last + k])
    return vertices, polygons


def fans(polygons):
    return np.array([[p[0], p[i - 1], p[i]] for p in polygons for i in range(2, len(p))])


def measures(vertices, polygons):
    triangles = fans(polygons)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    edges = {tuple(sorted(e)) for t in triangles.tolist() for e in zip(t, t[1:] + t[:1])}
    lengths = [np.linalg.norm(vertices[i] - vertices[j]) for i, j in edges]
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return {
        "vertices": len(vertices),
        "edges": len(edges),
        "triangles": len(triangles),
        "area": areas.sum(),
        "volume": np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6,
        "edge_length": {"min": min(lengths), "mean": np.mean(lengths), "max": max(lengths)},
        "triangle_area": {"min": areas.min(), "mean": areas.mean(), "max": areas.max()},
        "box": {"min": vertices.min(axis=0), "max": vertices.max(axis=0)},
    }


def check_measures(found, expected, where):
    for key, value in expected.items():
        if isinstance(value, dict):
            check_measures(found[key], value, f"{where}: {key}")
        else:
            check(np.allclose(found[key], value, rtol=1e-6, atol=1e-9), f"{where}: {key}: {found[key]}, not {value}")


def write_ply(path, vertices, polygons, order):
    name = {"<": "little", ">": "big"}[order]
    header = (f"ply\r\nformat binary_{name}_endian 1.0\r\ncomment made here\r\nelement face {len(polygons)}\r\n"
              f"property list uchar ushort vertex_index\r\nproperty uchar flags\r\nelement vertex {len(vertices)}\r\n"
              "property double x\r\nproperty double y\r\nproperty double z\r\nproperty float quality\r\nend_header\r\n")
    with open(path, "wb") as file:
        file.write(header.encode())
        for p in polygons:
            file.write(struct.pack(f"{order}B{len(p)}HB", len(p), *p, 7))
        for x in vertices:
            file.write(struct.pack(f"{order}3df", *x, 0.5))


def write_stl(path, vertices, polygons):
    triangles = fans(polygons)
    with open(path, "wb") as file:
        file.write(b"solid but binary".ljust(80) + struct.pack("<I", len(triangles)))
        for t in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *vertices[t].ravel(), 0))


def write_off(path, vertices, polygons):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(polygons)} 0\n")
        file.writelines(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
        file.writelines(f"{len(p)} {' '.join(map(str, p))} 0.5 0.5 0.5\n" for p in polygons)


def write_obj(path, vertices, polygons):
    with open(path, "w") as file:
        file.writelines(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
        file.writelines("f " + " ".join(f"{i - len(vertices)}" for i in p) + "\n" for p in polygons)


def test_formats(folder):
    vertices, polygons = wavy_ball()
    expected = measures(vertices, polygons) | {"components": 1}
    writers = {"a.ply": lambda path: write_ply(path, vertices, polygons, "<"),
               "b.ply": lambda path: write_ply(path, vertices, polygons, ">"),
               "a.stl": lambda path: write_stl(path, vertices, polygons),
               "a.off": lambda path: write_off(path, vertices, polygons),
               "a.obj": lambda path: write_obj(path, vertices, polygons)}
    for name, write in writers.items():
        path = os.path.join(folder, name)
        write(path)
        found = description(path)
        check_measures(found, expected, name)
        check(found["closed"] and found["boundary"]["count"] == 0, f"{name}: not closed")
        check(found["defects"] == [], f"{name}: {found['defects']}")
        check(found["polygons"] == (0 if name == "a.stl" else len(polygons)), f"{name}: polygons")
        check(found["maps"] == (["quality"] if name.endswith("ply") else []), f"{name}: maps")
    turned = description(os.path.join(folder, "a.obj"), "--scale", "0.001", "--up", "y")
    y_up = 0.001 * np.stack([vertices[:, 0], -vertices[:, 2], vertices[:, 1]], axis=1)
    check_measures(turned, measures(y_up, polygons), "scaled and turned")


def test_defects(folder):
    path = os.path.join(folder, "defects.obj")
    with open(path, "w") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 9 9 9\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 1 4\nf 1 2 6\n")
    found = {d["kind"]: d for d in description(path)["defects"]}
    check(found["zero_area_triangles"]["first"] == [0], f"zero area: {found}")
    check(found["zero_area_triangles"]["effect"] == "refused", "effect of zero area")
    check(found["duplicate_triangles"]["first"] == [2], "duplicates")
    check(found["isolated_vertices"]["first"] == [4], "isolated")
    check(found["nonmanifold_edges"]["first"] == [[0, 1]], "non-manifold")
    result = info(path)
    check(result.returncode == 0 and result.stderr == "", "a mesh with defects is no error")
    for text in ("triangles without area: 1\n", "triangle 0\n", "remedy: "):
        check(text in result.stdout, f"not in the text: {text!r}")


def test_crossings(folder):
    path = os.path.join(folder, "crossing.obj")
    with open(path, "w") as file:
        file.write("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 1\nv 1 9 1\nf 1 2 3\nf 4 5 6\n")
    found = description(path)["defects"]
    check([d["kind"] for d in found] == ["crossings"], f"crossing triangles: {found}")
    check(found[0]["count"] == 2 and found[0]["element"] == "triangle", f"crossing triangles: {found}")
    check(found[0]["first"] == [[0, 1], [1, 0]] and found[0]["effect"] == "harmless", f"first crossings: {found}")
    check(np.allclose(found[0]["point"], [1, 3, 0], atol=1e-12), f"point: {found}")
    result = info(path)
    check(result.returncode == 0 and result.stderr == "", "a mesh that crosses itself is no error")
    for text in ("  harmless crosses itself: triangles 0 and 1 (and 1 more)\n", "           at (1, 3, 0) m\n", "remedy: "):
        check(text in result.stdout, f"not in the text: {text!r} {result.stdout}")
    found = description(path, "--scale", "0.5", "--up", "y")["defects"]
    check(np.allclose(found[0]["point"], [0.5, 0, 1.5], atol=1e-12), f"scaled and turned: {found}")

    with open(path, "w") as file:  # a vertex on the triangle, and one beside it
        file.write("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 0\nv 1 1 1\nv 1 9 1\nf 1 2 3\nf 4 5 6\n")
    check(description(path)["defects"] == [], "what touches crosses")
    check("No defects." in info(path).stdout, "what touches is a defect")
    check(description(path)["all_crossings_found"], "a search in part")

    with open(path, "w") as file:  # far more triangles than a surface has
        file.write("v 0 0 0\nv 4 0 0\nv 0 4 0\n" + 100 * "f 1 2 3\n")
    check(not description(path)["all_crossings_found"], "what is no surface was searched")
    check("  crossings        looked for in part: too many triangles overlap\n" in info(path).stdout, "a search in part")
    path = os.path.join(folder, "crossing.mesh")
    with open(path, "w") as file:
        file.write("MeshVersionFormatted 2\nDimension 3\nVertices 8\n0 0 0 0\n4 0 0 0\n0 4 0 0\n0 0 4 0\n"
                   "1 1 -1 0\n1.5 1 -1 0\n1 1.5 -1 0\n1 1 1 0\nTetrahedra 2\n1 2 3 4 0\n5 6 7 8 0\nEnd\n")
    found = description(path)["defects"]
    check([d["kind"] for d in found] == ["crossings"] and found[0]["element"] == "edge", f"tetrahedra: {found}")
    check(found[0]["first"] == [[4, 7], [5, 7], [6, 7]] and found[0]["count"] == 3, f"tetrahedra: {found}")
    check("crosses itself: edge 4-7 and face 0-2-1 (and 2 more)\n" in info(path).stdout, "tetrahedra in the text")


def test_units(folder):
    path = os.path.join(folder, "size.obj")

    def suspected(length, *arguments):
        with open(path, "w") as file:
            file.write(f"v 0 0 0\nv {length} 0 0\nv 0 0 {length / 4}\nf 1 2 3\n")
        return description(path, *arguments)["suspected_unit"]

    for length, unit, scale in [(1700, "millimeters", 0.001), (170, "centimeters", 0.01), (0.0017, "kilometers", 1000)]:
        found = suspected(length)
        check(found is not None and found["unit"] == unit and found["scale"] == scale, f"{length}: {found}")
    found = suspected(1700)
    text = "1.7 by 0 by 0.425 km: is the file in millimeters? then --scale 0.001"
    check(found["text"] == text, f"text: {found}")
    suspected(1700)
    check(f"  unit             {text}\n" in info(path).stdout, "the unit is not in the text")
    for length in (1.7, 0.02, 50, 1e6, 1e-7):
        check(suspected(length) is None, f"{length} is suspected")
        check("  unit " not in info(path).stdout, f"{length}: a unit in the text")
    check(suspected(1700, "--scale", "0.001") is None, "suspected once scaled")
    found = suspected(1.7, "--scale", "0.001")
    check(found is not None and found["scale"] == 1, f"a wrong scale: {found}")


def test_refusals(folder):
    def refused(arguments, text):
        result = info(*arguments)
        check(result.returncode == 2, f"{arguments}: exit code {result.returncode}")
        check(result.stderr.startswith("pliant: error: ") and result.stderr.count("\n") == 1, result.stderr)
        check(text in result.stderr, f"{text!r} is not in {result.stderr!r}")

    obj = os.path.join(folder, "a.obj")
    refused([os.path.join(folder, "none.ply")], "no such file")
    refused([folder + "/a.fbx"], "known: .obj, .ply, .off, .stl")
    refused([obj, "--scale", "0"], "scale: 0 is out of range")
    refused([obj, "--scale", "nan"], "scale")
    refused([obj, "--up", "w"], "--up")
    refused([], "file")
    bad = os.path.join(folder, "bad\x1b[31m\n.obj")
    with open(bad, "w") as file:
        file.write("v 0 0\n")
    result = info(bad)
    check(result.returncode == 2 and result.stderr.count("\n") == 1, f"a file's name on two lines: {result.stderr!r}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        test_formats(folder)
        test_defects(folder)
        test_crossings(folder)
        test_units(folder)
        test_refusals(folder)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
