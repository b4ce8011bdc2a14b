"""Constraints and forces of one's own, written with NumPy."""
from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np


class OwnConstraint:
    """Constraints of a type of one's own: E = w/2 |z - p|^2 each, with z = A x of the vertices of its stencil.

    Derive from it and define ``project``, or give a function as ``project``. Arguments:

    - ``stencils``: vertex indices of the body, (count, n), or (count,) for one vertex each
    - ``reduction``: A, (rows, n) for all or (count, rows, n); default: the vertices themselves, rows = n
    - ``stiffness``: the factor of all weights w
    - ``measure``: what w is times the stiffness, a number or (count,): lengths or areas at rest, say
    - ``fields``: rest data of each constraint, (count, f) or (count,)
    - ``name``: of the type, in messages; default: that of the class
    """

    def __init__(self, stencils: Any, *, reduction: Any = None, stiffness: float = 1.0, measure: Any = 1.0,
                 fields: Any = None, project: Optional[Callable[..., Any]] = None, name: str = "") -> None:
        self.stencils = np.asarray(stencils, dtype=np.int32)
        if self.stencils.ndim == 1:
            self.stencils = self.stencils[:, None]
        count, n = self.stencils.shape
        matrix = np.eye(n) if reduction is None else np.asarray(reduction, dtype=float)
        self.reduction = np.broadcast_to(matrix, (count, *matrix.shape[-2:]))
        self.measure = np.broadcast_to(np.asarray(measure, dtype=float), (count,))
        self.fields = np.zeros((count, 0)) if fields is None else np.asarray(fields, dtype=float)
        if self.fields.ndim == 1:
            self.fields = self.fields[:, None]
        self.stiffness = stiffness
        self.name = name or type(self).__name__
        self._function = project

    def project(self, z: Any, fields: Any) -> Any:
        """The points p nearest to z that satisfy the constraints, an array of the shape of z.

        ``z`` is (count, rows, 3) and ``fields`` (count, f), of the same constraints; neither can be written. They are
        all constraints as a rule, once an iteration, and some of them where less is asked for: p must depend on nothing
        but these two. Called from any thread, with the interpreter's lock.
        """
        if self._function is None:
            raise NotImplementedError(f"{type(self).__name__}: define project(self, z, fields), or give project=")
        return self._function(z, fields)


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
