"""Numbers that are zero, negative, tiny, huge or no numbers at all, for every option that takes one: of the scene file's
tables, of the shapes and of the command line."""
import functools
import itertools
import json
import re

import hostile
from changes import paths_of, replaced, text_of, value_at
from hostile import DONE, INPUT, INTERRUPTED, SOURCE, HostileTest, run_scene_case, scene_of

REALS = [0, -0.0, -1, 1e-320, 1e-300, 1e-100, 1e100, 1e154, 1e300, -1e300, 1.7976931348623157e308]
WHOLE = [0, -1, 2**31 - 1, 2**31, -2**31, 2**32, 10**9, 10**18, 2**63 - 1, -2**63, 2**63, 2**64, 0.5, 1e300]

LOW = [value for value in WHOLE if value < 10**6 or value > 2**31]  # others are done, and take their time

# What the tables of the page do not say: keys that must be there, and what to try them on.
NEEDED = {"test_force": {"vertex": 1, "force": [0, 0, 1]}, "line": {"direction": [0, 0, 1]},
          "plane": {"normal": [0, 0, 1]}, "half_space": {"normal": [0, 0, 1]}, "drag": {"stencils": [[0, 1]], "weights": [[0.5, 0.5]]},
          "bending": {}, "mouse_spring": {"vertex": 1, "anchor": [0, 0, 1]}}
SOLIDS = ("tetrahedron_strain", "tetrahedron_volume", "tetrahedron_neo_hookean", "tetrahedron_stvk", "volume")

GRID = {"shape": "grid", "columns": 4, "rows": 4}
BALL = {"shape": "sphere", "subdivisions": 0}
BAR = {"shape": "bar", "cells": [1, 1, 1]}


@functools.cache
def page():
    """All pages on scenes as one, those of docs/scenes/ a level below docs/scenes.md."""
    folder = SOURCE / "docs"
    below = "".join(path.read_text() for path in sorted((folder / "scenes").glob("*.md")))
    return (folder / "scenes.md").read_text() + re.sub(r"^#", "##", below, flags=re.MULTILINE)


def sections(heading):
    """(name, text) of what has a heading of its own, one level below the one given."""
    level, title = re.search(rf"^(#+) {heading}\n", page(), re.MULTILINE).group(1, 0)
    text = re.split(rf"^#{{1,{len(level)}}} ", page().split(title)[1], flags=re.MULTILINE)[0]
    parts = re.split(rf"^#{level} `(\w+)`\n", text, flags=re.MULTILINE)
    return list(zip(parts[1::2], parts[2::2]))


def numeric_options(text):
    """The keys of a table whose options are numbers: with a unit, or a number as their default."""
    rows = re.findall(r"^\| `(\w+)` \| *([^|]*?) *\| *([^|]*?) *\|", text, re.MULTILINE)
    return [(key, default) for key, unit, default in rows
            if (unit or re.fullmatch(r"-?[\d.e+-]+|\[.*\]", default)) and not default.startswith('"')]


# Defaults that the tables tell in words.
POINTS = {("tube", "points"): [[0, 0, 0], [0, 0, 1]],
          ("panel", "bottom"): [[0, 0, 0], [1, 0, 0]], ("panel", "top"): [[0, 0, 1], [1, 0, 1]],
          ("panel", "left"): [[0, 0, 0.5]], ("panel", "right"): [[1, 0, 0.5]]}


def shapes():
    """(name, key, default) of every number of a shape."""
    return [(name, key, json.loads(default) if default else POINTS[name, key])
            for name, text in sections("Shapes") for key, default in numeric_options(text)]


def variants(default, numbers):
    """The number itself, or, for a list, the number in each place, of lists in it as well."""
    for number in numbers:
        if isinstance(default, list):
            for i in range(len(default)):
                for inner in variants(default[i], [number]) if isinstance(default[i], list) else [number]:
                    yield default[:i] + [inner] + default[i + 1:]
            yield [number] * len(default)
        else:
            yield number


def fits(constraint):
    return BAR if constraint in SOLIDS else GRID


def constraint_scene(name, options, **more):
    held = [] if name in ("position", "line", "plane", "half_space") else [{"type": "position", "on": [0]}]
    return scene_of(fits(name), *held, {"type": name} | NEEDED.get(name, {}) | options, **more)


def case(scene, *words, **more):
    return run_scene_case(" ".join(map(str, words)), scene, **more)


class Numbers(HostileTest):
    def test_constraints(self):
        names = [name for name, _ in sections("Constraints")]
        self.assertGreater(len(names), 8)
        self.attack((case(constraint_scene(name, {}), name, expect=(DONE,)) for name in names),
                    (case(constraint_scene(name, {key: value}), name, key, value)
                     for name, text in sections("Constraints") for key, default in numeric_options(text)
                     for value in [*REALS, [1, -1], [], [0.5] * 999]))

    def test_limits(self):
        self.attack(case(constraint_scene(name, {f"min_{what}": low, f"max_{what}": high}), name, low, high)
                    for name, what in (("edge_strain", "stretch"), ("triangle_strain", "stretch"), ("fibre_strain", "stretch"),
                                       ("tetrahedron_strain", "stretch"), ("triangle_area", "area"),
                                       ("tetrahedron_volume", "volume"))
                    for low in [0, 1e-300, 1, 1e300] for high in [0, 1e-300, 0.5, 1e300])

    def test_stiffnesses_masses_and_time_steps_of_all_sizes(self):
        def scene(soft, stiff, time_step, mass):
            return scene_of(GRID, {"type": "position", "on": [0]}, {"type": "edge_spring", "stiffness": soft},
                            {"type": "triangle_strain", "stiffness": stiff}, {"type": "hinge", "stiffness": soft},
                            {"type": "bending", "stiffness": stiff}, body={"mass": {"per_vertex": mass}},
                            settings={"threads": 1, "time_step": time_step})
        sizes = [1e-300, 1e-100, 1, 1e9, 1e100, 1e300]
        self.attack(case(scene(*numbers), *numbers) for numbers in
                    itertools.product(sizes, sizes, [1e-150, 1e-9, 1, 1e9, 1e150], [1e-300, 1e300]))

    def test_settings(self):
        def scene(key, value):
            return scene_of(GRID, {"type": "edge_spring"}, settings={"threads": 1} | {key: value})
        table = re.search(r"^#+ Settings\n(.*?)^#", page(), re.DOTALL | re.MULTILINE)[1]
        options = [key for key, _ in numeric_options(table)]
        self.assertIn("time_step", options)
        self.attack(case(scene(key, value), key, value) for key in options
                    for value in (LOW if key == "iterations" else WHOLE if key == "threads" else REALS + WHOLE))

    def test_an_interrupt_does_not_wait_for_a_thousand_million_iterations(self):
        scene = scene_of(GRID, {"type": "edge_spring"}, {"type": "position", "on": [0]}, forces=[{"type": "gravity"}],
                         settings={"threads": 1, "iterations": 10**9})
        self.attack([case(scene, "iterations", expect=(INPUT, INTERRUPTED), interrupt_after=0.5)])

    def test_masses(self):
        kinds = [("per_vertex", GRID), ("total", GRID), ("area_density", GRID), ("density", BAR),
                 ("line_density", {"shape": "chain"})]
        lists = [[1] * 15 + [value] for value in REALS] + [[1e-300, 1e300] * 8, [1e308] * 16, [], [1] * 17]
        self.attack((case(scene_of(mesh, body={"mass": {kind: value}}), kind, value)
                     for kind, mesh in kinds for value in REALS + WHOLE),
                    (case(scene_of(GRID, {"type": "edge_spring"}, body={"mass": {"each": each}}), "each", each)
                     for each in lists))

    def test_shapes(self):
        self.assertIn(("grid", "columns", 11), shapes())
        self.attack(case(scene_of({"shape": name, key: value}), name, key, value)
                    for name, key, default in shapes() for value in variants(default, REALS + WHOLE))

    def test_the_body(self):
        def scenes(value, vector):
            for key, part in [("scale", value), ("scale", vector), ("translate", vector),
                              ("rotate", {"axis": vector, "degrees": 30}), ("rotate", {"axis": [0, 0, 1], "degrees": value})]:
                yield {"body": {"transform": {key: part}}}
            yield {"body": {"velocity": vector}}
            yield {"body": {"start_positions": [vector] * 16}}
            yield {"body": {"start_positions": [[0, 0, i] for i in range(15)] + [vector]}}
            yield {"body": {"velocities": [[0, 0, i] for i in range(15)] + [vector]}}
            yield {"gravity": vector}
        self.attack(case(scene_of(GRID, {"type": "edge_spring"}, **more), more) for value in REALS
                    for vector in ([value, 0, 1], [value] * 3) for more in scenes(value, vector))

    def test_selections(self):
        def selections(value):
            yield {"box": {"min": [-value] * 3, "max": [value] * 3}}
            yield {"box": {"min": [value] * 3, "max": [-value] * 3}}
            yield {"nearest": [value] * 3}
            yield {"nearest": [[value] * 3] * 2}
            yield {"half_space": {"point": [value] * 3, "normal": [0, 0, 1]}}
            yield {"half_space": {"point": [0] * 3, "normal": [value, 0, 0]}}
        self.attack(case(scene_of(GRID, {"type": "position", "on": on}), on) for value in REALS for on in selections(value))

    def test_forces(self):
        def scene(name, **more):
            return scene_of(BALL if name == "pressure" else GRID, {"type": "edge_spring"},
                            forces=[{"type": name} | NEEDED.get(name, {}) | more])
        self.attack((case(scene(name, **{key: value}), name, key, value) for name, text in sections("Forces")
                     for key, default in numeric_options(text) for value in variants(json.loads(default or "[0, 0, 1]"), REALS)),
                    (case(scene("test_force", force=[value, 0, 0]), "force", value) for value in REALS),
                    (case(scene("test_force", frames=frames), "frames", frames)
                     for a, b in itertools.product(WHOLE, [0, 2**63 - 1]) for frames in [[a, b], [b, a]]),
                    (case(scene("test_force", vertex=vertex), "vertex", vertex) for vertex in WHOLE))

    def test_moves(self):
        def moved(key, value, without=None):
            move = {"group": "pin", "step": 0, "target": [0, 0, 1]}
            move.pop(without, None)
            return case(scene_of(GRID, {"type": "position", "name": "pin", "on": [0]}, {"type": "edge_spring"},
                                 moves=[move | {key: value}]), key, value)
        self.attack((moved(key, value, "target") for value in REALS
                     for key, value in [("target", [value, 0, 0]), ("offset", [0, value, 0])]),
                    (moved("over", value) for value in REALS), (moved("time", value, "step") for value in REALS),
                    (moved("step", value) for value in WHOLE), (moved("index", value) for value in WHOLE))

    def test_events(self):
        pin = {"type": "position", "name": "pin", "on": [0]}
        events = {"move": [{"move": "pin", "over": 0.1, "offset": [0, 0, 1]}, {"move": "pin", "over": 0.1, "target": [0, 0, 1]},
                           {"move": "pin", "over": 0.1, "rotate": {"axis": [0, 0, 1], "degrees": 90}}],
                  "change": [{"change": "springs", "stiffness": 5, "over": 0.1}, {"change": "wind", "velocity": [1, 0, 0],
                                                                                   "over": 0.1}],
                  "settings": [{"settings": {"time_step": 0.01, "iterations": 3}}], "gravity": [{"gravity": [0, 0, 1]}],
                  "release": [{"release": "pin", "index": 0}],
                  "add": [{"add": {"body": "thing", "type": "position", "on": [3]}}, {"add": {"type": "wind", "drag": 1}}]}
        def scenes():
            for event in itertools.chain(*events.values()):
                timed = {"step": 1} | event
                for path in paths_of(timed):
                    if not isinstance(value_at(timed, path), (int, float)):
                        continue
                    for value in REALS + WHOLE:
                        if path[-1] != "iterations" or value in LOW:
                            yield f"{event} {text_of(path)} = {value}", replaced(timed, path, value)
                for value in REALS:
                    yield f"{event} at {value}", {"time": value} | event
        self.attack(case(scene_of(GRID, pin, {"type": "edge_spring", "name": "springs"}, forces=[{"type": "wind"}], steps=3,
                                  events=[event]), name) for name, event in scenes())

    def test_steps_and_every(self):
        few = [value for value in WHOLE if not isinstance(value, int) or value < 1 or value > 2**53]
        many = [value for value in WHOLE if value not in few]
        self.attack((case(scene_of(GRID, steps=value), "steps", value) for value in few),
                    (case(scene_of(GRID, steps=value, output={"every": 10**6}), "steps", value, expect=(INTERRUPTED,),
                          interrupt_after=0.3) for value in many),
                    (case(scene_of(GRID, output={"every": value}), "every", value) for value in WHOLE))


if __name__ == "__main__":
    hostile.main()
