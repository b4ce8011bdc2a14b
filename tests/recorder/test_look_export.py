"""What bodies look like in glTF and USD that `pliant convert` writes: patterns, textures and finishes."""
import json
import struct
import unittest

import numpy

import png_file
import usd_reader
from export_case import PATCH, ExportCase
from gltf_reader import Gltf

OFF_THE_EDGE = 0.37
RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
# Of 4 × 2 pixels, no two alike, and another in the head alone of a JPEG of 40 × 30 pixels.
PICTURE = png_file.write(numpy.arange(24).reshape(2, 4, 3) * 10)
JPEG = b"\xff\xd8\xff\xc0" + struct.pack(">HBHHB", 17, 8, 30, 40, 3) + bytes((1, 17, 0, 2, 17, 0, 3, 17, 0)) + b"\xff\xd9"


def grid(columns, rows, origin, right, up):
    """A sheet of quadrilaterals cut in two, `right` and `up` from vertex to vertex."""
    points = [numpy.add(origin, numpy.multiply(right, i) + numpy.multiply(up, j)) for j in range(rows) for i in range(columns)]
    triangles = []
    for j in range(rows - 1):
        for i in range(columns - 1):
            a = j * columns + i
            triangles += [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]
    return {"vertices": numpy.round(points, 9).tolist(), "triangles": triangles}


def shade(place, size, pattern):
    """Whether a place at rest, in the order of the axes by length, is of the second color, as the renderer has it; and
    how far, in fields, it is from another field."""
    at = numpy.asarray(place) / size + OFF_THE_EDGE
    turns = numpy.where(numpy.mod(at, 2) > 1, 1, -1)
    edge = numpy.abs(at - numpy.round(at))
    return (turns[0] > 0, edge[0]) if pattern == "stripes" else (turns.prod() > 0, edge.min())


SHEET = grid(8, 6, [0.03, 0.02, 0.345], [0.1, 0, 0], [0, 0.09, 0])
WALL = grid(5, 7, [0.2, -0.4, 0.1], [0, 0, 0.05], [0, 0.1, 0])  # normals along x; longest along y
UPRIGHT = (numpy.array(SHEET["vertices"])[:, [0, 2, 1]] * [1, 1, 1.1] + [0, 3, 0]).tolist()
BODIES = {
    "sheet": {"mesh": SHEET, "start_positions": UPRIGHT, "appearance": {
        "front": "#ff0000", "back": "#00ff00", "pattern": "checker", "pattern_color": "#0000ff", "pattern_size": 0.11}},
    "wall": {"mesh": WALL, "appearance": {
        "front": "#ff0000", "pattern": "checker", "pattern_color": "#0000ff", "pattern_size": 0.07, "finish": "glossy"}},
    "bar": {"mesh": {"shape": "bar", "cells": [3, 1, 1], "size": [0.3, 0.11, 0.17]}, "appearance": {
        "front": "#ff0000", "pattern": "stripes", "pattern_color": "#ffffff", "pattern_size": 0.06}},
    "box": {"mesh": {"shape": "bar", "cells": [2, 2, 2], "size": [0.31, 0.2, 0.25]}, "appearance": {
        "front": "#ff0000", "pattern": "checker", "pattern_color": "#0000ff", "pattern_size": 0.07, "finish": "metal"}},
    "mapped": {"mesh": {"file": "patch.obj"}, "appearance": {
        "front": "#ff0000", "pattern": "checker", "pattern_color": "#0000ff", "pattern_size": 0.25, "mapping": "uv"}},
    "patch": {"mesh": {"file": "patch.obj"}, "appearance": {"texture": "picture.png", "texture_size": 0.5}},
    "banner": {"mesh": SHEET, "appearance": {
        "front": "#ff0000", "back": "#00ff00", "texture": "picture.png", "texture_size": 0.2}},
    "photo": {"mesh": {"file": "patch.obj"}, "appearance": {"texture": "photo.jpg", "texture_size": 0.4, "mapping": "rest"}},
    "steel": {"mesh": SHEET, "material": "steel_sheet", "appearance": {"front": "#808080"}},
    "own": {"mesh": SHEET, "material": "steel_sheet", "appearance": {"front": "#808080", "finish": "matte"}},
    "rope": {"mesh": {"shape": "chain", "links": 3, "direction": [1, 0, 0]}, "appearance": {
        "front": "#0000ff", "pattern": "stripes", "texture": "picture.png"}},
    "plain": {"mesh": SHEET},
}
COUNT = 3  # pictures of patterns in the whole scene: red on blue, green on blue, red on white


class LookExport(ExportCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "picture.png").write_bytes(PICTURE)
        (cls.folder / "photo.jpg").write_bytes(JPEG)
        cls.run_scene("looks", BODIES)
        cls.frames = numpy.load(cls.folder / "looks/frames.npy")
        cls.bodies = json.loads((cls.folder / "looks/run.json").read_text())["bodies"]

    @classmethod
    def run_scene(cls, name, bodies):
        scene = {"pliant": 1, "steps": 2, "gravity": [0, 0, -9.81], "settings": {"threads": 1}, "bodies": [
            {"name": key, **({} if "material" in body else {"mass": {"total": 1}}), **body} for key, body in bodies.items()]}
        (cls.folder / f"{name}.json").write_text(json.dumps(scene))
        cls.pliant("run", f"{name}.json", "--out", name)

    def gltf(self, name="looks.glb", *options, source="looks"):
        self.done = self.pliant("convert", source, name, "--tolerance", 0, *options)
        return Gltf(self.folder / name)

    def usd(self, name="looks.usda", *options, source="looks"):
        self.done = self.pliant("convert", source, name, *options)
        root, = usd_reader.read(self.folder / name).children.values()
        return root

    def material(self, gltf, name, side=0):
        return gltf.json["materials"][gltf.primitives(name)[side]["material"]]["pbrMetallicRoughness"]

    def image(self, gltf, name, side=0):
        """Its type and bytes; none: a color."""
        texture = self.material(gltf, name, side).get("baseColorTexture")
        if texture is None:
            return None
        texture = gltf.json["textures"][texture["index"]]
        sampler = gltf.json["samplers"][texture["sampler"]]
        self.assertEqual(sampler, {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
        image = gltf.json["images"][texture["source"]]
        return image["mimeType"], gltf.view(image["bufferView"])

    def rest(self, name):
        """Places at rest of a body's vertices, its axes by length."""
        mesh = BODIES[name]["mesh"]
        body = next(body for body in self.bodies if body["name"] == name)
        first = self.frames[0][body["first_vertex"]:body["first_vertex"] + body["vertices"]]
        rest = numpy.array(mesh["vertices"]) if "vertices" in mesh else first
        return rest[:, numpy.argsort(-numpy.round(numpy.ptp(rest, axis=0), 6), kind="stable")], first

    def gltf_corners(self, gltf, name, side=0):
        """Places at rest and texture coordinates, v from the bottom, of each triangle's corners."""
        part = gltf.primitives(name)[side]
        rest, first = self.rest(name)
        places = gltf.attribute(name, "POSITION", 0, side)
        distances = numpy.linalg.norm(places[:, None] - first[None], axis=2)
        self.assertLess(distances.min(1).max(), 1e-6)
        triangles = gltf.accessor(part["indices"])[:, 0].reshape(-1, 3)
        pairs = gltf.accessor(part["attributes"]["TEXCOORD_0"]).astype(float) * [1, -1] + [0, 1]
        return rest[distances.argmin(1)][triangles], pairs[triangles]

    def usd_corners(self, root, name):
        mesh = root.find(name, "mesh")
        self.assertEqual(mesh.interpolation["primvars:st"], "faceVarying")
        corners, pairs = [], []
        vertices = [int(vertex) for vertex in mesh.attributes["faceVertexIndices"]]
        rest, _ = self.rest(name)
        place = 0
        for count in map(int, mesh.attributes["faceVertexCounts"]):
            for last in range(place + 2, place + count):
                fan = [place, last - 1, last]
                corners.append(rest[[vertices[i] for i in fan]])
                pairs.append([mesh.attributes["primvars:st"][i] for i in fan])
            place += count
        return numpy.array(corners), numpy.array(pairs)

    def check_pattern(self, name, corners, pairs, pixels, base):
        """Each place inside a field has its color in the picture."""
        appearance = BODIES[name]["appearance"]
        second = tuple(bytes.fromhex(appearance["pattern_color"][1:]))
        seen = set()
        for triangle, uv in zip(corners, pairs):
            for a, b in [(i / 12, j / 12) for i in range(1, 11) for j in range(1, 12 - i)]:
                weights = numpy.array([1 - a - b, a, b])
                is_second, edge = shade(weights @ triangle, appearance["pattern_size"], appearance["pattern"])
                if edge < 0.03:
                    continue
                u, v = numpy.mod(weights @ uv, 1)
                found = tuple(pixels[min(int((1 - v) * len(pixels)), len(pixels) - 1), int(u * len(pixels[0]))])
                self.assertEqual(found, second if is_second else base)
                seen.add(found)
        self.assertEqual(seen, {second, base})

    def test_patterns_by_places_at_rest(self):
        gltf, root = self.gltf(), self.usd()
        for name in ("sheet", "wall", "bar", "box"):
            with self.subTest(name):
                kind, data = self.image(gltf, name)
                self.assertEqual(kind, "image/png")
                self.check_pattern(name, *self.gltf_corners(gltf, name), png_file.read(data), RED)
                self.check_pattern(name, *self.usd_corners(root, name), png_file.read(self.usd_picture(root, name)), RED)
        kind, data = self.image(gltf, "sheet", 1)
        self.check_pattern("sheet", *self.gltf_corners(gltf, "sheet", 1), png_file.read(data), GREEN)
        self.assertEqual(len(gltf.primitives("wall")), 1)  # both sides alike
        self.assertEqual(self.done.stderr, "")

    def test_texture_coordinates_of_a_flat_body_are_one_a_vertex(self):
        gltf = self.gltf()
        self.assertEqual(len(gltf.attribute("sheet", "POSITION", 0)), 8 * 6)
        self.assertLess(numpy.abs(self.gltf_corners(gltf, "sheet")[1]).max(), 8)

    def usd_picture(self, root, name):
        shader = root.find(name, "look", "picture")
        self.assertEqual(shader.attributes["info:id"], "UsdUVTexture")
        file = shader.attributes["inputs:file"]
        self.assertTrue(file.startswith("./"))
        return (self.folder / file).read_bytes()

    def own_coordinates(self, gltf, name):
        part = gltf.primitives(name)[0]
        pairs = gltf.accessor(part["attributes"]["TEXCOORD_0"]).astype(float) * [1, -1] + [0, 1]
        return pairs[gltf.accessor(part["indices"])[:, 0]]

    def test_patterns_and_textures_by_the_coordinates_of_the_mesh(self):
        wanted = numpy.array([line.split()[1:] for line in PATCH.splitlines() if line.startswith("vt")], float)
        wanted = wanted[[0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 6, 2, 5, 6]]
        gltf, root = self.gltf(), self.usd()
        for name, size in (("mapped", 2 * 0.25), ("patch", 0.5)):
            numpy.testing.assert_allclose(self.own_coordinates(gltf, name), wanted / size, atol=1e-6)
        numpy.testing.assert_allclose(root.find("patch", "mesh").attributes["primvars:st"][:3], wanted[:3] / 0.5)
        pixels = png_file.read(self.image(gltf, "mapped")[1])
        colors = [tuple(pixels[int(128 * (1 - v)), int(128 * u)]) for u, v in ((.25, .25), (.75, .25), (.75, .75), (.25, .75))]
        self.assertEqual(colors, [RED, BLUE, RED, BLUE])  # the field at 0, 0 has the front's color

    def test_textures_by_places_at_rest_keep_their_aspect(self):
        gltf = self.gltf()
        for name, width, aspect in (("banner", 0.2, 2), ("photo", 0.4, 4 / 3)):
            corners, pairs = self.gltf_corners(gltf, name)
            low = self.rest(name)[0].min(0)
            numpy.testing.assert_allclose(pairs, (corners - low)[..., :2] / [width, width / aspect], atol=1e-5)

    def test_textures_have_the_bytes_of_their_files(self):
        for file in ("looks.glb", "looks.gltf"):
            gltf = self.gltf(file)
            for name in ("patch", "banner"):
                self.assertEqual(self.image(gltf, name), ("image/png", PICTURE))
            self.assertEqual(self.image(gltf, "photo"), ("image/jpeg", JPEG))
            self.assertEqual(len(gltf.json["images"]), COUNT + 2)
            self.assertEqual(len(gltf.json["textures"]), COUNT + 2)
            self.assertEqual(len(gltf.json["samplers"]), 1)
        root = self.usd()
        self.assertEqual(self.usd_picture(root, "banner"), PICTURE)
        self.assertEqual(self.usd_picture(root, "photo"), JPEG)
        folder = self.folder / "looks_textures"
        self.assertEqual(len({root.find(name, "look", "picture").attributes["inputs:file"] for name in ("patch", "banner")}), 1)
        # The back of the sheet, green on blue, is not in USD.
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         ["picture_0.png", "picture_1.png", "picture_2.png", "picture_3.jpg"])

    def test_the_back_has_the_texture_or_its_own_color(self):
        gltf = self.gltf()
        self.assertEqual(len(gltf.primitives("patch")), 1)
        front, back = gltf.primitives("banner")
        self.assertIsNone(self.image(gltf, "banner", 1))
        self.assertEqual(self.material(gltf, "banner", 1)["baseColorFactor"], [0, 1, 0, 1])
        self.assertEqual(self.material(gltf, "banner")["baseColorFactor"], [1, 1, 1, 1])
        self.assertEqual([gltf.json["materials"][part["material"]]["doubleSided"] for part in (front, back)], [False, False])

    def test_finishes(self):
        gltf, root = self.gltf(), self.usd()
        wanted = {"sheet": (0, 0.9), "wall": (0, 0.35), "bar": (0, 0.8), "box": (1, 0.35), "patch": (0, 0.9),
                  "steel": (1, 0.35), "own": (0, 0.8)}
        for name, numbers in wanted.items():
            with self.subTest(name):
                material = self.material(gltf, name)
                self.assertEqual((material["metallicFactor"], material["roughnessFactor"]), numbers)
                surface = root.find(name, "look", "surface").attributes
                self.assertEqual((surface["inputs:metallic"], surface["inputs:roughness"]), numbers)
        self.assertEqual((self.material(gltf, "plain")["metallicFactor"], self.material(gltf, "plain")["roughnessFactor"]), (0, 0.8))

    def test_ropes_and_bodies_without_an_appearance_stay_plain(self):
        gltf, root = self.gltf(), self.usd()
        self.assertEqual(self.material(gltf, "rope")["baseColorFactor"], [0, 0, 1, 1])
        self.assertIsNone(self.image(gltf, "rope"))
        self.assertEqual(list(root.find("rope").children), ["edges"])
        self.assertEqual(list(root.find("plain").children), ["mesh"])
        self.assertNotIn("TEXCOORD_0", gltf.primitives("plain")[0]["attributes"])

    def test_materials_of_usd_are_connected(self):
        root = self.usd()
        mesh, look = root.find("sheet", "mesh"), root.find("sheet", "look")
        self.assertEqual((mesh.types["material:binding"], mesh.attributes["material:binding"]), ("rel", "/looks/sheet/look"))
        self.assertEqual(mesh.metadata["apiSchemas"], ["MaterialBindingAPI"])
        self.assertEqual((look.kind, look.connections["outputs:surface"]), ("Material", "/looks/sheet/look/surface.outputs:surface"))
        surface, picture, reader = (look.find(name) for name in ("surface", "picture", "coordinates"))
        self.assertEqual([part.kind for part in look.children.values()], ["Shader"] * 3)
        self.assertEqual(surface.attributes["info:id"], "UsdPreviewSurface")
        self.assertEqual(surface.connections["inputs:diffuseColor"], "/looks/sheet/look/picture.outputs:rgb")
        self.assertEqual((picture.attributes["inputs:wrapS"], picture.attributes["inputs:wrapT"]), ("repeat", "repeat"))
        self.assertEqual(picture.connections["inputs:st"], "/looks/sheet/look/coordinates.outputs:result")
        self.assertEqual((reader.attributes["info:id"], reader.attributes["inputs:varname"]), ("UsdPrimvarReader_float2", "st"))
        linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
        plain = root.find("steel", "look", "surface")
        numpy.testing.assert_allclose(plain.attributes["inputs:diffuseColor"], [linear] * 3, rtol=1e-6)
        numpy.testing.assert_allclose(root.find("steel", "mesh").attributes["primvars:displayColor"], [[linear] * 3], rtol=1e-6)

    def test_pictures_of_usd_are_replaced_together_or_not_at_all(self):
        self.usd("twice.usda")
        folder = self.folder / "twice_textures"
        self.usd("twice.usda", "--body", "banner")
        self.assertEqual([path.name for path in folder.iterdir()], ["picture_0.png"])
        (folder / "mine.png").write_bytes(b"mine")
        before = (self.folder / "twice.usda").read_bytes()
        done = self.pliant("convert", "looks", "twice.usda", expect=4)
        self.assertIn("it holds other files, mine.png for one", done.stderr)
        self.assertEqual((self.folder / "twice.usda").read_bytes(), before)
        self.assertEqual(len(list(folder.iterdir())), 2)
        self.usd("plain.usda", "--body", "steel")
        self.assertFalse((self.folder / "plain_textures").exists())
        self.usd("at@it.usda", "--body", "banner")
        self.assertEqual((self.folder / "at@it_textures/picture_0.png").read_bytes(), PICTURE)
        self.assertIn("@@@./at@it_textures/picture_0.png@@@", (self.folder / "at@it.usda").read_text())
        self.pliant("convert", "looks", "bad\n.usda", "--body", "banner", expect=2)
        self.assertEqual([path.name for path in self.folder.iterdir() if ".tmp" in path.name or "bad" in path.name], [])

    def test_no_texture_is_replaced_by_what_is_made_of_it(self):
        texture = self.folder / "loop_textures/picture_0.png"
        texture.parent.mkdir()
        texture.write_bytes(PICTURE)
        self.run_scene("loop", {"flag": {"mesh": SHEET, "appearance": {"texture": str(texture)}}})
        done = self.pliant("convert", "loop", "loop.usda", expect=2)
        self.assertIn("picture_0.png: this would replace the input", done.stderr)
        self.assertEqual(texture.read_bytes(), PICTURE)

    def test_one_body_at_one_moment(self):
        gltf = self.gltf("one.glb", "--body", "wall", "--frames", 1)
        self.assertEqual(len(gltf.json["images"]), 1)
        pairs = self.gltf_corners(self.gltf(), "wall")[1]
        part = gltf.primitives("wall")[0]
        own = gltf.accessor(part["attributes"]["TEXCOORD_0"])[gltf.accessor(part["indices"])[:, 0].reshape(-1, 3)]
        numpy.testing.assert_allclose(own * [1, -1] + [0, 1], pairs, atol=1e-7)

    def test_a_texture_that_is_gone_or_damaged(self):
        texture = self.folder / "gone.png"
        texture.write_bytes(PICTURE)
        self.run_scene("gone", {"first": BODIES["wall"], "flag": {"mesh": SHEET, "appearance": {"front": "#00ff00", "texture": "gone.png"}}})
        self.assertEqual(len(self.gltf("gone.glb", source="gone").json["images"]), 2)
        texture.unlink()
        gltf = self.gltf("gone.glb", source="gone")
        warning, = self.done.stderr.splitlines()
        self.assertEqual(warning, f"warning: flag: its texture is left out, and it has plain colors: {texture.resolve()}: no such file; check the path")
        self.assertEqual(self.material(gltf, "flag")["baseColorFactor"], [0, 1, 0, 1])
        self.assertEqual(len(gltf.json["images"]), 1)  # that of the first stays
        self.gltf("first.glb", "--body", "first", source="gone")
        self.assertEqual(self.done.stderr, "")
        self.pliant("resume", "gone", "--steps", 3)  # it moves nothing
        self.assertIn("gone.png: no such file", self.pliant("render", "gone", "--out", "gone.png2.png", "--size", "64x64").stderr)
        texture.write_bytes(PICTURE[:20])
        self.run_scene("cut", {"flag": {"mesh": SHEET, "appearance": {"texture": "gone.png"}}})
        gltf = self.gltf("cut.glb", source="cut")
        self.assertIn("flag: its texture", self.done.stderr)
        self.assertIn("the picture is broken", self.done.stderr)
        self.assertNotIn("images", gltf.json)

    def test_colliders(self):
        scene = {"pliant": 1, "steps": 1, "bodies": [{"name": "sheet", "mesh": SHEET, "mass": {"total": 1}}], "colliders": [
            {"type": "sphere", "name": "ball", "center": [0, 0, -3], "appearance": {"front": "#ff0000", "finish": "metal"}},
            {"type": "box", "name": "box", "center": [2, 0, -3], "appearance": {"finish": "glossy"}},
            {"type": "box", "name": "plain", "center": [4, 0, -3]}]}
        (self.folder / "colliders.json").write_text(json.dumps(scene))
        self.pliant("run", "colliders.json", "--out", "colliders")
        gltf, root = self.gltf("colliders.glb", source="colliders"), self.usd("colliders.usda", source="colliders")
        neutral = [((share + 0.055) / 1.055) ** 2.4 for share in (0.60, 0.65, 0.71)]
        for name, color, metal, roughness in (("ball", [1, 0, 0], 1, 0.35), ("box", neutral, 0, 0.35), ("plain", neutral, 0, 0.8)):
            with self.subTest(name):
                material = self.material(gltf, name)
                numpy.testing.assert_allclose(material["baseColorFactor"], [*color, 1], atol=5e-3)
                self.assertEqual((material["metallicFactor"], material["roughnessFactor"]), (metal, roughness))
                mesh = root.find(name, "mesh")
                numpy.testing.assert_allclose(mesh.attributes["primvars:displayColor"], [color], atol=5e-3)
                self.assertEqual("look" in root.find(name).children, name != "plain")
                if name == "plain":
                    continue
                self.assertEqual(mesh.attributes["material:binding"], f"/colliders/{name}/look")
                self.assertEqual(mesh.metadata["apiSchemas"], ["MaterialBindingAPI"])
                surface = root.find(name, "look", "surface").attributes
                numpy.testing.assert_allclose(surface["inputs:diffuseColor"], color, atol=5e-3)
                self.assertEqual((surface["inputs:metallic"], surface["inputs:roughness"]), (metal, roughness))
        self.assertEqual(self.done.stderr, "")

    def test_a_run_that_was_moved_without_its_texture(self):
        before = self.folder / "before"
        before.mkdir()
        (before / "patch.obj").write_text(PATCH)
        (before / "lost.png").write_bytes(PICTURE)
        scene = {"pliant": 1, "steps": 1, "bodies": [
            {"name": name, "mesh": {"file": "patch.obj"}, "mass": {"total": 1}, "appearance": {"front": "#00ff00", **more}}
            for name, more in (("a", {"texture": "lost.png"}), ("b", {"pattern": "stripes"}))]}
        (before / "scene.json").write_text(json.dumps(scene))
        self.pliant("run", "before/scene.json", "--out", "before/out")
        (before / "lost.png").unlink()
        before.rename(self.folder / "after")
        gltf = self.gltf("moved.glb", source="after/out")
        self.assertIn("warning: a: its texture", self.done.stderr)
        self.assertEqual(len(self.done.stderr.splitlines()), 1)
        self.assertEqual([self.image(gltf, name) is None for name in "ab"], [True, False])


if __name__ == "__main__":
    unittest.main()
