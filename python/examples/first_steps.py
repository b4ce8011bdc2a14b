"""A curtain of a square meter, pinned at two corners, falls for a second."""
import pliant

# [first steps]
simulation = pliant.Simulation()
cloth = simulation.add_body(pliant.grid(columns=32, rows=32), area_density=0.2)
simulation.add(cloth, pliant.EdgeSpring(stiffness=1e3))
simulation.add(cloth, pliant.Bending(stiffness=1e-4))
simulation.add(cloth, pliant.Position(on=[992, 1023]))
simulation.add(pliant.Gravity())
simulation.add(pliant.Wind(velocity=(0, 3, 0), gust_strength=0.5))

for _ in range(60):
    simulation.step()
pliant.write_mesh("curtain.obj", simulation.mesh(cloth), simulation.positions)
# [first steps]
print(f"curtain.obj: the curtain after {simulation.time:.1f} s")
