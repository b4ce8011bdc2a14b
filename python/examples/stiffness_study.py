"""How far a sheet hangs down, and what energy it holds, over the stiffness of its springs."""
import numpy as np
import pliant

# [study]
sag, energy = [], []
for stiffness in np.geomspace(10, 1000, 5):
    simulation = pliant.Simulation(damping=2, iterations=30, acceleration="lbfgs")
    sheet = simulation.add_body(pliant.grid(columns=15, rows=15, plane="xy"), area_density=0.2)
    springs = simulation.add(sheet, pliant.EdgeSpring(stiffness=stiffness))
    simulation.add(sheet, pliant.Position(on="boundary"))
    simulation.add(pliant.Gravity())
    for _ in range(180):
        simulation.step()
    sag.append(-simulation.positions[:, 2].min())
    energy.append(simulation.evaluate().elastic)
# [study]
for row in zip(np.geomspace(10, 1000, 5), sag, energy):
    print("%8.1f N/m   sag %.4f m   energy %.3e J" % row)
assert np.all(np.diff(sag) < 0)
