"""The scene of Blender as a scene file, with the meshes and motions that it names.

Everything is written in meters, in the coordinates of the world. docs/scenes.md has the keys.
"""

import contextlib
import itertools
import os

import bpy
import numpy as np

from . import baked_files
from .properties import SIMULATED

HARD = 0.999  # weights from here on are held exactly
FREE = 0.001  # and below this one not at all
STILL = 1e-9  # [m] what moves by less does not move


class ExportError(Exception):
    """What cannot be simulated, and how it could be; one line."""


class ExportedObject:
    """An object on its way into a scene file."""

    def __init__(self, obj, stem):
        self.name = obj.name
        self.role = obj.pliant.role
        self.stem = stem  # of its files
        self.vertex_count = 0
        self.positions = None  # [m] at the first frame
        self.triangles = None
        self.hard = self.soft = None  # indices of pinned vertices
        self.matrices = []  # frame by frame
        self.moving = np.zeros((1, 0, 3))  # what follows the animation, frame by frame [m]; in its file, if any does

    @property
    def is_simulated(self):
        return self.role in SIMULATED

    @property
    def mesh_file(self):
        return self.stem + ".obj"

    @property
    def motion_file(self):
        return self.stem + ".npy"

    @property
    def cache_file(self):
        return self.stem + ".pc2"

    @property
    def followed(self):
        """The vertices whose motion counts: of a collider all, of other bodies the pinned ones."""
        if self.is_simulated:
            return np.concatenate([self.hard, self.soft])
        return np.arange(self.vertex_count)

    @property
    def is_moving(self):
        return bool(np.any(np.abs(self.moving - self.moving[0]) > STILL))


def takes_part(obj):
    """Whether an object is simulated or met: with a type, and not disabled in viewports, it or its collection."""
    if obj.type != "MESH" or obj.pliant.role == "NONE" or obj.hide_viewport:
        return False
    return obj.visible_get() or (obj.hide_get() and not all(each.hide_viewport for each in obj.users_collection))


def unit_of(scene):
    """Meters in a unit of Blender."""
    settings = scene.unit_settings
    return settings.scale_length if settings.system != "NONE" else 1.0


@contextlib.contextmanager
def _without_bakes(objects):
    """Shows what takes part, also what is hidden by its eye; what is simulated as it is before its bake acts, without
    what stands behind that."""
    switched_off = []
    hidden = [obj.name for obj in objects if obj.hide_get()]
    try:
        for obj in objects:
            obj.hide_set(False)
            if obj.pliant.role not in SIMULATED:
                continue
            baked_files.prepare_modifier(obj, True)
            names = obj.modifiers.keys()
            for name in names[names.index(baked_files.MODIFIER) :]:
                switched_off.append((obj.name, name, obj.modifiers[name].show_viewport))
                obj.modifiers[name].show_viewport = False
        yield
    finally:
        for obj_name, name, was_shown in switched_off:
            obj = bpy.data.objects.get(obj_name)
            if obj is not None and name in obj.modifiers:
                obj.modifiers[name].show_viewport = was_shown
        for name in hidden:
            if name in bpy.data.objects:
                bpy.data.objects[name].hide_set(True)


@contextlib.contextmanager
def _evaluated_mesh(context, obj):
    evaluated = obj.evaluated_get(context.evaluated_depsgraph_get())
    try:
        yield evaluated, evaluated.to_mesh()
    finally:
        evaluated.to_mesh_clear()


def _vector(collection, attribute, dtype, width):
    values = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width)


def _world_positions(evaluated, mesh, unit):
    """Of all vertices [m], with the matrix that takes them there in units of Blender."""
    matrix = np.array(evaluated.matrix_world, dtype=np.float64)
    local = _vector(mesh.vertices, "co", np.float32, 3).astype(np.float64)
    return (local @ matrix[:3, :3].T + matrix[:3, 3]) * unit, matrix


def _weights(obj, mesh):
    """Of all vertices in the group of pins, 0 where it has none."""
    weights = np.zeros(len(mesh.vertices))
    name = obj.pliant.pins
    if not name:
        return weights
    group = obj.vertex_groups.get(name)
    if group is None:
        raise ExportError(f'"{obj.name}": there is no vertex group "{name}"; choose another one for the pins')
    for vertex in mesh.vertices:
        for entry in vertex.groups:
            if entry.group == group.index:
                weights[vertex.index] = entry.weight
    return weights


def _write_mesh(path, positions, triangles, uvs):
    """OBJ: numbers with all their digits, vertices in their order."""
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in positions.tolist())
        if uvs is None:
            file.writelines(f"f {a} {b} {c}\n" for a, b, c in (triangles + 1).tolist())
            return
        places, corners = np.unique(uvs.view(np.complex128), return_inverse=True)  # each pair once
        file.writelines(f"vt {each.real!r} {each.imag!r}\n" for each in places.tolist())
        corners = corners.reshape(-1, 3) + 1
        file.writelines(
            f"f {a}/{at} {b}/{bt} {c}/{ct}\n"
            for (a, b, c), (at, bt, ct) in zip((triangles + 1).tolist(), corners.tolist())
        )


def _triangles(mesh, is_mirrored):
    """Of all faces, with the texture coordinates of their corners or None."""
    mesh.calc_loop_triangles()
    corners = _vector(mesh.loop_triangles, "loops", np.int32, 3)
    vertices = _vector(mesh.loop_triangles, "vertices", np.int32, 3)
    uvs = None
    if mesh.uv_layers.active:
        uvs = _vector(mesh.uv_layers.active.data, "uv", np.float32, 2).astype(np.float64)
    if is_mirrored:
        corners, vertices = corners[:, ::-1], vertices[:, ::-1]
    return vertices, None if uvs is None else uvs[corners.ravel()]


def _begin(context, exported, folder, unit, frame_count):
    """Writes the mesh of an object as it is at the first frame, finds its pins, and makes room for so many frames."""
    obj = bpy.data.objects[exported.name]
    with _evaluated_mesh(context, obj) as (evaluated, mesh):
        if len(mesh.polygons) == 0:
            raise ExportError(f'"{obj.name}" has no faces; give it some, or set its type to None')
        exported.positions, matrix = _world_positions(evaluated, mesh, unit)
        determinant = np.linalg.det(matrix[:3, :3])
        if determinant == 0:
            raise ExportError(f'"{obj.name}" is scaled to 0 along an axis; give it another scale')
        exported.vertex_count = len(mesh.vertices)
        exported.triangles, uvs = _triangles(mesh, determinant < 0)
        weights = _weights(obj, mesh) if exported.is_simulated else np.zeros(0)
        exported.hard = np.flatnonzero(weights >= HARD)
        exported.soft = np.flatnonzero((weights > FREE) & (weights < HARD))
        exported.stiffness = weights[exported.soft] * obj.pliant.pin_stiffness
    _write_mesh(os.path.join(folder, exported.mesh_file), exported.positions, exported.triangles, uvs)
    if len(exported.followed) > 0:
        path = os.path.join(folder, exported.motion_file)
        shape = (frame_count, len(exported.followed), 3)
        exported.moving = np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=shape)


def _take_frame(context, exported, unit, frame):
    """Notes where an object is at the frame of that number, from 0."""
    obj = bpy.data.objects[exported.name]
    with _evaluated_mesh(context, obj) as (evaluated, mesh):
        if len(mesh.vertices) != exported.vertex_count:
            raise ExportError(
                f'"{obj.name}" has {len(mesh.vertices)} vertices at frame {context.scene.frame_current} and '
                f"{exported.vertex_count} at the first one; switch off the modifier that changes it"
            )
        positions, matrix = _world_positions(evaluated, mesh, unit)
    exported.matrices.append(matrix)
    if len(exported.followed) > 0:
        exported.moving[frame] = positions[exported.followed]


def _sheet(settings):
    material = {"name": settings.sheet}
    if settings.use_weight:
        material["area_density"] = settings.weight
    if settings.use_bending:
        material["bending"] = settings.bending * 1e-6
    return material


def _solid(settings):
    material = {"name": settings.solid}
    if settings.use_weight:
        material["density"] = settings.density
    if settings.use_young:
        material["young_modulus"] = settings.young * 1e3
    return material


def _body(exported, rate):
    """An object as a body of a scene file."""
    settings = bpy.data.objects[exported.name].pliant
    body = {"name": exported.name, "mesh": {"file": exported.mesh_file}}
    contact = {"friction": settings.friction} if settings.use_friction else {}
    if exported.role == "COLLIDER":
        body["animation"] = {}
        if exported.is_moving:
            body["animation"] = {"frames": exported.motion_file, "frames_per_second": rate}
        contact["self"] = False
    else:
        if exported.role == "SOLID":
            body["solid"] = {"spacing": settings.spacing * unit_of(bpy.context.scene)}
        body["material"] = _sheet(settings) if exported.role == "CLOTH" else _solid(settings)
        contact["self"] = settings.use_self
        body["constraints"] = _pins(exported)
    body["contact"] = contact
    return body


def _pins(exported):
    constraints = []
    if len(exported.hard) > 0:
        constraints.append({"type": "position", "name": f"{exported.name}.pins", "on": exported.hard.tolist()})
    if len(exported.soft) > 0:
        constraints.append(
            {
                "type": "position",
                "name": f"{exported.name}.springs",
                "on": exported.soft.tolist(),
                "hold": "soft",
                "stiffness": exported.stiffness.tolist(),
            }
        )
    return constraints


def _pin_events(exported, rate):
    """What lets pins follow the animation, whose file has the hard ones first."""
    hard = len(exported.hard)
    groups = (("pins", range(hard)), ("springs", range(hard, len(exported.followed))))
    return [
        {
            "step": 0,
            "follow": f"{exported.name}.{name}",
            "file": exported.motion_file,
            "vertices": list(points),
            "attach": "exact",
            "frames_per_second": rate,
        }
        for name, points in groups
        if len(points) > 0
    ]


class _Weather:
    """Gravity and winds, frame by frame."""

    def __init__(self, context, unit):
        self._unit = unit
        self._winds = [
            obj
            for obj in context.view_layer.objects
            if obj.field is not None and obj.field.type == "WIND" and not obj.hide_viewport
        ]
        self._gravity = []
        self._velocities = {obj.name: [] for obj in self._winds}

    def take_frame(self, context):
        scene = context.scene
        gravity = np.array(scene.gravity) * self._unit if scene.use_gravity else np.zeros(3)
        self._gravity.append(gravity.tolist())
        graph = context.evaluated_depsgraph_get()
        for obj in self._winds:
            evaluated = obj.evaluated_get(graph)
            direction = evaluated.matrix_world.to_3x3().col[2].normalized()
            self._velocities[obj.name].append([evaluated.field.strength * each for each in direction])

    def gravity(self):
        return self._gravity[0]

    def forces(self):
        return [
            {
                "type": "wind",
                "name": obj.name,
                "velocity": self._velocities[obj.name][0],
                "gust_strength": min(1.0, obj.field.noise),
            }
            for obj in self._winds
        ]

    def events(self, steps):
        """What changes from one frame to the next."""
        found = []
        for frame, (before, now) in enumerate(itertools.pairwise(self._gravity), 1):
            if now != before:
                found.append({"step": frame * steps, "gravity": now})
        for name, velocities in self._velocities.items():
            for frame, (before, now) in enumerate(itertools.pairwise(velocities), 1):
                if now != before:
                    found.append({"step": frame * steps, "change": name, "velocity": now})
        return found


def _usual_distance(exported_objects):
    """A quarter of the short edges of what is simulated; a floor of two triangles has no say."""
    shortest = np.inf
    for each in exported_objects:
        if each.is_simulated:
            corners = each.positions[each.triangles]
            lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
            shortest = min(shortest, np.quantile(lengths, 0.05))
    return shortest / 4


def _scene(context, exported_objects, weather, unit):
    scene = context.scene
    settings = scene.pliant
    rate = scene.render.fps / scene.render.fps_base
    frame_count = scene.frame_end - scene.frame_start
    events = weather.events(settings.steps)
    for each in exported_objects:
        if each.is_simulated and each.is_moving:
            events += _pin_events(each, rate)
    return {
        "pliant": 1,
        "name": scene.name,
        "description": "Written by the add-on for Blender",
        "settings": {"time_step": 1 / (rate * settings.steps), "iterations": settings.iterations},
        "steps": frame_count * settings.steps,
        "gravity": weather.gravity(),
        "bodies": [_body(each, rate) for each in exported_objects],
        "forces": weather.forces(),
        "contact": {"distance": settings.distance * unit or _usual_distance(exported_objects)},
        "events": events,
        "output": {"format": "npy", "every": settings.steps},
    }


def _stems(objects):
    """A name for the files of each object; names that differ by what files cannot have are numbered."""
    taken = {"scene", "bake", "transforms"}
    stems = []
    for obj in objects:
        clean = bpy.path.clean_name(obj.name)
        stem = next(each for each in itertools.chain([clean], (f"{clean}_{i}" for i in itertools.count(2)))
                    if each.lower() not in taken)
        taken.add(stem.lower())
        stems.append(stem)
    return stems


def export(context, folder):
    """Writes everything into a folder. A generator that yields the share that is done, so that the window goes on;
    whatever it hides or moves is as before at its end. Raises ExportError."""
    scene = context.scene
    objects = [obj for obj in context.view_layer.objects if takes_part(obj)]
    if not any(obj.pliant.role in SIMULATED for obj in objects):
        raise ExportError("Nothing is simulated; set the type of an object to Cloth or Soft Body")
    if scene.frame_end <= scene.frame_start:
        raise ExportError("The last frame of the scene is not behind its first one")
    os.makedirs(folder, exist_ok=True)
    exported_objects = [ExportedObject(*each) for each in zip(objects, _stems(objects))]
    unit = unit_of(scene)
    weather = _Weather(context, unit)
    frame_before = scene.frame_current
    count = scene.frame_end - scene.frame_start + 1
    try:
        with _without_bakes(objects):
            for frame in range(count):
                scene.frame_set(scene.frame_start + frame)
                weather.take_frame(context)
                for each in exported_objects:
                    if frame == 0:
                        _begin(context, each, folder, unit, count)
                    _take_frame(context, each, unit, frame)
                yield (frame + 1) / count
    finally:
        scene.frame_set(frame_before)
    _write_all(context, folder, exported_objects, weather, unit)


def _write_all(context, folder, exported_objects, weather, unit):
    scene = context.scene
    simulated = [each for each in exported_objects if each.is_simulated]
    before = baked_files.read_bake(folder)
    np.save(os.path.join(folder, baked_files.TRANSFORMS), np.array([each.matrices for each in simulated]))
    baked_files.write_json(os.path.join(folder, baked_files.SCENE), _scene(context, exported_objects, weather, unit))
    files = [each.mesh_file for each in exported_objects]
    files += [each.motion_file for each in exported_objects if each.is_moving]
    files += [each.cache_file for each in simulated]
    # Caches of an earlier bake may still be played by what is no longer simulated, until all is freed.
    files += [name for name in (before["files"] if before else []) if name.endswith(".pc2") and name not in files]
    bake = {
        "first_frame": scene.frame_start,
        "last_frame": scene.frame_end,
        "steps": scene.pliant.steps,
        "unit": unit,
        "is_animated": any(each.is_moving for each in exported_objects),
        "objects": [
            {"name": each.name, "vertices": each.vertex_count, "cache": each.cache_file} for each in simulated
        ],
        "files": files,
    }
    baked_files.write_json(os.path.join(folder, baked_files.BAKE), bake)
    written = {each.motion_file for each in exported_objects if len(each.followed) > 0}
    baked_files.remove_files(folder, (written | set(before["files"] if before else [])) - set(files))
