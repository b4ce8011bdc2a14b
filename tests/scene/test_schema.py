"""The JSON Schema of scenes, against an independent validator: what runs is accepted, what is wrong is refused."""
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is missing")
    sys.exit(77)

PLIANT = os.environ["PLIANT"]
SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])
SCHEMA = json.loads(subprocess.run([PLIANT, "schema"], capture_output=True, text=True, check=True).stdout)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

SOUND = {
    "pliant": 1,
    "bodies": [{
        "name": "sheet", "mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1},
        "constraints": [{"type": "position", "name": "pins", "on": [0, 2]},
                        {"type": "edge_spring", "stiffness": 10}, {"type": "hinge", "enabled": False}],
        "disabled_groups": [],
    }],
    "forces": [{"type": "wind", "velocity": [1, 2, 3]},
               {"type": "test_force", "vertex": 1, "force": [0, 0, 1], "frames": [0, 3], "enabled": False}],
    "gravity": {"acceleration": [0, 0, -9.81], "enabled": False},
    "contact": {"friction": 0.2},
    "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, -3], "radius": 0.5, "friction": 0.1}, {"type": "plane",
                   "position": [0, 0, -5]}, {"type": "capsule", "enabled": False}],
    "events": [{"step": 1, "move": "ball", "offset": [0, 0, 1]}, {"step": 2, "contact": {"friction": 0.3}},
               {"step": 3, "change": "ball", "radius": 0.4}, {"step": 4, "add": {"type": "box", "rounding": 0.1}},
               {"step": 5, "remove": "ball"}],
    "view": {"color": "stretch", "camera": {"position": [3, 3, 3]}, "background": "#ffffff"},
}

# Paths with values that both the schema and the program refuse.
WRONG = [
    (["pliant"], 2), (["stepz"], 3), (["steps"], -1), (["steps"], "5"), (["steps"], 5.5),
    (["settings"], {"time_step": 0}), (["settings"], {"iterations": 0}), (["settings"], {"threads": 1.5}),
    (["settings"], {"backend": "egen"}), (["settings"], {"iteratons": 3}), (["settings"], []),
    (["gravity"], 9.81), (["gravity"], [0, 0]), (["gravity"], [0, 0, 1e101]),
    (["output"], {"format": "mp4"}), (["output"], {"every": 0}),
    (["bodies", 0, "mesh"], {}), (["bodies", 0, "mesh"], {"shape": "gird"}), (["bodies", 0, "mesh", "colums"], 3),
    (["bodies", 0, "mesh", "columns"], "3"), (["bodies", 0, "mesh", "size"], [1]),
    (["bodies", 0, "mesh"], {"file": "a.obj", "up": "w"}), (["bodies", 0, "mesh"], {"vertices": [[0, 0]]}),
    (["bodies", 0, "mass"], {}), (["bodies", 0, "mass"], {"total": 0}), (["bodies", 0, "mass"], {"weight": 1}),
    (["bodies", 0, "mass"], {"total": 1, "per_vertex": 1}), (["bodies", 0, "velocity"], 3),
    (["bodies", 0, "transform"], {"scale": 0}), (["bodies", 0, "transform"], {"rotate": {"axis": [0, 0, 1]}}),
    (["bodies", 0, "constraints", 1, "type"], "edge"), (["bodies", 0, "constraints", 1, "stiffness"], -1),
    (["bodies", 0, "constraints", 1, "stiffness"], []), (["bodies", 0, "constraints", 1, "stiffness"], [1, "2"]),
    (["bodies", 0, "constraints", 1, "stiffness"], {"map": 3}), (["bodies", 0, "constraints", 1, "stifness"], 1),
    (["bodies", 0, "constraints", 0, "on"], "edges"), (["bodies", 0, "constraints", 0, "on"], {"box": {"min": [0, 0, 0]}}),
    (["bodies", 0, "constraints", 0, "on"], [-1]), (["bodies", 0, "constraints", 0, "on"], []),
    (["bodies", 0, "constraints", 0, "on"], {"map": {"name": "x"}}),
    (["bodies", 0, "constraints", 0, "on"], {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "nearest": [0, 0, 0]}),
    (["bodies", 0, "constraints", 0, "hold"], "firm"),
    (["forces", 0, "type"], "gravity"), (["forces", 0, "velocity"], [1, 2]), (["forces", 1, "vertices"], [1]),
    (["forces", 1, "frames"], [1]),
    (["contact"], {"fricton": 1}), (["contact"], {"friction": -1}), (["contact", "distance"], "1"),
    (["colliders", 0, "type"], "ball"), (["colliders", 0, "radius"], 0), (["colliders", 0, "friction"], -1),
    (["colliders", 0, "friction"], [0.1]), (["colliders", 0, "centre"], [0, 0, 0]), (["colliders", 1, "normal"], 1),
    (["colliders"], {}), (["events", 1, "contact"], {"frictio": 1}), (["events", 2, "radios"], 1),
    (["events", 3, "add", "roundness"], 1),
    (["view", "colr"], "stretch"), (["view", "color"], "red"), (["view", "background"], "red"),
    (["view", "background"], [0, 0, 2]), (["view", "wireframe"], 1), (["view", "size"], [1280]),
    (["view", "camera", "field_of_view"], 180),
    (["include"], 3), (["include"], {"set": {}}),
    (["bodies", 0, "constraints", 0, "enabled"], "no"), (["forces", 0, "enabled"], 0), (["colliders", 0, "enabled"], None),
    (["gravity"], {"enabled": "off"}), (["gravity"], {"acceleration": 9.81}), (["gravity"], {"accel": [0, 0, 1]}),
    (["bodies", 0, "disabled_groups"], "sheet.bend"), (["bodies", 0, "disabled_groups"], [1]),
    (["events", 2, "enabled"], False), (["events", 3, "add", "enabled"], False),
]


def changed(path, value):
    scene = copy.deepcopy(SOUND)
    target = scene
    for step in path[:-1]:
        target = target[step]
    target[path[-1]] = value
    return scene


def check(scene):
    with tempfile.TemporaryDirectory(prefix="pliant-") as folder:
        path = pathlib.Path(folder) / "scene.json"
        path.write_text(json.dumps(scene))
        return subprocess.run([PLIANT, "check", path], capture_output=True, text=True)


class Schema(unittest.TestCase):
    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_the_published_schema_is_that_of_the_program(self):
        published = (SOURCE / "docs" / "scene.schema.json").read_text()
        self.assertEqual(json.loads(published), SCHEMA, "pliant schema > docs/scene.schema.json")

    def test_scenes_are_accepted(self):
        scenes = sorted((SOURCE / "scenes").glob("*.json")) + sorted((SOURCE / "examples").glob("*.json"))
        self.assertGreater(len(scenes), 7)
        for path in scenes:
            with self.subTest(path.name):
                VALIDATOR.validate(json.loads(path.read_text()))

    def test_the_examples_of_the_documentation_are_accepted(self):
        pages = [SOURCE / "docs" / "scenes.md", *(SOURCE / "docs" / "scenes").glob("*.md")]
        examples = [example for page in pages
                    for example in re.findall(r"```jsonc\n(.*?)```", page.read_text(), re.DOTALL)]
        self.assertGreater(len(examples), 0)
        for example in examples:
            text = re.sub(r"//.*", "", example)
            if text.lstrip().startswith("{") and '"pliant"' in text:
                VALIDATOR.validate(json.loads(text))

    def test_what_the_program_refuses_is_refused(self):
        VALIDATOR.validate(SOUND)
        done = check(SOUND)
        self.assertEqual(done.returncode, 0, done.stderr)
        for path, value in WRONG:
            with self.subTest(path=path, value=value):
                scene = changed(path, value)
                self.assertFalse(VALIDATOR.is_valid(scene))
                done = check(scene)
                self.assertEqual(done.returncode, 2, done.stderr)

    def test_what_the_schema_accepts_besides(self):
        for path, value in [
            (["bodies", 0, "constraints", 1, "stiffness"], [1] * 16), (["bodies", 0, "constraints", 0, "on"], "corners"),
            (["bodies", 0, "constraints", 0, "on"], {"boundary_loop": 0}),
            (["bodies", 0, "constraints", 0, "on"], {"boundary_loop": {"nearest": [0, 0, 1]}}),
            (["bodies", 0, "constraints", 0, "on"], {"any_of": [[1], {"not": {"nearest": [0, 0, 0]}}]}),
            (["include"], {"file": "chain", "set": {"steps": 3}}), (["include"], ["chain", "bar"]),
            (["gravity"], None), (["$schema"], "scene.schema.json"), (["view", "background"], [0, 0.5, 1]),
            (["bodies", 0, "mass"], {"each": [1] * 9}),
        ]:
            with self.subTest(path=path, value=value):
                VALIDATOR.validate(changed(path, value))
                done = check(changed(path, value))
                self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
