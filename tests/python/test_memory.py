"""Simulations made and dropped leave nothing behind: a thousand, or $PLIANT_CREATIONS of them."""
import gc
import os
import unittest

import numpy as np
import pliant


def resident():
    """[kB]"""
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


def make_and_drop(i):
    simulation = pliant.Simulation(threads=1)
    body = simulation.add_body(pliant.grid(columns=40, rows=40), total=1)
    simulation.add(body, pliant.EdgeSpring(stiffness=np.full(4641, 1e3)))
    simulation.add(body, pliant.OwnConstraint(np.arange(1600), project=lambda z, fields: z))
    simulation.add(pliant.OwnForce(lambda x, v, m, t, h: np.zeros_like(x)))
    before = simulation.positions
    simulation.add_body(pliant.grid(), total=1)
    view = simulation.positions
    if i % 10 == 0:
        simulation.step()
        simulation.contacts(), simulation.touches(), simulation.evaluate()
    try:
        simulation.add(body, pliant.Position(on=[99999]))
    except pliant.Error:
        pass
    del simulation
    return float(before[0, 0] + view[0, 0])


class Memory(unittest.TestCase):
    def test_nothing_is_left(self):
        for i in range(100):
            make_and_drop(i)
        gc.collect()
        begin = resident()
        for i in range(int(os.environ.get("PLIANT_CREATIONS", 1000))):
            make_and_drop(i)
        gc.collect()
        # The states of a thousand alone would be 80 MB.
        self.assertLess(resident() - begin, 10_000)

    def test_nothing_is_left_of_scenes_and_meshes(self):
        def both():
            pliant.open_scene("curtain_wind").step()
            pliant.load_checkpoint(pliant.open_scene("curtain_wind").save())
            pliant.grid(columns=100, rows=100).vertices.sum()

        for _ in range(20):
            both()
        begin = resident()
        for _ in range(100):
            both()
        self.assertLess(resident() - begin, 10_000)


if __name__ == "__main__":
    unittest.main()
