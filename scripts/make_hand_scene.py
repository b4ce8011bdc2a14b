#!/usr/bin/env python3
"""Writes the built-in scene scenes/hand.json, whose mesh is a hand: the smoothed surface of a few dozen cubes.

  scripts/make_hand_scene.py
"""
import json
from pathlib import Path

import numpy

CUBE = 0.012  # [m]

SCENE = """{
  "pliant": 1,
  "description": "A rubber hand full of air hung by its wrist is swung to and fro, then jolted: watch it lag, wobble and plump up again",
  "settings": { "iterations": 20 },
  "steps": 480,
  "bodies": [
    {
      "name": "hand",
      "transform": { "rotate": { "axis": [0, 1, 0], "degrees": 180 } },
      "mass": { "total": 0.5 },
      "constraints": [
        { "type": "position", "name": "wrist", "on": { "half_space": { "point": [0, 0, -0.0096], "normal": [0, 0, 1] } } },
        { "type": "triangle_strain", "name": "rubber", "stiffness": 800 },
        { "type": "hinge", "name": "bend", "stiffness": 0.001, "orientation": "signed" }
      ],
      "mesh": {
        "vertices": VERTICES,
        "triangles": TRIANGLES
      }
    }
  ],
  "forces": [{ "type": "pressure", "model": "gas", "pressure": 180 }],
  "moves": [
    { "group": "wrist", "time": 0.5, "over": 0.2, "offset": [0.06, 0, 0] },
    { "group": "wrist", "time": 1.0, "over": 0.3, "offset": [-0.12, 0, 0] },
    { "group": "wrist", "time": 1.6, "over": 0.3, "offset": [0.12, 0, 0] },
    { "group": "wrist", "time": 2.2, "over": 0.3, "offset": [-0.12, 0, 0] },
    { "group": "wrist", "time": 2.8, "over": 0.2, "offset": [0.06, 0, 0] },
    { "group": "wrist", "time": 4.5, "over": 0.1, "offset": [0, 0, 0.06] },
    { "group": "wrist", "time": 4.7, "over": 0.1, "offset": [0, 0, -0.06] }
  ]
}
"""


def cubes():
    """The cells of palm, four fingers and a thumb: x across, y through, z along the hand."""
    cells = {(x, y, z) for x in range(7) for y in range(2) for z in range(7)}
    for x, length in ((0, 5), (2, 7), (4, 8), (6, 6)):
        cells |= {(x, y, 7 + z) for y in range(2) for z in range(length)}
    cells |= {(7 + x, y, z) for x in range(4) for y in range(2) for z in (3 + x // 2, 4 + x // 2)}
    return cells


def surface(cells):
    """Vertices and outward triangles of the faces that belong to a single cube."""
    places, quads = {}, []
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                neighbor = list(cell)
                neighbor[axis] += 2 * side - 1
                if tuple(neighbor) in cells:
                    continue
                corners = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = list(cell)
                    corner[axis] += side
                    corner[(axis + 1) % 3] += u
                    corner[(axis + 2) % 3] += v
                    corners.append(places.setdefault(tuple(corner), len(places)))
                quads.append(corners if side else corners[::-1])
    vertices = CUBE * numpy.array(list(places), dtype=float)
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return vertices, triangles


def smooth(vertices, triangles, rounds=12):
    """Taubin's filter: smooths without shrinking."""
    neighbors = [set() for _ in vertices]
    for a, b, c in triangles:
        neighbors[a] |= {b, c}
        neighbors[b] |= {a, c}
        neighbors[c] |= {a, b}
    for _ in range(rounds):
        for factor in (0.5, -0.52):
            means = numpy.array([vertices[sorted(n)].mean(axis=0) for n in neighbors])
            vertices = vertices + factor * (means - vertices)
    return vertices


def rows(values):
    """JSON with a few entries a line, since an embedded scene must not have long ones."""
    per_line = 6
    texts = [json.dumps(value) for value in values]
    lines = [", ".join(texts[i:i + per_line]) for i in range(0, len(texts), per_line)]
    return "[\n          " + ",\n          ".join(lines) + "\n        ]"


def main():
    vertices, triangles = surface(cubes())
    vertices = smooth(vertices, triangles)
    vertices -= [vertices[:, 0].mean(), vertices[:, 1].mean(), vertices[:, 2].min()]
    vertices = numpy.round(vertices, 5)
    text = SCENE.replace("VERTICES", rows(vertices.tolist())).replace("TRIANGLES", rows(triangles))
    out = Path(__file__).resolve().parent.parent / "scenes" / "hand.json"
    out.write_text(text, encoding="utf-8")
    print(f"{out.name}: {len(vertices)} vertices, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
