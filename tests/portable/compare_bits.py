#!/usr/bin/env python3
"""Compares what builds of scene_bits left, scene by scene.

  tests/portable/compare_bits.py FOLDER OTHER...   prints a table in Markdown: the largest distance between the places
                                                   of a vertex in FOLDER and each other, after the first step and after
                                                   the last, in parts of the scene's size; "equal" are equal bits
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
    if len(sys.argv) < 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder, *others = map(Path, sys.argv[1:])
    names = sorted(path.stem for path in folder.glob("*.bits"))
    for other in others:
        if names != sorted(path.stem for path in other.glob("*.bits")) or not names:
            sys.exit(f"compare_bits.py: {folder} and {other} do not have the same scenes")
    print("| scene | vertices |" + "".join(f" {other.name}: first step | last step |" for other in others))
    print("|---|---|" + "---|---|" * len(others))
    equal = [[0, 0] for _ in others]
    for name in names:
        one = read(folder / f"{name}.bits")
        cells = []
        for other, counts in zip(others, equal):
            another = read(other / f"{name}.bits")
            if len(one[1]) != len(another[1]):
                sys.exit(f"compare_bits.py: {name} does not have the same vertices in {folder} and {other}")
            for moment in range(2):
                cells.append(difference(one[moment], another[moment]))
                counts[moment] += cells[-1] == "equal"
        print(f"| {name} | {len(one[1]) // 3} | {' | '.join(cells)} |")
    counts = [f"{count} of {len(names)}" for pair in equal for count in pair]
    print(f"| equal | | {' | '.join(counts)} |")


if __name__ == "__main__":
    main()
