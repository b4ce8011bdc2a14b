"""Colliders with values that nobody means: an error in one line, or a run whose every number is finite."""
import copy

import hostile
from hostile import DONE, INPUT, LEGAL, HostileTest, run_scene_case

SCENE = {
    "pliant": 1, "steps": 12, "settings": {"threads": 1, "iterations": 5},
    "bodies": [{"name": "sheet", "mesh": {"shape": "grid", "columns": 7, "rows": 7, "plane": "xy"},
                "transform": {"translate": [-0.5, -0.5, 0.35]}, "mass": {"total": 0.2},
                "constraints": [{"type": "triangle_strain", "name": "skin", "stiffness": 300}]}],
    "contact": {"distance": 0.02, "friction": 0.3},
    "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, 0], "radius": 0.3},
                  {"type": "plane", "name": "floor", "position": [0, 0, -0.3]}],
}


def with_values(**values):
    """The scene with other options of its ball; with `contact`, `events` and so on in place of its own."""
    scene = copy.deepcopy(SCENE)
    for key in ("contact", "events", "colliders", "settings"):
        if key in values:
            scene[key] = values.pop(key)
    scene["colliders"][0] |= values
    return scene


class Colliders(HostileTest):
    def attack_with(self, cases, **more):
        self.attack((run_scene_case(str(values), with_values(**copy.deepcopy(values)), **more) for values in cases))

    def test_the_scene_itself(self):
        self.attack_with([{}], expect=(DONE,))

    def test_what_is_refused(self):
        for wrong, says in [
                ({"radius": 0}, r"radius: 0 is out of range; give a finite number above 0 \[m\]"),
                ({"radius": -1}, "radius: -1 is out of range"),
                ({"friction": -1}, "friction: -1 is out of range; give a finite number from 0"),
                ({"friction": [0.1, 0.2]}, "one friction for all of its surface"),
                ({"friction": {"map": {"name": "x"}}}, "give a number"),
                ({"center": [0, 0, 1e101]}, "1e[+]?101 is out of range"),
                ({"contact": {"friction": -1}}, "contact.friction: -1 is out of range"),
                ({"contact": {"distance": -1}}, "contact.distance: -1 is out of range"),
                ({"contact": []}, "contact: found a list; give an object"),
                ({"settings": {"energy_projection": 0.5}}, "energy_projection: it does not know the work of contact"),
                ({"colliders": [{"type": "ball"}]}, "unknown collider 'ball'; known: plane, sphere, capsule, box"),
                ({"colliders": [{"name": "ball"}]}, "'type' is missing"),
                ({"colliders": [{"type": "plane", "normal": [0, 0, 0]}]}, "normal: its length is zero"),
                ({"colliders": [{"type": "box", "rounding": 0.6}]}, "rounding: 0.6 is more than half of the least size"),
                ({"colliders": [{"type": "box", "size": [1, 0, 1]}]}, "0 is out of range"),
        ]:
            self.attack_with([wrong], expect=(INPUT,), says=says)
        nan = '{"pliant": 1, "bodies": [], "colliders": [{"type": "sphere", "radius": NaN}]}'
        self.attack([run_scene_case("NaN", nan, expect=(INPUT,), says="scene.json:1:")])

    def test_extreme_values_that_are_legal(self):
        self.attack_with([
            {"radius": 1e300}, {"radius": 1e-300}, {"friction": 1e9}, {"friction": 0}, {"friction": 1e300},
            {"contact": {"distance": 0}}, {"contact": {"distance": 100}}, {"contact": {"distance": 1e300}},
            {"contact": {"distance": 1e-300}}, {"contact": {"friction": 1e9}},
            {"center": [0, 0, 0.35]}, {"center": [0.1, 0.05, 0.3]}, {"center": [1e99, 0, 0]},  # it begins in the sheet
            {"velocity": [0, 0, 1e6]}, {"velocity": [1e6, 0, 0]}, {"velocity": [0, 0, 1e99]},
            {"angular_velocity": [0, 0, 1e6]}, {"angular_velocity": [1e99, 0, 0]},
            {"surface_velocity": [1e6, 0, 0]}, {"surface_velocity": [1e99, 0, 0]},
            {"colliders": [{"type": "plane", "position": [0, 0, 5]}]},  # the whole body is behind it
            {"colliders": [{"type": "plane", "normal": [1e-300, 0, 0]}]},
            {"colliders": [{"type": "capsule", "from": [0, 0, 0], "to": [0, 0, 0]}]},
            {"colliders": [{"type": "capsule", "from": [-1e99, 0, 0], "to": [1e99, 0, 0]}]},
            {"colliders": [{"type": "box", "center": [0, 0, 0.35], "rotation": [1e9, 0, 0]}]},
            {"colliders": [{"type": "box", "size": [1e-300, 1e300, 1], "rounding": 0}]},
            {"colliders": [{"type": "sphere"}] * 200},
        ], expect=LEGAL)

    def test_colliders_that_come_and_move(self):
        around = {"type": "sphere", "name": "shell", "center": [0, 0, 0.3], "radius": 2}
        self.attack_with([
            {"events": [{"step": 3, "add": around}, {"step": 8, "remove": "shell"}]},
            {"events": [{"step": 3, "change": "ball", "radius": 1e6}]},
            {"events": [{"step": 3, "change": "ball", "radius": 0.6}, {"step": 4, "change": "ball", "radius": 1e-9}]},
            {"events": [{"step": 3, "move": "ball", "offset": [0, 0, 1e6]}]},  # in one step
            {"events": [{"step": 3, "move": "ball", "offset": [0, 0, 2e5], "over": 0.2}]},  # at 1e6 m/s
            {"events": [{"step": 3, "move": "ball", "target": [0, 0, 1e99], "over": 0.1}]},
            {"events": [{"step": 2, "move": "ball", "rotate": {"axis": [1, 1, 0], "degrees": 1e9}, "over": 0.1}]},
            {"events": [{"step": 2, "contact": {"friction": 1e9, "distance": 1}}]},
            {"events": [{"step": n, "remove" if n % 2 else "add": "shell" if n % 2 else around} for n in range(10)]},
        ], expect=LEGAL)
        for event, says in [
                ({"step": 1, "move": "bal", "offset": [0, 0, 1]}, "unknown group or collider 'bal'; did you mean 'ball'"),
                ({"step": 1, "move": "ball", "offset": [0, 0, 1], "index": 0}, "leave out 'index'"),
                ({"step": 1, "move": "ball", "offset": [[0, 0, 1]]}, "a collider goes to one point"),
                ({"step": 1, "change": "ball"}, "nothing is changed; give an option of the collider"),
                ({"step": 1, "change": "ball", "radius": -1}, "-1 is out of range"),
                ({"step": 1, "change": "ball", "normal": [0, 0, 1]}, "unknown key"),
                ({"step": 1, "add": around | {"name": "ball"}}, "the name 'ball' is another collider's"),
                ({"step": 1, "release": "ball", "index": 0}, "unknown group 'ball'"),
                ({"step": 1, "contact": {}}, "no setting is given"),
                ({"step": 1, "settings": {"energy_projection": 1}}, "it does not know the work of contact"),
        ]:
            self.attack_with([{"events": [event]}], expect=(INPUT,), says=says)


if __name__ == "__main__":
    hostile.main()
