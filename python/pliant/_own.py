"""Constraints and forces of one's own, written with NumPy."""
from __future__ import annotations

import numbers
from typing import Any, Callable, Optional

import numpy as np

from ._error import Error


class OwnConstraint:
    """Constraints of a type of one's own: E = w/2 |z - p|^2 each, with z = A x of the vertices of its stencil.

    Derive from it and define ``project``, or give a function as ``project``. Arguments:

    - ``stencils``: vertex indices of the body, (count, n), or (count,) or a mask of booleans for one vertex each
    - ``reduction``: A, (rows, n) for all or (count, rows, n); default: the vertices themselves, rows = n
    - ``stiffness``: the factor of all weights w
    - ``measure``: what w is times the stiffness, a number or (count,): lengths or areas at rest, say
    - ``fields``: rest data of each constraint, (count, f) or (count,), or one number for all
    - ``name``: of the type, in messages; default: that of the class
    """

    def __init__(self, stencils: Any, *, reduction: Any = None, stiffness: float = 1.0, measure: Any = 1.0,
                 fields: Any = None, project: Optional[Callable[..., Any]] = None, name: str = "") -> None:
        self.name = name or type(self).__name__
        if project is None and type(self).project is OwnConstraint.project:
            raise Error(f"{self.name}: define project(self, z, fields), or give project=")
        self.stencils = self._read_stencils(stencils)
        count, n = self.stencils.shape
        matrix = np.eye(n) if reduction is None else self._numbers("reduction", reduction)
        if matrix.ndim not in (2, 3) or matrix.shape[-1] != n or (matrix.ndim == 3 and len(matrix) != count):
            raise Error(f"{self.name}: reduction has the shape {matrix.shape}; give (rows, {n}) or ({count}, rows, {n})")
        self.reduction = np.broadcast_to(matrix, (count, *matrix.shape[-2:]))
        measure = self._numbers("measure", measure)
        if measure.shape not in ((), (count,)):
            raise Error(f"{self.name}: measure has the shape {measure.shape}; give one number, or ({count},)")
        self.measure = np.broadcast_to(measure, (count,))
        given = np.zeros((count, 0)) if fields is None else self._numbers("fields", fields)
        if given.ndim == 0:
            given = np.broadcast_to(given, (count,))
        if given.ndim not in (1, 2) or len(given) != count:
            raise Error(f"{self.name}: fields has the shape {given.shape}; give one number, ({count},) or ({count}, f)")
        self.fields = given[:, None] if given.ndim == 1 else given
        if not isinstance(stiffness, numbers.Real):
            raise Error(f"{self.name}: stiffness is one number for all; give one for each as measure")
        self.stiffness = float(stiffness)
        self._function = project

    def project(self, z: Any, fields: Any) -> Any:
        """The points p nearest to z that satisfy the constraints, an array of the shape of z.

        ``z`` is (count, rows, 3) and ``fields`` (count, f), of the same constraints; neither can be written. Usually
        called once an iteration with all constraints, sometimes with a part of them: p must depend on nothing but these
        two. Called from any thread, with the interpreter's lock.
        """
        assert self._function is not None
        return self._function(z, fields)

    def _numbers(self, what: str, given: Any) -> Any:
        try:
            return np.asarray(given, dtype=float)
        except (TypeError, ValueError):
            raise Error(f"{self.name}: {what}: found {given!r:.60}; give numbers") from None

    def _read_stencils(self, given: Any) -> Any:
        try:
            array = np.asarray(given)
        except ValueError:
            array = np.asarray("ragged")
        if array.dtype == bool and array.ndim == 1:
            array = np.flatnonzero(array)
        if array.ndim not in (1, 2) or (array.size and array.dtype.kind not in "iu"):
            raise Error(f"{self.name}: stencils: found {given!r:.60}; give vertex indices, (count, n) or (count,), or a "
                        "mask of booleans")
        if array.size and not -2**31 <= array.min() <= array.max() < 2**31:
            raise Error(f"{self.name}: stencils: an index is out of range")
        array = array.astype(np.int32)
        return array[:, None] if array.ndim == 1 else array


class OwnForce:
    """A force of one's own. Derive from it and define ``force``, or give a function."""

    def __init__(self, force: Optional[Callable[..., Any]] = None, name: str = "") -> None:
        self._function = force
        self.name = name or type(self).__name__

    def force(self, positions: Any, velocities: Any, masses: Any, time: float, time_step: float) -> Any:
        """The force on every vertex [N], (m, 3), at the beginning of a step; the arrays are copies."""
        if self._function is None:
            raise NotImplementedError(f"{type(self).__name__}: define force(self, positions, ...), or give a function")
        return self._function(positions, velocities, masses, time, time_step)
