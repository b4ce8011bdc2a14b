"""glTF that `pliant convert` writes, before the validator of the standard: no error and no warning."""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy

import png_file
from export_case import SOURCE, ExportCase

VALIDATOR = SOURCE / "node_modules/gltf-validator"


class GltfValidator(ExportCase):
    def issues(self, name):
        script = pathlib.Path(__file__).with_name("validate_gltf.js")
        done = subprocess.run(["node", script, VALIDATOR, self.folder / name], capture_output=True, text=True,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_every_kind_of_file(self):
        self.pliant("run", "scene.json", "--out", "two", "--set=view.front=#ff8000")
        for arguments in [["run", "all.glb"], ["run", "all.gltf"], ["run", "flat.glb", "--normals", "flat"],
                          ["run", "rope.glb", "--body", "rope"], ["run", "still.glb", "--body", "still"],
                          ["run", "one.glb", "--frames", "7"], ["run", "two.glb", "--max-keyframes", "2"],
                          ["patch.obj", "patch.gltf"], ["two", "two.glb"]]:
            with self.subTest(arguments=arguments):
                self.pliant("convert", "--yes", *arguments)
                found = self.issues(arguments[1])
                self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])

    def test_patterns_and_textures(self):
        (self.folder / "picture.png").write_bytes(png_file.write(numpy.arange(24).reshape(2, 4, 3)))
        looks = {"patch": {"texture": "picture.png", "back": "#00ff00", "finish": "metal"},
                 "bar": {"pattern": "checker", "front": "#00ff00"}, "still": {"pattern": "stripes", "finish": "glossy"},
                 "rope": {"texture": "picture.png"}}
        self.pliant("run", "scene.json", "--out", "looks",
                    *(f"--set=bodies[{name}].appearance={json.dumps(look)}" for name, look in looks.items()))
        for name, *options in [["looks.glb"], ["looks.gltf", "--normals", "flat"], ["patch.glb", "--body", "patch"]]:
            self.pliant("convert", "--yes", "looks", name, *options)
            found = self.issues(name)
            self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])

    def test_colliders_that_move_come_and_go(self):
        (self.folder / "ball.json").write_text(json.dumps({
            "pliant": 1, "steps": 12,
            "bodies": [{"mesh": {"shape": "grid", "columns": 4, "rows": 4}, "mass": {"total": 1}}],
            "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, -2]}],
            "events": [{"step": 2, "move": "ball", "offset": [1, 0, 0], "over": 0.1}, {"step": 9, "remove": "ball"},
                       {"step": 5, "add": {"type": "box", "center": [3, 0, 0]}}]}))
        self.pliant("run", "ball.json", "--out", "ball")
        self.pliant("convert", "--yes", "ball", "ball.gltf")
        document = json.loads((self.folder / "ball.gltf").read_text())
        channels = [(document["nodes"][channel["target"]["node"]]["name"], channel["target"]["path"])
                    for channel in document["animations"][0]["channels"]]
        self.assertEqual([channel for channel in channels if channel[1] != "weights"],
                         [("ball", "translation"), ("ball", "rotation"), ("ball", "scale"), ("box", "scale")])
        found = self.issues("ball.gltf")
        self.assertEqual((found["numErrors"], found["numWarnings"]), (0, 0), found["messages"])

    def test_the_validator_finds_what_is_wrong(self):
        self.pliant("convert", "run", "good.gltf", "--yes")
        text = (self.folder / "good.gltf").read_text()
        (self.folder / "bad.gltf").write_text(text.replace('"mode":4', '"mode":"4"'))
        self.assertGreater(self.issues("bad.gltf")["numErrors"], 0)


if __name__ == "__main__":
    if not shutil.which("node") or not VALIDATOR.is_dir():
        print("skipped: node or node_modules/gltf-validator is missing; scripts/setup.sh --dev installs them")
        sys.exit(77)
    unittest.main()
