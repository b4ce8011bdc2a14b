"""Arrays that look at the state: of its memory, read-only, and never dangling."""
import gc
import unittest

import numpy as np
import pliant


def falling_cloth():
    simulation = pliant.Simulation()
    body = simulation.add_body(pliant.grid(), area_density=0.2)
    simulation.add(body, pliant.EdgeSpring())
    simulation.add(pliant.Gravity())
    return simulation, body


class Views(unittest.TestCase):
    def test_it_is_the_memory_of_the_state(self):
        simulation, _ = falling_cloth()
        x, v = simulation.positions, simulation.velocities
        self.assertEqual((x.shape, x.dtype, x.flags.c_contiguous), ((121, 3), np.float64, True))
        before = x.copy()
        for _ in range(3):
            simulation.step()
            self.assertEqual(x.__array_interface__["data"][0], simulation.positions.__array_interface__["data"][0])
        self.assertLess(x[:, 2].max(), before[:, 2].max())
        self.assertLess(v[:, 2].max(), 0)

    def test_it_cannot_be_written_to(self):
        simulation, _ = falling_cloth()
        for view in (simulation.positions, simulation.velocities, simulation.positions[3:]):
            with self.assertRaises(ValueError):
                view[0] = 1
            with self.assertRaises(ValueError):
                view.flags.writeable = True

    def test_it_keeps_its_numbers_when_the_state_grows(self):
        simulation, _ = falling_cloth()
        simulation.step()
        views = [simulation.positions, simulation.positions[5:9, 1], simulation.velocities]
        before = [view.copy() for view in views]
        for _ in range(20):
            simulation.add_body(pliant.bar(), density=100)
            simulation.step()
            garbage = [np.full((121, 3), np.nan) for _ in range(50)]  # whatever was freed would be these
            for view, old in zip(views, before):
                np.testing.assert_array_equal(view, old)
            del garbage
        self.assertEqual(len(simulation.positions), 121 + 20 * len(pliant.bar().vertices))

    def test_a_body_that_is_refused_changes_nothing(self):
        simulation, _ = falling_cloth()
        simulation.step()
        x = simulation.positions
        before = x.copy()
        with self.assertRaises(pliant.Error):
            simulation.add_body(pliant.grid(), area_density=-1)
        np.testing.assert_array_equal(simulation.positions, before)
        np.testing.assert_array_equal(x, before)
        simulation.step()
        self.assertEqual(len(simulation.positions), 121)

    def test_growing_with_a_view_has_the_bits_of_growing_without(self):
        states = []
        for looks in (False, True):
            simulation, _ = falling_cloth()
            simulation.step()
            views = [simulation.positions, simulation.velocities] if looks else []
            simulation.add_body(pliant.grid(), total=1)
            for _ in range(5):
                simulation.step()
            states.append(simulation.positions.copy())
            del views
        np.testing.assert_array_equal(states[0], states[1])

    def test_it_outlives_its_simulation(self):
        simulation, _ = falling_cloth()
        simulation.step()
        x = simulation.positions
        before = x.copy()
        del simulation
        gc.collect()
        garbage = [np.full((121, 3), np.nan) for _ in range(50)]
        np.testing.assert_array_equal(x, before)
        del garbage

    def test_it_outlives_its_scene_and_follows_its_steps(self):
        scene = pliant.open_scene("curtain_wind", steps=3)
        x = scene.simulation.positions
        before = x.copy()
        scene.run()
        self.assertTrue((x != before).any())
        after = x.copy()
        del scene
        gc.collect()
        np.testing.assert_array_equal(x, after)

    def test_it_follows_a_state_that_is_set(self):
        simulation, _ = falling_cloth()
        x = simulation.positions
        simulation.set_state(x + [0, 0, 1], np.zeros_like(x))
        self.assertAlmostEqual(x[:, 2].min(), 1)
        simulation.add(pliant.Gravity(acceleration=(0, 0, -1e308)))
        before = x.copy()
        with self.assertRaises(pliant.Error):
            simulation.step()
        np.testing.assert_array_equal(x, before)


if __name__ == "__main__":
    unittest.main()
