"""pliant check and pliant run --set, as their users meet them."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PLIANT = os.environ["PLIANT"]


class Check(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def pliant(self, *arguments, expect=0):
        done = subprocess.run([PLIANT, *map(str, arguments)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder)
        self.assertEqual(done.returncode, expect, done.stderr)
        if expect == 2:
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("pliant: error: "), done.stderr)
        return done

    def test_every_built_in_scene_is_described(self):
        for line in self.pliant("scenes").stdout.splitlines():
            name = line.split()[0]
            with self.subTest(name):
                text = self.pliant("check", name, "--still").stdout
                self.assertIn("The scene is sound.", text)
                info = json.loads(self.pliant("check", name, "--json", "--still").stdout)
                self.assertIsNone(info["motion"])
                self.assertEqual(info["scene"], name)
                self.assertEqual(sum(group["constraints"] for group in info["groups"]),
                                 sum(info["constraints"].values()))
                self.assertEqual(info["vertices"]["all"], sum(body["vertices"] for body in info["bodies"]))
                self.assertGreaterEqual(info["system"]["factor_entries"], info["system"]["matrix_entries"])
        self.assertEqual(list(self.folder.iterdir()), [])

    def cloth_scene(self, **settings):
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "settings": settings,
            "bodies": [{"name": "cloth", "mesh": {"shape": "grid", "columns": 20, "rows": 20, "plane": "xy"},
                        "material": "denim", "constraints": [{"type": "position", "on": [380, 399]}]}]}))
        return scene

    def test_how_it_moves_is_told_to_who_makes_films(self):
        text = self.pliant("check", self.cloth_scene()).stdout
        self.assertRegex(text, r"\nits first 30 steps, taken to see:\n"
                         r"  how lively: a swing that takes a second comes back to 1\d % of its height: BDF2 takes \d %, "
                         r"`damping` \d\d %; livelier: less `damping`\n"
                         r"  how stretchy: what is stretched most is [0-9.]+ % past its limits.*\n"
                         r"  how fast: a step takes [0-9.]+ ms here, .* times as fast as what it shows\n"
                         r"  how exact: 20 iterations leave 'cloth' [0-9.]+ mm from where a step ends, \d+ % of how far "
                         r"(gravity takes|all forces take) it in a step\n")
        motion = json.loads(self.pliant("check", self.cloth_scene(), "--json").stdout)["motion"]
        self.assertEqual((motion["steps"], motion["step_error"]["body"]), (30, "cloth"))
        self.assertLess(motion["step_error"]["share"], 0.5)
        self.assertEqual(motion["warning"], "")

    def test_a_mesh_too_coarse_for_the_folds_of_its_cloth_is_a_warning(self):
        scene = self.folder / "s.json"
        for columns, material, is_coarse in ((20, "silk", True), (20, "felt", False), (50, "silk", False), (30, "silk", True)):
            scene.write_text(json.dumps({
                "pliant": 1, "bodies": [{"name": "cloth", "mesh": {"shape": "grid", "columns": columns, "rows": columns},
                                         "material": material, "constraints": [{"type": "position", "on": [0]}]}]}))
            warnings = json.loads(self.pliant("check", scene, "--json", "--still").stdout)["warnings"]
            found = [each for each in warnings if "to fold" in each]
            self.assertEqual(len(found), int(is_coarse), (columns, material, warnings))
        scene.write_text(scene.read_text().replace('"columns": 30', '"columns": 12').replace('"rows": 30', '"rows": 12'))
        self.assertRegex(self.pliant("check", scene, "--still").stdout,
                         r"\nwarning: body 'cloth': edges are 9.1 cm long, and 'silk' needs them below [0-9.]+ cm to fold; "
                         r"with these it shows dimples of their size; give a finer mesh, or more `bending`\n")

    def test_far_from_converged_is_a_warning_with_what_helps(self):
        far = {"integrator": "implicit_euler", "acceleration": "none", "iterations": 2}
        text = self.pliant("check", self.cloth_scene(**far)).stdout
        self.assertRegex(text, r"\nwarning: far from converged: 2 iterations leave 'cloth' .*; give --set "
                         r"settings.acceleration=lbfgs\n")
        text = self.pliant("check", self.cloth_scene(**far | {"acceleration": "lbfgs"})).stdout
        self.assertRegex(text, r"\nwarning: far from converged: .*; give 'cloth' less stiffness, or more iterations: "
                         r"--iterations 4\n")
        self.assertIn("automatic iterations, at most 100, BDF2",
                      self.pliant("check", self.cloth_scene(iterations="automatic"), "--still").stdout)

    def test_nothing_is_told_of_steps_that_are_not_there_or_fail(self):
        for settings in ({"time_step": 1e-300}, {}):
            info = json.loads(self.pliant("check", self.cloth_scene(**settings), "--json", "--set",
                                          "steps=" + ("0" if not settings else "9")).stdout)
            self.assertIsNone(info["motion"])

    def test_colliders_are_listed(self):
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "bodies": [{"mesh": {"shape": "grid", "columns": 3, "rows": 3}, "mass": {"total": 1}}],
            "contact": {"friction": 0.25},
            "colliders": [{"type": "sphere", "name": "ball", "center": [0, 0, -2], "friction": 0.5},
                          {"type": "plane", "position": [0, 0, -3]}]}))
        info = json.loads(self.pliant("check", scene, "--json").stdout)
        self.assertEqual(info["colliders"], [{"name": "ball", "type": "sphere", "friction": 0.5},
                                             {"name": "plane", "type": "plane", "friction": 0.25}])
        text = self.pliant("check", scene, "--set", "contact.friction=0.1").stdout
        self.assertIn("\ncolliders: ball (sphere, friction 0.5), plane (plane, friction 0.1)\n", text)
        self.assertNotIn("colliders", self.pliant("check", "curtain").stdout)
        self.assertEqual(json.loads(self.pliant("check", "curtain", "--json").stdout)["colliders"], [])

    def contact_scene(self, contact=None):
        scene = self.folder / "s.json"
        sheet = {"mesh": {"shape": "grid", "columns": 3, "rows": 3, "plane": "xy"}, "mass": {"total": 1}}
        pole = {"mesh": {"shape": "chain", "links": 1, "direction": [0, 0, 1]}, "mass": {"total": 1}}
        scene.write_text(json.dumps({
            "pliant": 1, "contact": {"friction": 0.25},
            "bodies": [{"name": "shirt", "contact": contact or {}, **sheet},
                       {"name": "skin", "transform": {"translate": [0.1, 0, 0.2]}, **sheet},
                       {"name": "pole", "transform": {"translate": [0.4, 0.3, -0.5]}, **pole}]}))
        return scene

    def test_groups_say_how_stiff_they_are(self):
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "bodies": [{"name": "rope", "mesh": {"shape": "chain", "links": 3}, "mass": {"total": 1},
                                     "constraints": [{"type": "position", "name": "hook", "on": [0]},
                                                     {"type": "position", "name": "band", "on": [3], "hold": "soft",
                                                      "stiffness": 40},
                                                     {"type": "edge_spring", "name": "links",
                                                      "stiffness": [100, 2500, 300]}]},
                                    {"name": "cloth", "mesh": {"shape": "grid", "columns": 4, "rows": 4},
                                     "material": "silk"}]}))
        text = self.pliant("check", scene, "--still").stdout
        self.assertIn("\n  hook: 1 position\n  band: 1 position, stiffness 40 N/m\n"
                      "  links: 3 edge_spring, stiffness 100 to 2500 N/m\n", text)
        self.assertRegex(text, r"\n  cloth.warp: \d+ fibre_strain, stiffness [0-9.]+ N/m, [0-9.]+ once taut\n")
        self.assertRegex(text, r"\n  cloth.bend: \d+ triangle_bending, stiffness [0-9.e-]+ N·m\n")
        groups = {group["name"]: group for group in json.loads(
            self.pliant("check", scene, "--json", "--still").stdout)["groups"]}
        self.assertNotIn("stiffness", groups["hook"])
        stiffness = {"least": 100, "most": 2500, "unit": "N/m", "taut_factor": 1, "text": "stiffness 100 to 2500 N/m"}
        self.assertEqual(groups["links"]["stiffness"], stiffness)
        self.assertGreater(groups["cloth.warp"]["stiffness"]["taut_factor"], 1)

    def test_what_is_off_is_listed(self):
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "gravity": {"enabled": False},
            "bodies": [{"name": "cloth", "mesh": {"shape": "grid", "columns": 5, "rows": 5}, "material": "denim",
                        "disabled_groups": ["cloth.bend"],
                        "constraints": [{"type": "position", "name": "pins", "on": [20, 24], "enabled": False}]}],
            "forces": [{"type": "wind"}], "colliders": [{"type": "sphere", "name": "ball", "enabled": False}],
            "events": [{"step": 1, "remove": "pins"}, {"step": 2, "change": "wind", "drag": 2}]}))
        text = self.pliant("check", scene, "--still").stdout
        self.assertIn("off: ball (sphere), cloth.bend (", text)
        self.assertIn(" on cloth), gravity (gravity), pins (position on cloth); 1 of the events act on these", text)
        self.assertIn("forces: wind; events: 2\n", text)
        info = json.loads(self.pliant("check", scene, "--json", "--still").stdout)
        self.assertEqual(info["disabled"][-1], {"name": "pins", "type": "position", "body": "cloth"})
        self.assertEqual(info["idle_events"], 1)
        self.assertEqual(info["colliders"], [])
        # Switched by a value of the command line.
        text = self.pliant("check", scene, "--still", "--set", "colliders[ball].enabled=true").stdout
        self.assertNotIn("off: ball", text)
        self.assertIn("colliders: ball", text)
        done = self.pliant("check", scene, "--set", "forces[wind].enabled=no", expect=2)
        self.assertIn("--set forces[wind].enabled=no: found a string; give true or false", done.stderr)

    def test_what_is_no_scene_is_told(self):
        picture = self.folder / "a.png"
        picture.write_bytes(b"\x89PNG\r\n\x1a\n\0\0")
        for command in ("check", "run"):
            message = self.pliant(command, picture, expect=2).stderr
            self.assertIn(f"{picture}: this looks like a PNG picture, not a scene; give a scene (.json) or a mesh (", message)

    def test_who_touches_whom_and_how(self):
        scene = self.contact_scene({"distance": 0.01, "friction": 0.5, "self": False, "ignores": ["pole", "skin"]})
        info = json.loads(self.pliant("check", scene, "--json").stdout)["contact"]
        self.assertEqual(info["surfaces"], True)
        self.assertEqual(info["bodies"][0], {"name": "shirt", "distance": 0.01, "friction": 0.5, "self": False,
                                             "ignores": ["pole", "skin"]})
        self.assertEqual(info["bodies"][1], {"name": "skin", "distance": 0.125, "self": True, "ignores": []})
        text = self.pliant("check", scene).stdout
        self.assertIn("\ncontact: bodies touch each other and themselves; friction 0.25\n", text)
        self.assertIn("\n  shirt: distance 0.01 m, friction 0.5, does not touch itself, ignores pole, skin\n", text)
        self.assertIn("\n  skin: distance 0.125 m\n", text)
        without = self.pliant("check", scene, "--set", "contact.surfaces=false").stdout
        self.assertIn("\ncontact: none; bodies pass through each other and through themselves\n", without)
        floor = ("--set", 'colliders=[{"type": "plane", "position": [0, 0, -3]}]')
        self.assertIn("\ncontact: bodies touch each other, themselves and colliders; friction 0.25\n",
                      self.pliant("check", scene, *floor).stdout)
        self.assertIn("\ncontact: bodies touch colliders alone, and pass through each other and through themselves; "
                      "friction 0.25\n",
                      self.pliant("check", scene, *floor, "--set", "contact.surfaces=false").stdout)
        self.assertEqual(json.loads(self.pliant("check", "curtain", "--json").stdout)["contact"], {})
        self.assertIn("contact: bodies touch each other",
                      self.pliant("check", "curtain", "--set", "contact.surfaces=true").stdout)

    def test_crossings_of_what_touches(self):
        crossing = "warning: 'shirt' crosses 'pole': "
        text = self.pliant("check", self.contact_scene()).stdout
        self.assertIn(crossing, text)
        self.assertIn("edge 0-1 of 'pole'", text)
        self.assertIn("at (0.4, 0.3, 0) m", text)
        self.assertIn("warning: 'skin' crosses 'pole': ", text)
        text = self.pliant("check", self.contact_scene({"ignores": ["pole"]})).stdout
        self.assertNotIn(crossing, text)
        self.assertIn("warning: 'skin' crosses 'pole': ", text)
        # A rope in a surface is nobody's business where nothing touches.
        self.assertNotIn("crosses", self.pliant("check", self.contact_scene(), "--set", "contact.surfaces=false").stdout)

    def test_numbers_of_a_small_scene(self):
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "steps": 10, "settings": {"time_step": 0.5},
            "bodies": [{"name": "rod", "mesh": {"vertices": [[0, 0, 0], [2, 0, 0]], "edges": [[0, 1]]},
                        "mass": {"each": [1, 3]}, "constraints": [{"type": "edge_spring", "stiffness": 12}]}]}))
        info = json.loads(self.pliant("check", scene, "--json").stdout)
        self.assertEqual(info["bodies"], [{"name": "rod", "vertices": 2, "edges": 1, "triangles": 0, "tetrahedra": 0,
                                           "mass": 4.0, "size": [2.0, 0.0, 0.0]}])
        self.assertAlmostEqual(info["fastest_frequency"]["rad_per_s"], 4)  # sqrt(12 (1 + 1/3))
        self.assertAlmostEqual(info["fastest_frequency"]["times_time_step"], 2)
        self.assertAlmostEqual(info["fastest_frequency"]["loss_per_step"], 1 - 5 ** -0.5)
        for sets, loss in [
                (["settings.substeps=2"], 1 - 1 / 2),  # (1 + 1)^(-1/2) twice
                (["settings.integrator=bdf2"], 1 - abs((2 + (1 + 4j) ** 0.5) / (3 - 4j)))]:
            options = [word for path in sets for word in ("--set", path)]
            other = json.loads(self.pliant("check", scene, "--json", *options).stdout)
            self.assertAlmostEqual(other["fastest_frequency"]["loss_per_step"], loss)
            self.assertGreater(other["fastest_frequency"]["half_life_hz"], info["fastest_frequency"]["half_life_hz"])
        text = self.pliant("check", scene, "--set", "settings.damping=2").stdout
        self.assertIn("`damping` takes half of every vibration in 0.35 s", text)
        text = self.pliant("check", scene, "--set", "settings.energy_projection=0.5").stdout
        self.assertIn("`energy_projection` gives back 50 % of what steps take, of what swings slower than 0.32 Hz", text)
        self.assertNotIn("in a second", text)  # which has but two steps
        text = self.pliant("check", scene, "--set", "settings.time_step=0.1", "--set", "settings.substeps=1").stdout
        self.assertIn("loses half of it in a second, with `integrator` `bdf2`", text)
        self.assertEqual(info["constraints"], {"edge_spring": 1})
        self.assertEqual(info["system"]["matrix_entries"], 3)
        self.assertEqual(info["seconds"], 5)
        self.assertEqual(info["free_components"], 1)
        self.assertIn("nothing holds the 2 vertices", info["warnings"][0])

    def free_of(self, colliders, gravity=(0, 0, -9.81), bodies=None, contact=None, more=()):
        """What is said to be held by nothing, of a sheet over the unit square at a height of 1 m."""
        scene = self.folder / "free.json"
        sheet = {"name": "sheet", "mesh": {"shape": "grid", "columns": 5, "rows": 5, "size": [1, 1], "plane": "xy"},
                 "transform": {"translate": [0, 0, 1]}, "mass": {"total": 1},
                 "constraints": [{"type": "edge_spring", "stiffness": 100}]}
        scene.write_text(json.dumps({"pliant": 1, "gravity": list(gravity), "bodies": (bodies or [sheet]) + list(more),
                                     "contact": {} if contact is None else contact, "colliders": colliders}))
        return [line for line in json.loads(self.pliant("check", scene, "--json").stdout)["warnings"]
                if "nothing holds" in line]

    def test_what_colliders_hold_is_not_free(self):
        falls = ["nothing holds the 25 vertices from vertex 0 of 'sheet' on: they will move freely"]
        floor = {"type": "plane"}
        ball = {"type": "sphere", "radius": 0.2}
        for name, colliders, gravity, held in [
                ("nothing", [], (0, 0, -9.81), False),
                ("a floor", [floor], (0, 0, -9.81), True),
                ("a floor above it", [floor], (0, 0, 9.81), False),
                ("a ceiling for what falls up", [{"type": "plane", "position": [0, 0, 3], "normal": [0, 0, -1]}],
                 (0, 0, 9.81), True),
                ("no gravity", [floor], (0, 0, 0), False),
                ("a wall", [{"type": "plane", "position": [-1, 0, 0], "normal": [1, 0, 0]}], (0, 0, -9.81), False),
                ("a slope", [{"type": "plane", "normal": [1, 0, 1]}], (0, 0, -9.81), True),
                ("a ball below it", [ball | {"center": [0.5, 0.5, 0]}], (0, 0, -9.81), True),
                ("a ball beside it", [ball | {"center": [1.3, 0.5, 0]}], (0, 0, -9.81), False),
                ("a ball above it", [ball | {"center": [0.5, 0.5, 2]}], (0, 0, -9.81), False),
                ("a ball beside it, where gravity points", [ball | {"center": [3, 0.5, 1]}], (9.81, 0, 0), True),
                ("a tilted box", [{"type": "box", "center": [0.5, 0.5, -5], "size": [0.4, 0.4, 0.4],
                                   "rotation": [30, 40, 0]}], (0, 0, -9.81), True),
                ("a capsule", [{"type": "capsule", "from": [-3, 0.5, 0], "to": [3, 0.5, 0]}], (0, 0, -9.81), True),
                ("one of two", [ball | {"center": [9, 9, 0]}, floor], (0, 0, -9.81), True)]:
            with self.subTest(name):
                self.assertEqual(self.free_of(colliders, gravity), [] if held else falls)

    def test_what_animated_bodies_hold_is_not_free(self):
        surfaces = {}
        def statue(at):
            return {"name": "statue", "mesh": {"shape": "sphere", "subdivisions": 2, "radius": 0.3},
                    "transform": {"translate": at}, "animation": {}}
        for name, at, gravity, contact, held in [
                ("below it", [0.5, 0.5, 0], (0, 0, -9.81), surfaces, True),
                ("below it, where nothing touches", [0.5, 0.5, 0], (0, 0, -9.81), {"surfaces": False}, False),
                ("beside it", [2, 0.5, 0], (0, 0, -9.81), surfaces, False),
                ("above it", [0.5, 0.5, 2], (0, 0, -9.81), surfaces, False),
                ("above it, where it falls up", [0.5, 0.5, 2], (0, 0, 9.81), surfaces, True),
                ("no gravity", [0.5, 0.5, 0], (0, 0, 0), surfaces, False)]:
            with self.subTest(name):
                self.assertEqual(len(self.free_of([], gravity, contact=contact, more=[statue(at)])), 0 if held else 1)

    def test_crossings_of_what_is_held_do_no_harm(self):
        balls = [{"name": name, "mesh": {"shape": "sphere", "subdivisions": 2, "radius": 0.3},
                  "transform": {"translate": [x, 0, 0]}, "animation": {}} for name, x in [("one", 0), ("two", 0.4)]]
        scene = self.folder / "held.json"
        scene.write_text(json.dumps({"pliant": 1, "bodies": balls, "contact": {"surfaces": True}}))
        warnings = json.loads(self.pliant("check", scene, "--json").stdout)["warnings"]
        self.assertEqual(len(warnings), 1)
        self.assertTrue(warnings[0].startswith("'one' crosses 'two': "))
        self.assertTrue(warnings[0].endswith("; both are held, so that does no harm"))

    def test_parts_of_a_body_are_held_one_by_one(self):
        beads = {"name": "beads", "mass": {"total": 1},
                 "mesh": {"vertices": [[0, 0, 1], [0, 0, 2], [5, 0, 1], [5, 0, 2]], "edges": [[0, 1], [2, 3]]},
                 "constraints": [{"type": "edge_spring", "stiffness": 100}]}
        self.assertEqual(self.free_of([{"type": "sphere", "center": [0, 0, 0], "radius": 0.3}], bodies=[beads]),
                         ["nothing holds the 2 vertices from vertex 2 of 'beads' on: they will move freely"])

    def write_bodies(self, bodies):
        """A scene of surfaces that are given as name: (vertices, elements by their kind)."""
        scene = self.folder / "s.json"
        scene.write_text(json.dumps({
            "pliant": 1, "steps": 1,
            "bodies": [{"name": name, "mesh": {"vertices": vertices, **elements}, "mass": {"total": 1}}
                       for name, (vertices, elements) in bodies.items()]}))
        return scene

    def crossings_of(self, bodies):
        scene = self.write_bodies(bodies)
        text = self.pliant("check", scene).stdout
        self.assertIn("The scene is sound.", text)
        warnings = [line for line in json.loads(self.pliant("check", scene, "--json").stdout)["warnings"]
                    if "cross" in line]
        for line in warnings:
            self.assertIn(f"warning: {line}\n", text)
        return warnings

    def test_bodies_that_cross(self):
        level = ([[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]], {"triangles": [[0, 1, 2], [1, 3, 2]]})

        def upright(x, y=1, low=-1, high=1):
            return ([[x, y, low], [x, y, high], [x, y + 0.5, high + 1]], {"triangles": [[0, 1, 2]]})

        self.assertEqual(self.crossings_of({"sail": level, "mast": upright(1)}), [
            "'sail' crosses 'mast': triangle 0 of 'sail', triangle 0 of 'mast', at (1, 1, 0) m (and 1 more)"])
        self.assertEqual(self.crossings_of({"mast": upright(3, y=3), "sail": level}), [
            "'mast' crosses 'sail': triangle 0 of 'mast', triangle 1 of 'sail', at (3, 3, 0) m (and 1 more)"])
        self.assertEqual(self.crossings_of({"sail": level, "mast": upright(1, low=0)}), [])
        self.assertEqual(self.crossings_of({"sail": level, "mast": upright(5)}), [])
        solid = ([[1, 1, -1], [1.5, 1, -1], [1, 1.5, -1], [1, 1, 1]], {"tetrahedra": [[0, 1, 2, 3]]})
        self.assertEqual(self.crossings_of({"block": solid, "sail": level}), [
            "'block' crosses 'sail': edge 0-3 of 'block', triangle 0 of 'sail', at (1, 1, 0) m (and 2 more)"])
        spike = ([[1.1, 1.1, 0], [1.2, 1.1, 9], [1.1, 1.2, 9]], {"triangles": [[0, 1, 2]]})
        self.assertEqual(self.crossings_of({"spike": spike, "block": solid}), [
            "'spike' crosses 'block': triangle 0 of 'spike', face 1-2-3 of 'block', at (1.102, 1.1, 0.1915) m "
            "(and 1 more)"])
        rope = ([[1, 1, -1], [1, 1, 1]], {"edges": [[0, 1]]})
        self.assertEqual(self.crossings_of({"sail": level, "rope": rope}), [])
        masts = {f"mast {i}": upright(0.1 + 0.1 * i) for i in range(8)}
        warnings = self.crossings_of({**masts, "sail": level})
        self.assertEqual(len(warnings), 6)
        self.assertTrue(warnings[0].startswith("'mast 0' crosses 'sail': "))
        self.assertEqual(warnings[5], "and 3 more bodies or pairs of bodies that cross")

    def test_a_body_that_crosses_itself(self):
        both = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 1, 1]]
        other = ([[9, 9, 9], [8, 9, 9], [9, 8, 9]], {"triangles": [[0, 1, 2]]})
        warnings = self.crossings_of({"other": other, "sail": (both, {"triangles": [[0, 1, 2], [3, 4, 5]]})})
        self.assertEqual(warnings, ["'sail' crosses itself: triangles 0 and 1, at (3, 1, 0) m (and 1 more)"])

    def test_values_are_set(self):
        info = json.loads(self.pliant("check", "curtain", "--json", "--set", "steps=7", "--set",
                                      "bodies[curtain].mesh.columns=5").stdout)
        self.assertEqual(info["steps"], 7)
        self.assertEqual(info["bodies"][0]["vertices"], 5 * 41)
        done = self.pliant("run", "chain", "--set", "steps=2", "--set", "name=two words", "--out", "out")
        self.assertIn("two words: 2 of 2 steps", done.stdout)

    def test_slips_name_the_option(self):
        for arguments, wanted in [
            (["check", "curtain", "--set", "steps=x"], "--set steps=x: found "),
            (["check", "curtain", "--set", "steps"], "there is no '='"),
            (["check", "curtain", "--set"], "--set"),
            (["run", "curtain", "--steps", "99999999999999999999"], "--steps: '99999999999999999999' is out of range"),
            (["run", "curtain", "--steps", "x"], "give a whole number"),
            (["run", "curtain", "--steps", "1e18"], "without point and exponent"),
            (["run", "curtain", "--time-step", "0,1"], "--time-step: '0,1'"),
            (["run", "curtain", "--time-step", "nan"], "not a finite number"),
            (["run", "curtain", "--time-step", "1e999"], "out of range"),
            (["chek", "curtain"], "unknown command 'chek'; did you mean 'check'?"),
            (["run", "x" * 5000], "neither a file nor a built-in scene"),
            (["x" * 5000], "unknown command"),
            (["run", "a\x1b[31m\nb"], "neither a file nor a built-in scene"),
        ]:
            with self.subTest(arguments=arguments):
                error = self.pliant(*arguments, expect=2).stderr
                self.assertIn(wanted, error)
                self.assertLess(len(error), 1500)
                self.assertNotIn("\x1b", error)

    def test_the_schema_is_json(self):
        self.assertIn("$defs", json.loads(self.pliant("schema").stdout))


if __name__ == "__main__":
    unittest.main()
