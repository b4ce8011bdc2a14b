"""The files of a bake, and the modifier that plays them."""

import json
import os
import struct

import bpy
import numpy as np

MODIFIER = "Pliant"
SCENE = "scene.json"
BAKE = "bake.json"
TRANSFORMS = "transforms.npy"
RUN = "run"  # the folder that the program writes

RUN_FILES = ("frames.npy", "mesh.obj", "run.json", "measurements.csv", "checkpoint.pliant")

# What makes a surface finer or thicker acts upon what is baked; everything else before it is part of what is baked.
REFINING = {"SUBSURF", "MULTIRES", "SOLIDIFY"}


def folder_of(scene):
    """Where the bake of a scene is, and whether it stays there when Blender ends."""
    name = bpy.path.clean_name(scene.name)
    chosen = scene.pliant.folder
    if chosen and (bpy.data.is_saved or not chosen.startswith("//")):
        return bpy.path.abspath(chosen), True
    if bpy.data.is_saved:
        stem = os.path.splitext(bpy.data.filepath)[0]
        return os.path.join(stem + "_pliant", name), True
    return os.path.join(bpy.app.tempdir, "pliant", name), False


def find_modifier(obj):
    """The modifier that plays an object's bake, or None."""
    found = obj.modifiers.get(MODIFIER)
    return found if found is not None and found.type == "MESH_CACHE" else None


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


def silence(obj):
    """The modifier stays where it is in the stack and plays nothing."""
    modifier = find_modifier(obj)
    if modifier is not None:
        modifier.show_viewport = modifier.show_render = False
        modifier.filepath = ""


def write_json(path, value):
    """Whole or not at all."""
    with open(path + ".new", "w", encoding="utf-8") as file:
        json.dump(value, file, indent=1, ensure_ascii=False)
    os.replace(path + ".new", path)


def read_bake(folder):
    """What export.py has left of a bake, or None."""
    try:
        with open(os.path.join(folder, BAKE), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None


def extend(folder, bake, last_frame):
    """Makes room for more frames, in which nothing but what is simulated moves."""
    path = os.path.join(folder, TRANSFORMS)
    transforms = np.load(path)
    more = last_frame - bake["last_frame"]
    np.save(path, np.concatenate([transforms, np.repeat(transforms[:, -1:], more, axis=1)], axis=1))
    bake["last_frame"] = last_frame
    write_json(os.path.join(folder, BAKE), bake)


def can_go_on(scene):
    """Whether the program has left what it goes on from."""
    return os.path.isfile(os.path.join(folder_of(scene)[0], RUN, "checkpoint.pliant"))


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


def remove_files(folder, names):
    """Removes those of the files that are there."""
    for path in (os.path.join(folder, name) for name in names):
        if os.path.isfile(path):
            os.remove(path)


def remove_run(folder):
    """Removes what the program has written."""
    remove_files(folder, [os.path.join(RUN, name) for name in RUN_FILES])


def remove(folder):
    """Removes what a bake has written, and nothing else."""
    bake = read_bake(folder)
    if bake is not None:
        remove_run(folder)
        remove_files(folder, [*bake["files"], SCENE, BAKE, TRANSFORMS])
    for each in (os.path.join(folder, RUN), folder):
        try:
            os.rmdir(each)
        except OSError:  # there is something else in it, or it is gone
            pass
