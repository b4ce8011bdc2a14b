#!/usr/bin/env python3
"""Writes hand.json beside this script: a scene whose mesh is a hand, the smoothed surface of a few dozen cubes.

  experiments/hand/make_hand.py
"""
import json
from pathlib import Path

import numpy

CUBE = 0.012  # [m]


def cubes():
    """The cells of palm, four fingers and a thumb: x across, y through, z along the hand."""
    cells = {(x, y, z) for x in range(7) for y in range(2) for z in range(7)}
    for x, length in ((0, 5), (2, 7), (4, 8), (6, 6)):
        cells |= {(x, y, 7 + z) for y in range(2) for z in range(length)}
    cells |= {(7 + x, y, z) for x in range(4) for y in range(2) for z in (3 + x // 2, 4 + x // 2)}
    return cells


def surface(cells):
    """Vertices and outward triangles of the faces that only one cube has."""
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
    """Taubin's filter: rounds off and does not shrink."""
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


def main():
    vertices, triangles = surface(cubes())
    vertices = smooth(vertices, triangles)
    vertices -= [vertices[:, 0].mean(), vertices[:, 1].mean(), vertices[:, 2].min()]
    wrist = [int(i) for i in numpy.flatnonzero(vertices[:, 2] < 0.8 * CUBE)]
    scene = {
        "pliant": 1,
        "name": "hand",
        "description": "A weightless hand of skin alone, held at the wrist, is drawn at its fingertips and let go",
        "settings": {"iterations": 20},
        "steps": 420,
        "gravity": None,
        "bodies": [{
            "name": "hand",
            "mesh": {"vertices": numpy.round(vertices, 5).tolist(), "edges": [], "triangles": triangles, "tetrahedra": []},
            "mass": {"total": 0.5},
            "constraints": [
                {"type": "position", "name": "wrist", "on": wrist},
                {"type": "edge_spring", "name": "skin", "stiffness": 2000},
            ],
        }],
        "view": {"size": [480, 480], "camera": {"position": [0.02, -0.36, 0.14], "target": [0.02, 0, 0.085]}, "ground": False},
    }
    out = Path(__file__).resolve().with_name("hand.json")
    text = json.dumps(scene, separators=(", ", ": "))
    # A line for each value of the bodies, so that no line is longer than an embedded scene may have.
    text = text.replace("], [", "],\n[").replace('"mesh"', '\n"mesh"').replace('"constraints"', '\n"constraints"')
    out.write_text(text + "\n", encoding="utf-8")
    print(f"{out.name}: {len(vertices)} vertices, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
