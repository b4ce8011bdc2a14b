"""Springs in NumPy that move as those of the library."""
import numpy as np
import numpy.typing as npt
import pliant


# [own springs]
def keep_length(z: npt.NDArray[np.float64], fields: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    scaled: npt.NDArray[np.float64] = z * (fields / np.linalg.norm(z, axis=2))[:, :, None]
    return scaled


mesh = pliant.grid(columns=20, rows=20)
edges = mesh.unique_edges
lengths = np.linalg.norm(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]], axis=1)
springs = pliant.OwnConstraint(edges, reduction=[[-1, 1]], fields=lengths, stiffness=1e3, project=keep_length)
# [own springs]


def hung(springs_of: pliant.OwnConstraint | pliant.EdgeSpring) -> pliant.Simulation:
    simulation = pliant.Simulation()
    cloth = simulation.add_body(mesh, area_density=0.2)
    if isinstance(springs_of, pliant.OwnConstraint):
        simulation.add(cloth, springs_of)
    else:
        simulation.add(cloth, springs_of)
    simulation.add(cloth, pliant.Position(on="corners"))
    simulation.add(pliant.Gravity())
    for _ in range(30):
        simulation.step()
    return simulation


own, built_in = hung(springs), hung(pliant.EdgeSpring(stiffness=1e3))
difference = np.abs(own.positions - built_in.positions).max()
print(f"springs in NumPy and in C++ differ by {difference:.1e} m after 30 steps")
assert difference < 1e-6
