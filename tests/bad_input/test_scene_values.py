"""The scene of docs/scenes.md with one thing in it changed: a value of another type or size, a key misspelt or left out."""
import ast
import json
import re

import hostile
from changes import paths_of, renamed, replaced, text_of, value_at, without
from hostile import DONE, INPUT, SOURCE, Case, HostileTest, is_sanitized, run_scene_case

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
    scene["steps"] = 4
    scene["settings"] |= {"threads": 1, "time_step": 0.5}  # long ones, so that events come in so few steps
    scene["bodies"][0]["mesh"] |= {"columns": 5, "rows": 5}
    return scene


def misspellings(key):
    yield key + "x"
    yield key[:-1] or "q"
    yield key.upper()
    yield key.replace("_", "-") if "_" in key else key[0] + key


def wanted(key):
    """What is said where a key is misspelt: it is one of those near, or the one that is missing."""
    return rf"the key '{key}'|did you mean .*'{key}'.*\? \(known|'{key}' is missing|give one of the keys .*\b{key}\b"


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

    def test_check_and_run_agree(self):
        """What `pliant check` accepts has no mistake that a run finds before its first step, and the other way round."""
        changes = [(path, value) for path in self.paths for value in VALUES]
        disagreements = []
        for path, value in changes[::17 if not is_sanitized() else 170]:
            files = FILES | {"scene.json": replaced(self.scene, path, value)}
            run, _ = self.run_case(Case("run", ["run", "scene.json", "--out", "out"], files))
            check, _ = self.run_case(Case("check", ["check", "scene.json"], files))
            if (check.code == INPUT) != (run.code == INPUT):
                disagreements.append(f"{text_of(path)} = {value}: check: {check.code} {check.stderr} run: {run.code} {run.stderr}")
        self.assertEqual(disagreements, [])

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
                value = value_at(self.scene, path)
                if isinstance(value, list):
                    yield f"{text_of(path)} doubled", replaced(self.scene, path, value * 2)
                    yield f"{text_of(path)} reversed", replaced(self.scene, path, value[::-1])
                    yield f"{text_of(path)} with one more", replaced(self.scene, path, value + value[-1:])
                    yield f"{text_of(path)} with one less", replaced(self.scene, path, value[:-1])
                    yield f"{text_of(path)} thrice", replaced(self.scene, path, [value] * 3)
        self.attack_scenes(lists())


if __name__ == "__main__":
    hostile.main()
