#!/usr/bin/env python3
"""Steps of a body whose masses and stiffnesses differ by a factor of a million, where the plain algorithm takes tens
of thousands of iterations: each begins in the state of an independent solver, and is compared with where that one converges.

    PLIANT=build/release/bin/pliant tests/reference/test_contrast.py
"""
import json
import os
import pathlib
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

import test_reference

ITERATIONS = 2000
TOLERANCE = 1e-4  # m, in every step
CASE = pathlib.Path(__file__).resolve().parent / "contrast" / "c15_contrast.json"


def deviation_of_step(pliant, case, frames, step, acceleration):
    """Of the end of one step that begins in a frame [m]."""
    before = frames[step - 1] if step > 0 else frames[0] - case["h"] * np.array(case["velocities"])
    begin = {"start": frames[step].tolist(), "velocities": ((frames[step] - before) / case["h"]).tolist(), "steps": 1}
    scene = test_reference.scene_of(case | begin, "eigen")
    scene["settings"] |= {"precision": "double", "acceleration": acceleration, "iterations": ITERATIONS}
    with tempfile.TemporaryDirectory(prefix="pliant-") as folder:
        end = test_reference.run(pliant, scene, [], pathlib.Path(folder))[-1]
    return float(np.linalg.norm(end - frames[step + 1], axis=1).max())


def main():
    pliant = os.environ["PLIANT"]
    case = json.loads(CASE.read_text())
    frames = np.load(CASE.with_suffix(".npz"))["converged"]
    worst = {}
    for acceleration in ("none", "lbfgs"):
        steps = range(case["steps"])
        worst[acceleration] = max(deviation_of_step(pliant, case, frames, step, acceleration) for step in steps)
        print(f"{ITERATIONS} iterations, acceleration {acceleration}: at most {worst[acceleration]:.1e} m off in a step")
    good = worst["lbfgs"] <= TOLERANCE
    print(f"lbfgs {'holds' if good else 'FAILS'}: {TOLERANCE:.0e} m")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
