"""Gravity and winds, frame by frame."""

import itertools

import numpy as np


class Weather:
    """What gravity and the winds are at each frame that was read."""

    def __init__(self, scene, objects, unit):
        self._unit = unit
        self._winds = [obj for obj in objects if obj.field is not None and obj.field.type == "WIND"]
        self._gravities = []  # frame by frame
        self._velocities = {obj.name_full: [] for obj in self._winds}
        self._gusts = {obj.name_full: min(1.0, obj.field.noise) for obj in self._winds}

    def take_frame(self, scene, graph):
        """Notes what they are now."""
        gravity = np.array(scene.gravity) * self._unit if scene.use_gravity else np.zeros(3)
        self._gravities.append(gravity.tolist())
        for obj in self._winds:
            evaluated = obj.evaluated_get(graph)
            direction = evaluated.matrix_world.to_3x3().col[2].normalized()
            self._velocities[obj.name_full].append([evaluated.field.strength * each for each in direction])

    def is_steady(self):
        """Whether nothing has changed from frame to frame."""
        return all(each == rows[0] for rows in (self._gravities, *self._velocities.values()) for each in rows)

    def gravity(self):
        """At the first frame [m/s^2]."""
        return self._gravities[0]

    def forces(self):
        """The winds of a scene file, as they are at the first frame."""
        return [
            {"type": "wind", "name": name, "velocity": velocities[0], "gust_strength": self._gusts[name]}
            for name, velocities in self._velocities.items()
        ]

    def events(self, steps):
        """What changes from one frame to the next, with so many steps in each."""
        found = []
        for frame, (before, now) in enumerate(itertools.pairwise(self._gravities), 1):
            if now != before:
                found.append({"step": frame * steps, "gravity": now})
        for name, velocities in self._velocities.items():
            for frame, (before, now) in enumerate(itertools.pairwise(velocities), 1):
                if now != before:
                    found.append({"step": frame * steps, "change": name, "velocity": now})
        return found
