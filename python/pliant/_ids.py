"""What names a part of a simulation."""
from dataclasses import dataclass


@dataclass(frozen=True)
class BodyId:
    """A body of a simulation."""

    _body: int


@dataclass(frozen=True)
class GroupId:
    """A group of constraints of a simulation."""

    _group: int


@dataclass(frozen=True)
class ForceId:
    """A force of a simulation."""

    _force: int


@dataclass(frozen=True)
class ColliderId:
    """A collider of a simulation."""

    _collider: int
