"""A cotton cloth falls onto a ball and touches itself."""
import numpy as np
import pliant

# [drape]
simulation = pliant.Simulation(integrator="bdf2", iterations=20, damping=1)
sheet = pliant.grid(columns=30, rows=30, plane="xy")
cloth = simulation.add_body(sheet, material="cotton", start=sheet.vertices + [-0.5, -0.5, 0.32])
ball = simulation.add(pliant.SphereCollider(radius=0.3, friction=0.4))
simulation.add(pliant.Gravity())
simulation.set_contact(distance=0.01, friction=0.3)

for _ in range(120):
    report = simulation.step()
contacts = simulation.contacts()
carried = contacts["force"][:, 2].sum()  # N
# [drape]
weight = 9.81 * simulation.masses.sum()
print(f"{len(contacts)} vertices touch the ball, which carries {carried:.3f} N of {weight:.3f} N")
assert 0.8 * weight < carried < 1.2 * weight
assert np.linalg.norm(simulation.positions, axis=1).min() > 0.3
