"""The files of a bake, and the modifier that plays them.

A scene has a folder, and each bake a folder in that, `bake-1`, `bake-2` and so on, so that a bake that cannot be made
leaves the one before as it was. The newest one with frames counts.
"""

import json
import os
import re
import struct
from typing import NamedTuple

import bpy
import numpy as np

MODIFIER = "Pliant"
SCENE = "scene.json"
BAKE = "bake.json"
TRANSFORMS = "transforms.npy"
RUN = "run"  # the folder that the program writes

RUN_FILES = ("frames.npy", "mesh.obj", "run.json", "measurements.csv", "checkpoint.pliant")
NUMBERED = re.compile(r"bake-(\d+)")

# What makes a surface finer or thicker acts upon what is baked; everything else before it is part of what is baked.
REFINING = {"SUBSURF", "MULTIRES", "SOLIDIFY"}


# ---- folders


def is_kept(scene):
    """Whether a new bake is still there when Blender has ended."""
    return bpy.data.is_saved or bool(scene.pliant.folder and not scene.pliant.folder.startswith("//"))


def file_stem():
    """The name of the .blend file without its ending."""
    return os.path.splitext(os.path.basename(bpy.data.filepath))[0] if bpy.data.is_saved else "unsaved"


def _numbers(folder):
    """Of the bakes in a folder, from the newest to the oldest."""
    try:
        names = os.listdir(folder)
    except OSError:
        return []
    return sorted((int(match[1]) for match in map(NUMBERED.fullmatch, names) if match), reverse=True)


def bakes_in(folder):
    """The bakes in a folder, from the newest to the oldest: the folder of each, and what export.py has left."""
    places = (os.path.join(folder, f"bake-{number}") for number in _numbers(folder))
    return [(place, bake) for place in places if (bake := read_bake(place)) is not None]


def is_own(scene, folder):
    """Whether a folder has bakes of this scene of this file, also under a name that the scene had before."""
    bakes = bakes_in(folder)
    if not bakes or bakes[0][1]["file"] != file_stem():
        return False
    owner = bakes[0][1]["scene"]
    return owner == scene.name or owner not in bpy.data.scenes


def _usual_folder(scene):
    """Below the folder that was chosen, or that of the file: NAME_pliant/SCENE, numbered where another scene has it."""
    base = scene.pliant.folder or "//"
    if not is_kept(scene):
        base = bpy.app.tempdir
    usual = os.path.join(bpy.path.abspath(base), f"{file_stem()}_pliant", bpy.path.clean_name(scene.name))
    folder, number = usual, 2
    while bakes_in(folder) and not is_own(scene, folder):
        folder, number = f"{usual}_{number}", number + 1
    return folder


def scene_folder(scene):
    """Where the bakes of a scene are; where there are none, where they will be."""
    known = bpy.path.abspath(scene.pliant.baked_folder) if scene.pliant.baked_folder else ""
    return known if known and is_own(scene, known) else _usual_folder(scene)


def new_folder(scene):
    """For the next bake of a scene."""
    folder = _usual_folder(scene)
    return os.path.join(folder, f"bake-{max(_numbers(folder), default=0) + 1}")


def bake_folder(scene):
    """The newest bake that has frames, or None."""
    folder = scene_folder(scene)
    if not is_own(scene, folder):
        return None
    return next((place for place, _ in bakes_in(folder) if recorded_frames(place) is not None), None)


class Range(NamedTuple):
    """Of frames of Blender."""

    first: int
    last: int  # that is baked
    planned: int  # that was asked for


def baked_range(scene):
    """What is baked of a scene, or None."""
    folder = bake_folder(scene)
    if folder is None:
        return None
    bake, frames = read_bake(folder), recorded_frames(folder)
    return Range(bake["first_frame"], bake["first_frame"] + len(frames) - 1, bake["planned"])


# ---- the modifier


def find_modifier(obj):
    """The modifier that plays an object's bake, or None; also one whose name was changed."""
    known = obj.modifiers.get(obj.pliant.modifier) if obj.pliant.modifier else None
    if known is not None and known.type == "MESH_CACHE":
        return known
    return next((each for each in obj.modifiers if each.type == "MESH_CACHE" and plays_bake(each)), None)


def plays_bake(modifier):
    """Whether the file that it plays is in a folder of a bake."""
    return NUMBERED.fullmatch(os.path.basename(os.path.dirname(modifier.filepath))) is not None


def prepare_modifier(obj, is_simulated):
    """Puts the modifier where the bake will act, silent until there is one; or takes it away where it plays none."""
    found = find_modifier(obj)
    if found is None and is_simulated:
        found = obj.modifiers.new(MODIFIER, "MESH_CACHE")
        found.cache_format = "PC2"
        found.show_viewport = found.show_render = False
        found.show_expanded = False
        index = len(obj.modifiers) - 1
        while index > 0 and obj.modifiers[index - 1].type in REFINING:
            index -= 1
        obj.pliant.modifier = found.name
        with bpy.context.temp_override(object=obj):
            bpy.ops.object.modifier_move_to_index(modifier=found.name, index=index)
    elif found is not None and not is_simulated and not found.filepath:
        obj.modifiers.remove(found)


def play(obj, cache, first_frame):
    """Lets the object's modifier play a cache."""
    prepare_modifier(obj, True)
    modifier = find_modifier(obj)
    modifier.filepath = bpy.path.relpath(cache) if bpy.data.is_saved else cache
    modifier.frame_start = first_frame
    modifier.show_viewport = modifier.show_render = True


def silence(folder):
    """Modifiers that play files of a folder stay in their stacks and play nothing."""
    for obj in bpy.data.objects:
        for modifier in obj.modifiers:
            if modifier.type != "MESH_CACHE" or not modifier.filepath:
                continue
            path = os.path.normpath(bpy.path.abspath(modifier.filepath, library=obj.library))
            if path.startswith(os.path.normpath(folder) + os.sep):
                modifier.show_viewport = modifier.show_render = False
                modifier.filepath = ""


# ---- files


def write_json(path, value):
    """Whole or not at all."""
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1, ensure_ascii=False)
    os.replace(path + ".new", path)


def read_bake(folder):
    """What export.py has left of a bake, or None."""
    try:
        with open(os.path.join(folder, BAKE), encoding="utf-8") as file:
            bake = json.load(file)
    except (OSError, ValueError):
        return None
    return bake if isinstance(bake, dict) and bake.get("written_by") == "pliant_blender" else None


def append_transforms(folder, bake, matrices, last_frame):
    """Makes room for more frames; matrices of each object, frame by frame."""
    path = os.path.join(folder, TRANSFORMS)
    extended = np.concatenate([np.load(path), np.asarray(matrices)], axis=1)
    np.save(path, extended)
    bake["last_frame"] = last_frame
    write_json(os.path.join(folder, BAKE), bake)


def recorded_frames(folder):
    """The positions that the program has recorded so far [m], frames x vertices x 3; None before the first frame."""
    try:
        frames = np.load(os.path.join(folder, RUN, "frames.npy"), mmap_mode="r")
    except (OSError, ValueError):
        return None
    return frames if len(frames) > 0 else None


def recorded_bodies(folder):
    """The first vertex of each body in the frames, by its name."""
    with open(os.path.join(folder, RUN, "run.json"), encoding="utf-8") as file:
        return {body["name"]: body["first_vertex"] for body in json.load(file)["bodies"]}


def write_caches(folder, bake):
    """Writes a PC2 file for each simulated object, in its own coordinates. Yields after each frame."""
    frames = recorded_frames(folder)
    first_vertices = recorded_bodies(folder)
    transforms = np.load(os.path.join(folder, TRANSFORMS))
    for entry, matrices in zip(bake["objects"], transforms):
        first = first_vertices[entry["name"]]
        path = os.path.join(folder, entry["cache"])
        with open(path + ".new", "wb") as file:
            file.write(struct.pack("<12siiffi", b"POINTCACHE2", 1, entry["vertices"], 0.0, 1.0, len(frames)))
            for positions, matrix in zip(frames, matrices):
                world = positions[first : first + entry["vertices"]] / bake["unit"]
                local = np.linalg.solve(matrix[:3, :3], (world - matrix[:3, 3]).T).T
                file.write(np.ascontiguousarray(local, dtype="<f4").tobytes())
                yield
        os.replace(path + ".new", path)


def _remove_if_empty(folder):
    try:
        os.rmdir(folder)
    except OSError:  # there is something else in it, or it is gone
        pass


def remove_bake(folder):
    """Removes what a bake has written, and nothing else."""
    bake = read_bake(folder)
    if bake is None:
        return
    names = [*bake["files"], SCENE, BAKE, TRANSFORMS, *(os.path.join(RUN, name) for name in RUN_FILES)]
    for path in (os.path.join(folder, name) for name in names):
        if os.path.isfile(path):
            os.remove(path)
    _remove_if_empty(os.path.join(folder, RUN))
    _remove_if_empty(folder)


def remove_others(folder):
    """Removes the bakes beside one, which takes their place; those that are still played stay until all is freed."""
    parent = os.path.dirname(folder)
    played = {
        os.path.normpath(os.path.dirname(bpy.path.abspath(modifier.filepath, library=obj.library)))
        for obj in bpy.data.objects
        for modifier in obj.modifiers
        if modifier.type == "MESH_CACHE" and modifier.filepath
    }
    for other, _ in bakes_in(parent):
        if other != folder and os.path.normpath(other) not in played:
            remove_bake(other)


def remove_all(scene):
    """Removes all bakes of a scene, and the folders that they leave empty."""
    folder = scene_folder(scene)
    silence(folder)
    for place, _ in bakes_in(folder):
        remove_bake(place)
    _remove_if_empty(folder)
    _remove_if_empty(os.path.dirname(folder))
