"""Pictures of a moment, for notebooks: by the program `pliant` where it is found, else plain ones in NumPy."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union

import numpy as np

from ._error import Error

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._scene import Scene
    from ._simulation import Simulation

    Array = NDArray[np.float64]

# Of the plain picture: where eye and light are, seen from the middle; the colors of bodies and of colliders.
TOWARDS_EYE = np.array([0.55, -0.75, 0.38])
TOWARDS_LIGHT = np.array([0.3, -0.5, 0.81])
BODY_COLORS = np.array([[178, 74, 62], [70, 110, 160], [96, 140, 84], [190, 150, 70], [130, 96, 150]])
COLLIDER_COLOR = np.array([150, 156, 166])
BEHIND = 20.0  # [pixels] so that cloth that lies on a collider is drawn after it
MOST_TRIANGLES = 50_000  # of a plain picture, which has 80 bytes of each


class Picture:
    """A picture, which notebooks show. ``data`` is that of a file, ``format`` says of which kind: "png" or "svg"."""

    def __init__(self, data: bytes, format: str) -> None:
        self.data = data
        self.format = format

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes it to a file with the ending of its format."""
        if os.path.splitext(os.fspath(path))[1] != "." + self.format:
            raise Error(f"save: {os.fspath(path)}: the picture is another kind of file; give a name with .{self.format}")
        with open(path, "wb") as file:
            file.write(self.data)

    def _repr_mimebundle_(self, **_: Any) -> Dict[str, Union[str, bytes]]:
        return {"image/png": self.data} if self.format == "png" else {"image/svg+xml": self.data.decode()}


def find_program(program: str) -> Optional[str]:
    """Where the program is; None for one that is not found, or for ''."""
    return shutil.which(program) if program else None


def draw_file(program: str, source: str, size: Tuple[int, int], color: str) -> Picture:
    """The picture that the program makes of a scene or a checkpoint."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "picture.png")
        words = [program, "render", source, "--out", out, "--size", f"{size[0]}x{size[1]}", "--color", color, "--quiet"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or ["it ended without a word"]
            raise Error(lines[-1].replace("pliant: error: ", "picture: ", 1))
        with open(out, "rb") as file:
            return Picture(file.read(), "png")


def _rotated(rotation: Tuple[float, float, float, float], vector: Any) -> "Array":
    w, axis = rotation[0], np.array(rotation[1:])
    v = np.asarray(vector, dtype=float)
    return np.asarray(v + 2 * np.cross(axis, np.cross(axis, v) + w * v))


def _collider_in_scene(simulation: "Simulation", collider: Any, type_names: Dict[str, str]) -> Optional[Dict[str, Any]]:
    """A collider where it is now, as scene files have it."""
    options = simulation.options(collider)
    if options is None:
        return None
    position, rotation = simulation.pose(collider)
    kind = type_names[type(options).__name__]
    placed: Dict[str, Any] = {"type": kind}
    if kind == "plane":
        placed.update(position=position, normal=_rotated(rotation, [0, 0, 1]).tolist())
    elif kind == "sphere":
        placed.update(center=position, radius=options.radius)
    elif kind == "capsule":
        half = np.linalg.norm(np.subtract(options.to, options.from_)) / 2
        axis = _rotated(rotation, [0, 0, half])
        placed.update(from_=(position - axis).tolist(), to=(position + axis).tolist(), radius=options.radius)
        placed["from"] = placed.pop("from_")
    elif kind == "box":
        angle = 2 * np.arctan2(np.linalg.norm(rotation[1:]), rotation[0])
        axis = np.array(rotation[1:]) / (np.linalg.norm(rotation[1:]) or 1)
        placed.update(center=position, size=options.size, rounding=options.rounding,
                      rotation=np.degrees(angle * axis).tolist())
    else:
        return None
    return placed


def scene_of(simulation: "Simulation", type_names: Dict[str, str]) -> Dict[str, Any]:
    """A scene in which everything stands where it is now, for a picture: without constraints."""
    bodies = []
    for body in simulation.bodies:
        mesh, rows = simulation.mesh(body), simulation.vertices(body)
        bodies.append({
            "name": simulation.name(body),
            "mesh": {"vertices": mesh.vertices.tolist(), "edges": mesh.edges.tolist(),
                     "triangles": mesh.triangles.tolist(), "tetrahedra": mesh.tetrahedra.tolist()},
            "mass": {"per_vertex": 1},
            "start_positions": simulation.positions[rows].tolist(),
            "velocities": simulation.velocities[rows].tolist(),
        })
    colliders = [_collider_in_scene(simulation, each, type_names) for each in simulation.colliders]
    drawn = [each for each in colliders if each is not None]
    return {"pliant": 1, "steps": 0, "gravity": None, "bodies": bodies, "colliders": drawn}


def draw_with_program(program: str, simulation: "Simulation", type_names: Dict[str, str], size: Tuple[int, int],
                      color: str) -> Picture:
    """A simulation without a scene file has one written for the program."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(scene_of(simulation, type_names), file)
        return draw_file(program, path, size, color)


# ---- a plain picture


def _border(tetrahedra: Any) -> Any:
    """The triangles that belong to one tetrahedron alone, seen from outside counterclockwise."""
    faces = tetrahedra[:, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def _parts(simulation: "Simulation") -> "List[Tuple[Array, Any, Any, Any, float]]":
    """Points, triangles, lines and color of all that is drawn, and how far behind its place it is drawn [pixels]."""
    parts = []
    for i, body in enumerate(simulation.bodies):
        mesh, points = simulation.mesh(body), simulation.positions[simulation.vertices(body)]
        triangles = np.concatenate([mesh.triangles, _border(mesh.tetrahedra)])
        parts.append((points, triangles, mesh.edges, BODY_COLORS[i % len(BODY_COLORS)], 0.0))
    bodies = np.concatenate([part[0] for part in parts]) if parts else np.zeros((1, 3))
    reach = float(np.ptp(bodies, axis=0).max()) or 1.0
    for collider in simulation.colliders:
        mesh = simulation.collider_surface(collider, reach)
        parts.append((mesh.vertices, mesh.triangles, mesh.edges, COLLIDER_COLOR, BEHIND))
    return parts


def _camera(points: "Array", size: Tuple[int, int]) -> Any:
    """A function from points [m] to pixels with the depth behind them, in which these points fill the picture."""
    towards = TOWARDS_EYE / np.linalg.norm(TOWARDS_EYE)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    axes = np.stack([right, -np.cross(towards, right), towards])  # to the right, down, to the eye
    seen = points @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = 0.88 * min(size[0] / max(high[0] - low[0], 1e-9), size[1] / max(high[1] - low[1], 1e-9))

    def project(world: "Array") -> "Array":
        place = (world @ axes.T - (low + high) / 2) * scale
        return np.asarray(place + [size[0] / 2, size[1] / 2, 0])

    return project


def _shaded(corners: "Array", color: Any) -> "Array":
    """The color of each triangle in the light, alike on both sides."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    light = TOWARDS_LIGHT / np.linalg.norm(TOWARDS_LIGHT)
    share = np.abs(normals / np.where(lengths > 0, lengths, 1) @ light)
    return np.asarray(np.clip((0.45 + 0.6 * share)[:, None] * color, 0, 255))


def draw_plainly(simulation: "Simulation", size: Tuple[int, int]) -> Picture:
    """Triangles from the farthest to the nearest, as SVG."""
    parts = _parts(simulation)
    count = sum(len(part[1]) for part in parts)
    if count > MOST_TRIANGLES:
        raise Error(f"picture: {count} triangles are too many for a plain one; install the program pliant")
    project = _camera(simulation.positions if len(simulation.positions) else np.zeros((1, 3)), size)
    drawn: List[Tuple[float, str]] = []
    for points, triangles, lines, color, behind in parts:
        pixels = project(points) - [0, 0, behind]
        shades = _shaded(points[triangles], color).astype(int)
        depths = pixels[triangles, 2].min(axis=1)  # the two large triangles of a floor come first
        for (a, b, c), depth, (red, green, blue) in zip(pixels[triangles][:, :, :2].tolist(), depths, shades.tolist()):
            shade = f"#{red:02x}{green:02x}{blue:02x}"  # its outline closes the gaps between neighbors
            drawn.append((depth, f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f} {c[0]:.1f} {c[1]:.1f}Z" '
                                 f'fill="{shade}" stroke="{shade}"/>'))
        ends = pixels[lines]
        for (a, b), depth in zip(ends[:, :, :2].tolist(), ends[:, :, 2].min(axis=1)):
            drawn.append((depth, f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}" stroke-width="2" '
                                 f'stroke="#{color[0]:02x}{color[1]:02x}{color[2]:02x}"/>'))
    drawn.sort(key=lambda each: each[0])
    body = "\n".join(text for _, text in drawn)
    width, height = size
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
    ground = '<rect width="100%" height="100%" fill="#f4f4f2"/>'
    text = f'{head}\n{ground}\n<g stroke-width="0.7" stroke-linejoin="round">\n{body}\n</g>\n</svg>\n'
    return Picture(text.encode(), "svg")


def checked_size(size: Any) -> Tuple[int, int]:
    """Two whole numbers from 16 to 8192, or Error."""
    try:
        width, height = (int(each) for each in size)
    except (TypeError, ValueError):
        raise Error(f"picture: size: found {size!r}; give the width and the height in pixels") from None
    if not (16 <= width <= 8192 and 16 <= height <= 8192):
        raise Error(f"picture: size: {width} x {height} is out of range; give 16 to 8192 pixels each")
    return width, height


def picture_of(simulation: "Simulation", type_names: Dict[str, str], scene: "Optional[Scene]", size: Any, color: str,
               program: str) -> Picture:
    """What Simulation.picture and Scene.picture return."""
    checked = checked_size(size)
    found = find_program(program)
    if found is None:
        if color != "none":
            raise Error(f"picture: color: '{color}' is drawn by the program pliant alone, which was not found")
        return draw_plainly(simulation, checked)
    if scene is None:
        if color not in ("none", "stretch", "speed"):
            raise Error(f"picture: color: '{color}' needs a scene; give none, stretch or speed")
        return draw_with_program(found, simulation, type_names, checked, color)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "now.pliant")
        scene.save(path)
        return draw_file(found, path, checked, color)
