"""The simulation, over the compiled module."""
from __future__ import annotations

import os
from types import TracebackType
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Type, Union, overload

import numpy as np

from . import _pliant
from ._error import Error
from ._ids import BodyId, ColliderId, ForceId, GroupId
from ._lock import FolderLock
from ._own import OwnConstraint, OwnForce
from ._picture import Picture, picture_of
from ._pliant import Mesh
from ._results import Evaluation, StepError, StepReport
from ._types import TYPES, ColliderOptions, ConstraintOptions, ForceOptions, Options, make_classes

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

CLASSES = make_classes()

SCENE_NAMES = {name: described["scene_name"] for name, described in TYPES.items()}

CONTACT_TYPE = np.dtype([("vertex", "i4"), ("collider", "i4"), ("point", "f8", 3), ("normal", "f8", 3),
                         ("distance", "f8"), ("force", "f8", 3), ("friction_power", "f8")])


Id = Union[GroupId, ForceId, ColliderId]


def _kind_and_number(added: Id) -> Tuple[str, int]:
    if isinstance(added, GroupId):
        return "group", added._group
    if isinstance(added, ForceId):
        return "force", added._force
    if isinstance(added, ColliderId):
        return "collider", added._collider
    raise Error(f"found {added!r}; give what add() returned")


class Simulation:
    """Bodies, constraints, forces and colliders, to be changed at any time between steps."""

    def __init__(self, **settings: Any) -> None:
        self._made = _pliant.Simulation(settings)

    @classmethod
    def _of(cls, made: Any) -> "Simulation":
        simulation = cls.__new__(cls)
        simulation._made = made
        return simulation

    # ---- bodies

    def add_body(self, mesh: Mesh, *, name: str = "", start: Optional[ArrayLike] = None,
                 velocities: Optional[ArrayLike] = None, material: Union[str, Mapping[str, Any], None] = None,
                 **mass: Any) -> BodyId:
        """Adds a body.

        Its mass: ``per_vertex`` [kg], ``total`` [kg], ``area_density`` [kg/m^2], ``density`` [kg/m^3], ``line_density``
        [kg/m] or ``each``, one for each vertex [kg]; several are added up. A ``material`` by its name, or a dictionary
        with the ``name``, numbers that differ and how it lies, brings mass and constraints. ``start`` and ``velocities``
        are m x 3 [m], [m/s]. Arrays of positions taken before keep their numbers: take new ones.
        """
        return BodyId(self._made.add_body(mesh, mass, name, start, velocities, material))

    def add_material(self, body: BodyId, name: str, **numbers: Any) -> None:
        """Adds the constraints of a material to a body; numbers that differ, and how it lies, by keyword."""
        self._made.add_material(body._body, {"name": name, **numbers})

    def carry_surface(self, body: BodyId, stiffness: float = 0.0, name: str = "") -> GroupId:
        """Ties the surface of a body made by lattice_solid to its lattice."""
        return GroupId(self._made.carry_surface(body._body, stiffness, name))

    @property
    def bodies(self) -> List[BodyId]:
        return [BodyId(i) for i in range(self._made.body_count())]

    def mesh(self, body: BodyId) -> Mesh:
        """The mesh of a body at rest: a copy."""
        return self._made.body_mesh(body._body)

    def vertices(self, body: BodyId) -> slice:
        """The rows of a body in positions and velocities."""
        return slice(*self._made.body_range(body._body))

    # ---- what is added

    @overload
    def add(self, what: BodyId, on_body: ForceOptions, *, name: str = "") -> ForceId: ...
    @overload
    def add(self, what: BodyId, on_body: Union[ConstraintOptions, OwnConstraint], *, name: str = "") -> GroupId: ...
    @overload
    def add(self, what: Union[ForceOptions, OwnForce], *, name: str = "") -> ForceId: ...
    @overload
    def add(self, what: ColliderOptions, *, name: str = "") -> ColliderId: ...

    def add(self, what: Any, on_body: Any = None, *, name: str = "") -> Any:
        """Adds constraints or a force to a body, ``add(body, EdgeSpring())``, or what is for all, ``add(Gravity())``."""
        body = what._body if isinstance(what, BodyId) else None
        added = what if body is None else on_body
        if isinstance(added, (OwnForce, OwnConstraint)) and not hasattr(added, "name"):
            raise Error(f"{type(added).__name__}: its __init__ does not call super().__init__()")
        if isinstance(added, OwnForce):
            return ForceId(self._made.add_own_force(added.name, added.force, name))
        if isinstance(added, OwnConstraint):
            if body is None:
                raise Error(f"{added.name}: on no body; write add(body, ...)")
            return GroupId(self._made.add_own_constraints(
                body, added.name, added.project, added.stencils, added.reduction, added.measure, added.fields,
                added.stiffness, name))
        if not isinstance(added, (ConstraintOptions, ForceOptions, ColliderOptions)):
            raise Error(f"add: found {added!r}; give a constraint, a force or a collider, such as EdgeSpring()")
        number = self._made.add(body, type(added).__name__, added._given, name)
        kind = TYPES[type(added).__name__]["kind"]
        return {"constraint": GroupId, "force": ForceId, "collider": ColliderId}[kind](number)

    def replace(self, added: Id, options: Options) -> None:
        """Makes a group, a force or a collider anew from other options, under its id and name."""
        self._made.replace(_kind_and_number(added)[1], type(options).__name__, options._given)

    def options(self, added: Id) -> Any:
        """What a group, a force or a collider was made of, with its stiffness of now; None of one's own."""
        kind, number = _kind_and_number(added)
        found = self._made.options("constraint" if kind == "group" else kind, number)
        if found is None:
            return None
        given = {name: value for name, value in found[1].items() if value is not None}
        return CLASSES[found[0]](**given)

    def remove(self, added: Id) -> None:
        kind, number = _kind_and_number(added)
        getattr(self._made, f"remove_{kind}")(number)

    def name(self, added: Union[Id, BodyId]) -> str:
        if isinstance(added, BodyId):
            return str(self._made.body_name(added._body))
        kind, number = _kind_and_number(added)
        return str(getattr(self._made, f"{kind}_name")(number))

    def find_group(self, name: str) -> Optional[GroupId]:
        found = self._made.find_group(name)
        return None if found is None else GroupId(found)

    def find_force(self, name: str) -> Optional[ForceId]:
        found = self._made.find_force(name)
        return None if found is None else ForceId(found)

    def find_collider(self, name: str) -> Optional[ColliderId]:
        found = self._made.find_collider(name)
        return None if found is None else ColliderId(found)

    @property
    def groups(self) -> List[GroupId]:
        return [GroupId(i) for i in self._made.groups()]

    @property
    def forces(self) -> List[ForceId]:
        return [ForceId(i) for i in self._made.forces()]

    @property
    def colliders(self) -> List[ColliderId]:
        return [ColliderId(i) for i in self._made.colliders()]

    # ---- changes while it runs

    def stiffness(self, group: GroupId) -> Optional[float]:
        """The common factor of the weights of a group; None for hard pins."""
        return self._made.stiffness(group._group)

    def set_stiffness(self, group: GroupId, stiffness: float) -> None:
        """Costs one numeric factorization in the next step."""
        self._made.set_stiffness(group._group, stiffness)

    def set_stiffness_factors(self, group: GroupId, factors: ArrayLike) -> None:
        """Multiplies the stiffness of each constraint by their mean over its vertices: one a vertex, or none at all."""
        self._made.set_stiffness_factors(group._group, factors)

    def targets(self, group: GroupId) -> Array:
        """Where the points of a group of positions or drags are drawn to, (count, 3) [m]: a copy."""
        return self._made.targets(group._group)

    def set_targets(self, group: GroupId, targets: ArrayLike) -> None:
        """Moves all of them, (count, 3) [m], from the next step on; costs nothing."""
        self._made.set_targets(group._group, targets)

    def release(self, group: GroupId, vertices: Sequence[int]) -> None:
        """Lets vertices of a group of positions go; they have the indices of their body."""
        self._made.release(group._group, list(vertices))

    def pose(self, collider: ColliderId) -> Tuple[Tuple[float, float, float], Tuple[float, float, float, float]]:
        """Where a collider is [m], and its rotation as a quaternion (w, x, y, z)."""
        return self._made.pose(collider._collider)

    def collider_surface(self, collider: ColliderId, size: float = 10.0) -> Mesh:
        """The surface of a collider where it is now, for pictures: of one without end what is within ``size`` [m]."""
        return self._made.collider_surface(collider._collider, size)

    def set_target(self, collider: ColliderId, position: Sequence[float],
                   rotation: Optional[Sequence[float]] = None) -> None:
        """Where the next step takes a collider [m], with a rotation (w, x, y, z)."""
        self._made.set_collider_target(collider._collider, position, rotation)

    def set_state(self, positions: ArrayLike, velocities: ArrayLike) -> None:
        """Other positions [m] and velocities [m/s] of all vertices, m x 3 each."""
        self._made.set_state(positions, velocities)

    @overload
    def save_state(self) -> bytes: ...
    @overload
    def save_state(self, path: Union[str, "os.PathLike[str]"]) -> None: ...

    def save_state(self, path: Union[str, "os.PathLike[str]", None] = None) -> Optional[bytes]:
        """Writes the state to a file; without a path, returns its bytes. Scenes have Scene.save.

        It has positions, velocities, time, stiffnesses, targets, where colliders are and what friction remembers: not
        what bodies, constraints, forces and settings are.
        """
        if path is None:
            return bytes(self._made.state_bytes())
        self._made.write_state(os.fspath(path))
        return None

    def restore_state(self, saved: Union[str, "os.PathLike[str]", bytes]) -> None:
        """Goes on from a saved state, of a file or bytes: the steps that follow have the same bits.

        The simulation must have the same bodies, masses, constraints and colliders, added in the same order; forces and
        settings are as they are now. When this raises, nothing has changed.
        """
        if isinstance(saved, bytes):
            self._made.restore_bytes(saved)
        else:
            self._made.restore_state(os.fspath(saved))

    @property
    def settings(self) -> Dict[str, Any]:
        """All settings as they are now."""
        return self._made.settings()

    def set_settings(self, **settings: Any) -> None:
        """Changes settings; those that are left out stay."""
        self._made.set_settings(settings)

    def set_contact(self, body: Optional[BodyId] = None, **contact: Any) -> None:
        """How all touch (distance, friction, surfaces), or how one body does (distance, friction, self, ignores)."""
        if body is None:
            self._made.set_contact(contact)
        else:
            self._made.set_body_contact(body._body, contact)

    def contact(self, body: Optional[BodyId] = None) -> Dict[str, Any]:
        return self._made.contact() if body is None else self._made.body_contact(body._body)

    # ---- steps and what they leave

    def step(self) -> StepReport:
        """Takes one step, without the interpreter's lock. Ctrl-C raises KeyboardInterrupt, with the state as before."""
        return StepReport(**self._made.step())

    def record(self, folder: Union[str, "os.PathLike[str]"], *, every: int = 1, format: str = "npy",
               name: str = "simulation") -> "Recording":
        """Begins a run to files, with the state at hand, for `pliant render`, `plot` and `convert`.

        The folder gets frames (``format``: npy, pc2, obj, ply or none), measurements.csv, mesh.obj and run.json, of
        every so many steps. ``with simulation.record("rope") as run:``, and in it ``run.step()``.
        """
        _pliant.Recording.check(self._made, format, every)
        lock = FolderLock(folder)
        try:
            return Recording(_pliant.Recording(self._made, os.fspath(folder), format, every, name), lock)
        except BaseException:
            lock.close()
            raise

    @property
    def positions(self) -> Array:
        """Of all vertices, m x 3 [m]: looks at the state, follows it from step to step, and cannot be written to.

        Once a body is added the array keeps the numbers that it had, and this one is of the larger state.
        """
        return self._made.positions

    @property
    def velocities(self) -> Array:
        """Of all vertices, m x 3 [m/s]: as positions."""
        return self._made.velocities

    @property
    def masses(self) -> Array:
        """Of all vertices [kg]: a copy."""
        return self._made.masses

    @property
    def time(self) -> float:
        """[s]"""
        return self._made.time

    @property
    def steps_taken(self) -> int:
        return self._made.steps_taken

    @property
    def warnings(self) -> List[str]:
        """What a user may want to know: skipped constraints, forces past their stability limit. It only grows."""
        return self._made.warnings

    def contacts(self) -> NDArray[np.void]:
        """What touched colliders at the end of the last step: a structured array of CONTACT_TYPE."""
        columns = self._made.contacts()
        table = np.zeros(len(columns[0]), dtype=CONTACT_TYPE)
        for name, column in zip(CONTACT_TYPE.names or (), columns):
            table[name] = column
        return table

    def touches(self) -> Tuple[Array, Array]:
        """Of each vertex the gap to what pushes it [m], infinite where nothing does, and the force on it, m x 3 [N]."""
        return self._made.touches()

    def wrench(self, collider: ColliderId) -> Tuple[Tuple[float, float, float], Tuple[float, float, float]]:
        """The force [N] on a collider, and the torque about its position [N m]."""
        return self._made.wrench(collider._collider)

    def evaluate(self) -> Evaluation:
        """One more local step: how far the last step is from its end, and the energies."""
        return Evaluation(**self._made.evaluate())

    def step_error(self) -> Optional[StepError]:
        """How far its iterations leave the next step from convergence: a trial of it takes up to 2,000 iterations.

        The state is as before then; what contacts(), evaluate() and objective_history() tell is of the trial. None
        where there is nothing to tell. ``pliant run`` and ``check`` call a share of more than 0.5 far from
        converged: give more iterations then, or less stiffness.
        """
        found = self._made.step_error()
        return None if found is None else StepError(BodyId(found[0]), *found[1:])

    def elastic_energy(self, group: GroupId) -> float:
        """Of a group, at the last evaluate() [J]."""
        return self._made.elastic_energy(group._group)

    def kinetic_energy(self) -> float:
        """[J]"""
        return float(0.5 * np.sum(self.masses * np.sum(self.velocities**2, axis=1)))

    def potential_energy(self) -> float:
        """Of the forces that have one, such as gravity [J]."""
        return self._made.potential_energy()

    def objective_history(self) -> Array:
        """The objective before each global solve of the last step [J]."""
        return self._made.objective_history()

    def system_info(self) -> Dict[str, Any]:
        """Sizes of the matrix and its factor, the pinned vertices, the fastest frequency [rad/s]."""
        return self._made.system_info()

    def stiffness_matrix(self) -> Any:
        """K = sum of w A^T A of all constraints [N/m], m x m for each of x, y and z, as scipy.sparse.csr_matrix.

        Hard pins have no part in it. M/h^2 + K, without the rows of pinned vertices, is the matrix of a step of implicit
        Euler.
        """
        from scipy import sparse

        size = len(self.masses)
        total = sparse.csr_matrix((size, size))
        for indices, coefficients, weights, pinned in self._made.batches():
            if len(pinned):
                continue
            blocks = np.einsum("i,ira,irb->iab", weights, coefficients, coefficients)
            rows = np.broadcast_to(indices[:, :, None], blocks.shape)
            columns = np.broadcast_to(indices[:, None, :], blocks.shape)
            total = total + sparse.coo_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), (size, size)).tocsr()
        return total

    def picture(self, *, size: Tuple[int, int] = (640, 400), color: str = "none", program: str = "pliant") -> Picture:
        """What it looks like now, which notebooks show; they show a simulation itself likewise.

        By the program ``pliant``, with ``color`` "none", "stretch" or "speed"; where that is not found, or is "", a
        plain drawing. ``size`` is in pixels.
        """
        return picture_of(self, SCENE_NAMES, None, size, color, program)

    def _repr_mimebundle_(self, **_: Any) -> Dict[str, Any]:
        return {"text/plain": repr(self), **self.picture()._repr_mimebundle_()}

    def __repr__(self) -> str:
        return (f"<pliant.Simulation: {self._made.body_count()} bodies, {len(self.positions)} vertices, "
                f"{len(self._made.groups())} groups, {self.time:.6g} s>")


class Recording:
    """A run of a simulation to files: a context that ends it. No other run gets its folder meanwhile."""

    def __init__(self, made: Any, lock: FolderLock) -> None:
        self._made = made
        self._lock = lock

    def step(self) -> StepReport:
        """Takes a step and records it. When this raises, the run has ended, with what was recorded whole."""
        return StepReport(**self._made.step())

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        try:
            if error is None:
                self._made.end("ok", "")
            elif isinstance(error, KeyboardInterrupt):
                self._made.end("interrupted", "")
            else:
                self._made.end("failed", f"{type(error).__name__}: {error}")
        finally:
            self._lock.close()
