"""What a simulation tells about a step and about its state."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

from ._ids import BodyId


@dataclass(frozen=True)
class StepReport:
    """What a step tells about itself: iterations, the largest residual force on a vertex [N], seconds, contact."""

    iterations: int
    backtracks: int
    reached_tolerance: bool
    residual: float
    seconds_local: float
    seconds_global: float
    seconds_factor: float
    seconds_total: float
    contacts: int
    deepest: float
    pairs: int
    smallest_gap: float
    momentum_lost: Tuple[float, float, float]


@dataclass(frozen=True)
class Evaluation:
    """The largest force left on a vertex [N], and the parts of the objective [J]."""

    residual: float
    inertia: float
    elastic: float
    outside: float
    contact: float
    objective: float


@dataclass(frozen=True)
class StepError:
    """How far a step ends from where it would with a great many iterations, of the body in which that is farthest.

    ``distance`` is the root of the mean square [m], ``acceleration`` what that is over the square of the time step
    [m/s^2], ``share`` its share in gravity or in how strongly the step accelerates the body, if that is more.
    """

    body: BodyId
    distance: float
    acceleration: float
    share: float
