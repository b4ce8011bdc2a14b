"""Springs projected in NumPy against those of the library: 100 x 100 vertices, 29,601 springs, 10 iterations a step.

    PYTHONPATH=build/release/python python3 python/benchmarks/own_springs.py
"""
import statistics

import numpy as np
import pliant


class Springs(pliant.OwnConstraint):
    def project(self, z, fields):
        return z * (fields / np.linalg.norm(z, axis=2))[:, :, None]


def made(is_own, threads):
    simulation = pliant.Simulation(threads=threads)
    mesh = pliant.grid(columns=100, rows=100)
    cloth = simulation.add_body(mesh, area_density=0.2)
    if is_own:
        edges = mesh.unique_edges
        lengths = np.linalg.norm(mesh.vertices[edges[:, 1]] - mesh.vertices[edges[:, 0]], axis=1)
        simulation.add(cloth, Springs(edges, reduction=[[-1, 1]], stiffness=1e3, fields=lengths))
    else:
        simulation.add(cloth, pliant.EdgeSpring(stiffness=1e3))
    simulation.add(cloth, pliant.Position(on=[9900, 9999]))
    simulation.add(pliant.Gravity())
    for _ in range(20):
        simulation.step()
    return simulation


def main():
    for threads in (1, 2):
        simulations = {"C++": made(False, threads), "NumPy": made(True, threads)}
        total = {name: [] for name in simulations}
        local = {name: [] for name in simulations}
        for _ in range(60):  # in turns, so that both meet the same disturbances
            for name, simulation in simulations.items():
                report = simulation.step()
                total[name].append(1e3 * report.seconds_total)
                local[name].append(1e3 * report.seconds_local)
        for name in simulations:
            print(f"{threads} thread(s), {name:5}: {statistics.median(total[name]):7.2f} ms a step, "
                  f"of which the local step {statistics.median(local[name]):7.2f} ms")


if __name__ == "__main__":
    main()
