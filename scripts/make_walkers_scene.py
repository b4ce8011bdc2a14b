#!/usr/bin/env python3
"""Writes the built-in scene scenes/walkers.json: two figures walk across a rope bridge.

  scripts/make_walkers_scene.py

Of the bridge the script writes where ropes and boards begin, on a parabola; of the walkers, from their footprints, how
legs bend at hip and knee.
"""
import math
from pathlib import Path

from scene_text import text_of

SPAN = 5.2  # from post to post [m]
SAG = 0.34  # of the deck in the middle [m]
ROPE_Y, RAIL_Y, RAIL_HEIGHT = 0.4, 0.56, 0.95
BOARDS = 17
BOARD = [0.23, 1.0, 0.04]
KNOT = 0.0225  # of ropes that are held, from where they hang to their post [m]
SOLE = 0.073  # of a foot above the ropes [m]
DURATION = 6.0  # [s]


def deck(x):
    """Height of the ropes under the deck."""
    t = min(max(x / SPAN, 0), 1)
    return -4 * SAG * t * (1 - t)


def rounded(values, digits=4):
    return [round(v, digits) + 0.0 for v in values]


# ---- the bridge


class Ropes:
    """Lines of edges; points in the same place are one vertex."""

    def __init__(self):
        self.vertices, self.edges, self.index = [], [], {}

    def vertex(self, point):
        key = tuple(rounded(point))
        if key not in self.index:
            self.index[key] = len(self.vertices)
            self.vertices.append(list(key))
        return self.index[key]

    def line(self, points):
        ids = [self.vertex(p) for p in points]
        self.edges += [[a, b] for a, b in zip(ids, ids[1:])]


def bridge_ropes():
    ropes, links, hangers = Ropes(), 3 * BOARDS, BOARDS
    for side in (-1, 1):
        xs = [-KNOT] + [SPAN * i / links for i in range(links + 1)] + [SPAN + KNOT]
        ropes.line([[x, side * ROPE_Y, deck(x)] for x in xs])
        ropes.line([[x, side * RAIL_Y, deck(x) + RAIL_HEIGHT] for x in xs])
        for i in range(1, hangers):  # between the boards
            x = SPAN * i / hangers
            shares = [j / 6 for j in range(7)]
            ropes.line([[x, side * (ROPE_Y + s * (RAIL_Y - ROPE_Y)), deck(x) + s * RAIL_HEIGHT] for s in shares])
    return ropes


def board_parts():
    pitch = SPAN / BOARDS
    parts = []
    for i in range(BOARDS):
        x = pitch * (i + 0.5)
        slope = math.degrees(math.atan2(deck(x + 0.05) - deck(x - 0.05), 0.1))
        # Turned about its own middle, which then stands above the ropes.
        angle = math.radians(slope)
        half, height = BOARD[0] / 2, 0.024
        low = [x - half * math.cos(angle) - height * math.sin(angle), -BOARD[1] / 2,
               deck(x) - half * math.sin(angle) + height * math.cos(angle)]
        parts.append({"shape": "bar", "cells": [2, 10, 1], "size": BOARD,
                      "transform": {"rotate": {"axis": [0, 1, 0], "degrees": round(-slope, 3)}, "translate": rounded(low)}})
    return parts


# ---- the walkers


def limb(start, end, radius, end_radius, segments=9, group=None, scale=None):
    """A capsule from one point to another."""
    d = [b - a for a, b in zip(start, end)]
    length = math.sqrt(sum(v * v for v in d))
    part = {"name": group} if group else {}
    part |= {"shape": "capsule", "segments": segments, "radius": radius, "height": round(length, 4), "top_radius": end_radius}
    transform = {"scale": scale} if scale else {}
    angle = math.degrees(math.acos(d[2] / length))
    if angle > 1e-9:
        axis = [-d[1], d[0], 0] if angle < 180 - 1e-9 else [0, 1, 0]
        transform["rotate"] = {"axis": rounded(axis), "degrees": round(angle, 3)}
    part["transform"] = transform | {"translate": rounded(start)}
    return part


# Of a walker nothing touches anything of one.
WHAT = ["coat", "skin", "hat", "legs", "boots"]
OTHERS = [f"{what} of {name}" for name in ("one", "two") for what in WHAT]


class Walker:
    THIGH, SHANK, ANKLE = 0.42, 0.4, 0.06  # [m], of one who is 1.7 m tall

    def __init__(self, name, size, x, speed, press, colors):
        self.name, self.size, self.x, self.speed, self.press, self.colors = name, size, x, speed, press, colors
        self.step_length = 0.52 * size + 0.02
        self.groups = []  # of bodies: (name of the group, what moves it)

    def point(self, x, y, z):
        return [self.x + self.size * x, self.size * y, SOLE + self.size * z]

    def ground(self, x):
        """Where a sole stands: as deep as the weight presses the bridge down."""
        t = min(max(x / SPAN, 0), 1)
        return deck(x) - self.press * math.sin(math.pi * t)

    # ---- gait: phase p counts steps, foot k stands from p = k to k + 1.25

    STAND, BEGIN = 1.25, 0.625

    def phase(self, time):
        ease = 0.8  # [s]
        rate = self.speed / self.step_length
        return self.BEGIN + rate * (time * time / (2 * ease) if time < ease else time - ease / 2)

    def print_x(self, k):
        return self.x + self.step_length * max(k, 0)

    def foot(self, side, phase):
        """Of the left foot (0) or the right one (1): how far it has gone, how high, and how much it is turned."""
        k = math.floor((phase - side) / 2) * 2 + side
        a, b = self.print_x(k), self.print_x(k + 2)
        lift_off = max(k + self.STAND, self.BEGIN)
        share = min(max((phase - lift_off) / (k + 2 - lift_off), 0), 1)
        smooth = share * share * (3 - 2 * share)
        x = a + (b - a) * smooth
        z = self.ground(a) + (self.ground(b) - self.ground(a)) * smooth
        top = max(z, deck(x)) - z + 0.11 * self.size
        z += top * math.sin(math.pi * share)
        return x, z, 22 * math.sin(2 * math.pi * share) * (b > a)

    def hip(self, phase):
        x = self.x + self.step_length * (phase - self.BEGIN)
        z = self.ground(x) - 0.035 * self.size + 0.015 * self.size * math.cos(2 * math.pi * (phase - 0.125))
        return x, z

    def pose(self, time):
        """Displacement and turn of every part [m, degrees about y]."""
        size, p = self.size, self.phase(time)
        hip_x, hip_z = self.hip(p)
        parts = {"trunk": ([hip_x - self.x, 0, hip_z], 0)}
        hip = (hip_x, hip_z + size * (self.THIGH + self.SHANK + self.ANKLE))
        for side, leg in ((0, "left"), (1, "right")):
            x, z, turn = self.foot(side, p)
            ankle = (x, z + size * self.ANKLE)
            dx, dz = ankle[0] - hip[0], ankle[1] - hip[1]
            thigh, shank = size * self.THIGH, size * self.SHANK
            d = min(math.hypot(dx, dz), 0.9995 * (thigh + shank))
            line = math.atan2(dx, -dz)
            bend = math.acos((thigh ** 2 + d ** 2 - shank ** 2) / (2 * thigh * d))
            up = line + bend  # of the thigh, forwards
            knee = (hip[0] + thigh * math.sin(up), hip[1] - thigh * math.cos(up))
            low = math.atan2(ankle[0] - knee[0], knee[1] - ankle[1])
            rest_hip = (self.x, size * (self.THIGH + self.SHANK + self.ANKLE))
            rest_knee = (self.x, size * (self.SHANK + self.ANKLE))
            parts[leg + " thigh"] = ([hip[0] - rest_hip[0], 0, hip[1] - rest_hip[1]], -math.degrees(up))
            parts[leg + " shank"] = ([knee[0] - rest_knee[0], 0, knee[1] - rest_knee[1]], -math.degrees(low))
            parts[leg + " boot"] = ([x - self.x, 0, z], turn)
        return parts

    # ---- bodies

    def bodies(self):
        s, p = self.size, self.point
        r = lambda v: round(s * v, 4)
        hip, knee = self.THIGH + self.SHANK + self.ANKLE, self.SHANK + self.ANKLE
        coat = [
            limb(p(0, 0, hip + 0.02), p(0, 0, hip + 0.38), r(0.135), r(0.155), 16, scale=[0.8, 1, 1]),
            limb(p(0, -0.15, hip + 0.49), p(0, 0.15, hip + 0.49), r(0.07), r(0.07), 10)]
        for side in (-1, 1):
            coat += [limb(p(0, 0.19 * side, hip + 0.48), p(-0.05, 0.27 * side, hip + 0.24), r(0.055), r(0.045)),
                     limb(p(-0.05, 0.27 * side, hip + 0.24), p(0.13, 0.29 * side, hip + 0.1), r(0.047), r(0.04))]
        skin = [limb(p(0, 0, hip + 0.5), p(0, 0, hip + 0.62), r(0.05), r(0.05)),
                limb(p(0.01, 0, hip + 0.68), p(0.0, 0, hip + 0.75), r(0.08), r(0.1), 16)]
        skin += [limb(p(0.15, 0.292 * y, hip + 0.084), p(0.2, 0.292 * y, hip + 0.06), r(0.038), r(0.032), 10) for y in (-1, 1)]
        hat = [{"shape": "cylinder", "segments": 24, "rows": 4, "radius": r(0.24), "top_radius": r(0.015), "height": r(0.15),
                "transform": {"translate": rounded(p(0, 0, hip + 0.775))}},
               limb(p(-0.2, -0.06, hip + 0.16), p(-0.2, -0.06, hip + 0.4), r(0.1), r(0.1), 12),
               limb(p(-0.2, 0.06, hip + 0.16), p(-0.2, 0.06, hip + 0.4), r(0.1), r(0.1), 12)]
        legs, boots = [], []
        for side, leg in ((1, "left"), (-1, "right")):
            y = 0.085 * side
            legs += [limb(p(0, y, knee), p(0, y, hip), r(0.06), r(0.085), 10, leg + " thigh"),
                     limb(p(0, y, self.ANKLE + 0.03), p(0, y, knee), r(0.047), r(0.06), 10, leg + " shank")]
            boots.append(limb(p(-0.05, y, 0.05), p(0.13, y, 0.043), r(0.05), r(0.043), 10, leg + " boot"))
        result = [self.body("coat", coat, None), self.body("skin", skin, None), self.body("hat", hat, None),
                  self.body("legs", legs, ["left thigh", "left shank", "right thigh", "right shank"]),
                  self.body("boots", boots, ["left boot", "right boot"])]
        return result

    def body(self, what, parts, groups):
        name = f"{what} of {self.name}"
        constraints = []
        for group in groups or ["trunk"]:
            constraint = {"type": "position", "name": f"{group} of {self.name}" if groups else f"{what} of {self.name} held"}
            if groups:
                constraint["on"] = {"group": group}
            self.groups.append((constraint["name"], group))
            constraints.append(constraint)
        result = {"name": name, "appearance": {"front": self.colors[what], "finish": "matte"}, "mesh": {"parts": parts},
                  "mass": {"total": 10}, "constraints": constraints}
        # Boots alone come near the bridge.
        others = ["near rock", "far rock", "posts"] if what == "boots" else ["ropes", "boards", "near rock", "far rock", "posts"]
        return result | {"contact": {"self": False, "ignores": [each for each in others + OTHERS if each != name]}}

    def center(self, part):
        """About which a part turns."""
        hip, knee = self.THIGH + self.SHANK + self.ANKLE, self.SHANK + self.ANKLE
        height = hip if "thigh" in part or part == "trunk" else knee if "shank" in part else self.ANKLE
        return rounded([self.x, 0, SOLE + self.size * height])

    def moves(self):
        # Keys a step: enough of them that a boot stands still while it stands.
        frequency = {"trunk": 3, "boot": 7, "shank": 6, "thigh": 5}
        result = []
        for group, part in self.groups:
            rate = frequency[part.split()[-1]] * self.speed / self.step_length
            count = math.ceil(DURATION * rate)
            keys = []
            for i in range(count + 1):
                time = DURATION * i / count
                offset, turn = self.pose(time)[part]
                key = {"time": round(time, 2), "translate": rounded(offset, 3)}
                if part != "trunk":
                    key["rotate"] = {"axis": [0, 1, 0], "degrees": round(turn, 1)}
                keys.append(key)
            result.append({"group": group, "time": 0, "ease": "smooth", "center": self.center(part), "keyframes": keys})
        return result


# ---- rocks


def noise(*numbers):
    """Between -1 and 1, the same for the same numbers."""
    value = math.sin(sum(n * f for n, f in zip(numbers, (12.9898, 78.233, 37.719)))) * 43758.5453
    return 2 * (value - math.floor(value)) - 1


def rock(low, high, cells, edge_x):
    """A block of which all but the top is rough. `edge_x`: the side that stays as it is, for the bridge's end."""
    vertices, index, triangles = [], {}, []

    def vertex(cell):
        if cell not in index:
            point = [a + (b - a) * c / n for a, b, c, n in zip(low, high, cell, cells)]
            depth = 1 - cell[2] / cells[2]
            rough = 0.04 if depth in (0, 1) else 0.15
            out = [2 * c / n - 1 for c, n in zip(cell, cells)]
            for i in range(3):
                spread = rough if i < 2 else rough * (0.2 if depth == 0 else 1)
                point[i] += spread * noise(cell[0] + low[0], cell[1] + 3 * i, cell[2]) + (0.35 * depth * out[i] if i < 2 else 0)
            if cell[0] == edge_x:  # ropes and the first board hang clear of it
                sign = 1 if edge_x == 0 else -1
                edge = low[0] if edge_x == 0 else high[0]
                point[0] = edge + sign * (0 if depth == 0 else 0.03 + abs(point[0] - edge) * (1 - 0.7 * depth))
            index[cell] = len(vertices)
            vertices.append(rounded(point, 3))
        return index[cell]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, cells[axis]):
            for i in range(cells[u]):
                for j in range(cells[v]):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        cell = [0, 0, 0]
                        cell[axis], cell[u], cell[v] = end, i + a, j + b
                        corners.append(vertex(tuple(cell)))
                    if end == 0:
                        corners.reverse()
                    a, b, c, d = corners
                    triangles += [[a, b, c], [a, c, d]] if (i + j) % 2 else [[a, b, d], [b, c, d]]
    return {"vertices": vertices, "triangles": triangles}


# ---- the scene


def scene():
    ropes = bridge_ropes()
    ends = [[x, side * y, z] for x in (-KNOT, 0, SPAN, SPAN + KNOT) for side in (-1, 1) for y, z in ((ROPE_Y, 0), (RAIL_Y, RAIL_HEIGHT))]
    posts = [limb([x, side * RAIL_Y, 0.03], [x, side * RAIL_Y, 1.06], 0.055, 0.045, 8)
             for x in (-0.07, SPAN + 0.07) for side in (-1, 1)]
    walkers = [
        Walker("one", 1.0, -0.4, 1.15, 0.2,
               {"coat": "#b23a2e", "skin": "#c99572", "hat": "#d8b76a", "legs": "#39424f", "boots": "#3b2c22"}),
        Walker("two", 0.76, -1.6, 1.15, 0.1,
               {"coat": "#2f6f73", "skin": "#d9ab86", "hat": "#c79a4b", "legs": "#6b5b4b", "boots": "#4a382b"})]
    bodies = [
        {"name": "ropes", "appearance": {"front": "#c2a878"}, "mesh": {"vertices": ropes.vertices, "edges": ropes.edges},
         "mass": {"line_density": 0.3},
         "constraints": [{"type": "position", "name": "knots", "on": {"nearest": ends}},
                         {"type": "edge_strain", "name": "rope", "stiffness": 60000, "min_stretch": 0}]},
        {"name": "boards", "appearance": {"front": "#96683c"}, "mesh": {"parts": board_parts()}, "mass": {"density": 500},
         "constraints": [{"type": "tetrahedron_strain", "name": "wood", "stiffness": 1e8}]},
        {"name": "posts", "appearance": {"front": "#6e4c2f"}, "mesh": {"parts": posts}, "animation": {},
         "contact": {"self": False, "ignores": ["near rock", "far rock"]}},
        {"name": "near rock", "appearance": {"front": "#94897a"}, "animation": {}, "contact": {"self": False},
         "mesh": rock([-2.7, -1.1, -2.4], [-0.03, 1.1, 0.055], (8, 7, 7), 8)},
        {"name": "far rock", "appearance": {"front": "#94897a"}, "animation": {}, "contact": {"self": False},
         "mesh": rock([SPAN + 0.03, -1.1, -2.4], [SPAN + 2.7, 1.1, 0.055], (8, 7, 7), 0)}]
    moves = []
    for walker in walkers:
        bodies += walker.bodies()
        moves += walker.moves()
    sides = {"any_of": [{"half_space": {"point": [0, -0.39, 0], "normal": [0, -1, 0]}},
                        {"half_space": {"point": [0, 0.39, 0], "normal": [0, 1, 0]}}]}
    return {
        "pliant": 1,
        "description": "Two walkers cross a rope bridge, a tall one and a small one: watch the boards give way under each "
                       "step, and the waves that run ahead of it",
        "settings": {"integrator": "bdf2", "iterations": 20, "acceleration": "lbfgs", "damping": 0.5},
        "steps": round(60 * DURATION),
        "bodies": bodies,
        "attachments": [{"name": "lashings", "mode": "nearest_vertex", "keep_distance": True, "stiffness": 20000,
                         "from": {"body": "boards", "on": sides}, "to": {"body": "ropes"}}],
        "contact": {"distance": 0.008, "friction": 0.6},
        "view": {"camera": {"position": [0.9, -6.2, 1.75], "target": [2.55, 0, 0.3], "field_of_view": 36},
                 "background": "#dbe6ee", "ground": False, "light": [-0.3, -1, 1.05]},
        "moves": moves}


if __name__ == "__main__":
    Path(__file__).resolve().parent.parent.joinpath("scenes/walkers.json").write_text(text_of(scene()), encoding="utf-8")
