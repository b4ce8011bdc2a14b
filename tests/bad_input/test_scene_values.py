"""The scene of docs/scenes.md with one thing in it changed: a value of another type or size, a key misspelt or left out."""
import ast
import copy
import json
import re

import hostile
from hostile import DONE, INPUT, SOURCE, HostileTest, run_scene_case

# What the scene on the page refers to, as the test of the page writes it.
PAGE_TEST = (SOURCE / "tests" / "docs" / "test_scenes_page.cpp").read_text()
FILES = {name: ast.literal_eval(f"'{text}'") for name, text in re.findall(r'\.write\("([^"]+)",\s*"([^"]*)"\)', PAGE_TEST)}

VALUES = [None, True, "x", "", -1, 0, 0.5, 1e308, -1e308, 1e-320, 2**31, 2**63, [], {}, [[]], [1e300, 1e300, 1e300]]

# Steps and threads are kept low: what is asked for here would be done, and takes its time.
KEPT = [r"^steps$"]


def page_scene():
    page = (SOURCE / "docs" / "scenes.md").read_text()
    text = re.search(r"```jsonc\n(.*?)```", page, re.DOTALL)[1]
    scene = json.loads(re.sub(r"//.*", "", text))
    scene["steps"] = 2
    scene["settings"]["threads"] = 1
    scene["bodies"][0]["mesh"] |= {"columns": 5, "rows": 5}
    return scene


def paths_of(value, path=()):
    """Every place in a JSON value but the root."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in entries:
        yield (*path, key)
        yield from paths_of(entry, (*path, key))


def text_of(path):
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).lstrip(".")


def changed(scene, path, change):
    """A copy in which `change` was called with the container and the key that the path leads to."""
    result = copy.deepcopy(scene)
    container = result
    for key in path[:-1]:
        container = container[key]
    change(container, path[-1])
    return result


def replaced(scene, path, value):
    def change(container, key):
        container[key] = value
    return changed(scene, path, change)


def without(scene, path):
    def change(container, key):
        del container[key]
    return changed(scene, path, change)


def renamed(scene, path, name):
    def change(container, key):
        entries = [(name if k == key else k, value) for k, value in container.items()]
        container.clear()
        container.update(entries)
    return changed(scene, path, change)


def misspellings(key):
    yield key + "x"
    yield key[:-1] or "q"
    yield key.upper()
    yield key.replace("_", "-") if "_" in key else key[0] + key


def wanted(key):
    """What is said where a key is misspelt: it is the nearest of those known, or the one that is missing."""
    return rf"the nearest first: {key}\b|'{key}' is missing|give one of the keys .*\b{key}\b"


class SceneValues(HostileTest):
    def setUp(self):
        super().setUp()
        self.scene = page_scene()
        self.paths = [path for path in paths_of(self.scene) if not any(re.search(kept, text_of(path)) for kept in KEPT)]
        self.keys = [path for path in self.paths if isinstance(path[-1], str)]

    def attack_scenes(self, scenes, **more):
        self.attack(run_scene_case(name, scene, files=FILES, **more) for name, scene in scenes)

    def test_the_scene_itself(self):
        self.attack_scenes([("page", self.scene)], expect=(DONE,))

    def test_other_values(self):
        self.attack_scenes((f"{text_of(path)} = {value}", replaced(self.scene, path, value))
                           for path in self.paths for value in VALUES)

    def test_keys_left_out(self):
        self.attack_scenes((f"without {text_of(path)}", without(self.scene, path)) for path in self.paths)

    def test_keys_misspelt(self):
        self.attack(run_scene_case(f"{text_of(path)} spelt {name}", renamed(self.scene, path, name), files=FILES,
                                   expect=(INPUT,), says=wanted(path[-1]))
                    for path in self.keys for name in sorted(set(misspellings(path[-1])) - {path[-1]}))

    def test_keys_twice(self):
        def twice(path):
            head, tail = json.dumps(renamed(self.scene, path, "MARK")).split('"MARK": ')
            return f'{head}"{path[-1]}": 0, "{path[-1]}": {tail}'
        self.attack(run_scene_case(f"{text_of(path)} twice", twice(path), files=FILES, expect=(INPUT,), says="twice")
                    for path in self.keys[:: 3])

    def test_lists_shorter_longer_and_turned_round(self):
        def lists():
            for path in self.paths:
                value = self.scene
                for key in path:
                    value = value[key]
                if isinstance(value, list):
                    yield f"{text_of(path)} doubled", replaced(self.scene, path, value * 2)
                    yield f"{text_of(path)} reversed", replaced(self.scene, path, value[::-1])
                    yield f"{text_of(path)} with one more", replaced(self.scene, path, value + value[-1:])
                    yield f"{text_of(path)} with one less", replaced(self.scene, path, value[:-1])
                    yield f"{text_of(path)} thrice", replaced(self.scene, path, [value] * 3)
        self.attack_scenes(lists())


if __name__ == "__main__":
    hostile.main()
