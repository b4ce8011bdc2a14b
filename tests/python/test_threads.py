"""Python goes on while a step is taken, and Ctrl-C ends it."""
import _thread
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import numpy as np
import pliant


def slow(iterations=1_000_000_000):
    """A step that would take minutes."""
    simulation = pliant.Simulation(iterations=iterations)
    body = simulation.add_body(pliant.grid(columns=40, rows=40), total=1)
    simulation.add(body, pliant.EdgeSpring())
    simulation.add(body, pliant.Position(on="corners"))
    simulation.add(pliant.Gravity())
    return simulation


class Threads(unittest.TestCase):
    def interrupt_soon(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        return timer

    def test_ctrl_c_ends_a_step_and_the_state_is_as_before(self):
        simulation = slow()
        simulation.set_settings(iterations=5)
        simulation.step()
        before = simulation.positions.copy()
        simulation.set_settings(iterations=1_000_000_000)
        timer = self.interrupt_soon()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step()
        timer.join()
        np.testing.assert_array_equal(simulation.positions, before)
        self.assertEqual(simulation.steps_taken, 1)
        simulation.set_settings(iterations=5)
        simulation.step()

    def test_ctrl_c_ends_a_run_and_its_files_are_whole(self):
        scene = pliant.open_scene("curtain_wind", steps=1_000_000)
        timer = self.interrupt_soon()
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        out = pathlib.Path(temporary.name) / "interrupted"
        with self.assertRaises(KeyboardInterrupt):
            scene.run(out=out)
        timer.join()
        frames = np.load(out / "frames.npy")
        self.assertEqual(len(frames), scene.simulation.steps_taken + 1)
        np.testing.assert_array_equal(frames[-1], scene.simulation.positions)
        self.assertIn('"interrupted"', (out / "run.json").read_text())
        again = pliant.load_checkpoint(out / "checkpoint.pliant")
        np.testing.assert_array_equal(again.simulation.positions, scene.simulation.positions)

    def test_another_thread_goes_on_while_a_step_is_taken(self):
        simulation = slow()
        counts = []

        def count():
            while simulation.steps_taken == 0 and len(counts) < 1000:
                counts.append(1)
                time.sleep(0)
            _thread.interrupt_main()

        thread = threading.Thread(target=count)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step()
        thread.join()
        self.assertEqual(len(counts), 1000)  # all of them before the step was over

    def test_nobody_changes_a_simulation_in_a_step(self):
        simulation = slow()
        caught = []

        def change():
            time.sleep(0.1)
            self.assertEqual(simulation.positions.shape, (1600, 3))
            for call in (simulation.step, lambda: simulation.add(pliant.Gravity()),
                         lambda: simulation.add_body(pliant.grid(), total=1)):
                try:
                    call()
                except pliant.Error as error:
                    caught.append(str(error))
            _thread.interrupt_main()

        thread = threading.Thread(target=change)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step()
        thread.join()
        self.assertEqual(len(caught), 3)
        self.assertIn("in the middle of a step", caught[0])

    def test_simulations_of_several_threads(self):
        ends = []

        def run():
            simulation = slow(10)
            for _ in range(10):
                simulation.step()
            ends.append(simulation.positions.copy())

        threads = [threading.Thread(target=run) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(ends[0], ends[1])
        np.testing.assert_array_equal(ends[0], ends[2])


if __name__ == "__main__":
    unittest.main()
