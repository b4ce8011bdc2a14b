"""The pages of the documentation: what they quote is compiled, what they link to is there, what they tell to type works."""
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import tempfile
import textwrap
import unittest

PLIANT = os.environ["PLIANT"]
SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])
PAGES = sorted([*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md"), SOURCE / "benchmarks" / "NOTES.md"])


def without_code(page):
    return re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)


def anchors(page):
    """Those that GitHub gives to the headings of a page."""
    titles = re.findall(r"^#+ (.*)$", without_code(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def snippet(source, name):
    """What stands between the two markers `//! [name]`, without the indentation that all lines share."""
    marker = re.escape(f"//! [{name}]")
    return textwrap.dedent(re.search(rf" *{marker}\n(.*\n) *{marker}\n", source, re.DOTALL)[1])


class Pages(unittest.TestCase):
    def test_scenes_beside_pages_run(self):
        scenes = sorted(SOURCE.glob("docs/pictures/*.json"))
        self.assertGreaterEqual(len(scenes), 1)
        for scene in scenes:
            with self.subTest(scene.name), tempfile.TemporaryDirectory() as folder:
                words = [PLIANT, "run", scene, "--steps", "1", "--out", f"{folder}/out", "--quiet"]
                done = subprocess.run(words, capture_output=True, text=True, timeout=120)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_links_lead_somewhere(self):
        count = 0
        for page in PAGES:
            for target, anchor in re.findall(r"\]\(([^)#:\s]*)(?:#([^)]*))?\)", without_code(page)):
                count += 1
                with self.subTest(page=page.name, target=target, anchor=anchor):
                    path = page.parent / target if target else page
                    self.assertTrue(path.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(path))
        self.assertGreater(count, 50)

    def test_quotes_are_parts_of_the_examples(self):
        count = 0
        for page in PAGES:
            quotes = re.findall(r"<!-- (examples/\S+\.cpp): (\w+) -->\n```cpp\n(.*?)```", page.read_text(), re.DOTALL)
            for file, name, quote in quotes:
                count += 1
                with self.subTest(page=page.name, file=file, name=name):
                    self.assertEqual(quote, snippet((SOURCE / file).read_text(), name))
        self.assertGreater(count, 10)

    def test_cmake_asks_for_this_version(self):
        version = re.search(r"project\(pliant VERSION (\d+\.\d+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        for file in ("docs/cpp.md", "examples/consumer/CMakeLists.txt"):
            self.assertIn(f"find_package(pliant {version} REQUIRED)", (SOURCE / file).read_text(), file)


class Tree(unittest.TestCase):
    """What the pages say of the source is so."""

    def test_layers_are_folders_and_listed_for_contributors(self):
        spec = importlib.util.spec_from_file_location("check_layers", SOURCE / "scripts" / "check_layers.py")
        check_layers = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(check_layers)
        folders = {path.relative_to(SOURCE / "src").as_posix() for path in (SOURCE / "src").glob("*/*/")}
        self.assertEqual(set(check_layers.LAYERS), {folder for folder in folders if (SOURCE / "src" / folder).is_dir()})
        listed = re.findall(r"^\| `(pliant\w*/\w+)` \|", (SOURCE / "CONTRIBUTING.md").read_text(), re.MULTILINE)
        self.assertEqual(set(check_layers.LAYERS), set(listed))

    def test_folders_of_the_architecture_exist(self):
        page = (SOURCE / "docs" / "architecture.md").read_text().split("\n## ")[0]
        for target in ("pliant", "pliant_io"):
            table = re.search(rf"\| `src/{target}/`.*?\n\n", page, re.DOTALL)[0]
            rooms = re.findall(r"^\| `([\w/.]+)` \|", table, re.MULTILINE)
            self.assertGreater(len(rooms), 5)
            for room in rooms:
                self.assertTrue((SOURCE / "src" / target / room).exists(), room)

    def test_what_to_change_is_where_the_page_says(self):
        page = (SOURCE / "docs" / "architecture.md").read_text()
        rows = re.search(r"\| to change \| look in \|\n(.*?)\n\n", page, re.DOTALL)[1]
        places = re.findall(r"`((?:src|apps)/[\w/.]+)`", rows)
        self.assertGreater(len(places), 8)
        for place in places:
            self.assertTrue((SOURCE / place).exists(), place)

    def test_functions_of_the_algorithm_exist(self):
        page = (SOURCE / "docs" / "algorithm.md").read_text()
        table = re.search(r"## One step\n\n(.*?)\n\n", page, re.DOTALL)[1]
        text = {path: path.read_text() for path in (SOURCE / "src" / "pliant").rglob("*.h")}
        functions = re.findall(r"`(\w+)::(\w+)`", table)
        self.assertGreater(len(functions), 5)
        for owner, function in functions:
            with self.subTest(f"{owner}::{function}"):
                headers = [t for t in text.values() if re.search(rf"^class {owner}\b[^;]*\{{", t, re.MULTILINE)]
                self.assertEqual(len(headers), 1)
                self.assertRegex(headers[0], rf"\b{function}\(")
        for place in re.findall(r"`([\w/.]+/[\w.]*)`", "".join(row.split("|")[4] for row in table.splitlines()[2:])):
            self.assertTrue((SOURCE / "src" / "pliant" / place).exists(), place)


class FirstGarment(unittest.TestCase):
    """The page's scene on a mesh of the size and axes of the page's: a tube, 11 high along y."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.scene = re.search(r"```json\n(.*?)```", (SOURCE / "docs" / "first_garment.md").read_text(), re.DOTALL)[1]
        mesh = {"shape": "cylinder", "radius": 3, "height": 12.5}
        tube = {"pliant": 1, "bodies": [{"mesh": mesh, "mass": {"total": 1}}]}
        (self.folder / "tube.json").write_text(json.dumps(tube))
        self.pliant("run", "tube.json", "--steps", "0", "--out", "tube")
        lines = (self.folder / "tube" / "mesh.obj").read_text().splitlines()
        turned = [f"v {x} {z} {-float(y)}" for kind, x, y, z in (line.split()[:4] for line in lines if line[:2] == "v ")]
        (self.folder / "shirt.obj").write_text("\n".join(turned + [line for line in lines if line[:2] == "f "]) + "\n")

    def pliant(self, *words, expected=0):
        done = subprocess.run([PLIANT, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, expected, done.stderr)
        return done.stdout + done.stderr

    def test_what_the_page_says(self):
        (self.folder / "shirt.json").write_text(self.scene)
        self.assertIn("The scene is sound.", self.pliant("check", "shirt.json"))
        self.pliant("run", "shirt.json", "--steps", "3", "--out", "out/stiff", "--set",
                    "bodies[shirt].material.bending=0.003")
        self.pliant("convert", "out/stiff", "shirt.usda")
        self.pliant("convert", "out/stiff", "shirt.pc2", "--fps", "24")

    def test_the_messages_of_the_page(self):
        for old, new, message in (('"bending"', '"bendng"', "bodies[0].material.bendng: unknown key; "),
                                  ('"shirt.obj"', '"shrt.obj"', "bodies[0].mesh.file: shrt.obj: no such file; check the path"),
                                  ("[0, 0, 0.7]", "[0, 0, 7]", "constraints[0].on: no vertex is selected; the body spans (")):
            with self.subTest(message):
                self.assertIn(old, self.scene)
                (self.folder / "bad.json").write_text(self.scene.replace(old, new))
                self.assertIn(message, self.pliant("check", "bad.json", expected=2))


if __name__ == "__main__":
    unittest.main()
