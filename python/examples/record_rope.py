"""A rope that is recorded, saved, and gone on with in another simulation."""
import numpy as np
import pliant


# [record]
def made() -> pliant.Simulation:
    simulation = pliant.Simulation(integrator="bdf2", iterations=30)
    rope = simulation.add_body(pliant.chain(links=30, direction=(1, 0, 0)), line_density=0.1)
    simulation.add(rope, pliant.EdgeSpring(stiffness=1e4))
    simulation.add(rope, pliant.Position(on=[0]))
    simulation.add(pliant.Gravity())
    return simulation


first = made()
with first.record("rope") as run:  # frames.npy, measurements.csv, mesh.obj, run.json
    for _ in range(60):
        run.step()
saved = first.save_state()  # bytes, or a file: first.save_state("rope.state")

again = made()
again.restore_state(saved)  # the steps that follow have the same bits
# [record]

for _ in range(30):
    first.step()
    again.step()
assert np.array_equal(first.positions, again.positions)
frames = np.load("rope/frames.npy")
print(f"rope: {len(frames)} frames; after 60 steps its end is {frames[-1, -1, 2] - frames[0, -1, 2]:.3f} m lower")
