"""The scene of Blender as a scene file, with the meshes and motions that it names.

Everything is written in meters, in the coordinates of the world. docs/scenes.md has the keys.
"""

import contextlib
import itertools
import os

import bpy
import numpy as np

from . import baked_files, participants
from .exported_object import ExportedObject
from .weather import Weather


class ExportError(Exception):
    """What cannot be simulated, and how it could be; one line."""


def unit_of(scene):
    """Meters in a unit of Blender."""
    settings = scene.unit_settings
    return settings.scale_length if settings.system != "NONE" else 1.0


def _rate_of(scene):
    """Frames in a second."""
    return scene.render.fps / scene.render.fps_base


def _usual_distance(exported_objects):
    """A quarter of the short edges of what is simulated; a floor of two triangles has no say."""
    shortest = min(each.short_edge for each in exported_objects if each.is_simulated)
    return shortest / 4


def _stems(objects):
    """A name for the files of each object; names that differ by what files cannot have are numbered."""
    taken = {"scene", "bake", "transforms"}
    stems = []
    for obj in objects:
        clean = bpy.path.clean_name(obj.name)
        numbered = itertools.chain([clean], (f"{clean}_{i}" for i in itertools.count(2)))
        stem = next(each for each in numbered if each.lower() not in taken)
        taken.add(stem.lower())
        stems.append(stem)
    return stems


@contextlib.contextmanager
def _frame_kept(scene):
    frame, subframe = scene.frame_current, scene.frame_subframe
    try:
        yield
    finally:
        scene.frame_set(frame, subframe=subframe)


class _Reading:
    """What takes part, as it is from frame to frame; leaves the scene as it was. A context."""

    def __init__(self, context, first_frame):
        self._stack = contextlib.ExitStack()
        self.scene, self.view_layer = context.scene, context.view_layer
        self._first_frame = first_frame

    def __enter__(self):
        with self._stack:
            self._stack.enter_context(_frame_kept(self.scene))
            self.scene.frame_set(self._first_frame)  # settings may have keyframes too
            enabled = participants.enabled_objects(self.view_layer)
            objects = [obj for obj in enabled if participants.takes_part(obj, self.view_layer)]
            self._stack.enter_context(participants.all_shown(self.view_layer, enabled))
            self._stack.enter_context(participants.without_bakes(objects))
            self.unit = unit_of(self.scene)
            self.weather = Weather(self.scene, enabled, self.unit)
            self.exported_objects = [ExportedObject(*each, self.unit) for each in zip(objects, _stems(objects))]
            self._stack = self._stack.pop_all()
        return self

    def __exit__(self, *error):
        return self._stack.__exit__(*error)

    def go_to(self, frame):
        """Takes the weather there; returns what objects are evaluated by."""
        self.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        self.weather.take_frame(self.scene, graph)
        return graph


def export(context, folder):
    """Writes everything into a new folder. A generator that yields the share that is done, so that the window goes on;
    whatever it hides or moves is as before at its end. Raises ExportError."""
    scene = context.scene
    if scene.frame_end <= scene.frame_start:
        raise ExportError("The end frame of the scene must be after its start frame")
    count = scene.frame_end - scene.frame_start + 1
    with _Reading(context, scene.frame_start) as reading:
        exported_objects = reading.exported_objects
        if not any(each.is_simulated for each in exported_objects):
            raise ExportError("Nothing is simulated; set the type of an object to Cloth or Soft Body")
        os.makedirs(folder)
        bake = _new_bake(scene, exported_objects, reading.unit)
        baked_files.write_json(os.path.join(folder, baked_files.BAKE), bake)  # Free removes what this names
        for frame in range(count):
            graph = reading.go_to(scene.frame_start + frame)
            for each in exported_objects:
                with _errors_of(each):
                    if frame == 0:
                        each.begin(graph, folder, count)
                    each.take_frame(graph, frame)
            yield (frame + 1) / count
    for each in exported_objects:
        each.finish()
    simulated = [each for each in exported_objects if each.is_simulated]
    np.save(os.path.join(folder, baked_files.TRANSFORMS), np.array([each.matrices for each in simulated]))
    bake["objects"] = [
        {"name": each.name, "vertices": each.vertex_count, "cache": each.cache_file} for each in simulated
    ]
    baked_files.write_json(os.path.join(folder, baked_files.BAKE), bake)
    baked_files.write_json(os.path.join(folder, baked_files.SCENE), _scene_file(scene, reading))


def extend(context, folder, bake):
    """Reads the frames behind those of a bake, in which nothing but what is simulated may move. A generator that yields
    the share that is done. Raises ExportError."""
    scene = context.scene
    first = bake["last_frame"]
    count = scene.frame_end - first + 1
    with _Reading(context, bake["first_frame"]) as reading:
        exported_objects = reading.exported_objects
        graph = bpy.context.evaluated_depsgraph_get()
        for each in exported_objects:
            with _errors_of(each):
                each.begin(graph, None, count)
        for frame in range(count):
            graph = reading.go_to(first + frame)
            for each in exported_objects:
                with _errors_of(each):
                    each.take_frame(graph, frame)
            if any(each.is_moving for each in exported_objects) or not reading.weather.is_steady():
                raise ExportError(
                    f"Pins, colliders, wind or gravity are animated after frame {first}, the last one that was read; "
                    "use Bake to simulate past it"
                )
            yield (frame + 1) / count
    by_name = {each.name: each.matrices[1:] for each in exported_objects}
    missing = [entry["name"] for entry in bake["objects"] if entry["name"] not in by_name]
    if missing:
        raise ExportError(f'"{missing[0]}" was baked and is gone or renamed; use Bake to begin anew')
    matrices = [by_name[entry["name"]] for entry in bake["objects"]]
    baked_files.append_transforms(folder, bake, matrices, scene.frame_end)


@contextlib.contextmanager
def _errors_of(exported):
    """ValueErrors of an object with its name."""
    try:
        yield
    except ValueError as error:
        raise ExportError(f'"{exported.name}" {error}') from None


def _new_bake(scene, exported_objects, unit):
    return {
        "written_by": "pliant_blender",
        "file": baked_files.file_stem(),
        "scene": scene.name,
        "first_frame": scene.frame_start,
        "last_frame": scene.frame_end,  # that was read
        "planned": scene.frame_end,  # up to which it is simulated
        "steps": scene.pliant.steps,
        "unit": unit,
        "objects": [],
        "files": [name for each in exported_objects for name in (each.mesh_file, each.motion_file, each.cache_file)],
    }


def _scene_file(scene, reading):
    settings = scene.pliant
    rate = _rate_of(scene)
    events = reading.weather.events(settings.steps)
    for each in reading.exported_objects:
        if each.is_simulated and each.is_moving:
            events += each.pin_events(rate)
    distance = settings.distance * reading.unit or _usual_distance(reading.exported_objects)
    return {
        "pliant": 1,
        "name": scene.name,
        "description": "Written by the add-on for Blender",
        "settings": {"time_step": 1 / (rate * settings.steps), "iterations": settings.iterations or "automatic"},
        "steps": (scene.frame_end - scene.frame_start) * settings.steps,
        "gravity": reading.weather.gravity(),
        "bodies": [each.body(rate) for each in reading.exported_objects],
        "forces": reading.weather.forces(),
        "contact": {"distance": distance},
        "events": events,
        "output": {"format": "npy", "every": settings.steps},
    }
