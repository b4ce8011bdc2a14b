"""An object on its way into a scene file: its mesh, its pins, and what of it follows the animation."""

import contextlib
import os

import numpy as np

from .participants import SIMULATED

HARD = 0.999  # weights from here on are held exactly
FREE = 0.001  # and below this one not at all
STILL = 1e-9  # [m] what moves by less does not move


def _vector(collection, attribute, dtype, width):
    values = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width)


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


class ExportedObject:
    """What is wrong with an object is raised as ValueError, which says it of "the object"."""

    def __init__(self, obj, stem, unit):
        self.name = obj.name_full
        self.role = obj.pliant.role
        self.mesh_file, self.motion_file, self.cache_file = (stem + ending for ending in (".obj", ".npy", ".pc2"))
        self.matrices = []  # frame by frame
        self.is_moving = False  # what follows the animation
        self.short_edge = np.inf  # [m], than which 5 % are shorter
        self.vertex_count = 0
        self._obj = obj
        self._unit = unit
        self._first = self._moving = None  # what follows the animation [m]: at first, and in its file if it moves
        self._hard = self._soft = self._stiffness = None  # vertices that are pinned
        self._body = None
        self._folder, self._frame_count = None, 0

    @property
    def is_simulated(self):
        return self.role in SIMULATED

    @contextlib.contextmanager
    def _mesh(self, graph):
        evaluated = self._obj.evaluated_get(graph)
        try:
            yield evaluated, evaluated.to_mesh()
        finally:
            evaluated.to_mesh_clear()

    def _world_positions(self, evaluated, mesh):
        """Of all vertices [m], with the matrix that takes them there in units of Blender."""
        matrix = np.array(evaluated.matrix_world, dtype=np.float64)
        local = _vector(mesh.vertices, "co", np.float32, 3).astype(np.float64)
        return (local @ matrix[:3, :3].T + matrix[:3, 3]) * self._unit, matrix

    def _weights(self, mesh):
        """Of all vertices in the group of pins, 0 where it has none."""
        weights = np.zeros(len(mesh.vertices))
        name = self._obj.pliant.pins
        if not name:
            return weights
        group = self._obj.vertex_groups.get(name)
        if group is None:
            raise ValueError(f'has no vertex group "{name}"; choose another one for the pins')
        for vertex in mesh.vertices:
            for entry in vertex.groups:
                if entry.group == group.index:
                    weights[vertex.index] = entry.weight
        return weights

    def begin(self, graph, folder, frame_count):
        """Takes the mesh and the settings as they are at the first frame, and writes the mesh; room for so many frames.
        Without a folder nothing is written."""
        self._folder, self._frame_count = folder, frame_count
        with self._mesh(graph) as (evaluated, mesh):
            if len(mesh.polygons) == 0:
                raise ValueError("has no faces; give it some, or set its type to None")
            positions, matrix = self._world_positions(evaluated, mesh)
            determinant = np.linalg.det(matrix[:3, :3])
            if determinant == 0:
                raise ValueError("is scaled to 0 along an axis; give it another scale")
            self.vertex_count = len(mesh.vertices)
            triangles, uvs = _triangles(mesh, determinant < 0)
            weights = self._weights(mesh) if self.is_simulated else np.zeros(0)
        self._hard = np.flatnonzero(weights >= HARD)
        self._soft = np.flatnonzero((weights > FREE) & (weights < HARD))
        self._stiffness = weights[self._soft] * self._obj.pliant.pin_stiffness
        corners = positions[triangles]
        self.short_edge = np.quantile(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2), 0.05)
        self._body = self._body_without_motion()
        if folder is not None:
            _write_mesh(os.path.join(folder, self.mesh_file), positions, triangles, uvs)

    def take_frame(self, graph, frame):
        """Notes where it is at the frame of that number, from 0."""
        with self._mesh(graph) as (evaluated, mesh):
            if len(mesh.vertices) != self.vertex_count:
                raise ValueError(
                    f"has {len(mesh.vertices)} vertices at frame {graph.scene.frame_current} and {self.vertex_count} at "
                    "the first one; switch off the modifier that changes it"
                )
            positions, matrix = self._world_positions(evaluated, mesh)
        self.matrices.append(matrix)
        if self.is_simulated:
            positions = positions[np.concatenate([self._hard, self._soft])]
        if frame == 0:
            self._first = positions
        elif not self.is_moving and np.any(np.abs(positions - self._first) > STILL):
            self._begin_to_move(frame)
        if self._moving is not None:
            self._moving[frame] = positions

    def _begin_to_move(self, frame):
        """What has stood still until this frame gets a file."""
        self.is_moving = True
        if self._folder is None:
            return
        path = os.path.join(self._folder, self.motion_file)
        shape = (self._frame_count, *self._first.shape)
        self._moving = np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=shape)
        self._moving[:frame] = self._first

    def finish(self):
        """Closes what was written."""
        self._moving = None

    def _body_without_motion(self):
        settings = self._obj.pliant
        body = {"name": self.name, "mesh": {"file": self.mesh_file}}
        contact = {"friction": settings.friction} if settings.use_friction else {}
        if self.role == "COLLIDER":
            return body | {"animation": {}, "contact": contact | {"self": False}}
        if self.role == "SOLID":
            body["solid"] = {"spacing": settings.spacing * self._unit}
        body["material"] = _sheet(settings) if self.role == "CLOTH" else _solid(settings)
        return body | {"constraints": self._pins(), "contact": contact | {"self": settings.use_self}}

    def body(self, rate):
        """As a scene file has it."""
        if self.is_simulated or not self.is_moving:
            return self._body
        return self._body | {"animation": {"frames": self.motion_file, "frames_per_second": rate}}

    def _pins(self):
        constraints = []
        if len(self._hard) > 0:
            constraints.append({"type": "position", "name": f"{self.name}.pins", "on": self._hard.tolist()})
        if len(self._soft) > 0:
            constraints.append(
                {
                    "type": "position",
                    "name": f"{self.name}.springs",
                    "on": self._soft.tolist(),
                    "hold": "soft",
                    "stiffness": self._stiffness.tolist(),
                }
            )
        return constraints

    def pin_events(self, rate):
        """What lets pins follow the animation, whose file has the hard ones first."""
        hard = len(self._hard)
        groups = (("pins", range(hard)), ("springs", range(hard, hard + len(self._soft))))
        return [
            {
                "step": 0,
                "follow": f"{self.name}.{name}",
                "file": self.motion_file,
                "vertices": list(points),
                "attach": "exact",
                "frames_per_second": rate,
            }
            for name, points in groups
            if len(points) > 0
        ]
