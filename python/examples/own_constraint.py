"""A constraint type of one's own, in NumPy: a vertex stays on or above a sphere."""
# [own constraint]
import numpy as np
import numpy.typing as npt
import pliant

CENTER, RADIUS = np.array([0.5, 0.5, -0.3]), 0.3


class OutsideSphere(pliant.OwnConstraint):
    def project(self, z: npt.NDArray[np.float64], fields: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        away = z - CENTER  # (count, rows, 3), for many constraints at once
        distance = np.linalg.norm(away, axis=2, keepdims=True)
        nearest: npt.NDArray[np.float64] = CENTER + away * np.maximum(1, RADIUS / distance)
        return nearest


simulation = pliant.Simulation(iterations=20)
cloth = simulation.add_body(pliant.grid(columns=30, rows=30, plane="xy"), area_density=0.2)
simulation.add(cloth, pliant.EdgeSpring(stiffness=1e3))
simulation.add(cloth, pliant.Position(on="corners"))
simulation.add(cloth, OutsideSphere(np.arange(900), stiffness=1e4))  # N/m
simulation.add(pliant.Gravity())
# [own constraint]

for _ in range(90):
    simulation.step()
nearest = np.linalg.norm(simulation.positions - CENTER, axis=1).min()
print(f"a cloth on a sphere of 0.3 m; its nearest vertex is {nearest:.3f} m from the center")
assert 0.29 < nearest < 0.31
