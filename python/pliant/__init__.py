"""Projective Dynamics of cloth, ropes and soft bodies; docs/python.md begins with an example.

The classes of constraints, forces and colliders, and the functions that make shapes, are made from the lists of the
library: ``help(pliant.EdgeSpring)`` has the options of each with units and defaults.
"""
from typing import Any as _Any
from typing import List as _List

from . import _pliant
from ._error import Error
from ._ids import BodyId, ColliderId, ForceId, GroupId
from ._own import OwnConstraint, OwnForce
from ._picture import Picture
from ._pliant import Mesh
from ._results import Evaluation, StepError, StepReport
from ._scene import Scene, load_checkpoint, open_scene
from ._simulation import CLASSES, CONTACT_TYPE, Recording, Simulation
from ._types import TYPES, ColliderOptions, ConstraintOptions, ForceOptions, Options, PerVertex
from ._types import make_shapes as _make_shapes
from ._types import option_lines as _option_lines
from ._types import signature_of as _signature_of

__version__: str = _pliant.version

globals().update(CLASSES)
globals().update(_make_shapes())

Mesh.__module__ = "pliant"
Simulation.__doc__ = f"{Simulation.__doc__}\n\nSettings:\n{_option_lines(TYPES['SolverSettings']['fields'])}\n"
Simulation.__signature__ = _signature_of(TYPES["SolverSettings"]["fields"])  # type: ignore[attr-defined]


def read_mesh(path: _Any, **options: _Any) -> Mesh:
    """Reads the mesh of a file, in the format of its extension."""
    return _pliant.read_mesh(path, options)


def lattice_solid(surface: Mesh, **options: _Any) -> Mesh:
    """A solid of tetrahedra that fills a closed surface and carries it; see Simulation.carry_surface."""
    return _pliant.lattice_solid(surface, options)


def scene_names() -> _List[str]:
    """The built-in scenes."""
    return _pliant.scene_names()


def material_names() -> _List[str]:
    """The materials of the library."""
    return _pliant.material_names()


def write_mesh(path: _Any, mesh: Mesh, positions: _Any = None) -> None:
    """Writes a mesh, with these positions in place of its own, in the format of the extension."""
    mesh.write(path, positions)


__all__ = [name for name in globals() if not name.startswith("_")]
