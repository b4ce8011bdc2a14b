"""Springs projected in NumPy against those of the library: 100 x 100 vertices, 29,601 springs, 10 iterations a step.

    PYTHONPATH=build/release/python python3 python/benchmarks/own_springs.py

bench_own_springs has the same springs as a type of one's own in C++. Times of one thread are processor times.
"""
import statistics
import time

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
        clock = time.thread_time if threads == 1 else time.perf_counter
        simulations = {"C++": made(False, threads), "NumPy": made(True, threads)}
        times = {name: [] for name in simulations}
        for _ in range(60):  # in turns, so that both meet the same disturbances
            for name, simulation in simulations.items():
                begin = clock()
                simulation.step()
                times[name].append(1e3 * (clock() - begin))
        library, own = (statistics.median(each) for each in times.values())
        print(f"{threads} thread(s): springs of the library {library:.2f} ms a step, in NumPy {own:.2f} ms, "
              f"{own / library:.2f} times as long")


if __name__ == "__main__":
    main()
