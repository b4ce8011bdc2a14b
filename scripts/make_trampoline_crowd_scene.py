#!/usr/bin/env python3
"""Writes the built-in scene scenes/trampoline_crowd.json: soft dolls, turned like skittles, on a trampoline.

  scripts/make_trampoline_crowd_scene.py
"""
import math
from pathlib import Path

from scene_text import text_of

SEGMENTS = 10
# Radius at each height [m], from the foot to the crown.
PROFILE = [(round(1.2 * r, 4), round(1.2 * z, 4)) for r, z in (
    (0.0, 0.0), (0.1, 0.004), (0.145, 0.05), (0.15, 0.12), (0.13, 0.2), (0.1, 0.27), (0.07, 0.31), (0.095, 0.36),
           (0.112, 0.41), (0.095, 0.465), (0.05, 0.497), (0.0, 0.505))]
MAT = 2.8  # [m]
HEIGHT = 0.9  # of the mat [m]


def doll():
    """Vertices and tetrahedra of a body of revolution about z: an axis, and a ring at each level."""
    axis = list(range(len(PROFILE)))
    vertices = [[0.0, 0.0, z] for _, z in PROFILE]
    rings = [[0] * SEGMENTS for _ in PROFILE]
    for level, (radius, z) in enumerate(PROFILE):
        for i in range(SEGMENTS if radius else 0):
            angle = 2 * math.pi * i / SEGMENTS
            rings[level][i] = len(vertices)
            vertices.append([round(radius * math.cos(angle), 4), round(radius * math.sin(angle), 4), z])
    tetrahedra = []

    def add(*corners):
        a, b, c, d = (vertices[v] for v in corners)
        u, v, w = ([q - p for p, q in zip(a, e)] for e in (b, c, d))
        volume = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
        tetrahedra.append(list(corners) if volume > 0 else [corners[0], corners[2], corners[1], corners[3]])

    last = len(PROFILE) - 1
    for i in range(SEGMENTS):
        j = (i + 1) % SEGMENTS
        add(axis[0], axis[1], rings[1][i], rings[1][j])
        add(axis[last], axis[last - 1], rings[last - 1][i], rings[last - 1][j])
        for level in range(1, last - 1):
            # Each wedge is three tetrahedra, cut so that its neighbors are cut alike.
            columns = [(axis[level], axis[level + 1])] + sorted((rings[level][k], rings[level + 1][k]) for k in (i, j))
            (a, a1), (b, b1), (c, c1) = columns
            add(a, b, c, c1)
            add(a, b, b1, c1)
            add(a, a1, b1, c1)
    return {"vertices": vertices, "tetrahedra": tetrahedra}


def stripe(foot):
    """Width of stripes [m] of which one, with an even number, has the coat of a doll that begins at that height."""
    neck = foot + 0.37
    return round(neck / max(k for k in range(1, 100, 2) if neck / k > 0.39), 4)


def rod(start, end, radius):
    d = [b - a for a, b in zip(start, end)]
    length = math.sqrt(sum(v * v for v in d))
    angle = math.degrees(math.acos(d[2] / length))
    transform = {"rotate": {"axis": [-d[1], d[0], 0], "degrees": round(angle, 3)}} if angle else {}
    return {"shape": "cylinder", "segments": 12, "rows": 2, "caps": "closed", "radius": radius, "height": round(length, 4),
            "transform": transform | {"translate": start}}


def frame():
    half = MAT / 2 + 0.09
    corners = [[-half, -half], [half, -half], [half, half], [-half, half]]
    parts = []
    for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
        parts.append(rod([x, y, HEIGHT], [u, v, HEIGHT], 0.06))
        parts.append({"shape": "sphere", "subdivisions": 2, "radius": 0.06, "transform": {"translate": [x, y, HEIGHT]}})
        for share in (0.12, 0.88):
            p, q = x + share * (u - x), y + share * (v - y)
            parts.append(rod([round(p, 4), round(q, 4), 0.03], [round(p, 4), round(q, 4), HEIGHT], 0.03))
    return parts


def scene():
    # name, coat, where and how it falls, and its velocity
    crowd = [("red", "#c2453a", [1, 0, 0], 4, [-0.6, -0.4, 0.3], [0.25, 0.1, 0]),
             ("yellow", "#e0a92e", [0, 1, 0.3], -3, [0.45, -0.5, 0.75], [-0.15, 0.2, 0]),
             ("green", "#4f8f57", [1, 0, 0.5], 5, [-0.45, 0.5, 1.05], [0.2, -0.2, 0]),
             ("blue", "#3d6ea8", [1, 1, 0], -4, [0.55, 0.45, 0.5], [-0.2, -0.2, 0]),
             ("violet", "#7b5a9c", [0, 1, 0], 3, [0.0, -0.05, 1.25], [0, 0, 0]),
             ("teal", "#2f8a8a", [1, 0, 0], -5, [-0.75, 0.1, 1.5], [0.3, 0, 0]),
             ("orange", "#d9752c", [0.3, 1, 0], 4, [0.5, 0.0, 1.7], [-0.1, 0, 0])]
    bodies = [
        {"name": "mat",
         "appearance": {"front": "#2c3a4b", "back": "#2c3a4b", "pattern": "checker", "pattern_color": "#3c4f64", "pattern_size": 0.2},
         "mesh": {"shape": "grid", "columns": 45, "rows": 45, "size": [MAT, MAT], "plane": "xy", "diagonals": "alternating"},
         "transform": {"translate": [-MAT / 2, -MAT / 2, HEIGHT]},
         "mass": {"area_density": 0.5},
         "constraints": [{"type": "position", "name": "rim", "on": "boundary"},
                         {"type": "triangle_strain", "name": "weave", "stiffness": 6000, "min_stretch": 0.9, "max_stretch": 0.9}]},
        {"name": "frame", "appearance": {"front": "#d8d3c6", "finish": "glossy"}, "mesh": {"parts": frame()}, "animation": {}}]
    for name, color, axis, degrees, place, velocity in crowd:
        bodies.append({
            "name": name,
            # Stripes are counted from the scene's origin; one of them ends at the neck.
            "appearance": {"front": color, "pattern": "stripes", "pattern_color": "#e3b892", "pattern_size": stripe(round(HEIGHT + place[2], 3)), "finish": "matte"},
            "mesh": doll(),
            "transform": {"rotate": {"axis": axis, "degrees": degrees}, "translate": [*place[:2], round(HEIGHT + place[2], 3)]},
            "mass": {"density": 300},
            "velocity": velocity,
            "constraints": [{"type": "tetrahedron_strain", "name": f"rubber of {name}", "stiffness": 2e6}]})
    return {
        "pliant": 1,
        "description": "Seven soft dolls drop onto a trampoline one after the other: watch each throw the others up, until they "
                       "lie together in the middle",
        "settings": {"integrator": "bdf2", "iterations": 30, "acceleration": "lbfgs"},
        "steps": 420,
        "bodies": bodies,
        "contact": {"friction": 0.3},
        "colliders": [{"type": "plane", "name": "floor"}],
        "view": {"camera": {"position": [2.9, -5.7, 2.5], "target": [0.05, 0, 1.28], "field_of_view": 38}, "light": [-0.7, -0.5, 0.9],
                 "subdivision": 1}}


if __name__ == "__main__":
    path = Path(__file__).resolve().parent.parent / "scenes/trampoline_crowd.json"
    path.write_text(text_of(scene()), encoding="utf-8")
