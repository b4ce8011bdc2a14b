"""Constraints and forces that are written with NumPy, and what can be changed and asked for while a simulation runs."""
import json
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest

import numpy as np
import pliant


class Springs(pliant.OwnConstraint):
    def project(self, z, fields):
        return z * (fields / np.linalg.norm(z, axis=2))[:, :, None]


def own_springs(mesh, stiffness):
    edges = mesh.unique_edges
    lengths = np.linalg.norm(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]], axis=1)
    return Springs(edges, reduction=[[-1, 1]], stiffness=stiffness, fields=lengths)


def hung(add, columns=20, **settings):
    simulation = pliant.Simulation(**settings)
    mesh = pliant.grid(columns=columns, rows=columns)
    body = simulation.add_body(mesh, area_density=0.2)
    add(simulation, body, mesh)
    simulation.add(body, pliant.Position(on="corners"))
    simulation.add(pliant.Gravity())
    return simulation


class Own(unittest.TestCase):
    def test_springs_in_numpy_move_as_those_in_cpp(self):
        own = hung(lambda s, b, mesh: s.add(b, own_springs(mesh, 500)), precision="double")
        built_in = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500)), precision="double")
        for _ in range(30):
            own.step()
            built_in.step()
        self.assertLess(np.abs(own.positions - built_in.positions).max(), 1e-12)
        self.assertGreater(np.abs(own.positions - pliant.grid(columns=20, rows=20).vertices).max(), 1e-3)

    def test_it_is_called_with_threads(self):
        seen = set()

        def project(z, fields):
            seen.add(threading.get_ident())
            return np.zeros_like(z)

        simulation = hung(lambda s, b, mesh: s.add(
            b, pliant.OwnConstraint(mesh.unique_edges, reduction=[[-1, 1]], stiffness=1, project=project)),
            columns=80, threads=2, precision="double")
        for _ in range(5):
            simulation.step()
        self.assertTrue(seen)
        self.assertTrue(np.isfinite(simulation.positions).all())

    def test_it_is_called_once_an_iteration_for_all_constraints(self):
        for reduction, rows in [([[-1, 1]], 1), (None, 2)]:
            shapes = []

            def project(z, fields):
                shapes.append((z.shape, fields.shape))
                return z * 0.9

            simulation = hung(lambda s, b, mesh: s.add(b, pliant.OwnConstraint(
                mesh.unique_edges, reduction=reduction, fields=np.ones(len(mesh.unique_edges)), project=project)),
                columns=60, iterations=5, precision="double")
            simulation.step()
            count = len(pliant.grid(columns=60, rows=60).unique_edges)
            self.assertEqual(set(shapes), {((count, rows, 3), (count, 1))})
            self.assertIn(len(shapes), (5, 6))  # one more where the end of the step is judged

    def test_arrays_that_a_function_keeps_or_uses_again_are_safe(self):
        kept, room = [], {}

        class Wrapped:  # hands out an array that it keeps
            def __init__(self, array):
                self.array = array

            def __array__(self, dtype=None):
                return self.array

        def project(z, fields):
            kept.append((z, z.copy()))
            with self.assertRaises(ValueError):
                z[0] = 1
            with self.assertRaises(ValueError):
                fields[0] = 1
            out = room.setdefault(z.shape, np.empty_like(z))
            return wrap(np.multiply(z, (fields / np.linalg.norm(z, axis=2))[:, :, None], out=out))

        def add(simulation, body, mesh):  # two groups that write to one array
            springs = own_springs(mesh, 500)
            for stiffness in (200, 300):
                simulation.add(body, pliant.OwnConstraint(springs.stencils, reduction=[[-1, 1]], stiffness=stiffness,
                                                          fields=springs.fields * stiffness / 250, project=project))

        def add_alike(simulation, body, mesh):
            springs = own_springs(mesh, 500)
            for stiffness in (200, 300):
                simulation.add(body, Springs(springs.stencils, reduction=[[-1, 1]], stiffness=stiffness,
                                             fields=springs.fields * stiffness / 250))

        for wrap in (lambda array: array, Wrapped, lambda array: array[:]):
            own, alike = hung(add, precision="double"), hung(add_alike, precision="double")
            for _ in range(5):
                own.step()
                alike.step()
            np.testing.assert_array_equal(own.positions, alike.positions)
        for z, copy in kept:
            np.testing.assert_array_equal(z, copy)

    def test_a_group_without_constraints_is_not_called(self):
        def project(z, fields):
            return z * z.max()  # which an array without elements does not have

        simulation = hung(lambda s, b, mesh: s.add(
            b, pliant.OwnConstraint(np.zeros((0, 2)), reduction=[[-1, 1]], project=project)))
        simulation.step()

    def test_several_rows_have_the_forces_of_their_rows(self):
        """Both ends of a spring by themselves, rows = n, against the same in C++."""
        def both(z, fields):
            middle = z.mean(axis=1, keepdims=True)
            half = (z[:, 1] - z[:, 0]) / 2
            half *= (fields / 2 / np.linalg.norm(half, axis=1)[:, None])
            return middle + np.stack([-half, half], axis=1)

        def add_own(simulation, body, mesh):
            edges = mesh.unique_edges
            lengths = np.linalg.norm(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]], axis=1)
            simulation.add(body, pliant.OwnConstraint(edges, stiffness=500, measure=2, fields=lengths, project=both))

        built_in = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500, reduction="identity")), precision="double")
        own = hung(add_own, precision="double")
        for _ in range(20):
            own.step()
            built_in.step()
        self.assertLess(np.abs(own.positions - built_in.positions).max(), 1e-12)

    def test_what_goes_wrong_in_it_is_told_and_nothing_has_changed(self):
        def fails(z, fields):
            raise KeyError("my own")

        for project, error, words in [(fails, KeyError, "my own"),
                                      (lambda z, fields: z[:1], pliant.Error, "shape of z"),
                                      (lambda z, fields: "no numbers", pliant.Error, "shape of z"),
                                      (lambda z, fields: None, pliant.Error, "shape of z"),
                                      (lambda z, fields: z * np.nan, pliant.Error, ".")]:
            simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring()))
            body = simulation.bodies[0]
            simulation.step()
            before = simulation.positions.copy()
            wrong = simulation.add(body, pliant.OwnConstraint(np.arange(400), project=project))
            with self.assertRaisesRegex(error, words):
                simulation.step()
            np.testing.assert_array_equal(simulation.positions, before)
            simulation.remove(wrong)
            simulation.step()

    def test_wrong_arguments_are_told_at_once(self):
        def same(z, fields):
            return z

        for words, arguments, options in (
                ("reduction has the shape", [[[0, 1]]], {"reduction": np.zeros((1, 2, 3))}),
                ("reduction has the shape", [[[0, 1]]], {"reduction": [-1, 1]}),
                ("stencils: found 'boundary'", ["boundary"], {}),
                ("stencils: found 5", [5], {}),
                ("stencils: found", [[0.5, 1.5]], {}),
                ("stencils: found", [[[0, 1], [2]]], {}),
                ("out of range", [[2**40]], {}),
                ("measure has the shape", [[0, 1]], {"measure": np.ones(3)}),
                ("measure: found 'a'; give numbers", [[0, 1]], {"measure": "a"}),
                ("fields has the shape", [[0, 1]], {"fields": np.ones(3)}),
                ("stiffness is one number", [[0, 1]], {"stiffness": np.ones(2)}),
                ("stiffness is one number", [[0, 1]], {"stiffness": None}),
                ("stiffness is one number", [[0, 1]], {"stiffness": "1e3"})):
            with self.subTest(words), self.assertRaisesRegex(pliant.Error, words):
                pliant.OwnConstraint(*arguments, project=same, **options)
        with self.assertRaisesRegex(pliant.Error, "define project"):
            pliant.OwnConstraint([0])

        class WithoutInit(pliant.OwnConstraint):
            def __init__(self):
                pass

        simulation = pliant.Simulation()
        body = simulation.add_body(pliant.grid(), total=1)
        with self.assertRaisesRegex(pliant.Error, "super"):
            simulation.add(body, WithoutInit())

    def test_a_mask_is_the_vertices_for_which_it_is_true(self):
        mask = np.zeros(121, bool)
        mask[[3, 7]] = True
        made = pliant.OwnConstraint(mask, project=lambda z, fields: z, fields=0.5)
        np.testing.assert_array_equal(made.stencils, [[3], [7]])
        np.testing.assert_array_equal(made.fields, [[0.5], [0.5]])

    def test_a_force_in_numpy_is_that_in_cpp(self):
        class Weight(pliant.OwnForce):
            def force(self, positions, velocities, masses, time, time_step):
                return masses[:, None] * np.array([0, 0, -9.81])

        simulations = []
        for force in (Weight(), pliant.Gravity()):
            simulation = pliant.Simulation()
            simulation.add_body(pliant.grid(), total=1)
            simulation.add(force)
            for _ in range(10):
                simulation.step()
            simulations.append(simulation)
        np.testing.assert_allclose(simulations[0].positions, simulations[1].positions, atol=1e-14)
        with self.assertRaisesRegex(pliant.Error, "force"):
            simulations[0].add(pliant.OwnForce(lambda *arguments: np.zeros((2, 3))))
            simulations[0].step()

    def test_a_step_cannot_be_taken_within_a_step(self):
        simulation = pliant.Simulation()
        simulation.add_body(pliant.grid(), total=1)

        def again(*arguments):
            simulation.step()

        simulation.add(pliant.OwnForce(again))
        with self.assertRaisesRegex(pliant.Error, "in the middle of a step"):
            simulation.step()


class Changes(unittest.TestCase):
    def test_targets_move_pins(self):
        simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring()))
        pins = simulation.groups[-1]
        targets = simulation.targets(pins)
        simulation.set_targets(pins, targets + [0, 0.1, 0])
        simulation.step()
        corners = [0, 19, 380, 399]
        np.testing.assert_allclose(simulation.positions[corners], targets + [0, 0.1, 0], atol=1e-15)
        for wrong in (targets[:2], targets * np.nan, 3):
            with self.assertRaisesRegex(pliant.Error, "targets"):
                simulation.set_targets(pins, wrong)
        simulation.release(pins, [0])
        self.assertEqual(len(simulation.targets(pins)), 3)

    def test_stiffness_is_set_and_told(self):
        simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500)))
        springs, pins = simulation.groups
        self.assertEqual(simulation.stiffness(pins), None)
        simulation.set_stiffness(springs, 2 * simulation.stiffness(springs))
        self.assertEqual(simulation.options(springs).stiffness, 1000)
        with self.assertRaises(pliant.Error):
            simulation.set_stiffness(springs, -1)
        simulation.remove(springs)
        with self.assertRaises(pliant.Error):
            simulation.stiffness(springs)

    def test_stiffness_is_multiplied_from_vertex_to_vertex(self):
        made = []
        for factors in (None, 3.0, []):
            simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500)))
            springs, pins = simulation.groups
            if factors is not None:
                simulation.set_stiffness_factors(springs, np.full(len(simulation.positions), 3.0))
            if factors == []:
                simulation.set_stiffness_factors(springs, [])
            for wrong in ([1, 2], [[1, 2]], "stiff", None):
                with self.assertRaises(pliant.Error):
                    simulation.set_stiffness_factors(springs, wrong)
            for _ in range(5):
                simulation.step()
            made.append(simulation.positions.copy())
        stiffer = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=1500)))
        for _ in range(5):
            stiffer.step()
        self.assertTrue(np.allclose(made[1], stiffer.positions, atol=1e-12))
        self.assertTrue(np.array_equal(made[0], made[2]))

    def test_energies_add_up_and_the_matrix_is_that_of_the_groups(self):
        simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500)), iterations=200)
        for _ in range(20):
            simulation.step()
        evaluation = simulation.evaluate()
        self.assertAlmostEqual(evaluation.elastic, simulation.elastic_energy(simulation.groups[0]), places=12)
        self.assertLess(evaluation.objective, simulation.objective_history()[0])
        potential = -np.sum(simulation.masses * simulation.positions[:, 2] * -9.81)
        self.assertAlmostEqual(simulation.potential_energy(), potential, places=9)
        matrix = simulation.stiffness_matrix()
        self.assertEqual(matrix.shape, (400, 400))
        self.assertLess(abs(matrix @ np.ones(400)).max(), 1e-9)  # springs resist no shift
        self.assertEqual(simulation.system_info()["pinned_vertices"], 4)

    def test_contact_is_told(self):
        simulation = pliant.Simulation(iterations=20)
        simulation.add_body(pliant.grid(plane="xy"), total=1, start=pliant.grid(plane="xy").vertices + [0, 0, 0.03])
        floor = simulation.add(pliant.PlaneCollider())
        simulation.add(pliant.Gravity())
        simulation.set_contact(friction=0.5, distance=0.01)
        for _ in range(120):
            report = simulation.step()
        contacts = simulation.contacts()
        self.assertEqual(report.contacts, len(contacts))
        self.assertAlmostEqual(contacts["force"][:, 2].sum(), 9.81, delta=0.05)
        self.assertAlmostEqual(simulation.wrench(floor)[0][2], -contacts["force"][:, 2].sum(), places=9)
        gaps, forces = simulation.touches()
        self.assertEqual((gaps.shape, forces.shape), ((121,), (121, 3)))
        self.assertEqual(simulation.contact()["friction"], 0.5)
        simulation.set_target(floor, [0, 0, 0.01])
        simulation.step()
        self.assertEqual(simulation.pose(floor)[0], (0, 0, 0.01))

    def test_attachments_and_bodies_in_contact_by_name(self):
        simulation = pliant.Simulation()
        a = simulation.add_body(pliant.grid(), total=1, name="a")
        b = simulation.add_body(pliant.grid(), total=1, start=pliant.grid().vertices + [0, 0.1, 0])
        tie = simulation.add(a, pliant.Attachment(on=[0, 10], to=b, to_on=[0, 10]), name="tie")
        self.assertEqual((simulation.find_group("tie"), simulation.name(a)), (tie, "a"))
        self.assertEqual(simulation.options(tie).to, b)
        simulation.set_contact(a, ignores=[b], friction=0.1)
        self.assertEqual(simulation.contact(a)["ignores"], [b])
        simulation.step()

    def test_a_state_is_saved_and_restored(self):
        def made():
            return hung(lambda s, b, mesh: s.add(b, own_springs(mesh, 500)), integrator="bdf2")

        simulation = made()
        for _ in range(5):
            simulation.step()
        saved = simulation.save_state()
        with tempfile.TemporaryDirectory() as folder:
            simulation.save_state(pathlib.Path(folder) / "half.state")
            self.assertEqual((pathlib.Path(folder) / "half.state").read_bytes(), saved)
            again = [made(), made()]
            seen = again[1].positions
            again[1].step()
            again[0].restore_state(saved)
            again[1].restore_state(pathlib.Path(folder) / "half.state")
        np.testing.assert_array_equal(seen, simulation.positions)  # the array follows
        for each in (simulation, *again):
            for _ in range(5):
                each.step()
        for each in again:
            np.testing.assert_array_equal(each.positions, simulation.positions)
            self.assertEqual(each.steps_taken, 10)
        with self.assertRaisesRegex(pliant.Error, "cut"):
            simulation.restore_state(saved[:100])
        with self.assertRaisesRegex(pliant.Error, "where the simulation has"):
            hung(lambda s, b, mesh: None, columns=4).restore_state(saved)

    def test_a_run_is_recorded(self):
        simulation = hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring(stiffness=500)))
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "run"
            with simulation.record(folder, every=2, name="sheet") as run:
                for _ in range(6):
                    report = run.step()
            self.assertEqual(report.iterations, 10)
            frames = np.load(folder / "frames.npy")
            self.assertEqual(frames.shape, (4, 400, 3))
            np.testing.assert_array_equal(frames[-1], simulation.positions)
            info = json.loads((folder / "run.json").read_text())
            self.assertEqual((info["outcome"], info["scene"]), ("ok", "sheet"))
            with self.assertRaises(ZeroDivisionError), simulation.record(folder) as run:
                run.step()
                1 / 0
            info = json.loads((folder / "run.json").read_text())
            self.assertEqual(info["outcome"], "failed")
            self.assertIn("ZeroDivisionError", info["error"])
            with self.assertRaisesRegex(pliant.Error, "this run has ended"):
                run.step()
            self.assertEqual(len(np.load(folder / "frames.npy")), 2)
            with self.assertRaises(KeyboardInterrupt), simulation.record(folder) as run:
                raise KeyboardInterrupt
            info = json.loads((folder / "run.json").read_text())
            self.assertEqual((info["outcome"], info.get("error", "")), ("interrupted", ""))
            for options in ({"format": "abc"}, {"every": 0}):
                with self.assertRaisesRegex(pliant.Error, "^record: " + next(iter(options))):
                    simulation.record(pathlib.Path(name) / "other", **options)
            self.assertFalse((pathlib.Path(name) / "other").exists())

    def test_a_folder_has_one_run_at_a_time(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "run"
            first, second = (hung(lambda s, b, mesh: s.add(b, pliant.EdgeSpring())) for _ in range(2))
            scene = pliant.open_scene("curtain", steps=2)
            with first.record(folder) as run:
                run.step()
                for begin in (lambda: second.record(folder), lambda: scene.run(out=folder)):
                    with self.assertRaisesRegex(pliant.Error, f"process {os.getpid()} .* writes here") as caught:
                        begin()
                    self.assertEqual(caught.exception.kind, "output")
                if program := os.environ.get("PLIANT"):
                    other = subprocess.run([program, "run", "curtain", "--steps", "2", "--out", folder],
                                           capture_output=True, text=True)
                    self.assertEqual(other.returncode, 4)  # output
                    self.assertIn(f"process {os.getpid()} ", other.stderr)
                run.step()
            self.assertEqual(len(np.load(folder / "frames.npy")), 3)
            scene.run(out=folder)
            self.assertFalse((folder / ".pliant-lock").exists())
            self.assertEqual(json.loads((folder / "run.json").read_text())["scene"], "curtain")

    def test_how_far_a_step_ends_from_its_end(self):
        shares = []
        for iterations in (2, 200):
            simulation = pliant.Simulation(iterations=iterations, acceleration="lbfgs")
            body = simulation.add_body(pliant.grid(columns=20, rows=20), material="cotton")
            simulation.add(body, pliant.Position(on="corners"))
            simulation.add(pliant.Gravity())
            for _ in range(10):
                simulation.step()
            before = simulation.positions.copy()
            error = simulation.step_error()
            np.testing.assert_array_equal(simulation.positions, before)
            self.assertEqual(error.body, body)
            shares.append(error.share)
        self.assertGreater(shares[0], 10 * shares[1])

    def test_materials(self):
        for name in pliant.material_names():
            simulation = pliant.Simulation()
            try:
                simulation.add_body(pliant.grid(), material=name)
            except pliant.Error:  # a solid
                simulation.add_body(pliant.bar(), material={"name": name, "least_stretch": 0})
            self.assertTrue(simulation.groups)
        with self.assertRaisesRegex(pliant.Error, "did you mean 'cotton'"):
            simulation.add_body(pliant.grid(), material="coton")
        with self.assertRaisesRegex(pliant.Error, "did you mean 'bending'"):
            simulation.add_body(pliant.grid(), material={"name": "cotton", "bendng": 1})
        self.assertEqual(len(simulation.bodies), 1)


if __name__ == "__main__":
    unittest.main()
