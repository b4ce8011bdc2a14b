#!/usr/bin/env python3
"""Measures drape coefficients: a round cloth that hangs over the rim of a disc, as in the drape test of fabrics.

  scripts/drape.py [--pliant PROGRAM] [--out FOLDER] [--fabrics wool,polyester,faille] [--apparatus cusick,jis]
                   [--diagonals forward,alternating,crossed] [--cells 20] [--starts 1,2,3,4,5] [--steps 1500]
                   [--iterations 20] [--bare]

The coefficient is the share of the overhanging ring that the shadow from above covers [%]. Cells are counted over the
overhang. What lies between the two plates of the apparatus is flat and fixed, and leaves it horizontally; the rest lies
on a platform at first, which is lowered slowly: lowered faster, or let go at once, cloth falls into more folds. A start
is a small random disturbance, the same on every mesh; --starts=-8 disturbs into eight folds alone. A fabric is the
material of that name as it is; --bare: isotropic, of its weight and bending, twice its shear as the stiffness of
`triangle_strain`. Published coefficients and their source are in docs/materials.md. Scenes, runs and `drape.csv` are in
FOLDER, default out/drape; runs that are there are not made again. Needs python3-numpy and python3-pil.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess

import numpy
from PIL import Image, ImageDraw

SOURCE = pathlib.Path(__file__).resolve().parent.parent
APPARATUS = {"cusick": (0.09, 0.15), "jis": (0.0635, 0.127)}  # radius of the disc and of the cloth [m]
BARE = {"wool": (0.1629, 78, 6.57e-6), "polyester": (0.1165, 68, 7.55e-6), "faille": (0.1043, 40, 1.86e-6)}
TIME_STEP = 1 / 60
SPEED = 0.005  # of the platform [m/s]; half of it changes nothing, four times as much makes more folds


def mesh_of(cells, diagonals, disc, rim):
    """Vertices, triangles and clamped vertices. Rings of cells that are square halfway; a clamp acts half a row behind
    the last clamped row, which therefore lies that much outside the disc."""
    behind = 0.25 if diagonals == "crossed" else 0.5
    size = (rim - disc) / (cells + behind)
    radii = disc + behind * size + size * numpy.arange(-1, cells + 1)
    around = 2 * round(math.pi * (disc + rim) / 2 / size)
    angles = 2 * math.pi * numpy.arange(around) / around
    vertices = [[r * math.cos(a), r * math.sin(a), 0] for r in radii for a in angles]
    faces = []
    for j in range(len(radii) - 1):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            c, d = a + around, b + around
            if diagonals == "crossed":
                r, angle = (radii[j] + radii[j + 1]) / 2, 2 * math.pi * (i + 0.5) / around
                middle = len(vertices)
                vertices.append([r * math.cos(angle), r * math.sin(angle), 0])
                faces += [(a, c, middle), (c, d, middle), (d, b, middle), (b, a, middle)]
            elif diagonals == "forward" or (i + j) % 2 == 0:
                faces += [(a, c, d), (a, d, b)]
            else:
                faces += [(a, c, b), (b, c, d)]
    vertices = numpy.array(vertices)
    clamped = numpy.flatnonzero(numpy.hypot(vertices[:, 0], vertices[:, 1]) < radii[1] + 1e-6)
    return vertices, numpy.array(faces), clamped


def disturbance(vertices, start, disc, rim):
    """Heights of up to some tenths of a millimeter, by the angle alone, growing towards the rim."""
    angle = numpy.arctan2(vertices[:, 1], vertices[:, 0])
    share = numpy.maximum(numpy.hypot(vertices[:, 0], vertices[:, 1]) - disc, 0) / (rim - disc)
    if start < 0:
        return 2e-3 * share ** 2 * numpy.cos(-start * angle)
    random = numpy.random.default_rng(start)
    waves = [(random.normal(), random.uniform(0, 2 * math.pi)) for _ in range(2, 13)]
    return 2e-4 * share ** 2 * sum(a * numpy.cos(k * angle + phase) for k, (a, phase) in enumerate(waves, 2))


def coefficient(positions, faces, disc, rim):
    """Of the shadow, drawn with pixels of about 0.1 mm."""
    pixels, extent = 4000, 1.15 * rim
    places = (positions[:, :2] + extent) * (pixels / (2 * extent))
    shadow = Image.new("1", (pixels, pixels))
    draw = ImageDraw.Draw(shadow)
    for face in faces:
        draw.polygon([tuple(places[v]) for v in face], fill=1)
    radius = disc * pixels / (2 * extent)
    draw.ellipse([pixels / 2 - radius, pixels / 2 - radius, pixels / 2 + radius, pixels / 2 + radius], fill=1)
    area = numpy.count_nonzero(numpy.array(shadow)) * (2 * extent / pixels) ** 2
    return 100 * (area - math.pi * disc ** 2) / (math.pi * (rim ** 2 - disc ** 2))


def folds_of(vertices, positions, rim):
    """Waves of the rim's distance from the axis: how often it crosses its mean, halved, without its oval."""
    at_rim = numpy.flatnonzero(numpy.hypot(vertices[:, 0], vertices[:, 1]) > rim - 1e-6)
    order = at_rim[numpy.argsort(numpy.arctan2(vertices[at_rim, 1], vertices[at_rim, 0]))]
    radii = numpy.hypot(positions[order, 0], positions[order, 1])
    waves = numpy.fft.rfft(radii)
    waves[:3] = 0
    outside = numpy.fft.irfft(waves, len(radii)) > 0
    return int(numpy.count_nonzero(outside != numpy.roll(outside, 1))) // 2


def scene_of(fabric, is_bare, clamped, steps, iterations):
    clamp = {"type": "position", "on": [int(v) for v in clamped]}
    body = {"name": "cloth", "mesh": {"file": "cloth.obj"}}
    if is_bare:
        density, strain, bending = BARE[fabric]
        body |= {"mass": {"area_density": density},
                 "constraints": [{"type": "triangle_strain", "stiffness": strain},
                                 {"type": "triangle_bending", "stiffness": bending}, clamp]}
    else:
        body |= {"material": {"name": fabric, "direction": [1, 0, 0]}, "constraints": [clamp]}
    platform = {"type": "plane", "name": "platform", "position": [0, 0, -0.002], "velocity": [0, 0, -SPEED], "friction": 0}
    return {"pliant": 1, "steps": steps, "bodies": [body], "colliders": [platform],
            "contact": {"surfaces": False, "distance": 0.001},  # implicit Euler, whose damping brings it to rest:
            "settings": {"integrator": "implicit_euler", "iterations": iterations, "acceleration": "lbfgs", "start": "adaptive", "time_step": TIME_STEP}}


def read_vertices(path):
    return numpy.array([[float(x) for x in line.split()[1:4]] for line in path.read_text().splitlines() if line.startswith("v ")])


def measured(options, fabric, apparatus, diagonals, cells, start):
    disc, rim = APPARATUS[apparatus]
    vertices, faces, clamped = mesh_of(cells, diagonals, disc, rim)
    raised = vertices.copy()
    raised[:, 2] += disturbance(vertices, start, disc, rim)
    folder = pathlib.Path(options.out) / f"{fabric}_{apparatus}_{diagonals}_{cells}_{start}_{options.steps}_{options.iterations}{'_bare' if options.bare else ''}"
    run, end = folder / "run", folder / "end.obj"
    if not (run / "run.json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        lines = [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in raised] + ["f " + " ".join(str(v + 1) for v in face) for face in faces]
        (folder / "cloth.obj").write_text("\n".join(lines) + "\n")
        (folder / "scene.json").write_text(json.dumps(scene_of(fabric, options.bare, clamped, options.steps, options.iterations)) + "\n")
        command = [options.pliant, "run", folder / "scene.json", "--out", run, "--quiet", "--threads", "1",
                   "--every", str(options.steps)]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    subprocess.run([options.pliant, "convert", run, end, "--time", str(options.steps * TIME_STEP)], check=True, capture_output=True)
    positions = read_vertices(end)
    last = list(csv.DictReader((run / "measurements.csv").open()))[-1]
    return {"fabric": fabric, "apparatus": apparatus, "diagonals": diagonals, "cells": cells, "vertices": len(vertices),
            "start": start, "coefficient": round(coefficient(positions, faces, disc, rim), 2),
            "folds": folds_of(vertices, positions, rim), "speed_mm_s": round(1000 * float(last["speed_sum"]) / len(vertices), 4)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pliant", default=str(SOURCE / "build/release/bin/pliant"))
    parser.add_argument("--out", default="out/drape")
    parser.add_argument("--fabrics", default="wool,polyester,faille")
    parser.add_argument("--apparatus", default="cusick")
    parser.add_argument("--diagonals", default="forward")
    parser.add_argument("--cells", default="20")
    parser.add_argument("--starts", default="1,2,3,4,5")
    parser.add_argument("--steps", type=int, default=1500)
    parser.add_argument("--iterations", type=int, default=20)
    parser.add_argument("--bare", action="store_true")
    options = parser.parse_args()
    table = []
    for fabric in options.fabrics.split(","):
        for apparatus in options.apparatus.split(","):
            for diagonals in options.diagonals.split(","):
                for cells in (int(text) for text in options.cells.split(",")):
                    rows = [measured(options, fabric, apparatus, diagonals, cells, int(start)) for start in options.starts.split(",")]
                    each = [row["coefficient"] for row in rows]
                    print(f"{fabric}, {apparatus}, {diagonals}, {cells} cells, {rows[0]['vertices']} vertices: mean "
                          f"{numpy.mean(each):.1f} %, deviation {numpy.std(each):.1f}; each (folds, mm/s): " +
                          ", ".join(f"{row['coefficient']} ({row['folds']}, {row['speed_mm_s']})" for row in rows), flush=True)
                    table += rows
    with (pathlib.Path(options.out) / "drape.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, table[0])
        writer.writeheader()
        writer.writerows(table)


if __name__ == "__main__":
    main()
