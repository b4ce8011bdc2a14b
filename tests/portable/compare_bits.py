#!/usr/bin/env python3
"""Compares what two builds of scene_bits left, scene by scene.

  tests/web/compare_bits.py FOLDER OTHER   prints a table in Markdown: the largest distance between the places of a
                                           vertex, after the first step and after the last, in parts of the scene's size
"""
import array
import sys
from pathlib import Path


def read(path):
    """The coordinates after the first step, and after the last."""
    numbers = array.array("d")
    numbers.frombytes(path.read_bytes())
    half = len(numbers) // 2
    return numbers[:half], numbers[half:]


def size(x):
    """The longest side of the box around the vertices."""
    return max(max(x[axis::3]) - min(x[axis::3]) for axis in range(3))


def difference(a, b):
    """"equal" bits, or the largest distance of a vertex in parts of the size."""
    if a.tobytes() == b.tobytes():
        return "equal"
    largest = max(sum((a[3 * v + k] - b[3 * v + k]) ** 2 for k in range(3)) for v in range(len(a) // 3)) ** 0.5
    return f"{largest / size(a):.1e}"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, other = map(Path, sys.argv[1:])
    names = sorted(path.stem for path in folder.glob("*.bits"))
    if names != sorted(path.stem for path in other.glob("*.bits")) or not names:
        sys.exit(f"compare_bits.py: {folder} and {other} do not have the same scenes")
    print("| scene | vertices | first step | last step |\n|---|---|---|---|")
    for name in names:
        (first, last), (other_first, other_last) = (read(f / f"{name}.bits") for f in (folder, other))
        if len(last) != len(other_last):
            sys.exit(f"compare_bits.py: {name} does not have the same vertices in both")
        print(f"| {name} | {len(last) // 3} | {difference(first, other_first)} | {difference(last, other_last)} |")


if __name__ == "__main__":
    main()
