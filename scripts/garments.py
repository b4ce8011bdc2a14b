#!/usr/bin/env python3
"""Makes garments on three resolutions, simulates them and lays their pictures out as contact sheets, to be looked at.

  scripts/garments.py [--pliant PROGRAM] [--out FOLDER] [--only NAME,..] [--levels 0,1,2] [--material NAME] [--strip]

Without --only: a dress of panels, a skirt, a curtain, a flag, a towel and a sock, and the t-shirt of ../shared/meshes where
that is, as given and subdivided once and twice. Each finer level has half the edge length. Scenes, meshes, runs, pictures and
`garments.csv` (stretch past the limits at most and at the end, mean speed in the last second, smallest gap, crossings of a body
with itself at the end, median time a step) are in FOLDER, default out/garments. --material makes all of them of one material; --materials one garment (the first of --only, a skirt by default) of
each. --strip draws six moments of each, in place of its end. Needs python3-numpy and python3-pil.
"""
import argparse
import copy
import csv
import json
import math
import pathlib
import subprocess

import numpy
from PIL import Image, ImageDraw, ImageFont

SOURCE = pathlib.Path(__file__).resolve().parent.parent
SHIRT = SOURCE.parent / "shared" / "meshes" / "tshirt.obj"
SHEETS = ("cotton", "denim", "faille", "felt", "habotai", "leather", "paper", "polyester", "rubber_sheet", "silk", "steel_sheet",
          "wool")
FONT = ImageFont.load_default()
SETTINGS = {"integrator": "bdf2", "iterations": 20, "acceleration": "lbfgs", "start": "adaptive"}
AIR = {"type": "wind", "velocity": [0, 0, 0], "drag": 0.2}


def scene_of(steps, bodies, camera, target, view=32, **more):
    return {"pliant": 1, "settings": SETTINGS, "steps": steps, "bodies": bodies, "forces": [AIR], "contact": {}} | more | {
        "view": {"camera": {"position": camera, "target": target, "field_of_view": view}, "light": [-0.9, -0.6, 0.9]}}


def body(name, mesh, material, *constraints, **more):
    return {"name": name, "mesh": mesh, "material": material, "constraints": list(constraints)} | more


def write_obj(path, vertices, faces, places):
    """`places`: texture coordinates, in meters of cloth: v runs along the warp."""
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in vertices] + [f"vt {u:.6f} {v:.6f}" for u, v in places]
    path.write_text("\n".join(lines + ["f " + " ".join(f"{v + 1}/{v + 1}" for v in face) for face in faces]) + "\n")


def strip_of_quads(around, rows, is_closed):
    """Faces of rows of vertices, cut along alternating diagonals."""
    faces = []
    for j in range(rows - 1):
        for i in range(around if is_closed else around - 1):
            a, b = j * around + i, j * around + (i + 1) % around
            c, d = a + around, b + around
            faces += [(a, b, d), (a, d, c)] if (i + j) % 2 == 0 else [(a, b, c), (b, d, c)]
    return faces


def dress(level, material, folder):
    """The built-in scene, of more vertices."""
    scene = json.loads((SOURCE / "scenes" / "dress_from_panels.json").read_text())
    for panel in scene["bodies"][1:]:
        for key in ("columns", "rows"):
            panel["mesh"][key] = (panel["mesh"][key] - 1) * 2 ** level // 2 + 1
        panel["material"] = material
    scene["contact"] = {"distance": 0.006 / 1.5 ** level}
    return scene


def skirt(level, material, folder):
    """A circle of cloth with a hole, worn: its waist turns with the hips."""
    around, rows = 48 * 2 ** level, 10 * 2 ** level + 1
    angles, radii = 2 * math.pi * numpy.arange(around) / around, numpy.linspace(0.115, 0.565, rows)
    flat = numpy.array([[r * math.cos(a), r * math.sin(a), 0] for r in radii for a in angles])
    write_obj(folder / "skirt.obj", flat, strip_of_quads(around, rows, True), flat[:, :2])
    waist = {"type": "position", "name": "waist", "on": list(range(around))}
    return scene_of(360, [body("skirt", {"file": "skirt.obj"}, material, waist, transform={"translate": [0, 0, 0.98]})],
                    [0.9, -2.2, 1.1], [0, 0, 0.68], 28,
                    colliders=[{"type": "capsule", "name": "hips", "from": [-0.04, 0, 0.88], "to": [0.04, 0, 0.88], "radius": 0.11},
                               {"type": "capsule", "name": "left leg", "from": [-0.08, 0, 0.84], "to": [-0.1, 0, 0.08], "radius": 0.07},
                               {"type": "capsule", "name": "right leg", "from": [0.08, 0, 0.84], "to": [0.1, 0, 0.08], "radius": 0.07}],
                    moves=[{"group": "waist", "time": 2, "over": 1.5, "ease": "smooth", "center": [0, 0, 0],
                            "rotate": {"axis": [0, 0, 1], "degrees": 360}}])


def curtain(level, material, folder):
    """Hangs on nine hooks that are drawn together."""
    cells = 24 * 2 ** level
    hooks = [[0.2 * i, 0, 1.8] for i in range(9)]
    offsets = [[0.11 * (4 - i), 0.03 * (-1) ** i, 0] for i in range(9)]
    return scene_of(360, [body("curtain", {"shape": "grid", "columns": cells + 1, "rows": cells + 1, "size": [1.6, 1.8],
                                           "diagonals": "alternating"}, material,
                               {"type": "position", "name": "hooks", "on": {"nearest": hooks}})],
                    [1.7, -3.8, 1.3], [0.8, 0, 0.9],
                    moves=[{"group": "hooks", "time": 0, "over": 2, "ease": "smooth", "offset": offsets}])


def flag(level, material, folder):
    columns, rows = 24 * 2 ** level + 1, 16 * 2 ** level + 1
    pole = {"type": "position", "name": "pole", "on": {"box": {"min": [0, 0, 0], "max": [0, 0, 1]}}}
    wind = {"type": "wind", "velocity": [5, 1.5, 0], "drag": 0.6, "gust_strength": 0.3, "gust_period": 1.2}
    return scene_of(300, [body("flag", {"shape": "grid", "columns": columns, "rows": rows, "size": [1.5, 1],
                                        "diagonals": "alternating"}, material, pole)],
                    [0.9, -3.4, 0.7], [0.7, 0.1, 0.45], forces=[wind])


def towel(level, material, folder):
    """Falls onto a rail and hangs over it."""
    columns, rows = 16 * 2 ** level + 1, 32 * 2 ** level + 1
    return scene_of(300, [body("towel", {"shape": "grid", "columns": columns, "rows": rows, "size": [0.6, 1.2], "plane": "xy",
                                         "diagonals": "alternating"}, material, transform={"rotate": {"axis": [0, 0, 1], "degrees": 12},
                                                                                        "translate": [-0.17, -0.6, 1.02]})],
                    [1.2, -2, 1.35], [0, 0, 0.68],
                    colliders=[{"type": "capsule", "name": "rail", "from": [-0.45, 0, 1], "to": [0.45, 0, 1], "radius": 0.02,
                                "friction": 0.6}])


def sock(level, material, folder):
    """A tube with a heel, closed at its toe; it hangs by two pegs in the wind."""
    around, rows = 20 * 2 ** level, 24 * 2 ** level + 1
    bend = [[0.065 - 0.065 * math.cos(a), 0, 0.065 - 0.065 * math.sin(a)] for a in numpy.linspace(0, math.pi / 2, 60)]
    line = numpy.array([[0, 0, 0.3], *bend, [0.2, 0, 0]])
    lengths = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(line, axis=0), axis=1))])
    at = numpy.linspace(0, lengths[-1], rows)
    middles = numpy.column_stack([numpy.interp(at, lengths, line[:, k]) for k in range(3)])
    ahead = numpy.gradient(middles, axis=0)
    ahead /= numpy.linalg.norm(ahead, axis=1)[:, None]
    side = numpy.array([0.0, 1, 0])
    vertices, places = [], []
    for j in range(rows):
        to_toe = max(0.0, (at[j] - lengths[-1] + 0.05) / 0.05)
        radius = 0.042 * math.sqrt(max(0.04, 1 - 0.97 * to_toe ** 2))
        up = numpy.cross(ahead[j], side)
        for i in range(around):
            angle = 2 * math.pi * i / around
            vertices.append(middles[j] + radius * (math.cos(angle) * up + math.sin(angle) * side))
            places.append([0.042 * angle, -at[j]])
    toe = len(vertices)
    last = (rows - 1) * around
    vertices.append(middles[-1] + 0.004 * ahead[-1])
    places.append([0, -lengths[-1]])
    faces = strip_of_quads(around, rows, True) + [(last + i, last + (i + 1) % around, toe) for i in range(around)]
    write_obj(folder / "sock.obj", numpy.array(vertices), faces, places)
    pegs = {"type": "position", "name": "pegs", "on": {"nearest": [[-0.03, y, 0.3] for y in (-0.03, -0.02, -0.01, 0.01, 0.02, 0.03)]}}
    return scene_of(300, [body("sock", {"file": "sock.obj"}, material, pegs)], [0.25, -0.85, 0.3], [0.04, 0, 0.13],
                    forces=[{"type": "wind", "velocity": [0.3, 0.8, 0], "drag": 0.3, "gust_strength": 0.7}])


def read_obj(path):
    """Vertices, polygons and their corners' texture coordinates."""
    vertices, places, faces, corners = [], [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(x) for x in words[1:4]])
        elif words[:1] == ["vt"]:
            places.append([float(x) for x in words[1:3]])
        elif words[:1] == ["f"]:
            numbers = [word.split("/") for word in words[1:]]
            faces.append([int(n[0]) - 1 for n in numbers])
            corners.append([int(n[1]) - 1 for n in numbers])
    return vertices, places, faces, corners


def subdivided(vertices, places, faces, corners):
    """Each triangle cut into four at the middles of its edges."""
    vertices, places = list(vertices), list(places)

    def middle(of, known, a, b):
        key = (min(a, b), max(a, b))
        if key not in known:
            known[key] = len(of)
            of.append([(x + y) / 2 for x, y in zip(of[a], of[b])])
        return known[key]

    def cut(of, triangles):
        known, result = {}, []
        for a, b, c in triangles:
            ab, bc, ca = middle(of, known, a, b), middle(of, known, b, c), middle(of, known, c, a)
            result += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        return result

    return vertices, places, cut(vertices, faces), cut(places, corners)


def tshirt(level, material, folder):
    """On a line by its shoulders, in a light wind."""
    vertices, places, faces, corners = read_obj(SHIRT)
    triangles = [[polygon[0], polygon[k], polygon[k + 1]] for polygon in faces for k in range(1, len(polygon) - 1)]
    cut = [[polygon[0], polygon[k], polygon[k + 1]] for polygon in corners for k in range(1, len(polygon) - 1)]
    mesh = (vertices, places, triangles, cut)
    for _ in range(level):
        mesh = subdivided(*mesh)
    vertices, places, triangles, cut = mesh
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in vertices] + [f"vt {u:.7g} {v:.7g}" for u, v in places]
    lines += ["f " + " ".join(f"{v + 1}/{t + 1}" for v, t in zip(*pair)) for pair in zip(triangles, cut)]
    (folder / "tshirt.obj").write_text("\n".join(lines) + "\n")
    hanger = {"type": "position", "name": "hanger", "on": {"half_space": {"point": [0, 0, 0.7], "normal": [0, 0, 1]}}}
    return scene_of(300, [body("tshirt", {"file": "tshirt.obj", "scale": 0.06, "up": "y"}, material, hanger)],
                    [0.6, -1.7, 0.6], [0, 0, 0.42],
                    forces=[{"type": "wind", "velocity": [0.1, 0.8, 0], "drag": 0.5, "gust_strength": 0.7}])


GARMENTS = {"dress": (dress, "cotton"), "skirt": (skirt, "wool"), "curtain": (curtain, "polyester"), "flag": (flag, "faille"),
            "towel": (towel, "cotton"), "sock": (sock, "wool"), "tshirt": (tshirt, "cotton")}


def crossings_at_end(run, info, pliant):
    """Of each free body with itself, at the end of a run. Where it began so is in the run's warnings."""
    count = 0
    for each in info["bodies"]:
        if each["name"] == "form":
            continue
        mesh = run / "end.obj"
        time = str(info["steps"] * info["settings"]["time_step"])
        subprocess.run([pliant, "convert", run, mesh, "--body", each["name"], "--time", time], check=True, capture_output=True)
        found = json.loads(subprocess.run([pliant, "info", mesh, "--json"], check=True, capture_output=True).stdout)
        count += sum(defect["count"] for defect in found["defects"] if defect["kind"] == "crossings")
    return count


def measured(run, pliant):
    """What the table says of a run, looking at its last second for what is at rest."""
    rows = list(csv.DictReader((run / "measurements.csv").open()))
    info = json.loads((run / "run.json").read_text())
    count = sum(each["vertices"] for each in info["bodies"] if each["name"] != "form")
    end = rows[-60:]
    milliseconds = sorted(float(row["ms_total"]) for row in rows[1:])
    return {"vertices": count,
            "past_limits": f"{max(float(row['past_limits']) for row in rows):.3f}",
            "past_limits_end": f"{float(rows[-1]['past_limits']):.3f}",
            "speed_end_mm_s": f"{1000 * sum(float(row['speed_sum']) for row in end) / len(end) / count:.2f}",
            "residual_end_N": f"{float(rows[-1]['residual']):.2g}",
            "smallest_gap_mm": f"{1000 * min(float(row['smallest_gap']) for row in rows):.2g}",
            "let_go": int(max(float(row["let_go"]) for row in rows)),
            "crossings_end": crossings_at_end(run, info, pliant),
            "ms_step": f"{milliseconds[len(milliseconds) // 2]:.1f}"}


class Studio:
    def __init__(self, options):
        self.pliant = options.pliant
        self.out = pathlib.Path(options.out)
        self.is_strip = options.strip
        self.table = []

    def run_one(self, garment, level, material):
        """Runs it unless that is done; the picture of it."""
        name = f"{garment}_{level}_{material}"
        folder = self.out / name
        folder.mkdir(parents=True, exist_ok=True)
        scene_file, run = folder / "scene.json", folder / "run"
        scene_file.write_text(json.dumps(GARMENTS[garment][0](level, material, folder), indent=1) + "\n")
        if not (run / "run.json").exists():
            subprocess.run([self.pliant, "run", scene_file, "--out", run, "--quiet", "--threads", "1"], check=True)
        row = {"garment": garment, "level": level, "material": material} | measured(run, self.pliant)
        self.table.append(row)
        print(" ".join(f"{key}={value}" for key, value in row.items()), flush=True)
        picture = folder / ("strip.png" if self.is_strip else "end.png")
        more = ["--size", "1260x1260", "--frames", "6", "--sheet"] if self.is_strip else ["--size", "480x480"]
        subprocess.run([self.pliant, "render", run, "--out", picture, "--quiet", *more], check=True, capture_output=True)
        return picture, f"{garment}, {material}, {row['vertices']} vertices"

    def sheet(self, name, cells, columns):
        """Lays pictures out in rows, with a line of text below each."""
        pictures = [Image.open(picture) for picture, _ in cells]
        width, height, line = *pictures[0].size, 24
        sheet = Image.new("RGB", (columns * width, -(-len(cells) // columns) * (height + line)), "white")
        for i, (picture, (_, text)) in enumerate(zip(pictures, cells)):
            corner = (i % columns * width, i // columns * (height + line))
            sheet.paste(picture, corner)
            ImageDraw.Draw(sheet).text((corner[0] + 6, corner[1] + height + 4), text, "black", FONT)
        sheet.save(self.out / name)
        print(self.out / name)

    def write_table(self):
        with (self.out / "garments.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, self.table[0])
            writer.writeheader()
            writer.writerows(self.table)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pliant", default=str(SOURCE / "build/release/bin/pliant"))
    parser.add_argument("--out", default="out/garments")
    parser.add_argument("--only", default="")
    parser.add_argument("--levels", default="0,1,2")
    parser.add_argument("--material", default="")
    parser.add_argument("--materials", action="store_true")
    parser.add_argument("--strip", action="store_true")
    options = parser.parse_args()
    studio = Studio(options)
    levels = [int(level) for level in options.levels.split(",")]
    names = options.only.split(",") if options.only else [name for name in GARMENTS if name != "tshirt" or SHIRT.exists()]
    if options.materials:
        garment = names[0] if options.only else "skirt"
        cells = [studio.run_one(garment, levels[0], material) for material in SHEETS]
        studio.sheet(f"materials_{garment}.png", cells, 1 if options.strip else 4)
    else:
        cells = [studio.run_one(name, level, options.material or GARMENTS[name][1]) for name in names for level in levels]
        studio.sheet("strips.png" if options.strip else "garments.png", cells, 1 if options.strip else len(levels))
    studio.write_table()


if __name__ == "__main__":
    main()
