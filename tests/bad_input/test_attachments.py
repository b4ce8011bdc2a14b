"""Attachments that nobody means: unequal and broken sides, sides in one place, extreme lengths and times, events on them. An
error in one line, or a run whose every number is finite."""
import copy

import hostile
from hostile import DONE, INPUT, LEGAL, HostileTest, run_scene_case


def sheet(name, y, **more):
    return {"name": name, "mesh": {"shape": "grid", "columns": 6, "rows": 6, "size": [0.4, 0.4]} | more,
            "transform": {"translate": [0, y, 0]}, "mass": {"total": 0.1},
            "constraints": [{"type": "triangle_strain", "name": f"skin of {name}", "stiffness": 300}]}


SEAM = {"name": "seam", "mode": "seam", "from": {"body": "front", "on": "boundary"}, "to": {"body": "back", "on": "boundary"}}
SCENE = {
    "pliant": 1, "steps": 12, "settings": {"threads": 1, "iterations": 5},
    "bodies": [sheet("front", -0.05), sheet("back", 0.05),
               {"name": "cord", "mesh": {"shape": "chain", "links": 5, "length": 0.4}, "mass": {"total": 0.05},
                "constraints": [{"type": "edge_spring", "name": "yarn", "stiffness": 100}]},
               {"name": "block", "mesh": {"shape": "bar", "cells": [2, 2, 2], "size": [0.2, 0.2, 0.2]}, "mass": {"total": 1},
                "transform": {"translate": [1, 0, 0]},
                "constraints": [{"type": "tetrahedron_strain", "name": "wood", "stiffness": 1e4}]}],
    "attachments": [SEAM],
}


def end(body, on=None):
    return {"body": body} | ({} if on is None else {"on": on})


def with_values(**values):
    """The scene with other options of its seam; with `settings`, `contact` and so on in place of its own."""
    scene = copy.deepcopy(SCENE)
    for key in ("settings", "contact", "events", "attachments", "bodies", "gravity"):
        if key in values:
            scene[key] = values.pop(key)
    if values:
        scene["attachments"][0] |= values
    return scene


class Attachments(HostileTest):
    def attack_with(self, cases, **more):
        self.attack((run_scene_case(str(values)[:200], with_values(**copy.deepcopy(values)), **more) for values in cases))

    def test_the_scene_itself(self):
        self.attack_with([{}, {"closing_time": 0.1}], expect=(DONE,))

    def test_sides_that_are_refused(self):
        open_side, loop = [0, 1, 2], "boundary"
        for wrong, says in [
                ({"to": end("back", open_side)}, "'from' selects a loop of 20 vertices, 'to' a chain of 3 vertices"),
                ({"from": end("front", open_side), "to": end("back", [0, 1])}, "use mode 'seam_by_length'"),
                ({"from": end("front", open_side), "to": end("back", loop), "mode": "seam_by_length"},
                 "select two loops or two open chains"),
                ({"from": end("front", [0, 35]), "to": end("back", open_side)}, "make no single chain"),
                ({"from": end("front", [0, 1, 2, 30, 31, 32]), "to": end("back", [0, 1, 2, 3, 4, 5])}, "make no single chain"),
                ({"from": end("front"), "to": end("back")}, "make no single chain"),  # all vertices
                ({"from": end("front", [7]), "to": end("back", [7])}, "chain"),
                ({"from": end("block", "boundary"), "to": end("back", loop)}, "make no single chain"),
                ({"from": end("front", [0, 1, 1])}, "'from' names vertex 1 twice"),
                ({"from": end("front", [])}, "the list is empty"),
                ({"from": end("front", [36])}, "36"),
                ({"from": end("front", [-1])}, "-1"),
                ({"from": end("front", {"boundary_loop": 1})}, "boundary"),
                ({"from": end("front", {"group": "left"})}, "the mesh has no groups"),
                ({"from": end("front", loop), "to": end("front", loop)}, "both sides are the same vertices"),
                ({"mode": "nearest_face", "from": end("front"), "to": end("cord")}, "has no triangle at all"),
                ({"mode": "nearest_face", "from": end("cord"), "to": end("front", [0, 1])}, "no triangle whose corners"),
                ({"mode": "nearest_vertex", "from": end("front"), "to": end("front")}, "tied to itself"),
                ({"from": {"body": "front", "on": loop, "ON": loop}}, "unknown key"),
                ({"from": "front"}, "give an object"),
                ({"from": None}, "from"),
                ({"from": {"body": 0}}, "body"),
                ({"attachments": {}}, "give a list"),
                ({"attachments": [[]]}, "give an object"),
        ]:
            self.attack_with([wrong], expect=(INPUT,), says=says)

    def test_values_that_are_refused(self):
        for wrong, says in [
                ({"stiffness": 0}, "0 is out of range; give a finite number above 0"),
                ({"stiffness": -1e5}, "out of range"),
                ({"stiffness": 1e101}, "reduce the ratio of stiffness"),
                ({"stiffness": [1, 2]}, "stiffness has 2 entries for 20"),
                ({"length": -1}, "length: -1 is out of range"),
                ({"length": 1, "keep_distance": True}, "'keep_distance' and 'length'"),
                ({"closing_time": -1}, "closing_time: -1 is out of range"),
                ({"closing_time": True}, "give a number"),
                ({"mode": "sewn"}, "seam_by_length"),
                ({"direction": "back"}, "opposite"),
                ({"name": "yarn"}, "the name 'yarn' is another group's"),
                ({"weight": 1}, "unknown key"),
        ]:
            self.attack_with([wrong], expect=(INPUT,), says=says)

    def test_extreme_values_that_are_legal(self):
        far = sheet("back", 1e9)
        flat = sheet("back", -0.05)  # in the very place of the other panel
        self.attack_with([
            {"stiffness": 1e100}, {"stiffness": 1e-100}, {"stiffness": 1e30, "closing_time": 1e-9},
            {"length": 1e100}, {"length": 1e-100}, {"closing_time": 1e100}, {"closing_time": 1e-100}, {"closing_time": 1e-9},
            {"direction": "opposite"}, {"direction": "opposite", "closing_time": 0.05, "contact": {}},
            {"bodies": [SCENE["bodies"][0], far, *SCENE["bodies"][2:]], "closing_time": 0.1},
            {"bodies": [SCENE["bodies"][0], flat, *SCENE["bodies"][2:]], "closing_time": 0.1},
            {"bodies": [SCENE["bodies"][0], flat, *SCENE["bodies"][2:]], "contact": {}},
            {"bodies": [SCENE["bodies"][0], sheet("back", 0.05, size=[1e-6, 1e-6]), *SCENE["bodies"][2:]]},
            {"mode": "seam_by_length", "bodies": [SCENE["bodies"][0], sheet("back", 0.05, columns=2, rows=2), *SCENE["bodies"][2:]]},
            {"mode": "seam_by_length", "bodies": [SCENE["bodies"][0], sheet("back", 0.05, columns=90, rows=3), *SCENE["bodies"][2:]]},
            {"mode": "nearest_vertex", "from": end("front"), "to": end("back", [0])},  # all to one
            {"mode": "nearest_face", "from": end("front"), "to": end("block"), "closing_time": 0.1, "contact": {}},
            {"mode": "nearest_face", "from": end("cord"), "to": end("back"), "keep_distance": True},
            {"attachments": [SEAM | {"name": f"seam {i}"} for i in range(50)]},
            {"attachments": []}, {"contact": {"distance": 1}}, {"contact": {"distance": 1e-9}, "closing_time": 0.1},
        ], expect=LEGAL)

    def test_events_on_seams(self):
        for event, says in [
                ({"step": 1, "change": "seem", "length": 1}, "did you mean 'seam'"),
                ({"step": 1, "change": "seam", "closing_time": -1}, "out of range"),
                ({"step": 1, "change": "seam", "from": end("front")}, "unknown key"),
                ({"step": 1, "move": "seam", "offset": [0, 0, 1]}, "seam"),
                ({"step": 1, "release": "seam", "vertices": [1]}, "'seam' is a group of type attachment"),
                ({"step": 1, "add": SEAM | {"type": "attachment"}}, "the name 'seam' is another group's"),
                ({"step": 1, "add": {"type": "attachment", "from": end("front")}}, "'to'"),
        ]:
            self.attack_with([{"events": [event]}], expect=(INPUT,), says=says)
        again = SEAM | {"type": "attachment", "closing_time": 0.05}
        self.attack_with([
            {"events": [{"step": 2, "remove": "seam"}, {"step": 3, "add": again}, {"step": 5, "remove": "seam"}]},
            {"events": [{"step": n, "change": "seam", "closing_time": 0.1 * n} for n in range(10)], "closing_time": 0.1},
            {"events": [{"step": 2, "change": "seam", "stiffness": 1e-9, "over": 0.1}]},
            {"events": [{"step": 2, "change": "seam", "length": 5, "closing_time": 0.1}]},  # threads that grow
            {"events": [{"step": 3, "settings": {"time_step": 1}}], "closing_time": 0.5},
            {"events": [{"step": 3, "settings": {"time_step": 1e-9}}], "closing_time": 0.5},
        ], expect=LEGAL)

    def test_seams_that_close_while_energy_is_kept(self):
        for energy in (0.5, 1):
            for more in ({"closing_time": 0.1}, {"closing_time": 0.15, "direction": "opposite"}, {"closing_time": 0},
                         {"closing_time": 0.1, "gravity": None},
                         {"closing_time": 0.1, "events": [{"step": 4, "remove": "seam"}]},
                         {"closing_time": 0.1, "events": [{"step": 4, "change": "seam", "length": 0.02, "closing_time": 0.05}]}):
                settings = SCENE["settings"] | {"energy_projection": energy}
                self.attack_with([more | {"settings": settings}, more | {"settings": settings | {"integrator": "bdf2"}}],
                                 expect=(DONE,))


if __name__ == "__main__":
    hostile.main()
