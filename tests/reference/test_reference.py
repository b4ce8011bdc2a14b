#!/usr/bin/env python3
"""Runs the reference cases through `pliant run` and compares with an independent solver.

    PLIANT=build/release/bin/pliant tests/reference/test_reference.py [FOLDER ...]

Turns each case of the folders (default: cases/ beside this file) into a scene, runs it with 1, 5 and 20 iterations and
to convergence, with each back end, and asks for 1e-9 m and 1e-7 m.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

ITERATION_TOLERANCE = 1e-9  # m
CONVERGED_TOLERANCE = 1e-7  # m
MIXED_TOLERANCE = 1e-6  # m
HERE = pathlib.Path(__file__).resolve().parent


def of_type(case, kind):
    return [(i, c) for i, c in enumerate(case["constraints"]) if c["type"] == kind]


def column(found, key, scale=1.0):
    return [c[key] * scale for _, c in found]


def pins(found):
    return {
        "type": "position",
        "name": "pins",
        "hold": "soft",
        "stencils": [[c["v"]] for _, c in found],
        "targets": [c["target"] for _, c in found],
        "stiffness": column(found, "w"),
    }


def lines(found):
    return {
        "type": "line",
        "stencils": [[c["v"]] for _, c in found],
        "origin": [c["origin"] for _, c in found],
        "direction": [c["dir"] for _, c in found],
        "stiffness": column(found, "w"),
    }


def springs(found, name, scale, **more):
    return {
        **more,
        "type": "edge_spring",
        "name": name,
        "stencils": [c["v"] for _, c in found],
        "rest_length": column(found, "L"),
        "stiffness": column(found, "w", scale),
    }


def bending(found):
    return {
        "type": "bending",
        "stencils": [[c["v"], *c["nb"]] for _, c in found],
        "cotangents": [c["cot"] for _, c in found],
        "areas": column(found, "area"),
        "stiffness": column(found, "w"),
    }


def limited(found, kind, what):
    return {
        "type": kind,
        "stencils": [c["v"] for _, c in found],
        "stiffness": column(found, "w"),
        f"min_{what}": column(found, "min"),
        f"max_{what}": column(found, "max"),
    }


# The thesis' edge weight is twice the spring constant.
BUILDERS = {
    "point": pins,
    "line": lines,
    "edge": lambda found: springs(found, "edges", 0.5),
    "spring": lambda found: springs(found, "springs", 1.0),
    "bend": bending,
    "edge_id": lambda found: springs(found, "ends", 0.5, reduction="identity"),
    "tet": lambda found: limited(found, "tetrahedron_strain", "stretch"),
    "tetvol": lambda found: limited(found, "tetrahedron_volume", "volume"),
    "tri": lambda found: limited(found, "triangle_strain", "stretch"),
    "triarea": lambda found: limited(found, "triangle_area", "area"),
}


def scene_of(case, backend):
    constraints = [build(found) for kind, build in BUILDERS.items() if (found := of_type(case, kind))]
    body = {
        "name": "body",
        "mesh": {"vertices": case["vertices"], "triangles": case.get("triangles", [])},
        "velocities": case["velocities"],
        "start_positions": case.get("start", case["vertices"]),
        "mass": {"each": case["masses"]},
        "constraints": constraints,
    }
    forces = []
    if case.get("wind"):
        forces.append({"type": "wind", "model": "thesis", "velocity": case["wind"]})
    if case.get("fext"):
        vertices = list(range(len(case["vertices"])))
        forces.append({"type": "test_force", "body": "body", "vertices": vertices, "force": case["fext"]})
    place = {constraint: i for i, (constraint, _) in enumerate(of_type(case, "point"))}
    moves = [
        {"group": "pins", "step": event["step"], "index": place[event["constraint"]], "target": event["target"]}
        for event in case.get("schedule", [])
    ]
    return {
        "pliant": 1,
        "settings": {"time_step": case["h"], "backend": backend, "threads": 1},
        "steps": case["steps"],
        "gravity": case["gravity"],
        "bodies": [body],
        "forces": forces,
        "moves": moves,
    }


def run(pliant, scene, options, folder):
    path = folder / "scene.json"
    path.write_text(json.dumps(scene))
    subprocess.run([pliant, "run", path, "--out", folder / "out", "--quiet", *options], check=True)
    return np.load(folder / "out" / "frames.npy")


def kept(frames, count):
    """Those that a reference of so many frames holds: all of them, or every tenth and the last."""
    return frames if len(frames) == count else frames[sorted({*range(0, len(frames), 10), len(frames) - 1})]


def check(pliant, path, backend):
    """Compares one case with one back end; returns the number of runs that are too far off."""
    case = json.loads(path.read_text())
    unknown = {c["type"] for c in case["constraints"]} - set(BUILDERS)
    if unknown:
        print(f"{path.stem}: left out, no such constraint here: {', '.join(sorted(unknown))}")
        return 0
    reference = np.load(path.with_suffix(".npz"))
    runs = [(f"K{k}", "double", ["--iterations", str(k)], ITERATION_TOLERANCE) for k in (1, 5, 20)]
    for precision, tolerance in (("double", CONVERGED_TOLERANCE), ("mixed", MIXED_TOLERANCE)):
        runs.append(("converged", precision, ["--iterations", "2000000", "--tolerance", "1e-9"], tolerance))
    failures = 0
    for name, precision, options, tolerance in runs:
        options = [*options, "--set", f"settings.precision={precision}"]
        with tempfile.TemporaryDirectory() as folder:
            frames = kept(run(pliant, scene_of(case, backend), options, pathlib.Path(folder)), len(reference[name]))
        same_shape = frames.shape == reference[name].shape
        deviation = float(np.abs(frames - reference[name]).max()) if same_shape else float("inf")
        good = deviation <= tolerance
        failures += not good
        verdict = "holds" if good else "FAILS"
        print(f"{path.stem:24} {backend:8} {precision:7} {name:10} {deviation:9.2e} m of {tolerance:.0e} m  {verdict}")
    return failures


def backends(pliant):
    """Those that this build has: a scene without vertices to move is refused only for a back end that it lacks."""
    scene = {"pliant": 1, "steps": 1, "bodies": [{"mesh": {"vertices": [[0, 0, 0]]}, "mass": {"per_vertex": 1}}]}
    found = []
    for backend in ("eigen", "cholmod"):
        with tempfile.TemporaryDirectory() as folder:
            try:
                run(pliant, scene | {"settings": {"backend": backend}}, [], pathlib.Path(folder))
                found.append(backend)
            except subprocess.CalledProcessError:
                if backend == "eigen":
                    raise
                print("left out: this build has no CHOLMOD")
    return found


def main():
    pliant = os.environ["PLIANT"]
    folders = [pathlib.Path(f) for f in sys.argv[1:]] or [HERE / "cases"]
    cases = sorted(path for folder in folders for path in folder.glob("*.json"))
    if not cases:
        sys.exit(f"no cases in {', '.join(map(str, folders))}")
    failures = sum(check(pliant, path, backend) for backend in backends(pliant) for path in cases)
    print(f"{len(cases)} cases, {failures} runs too far off")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
