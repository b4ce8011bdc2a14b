"""A built-in scene, step by step and to files."""
import numpy as np
import pliant

# [scene]
with pliant.open_scene("curtain_wind", iterations=20, set={"forces[wind].velocity": [0, 2, 0]}) as scene:
    heights = []
    for _ in range(30):
        scene.step()  # its events act
        heights.append(scene.simulation.positions[:, 2].min())
    saved = scene.save()  # bytes, or a file: scene.save("half.pliant")

again = pliant.load_checkpoint(saved)
again.run(steps=30)

with pliant.open_scene("curtain_wind") as scene:
    scene.run(out="curtain", steps=60)  # frames, measurements.csv, run.json, a checkpoint
frames = np.load("curtain/frames.npy")  # 61 x m x 3
# [scene]
print(f"{again.simulation.time:.2f} s; {frames.shape} recorded")
assert again.simulation.steps_taken == 60 and len(frames) == 61
