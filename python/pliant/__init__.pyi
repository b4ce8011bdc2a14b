# Made by scripts/make_stubs.py from the lists of types of the library; do not edit.
import os
from typing import Any, Literal, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from ._error import Error as Error
from ._ids import BodyId as BodyId
from ._ids import ColliderId as ColliderId
from ._ids import ForceId as ForceId
from ._ids import GroupId as GroupId
from ._own import OwnConstraint as OwnConstraint
from ._own import OwnForce as OwnForce
from ._picture import Picture as Picture
from ._pliant import Mesh as Mesh
from ._results import Evaluation as Evaluation
from ._results import StepError as StepError
from ._results import StepReport as StepReport
from ._scene import Scene as Scene
from ._scene import load_checkpoint as load_checkpoint
from ._scene import open_scene as open_scene
from ._simulation import CONTACT_TYPE as CONTACT_TYPE
from ._simulation import Recording as Recording
from ._simulation import Simulation as _Simulation
from ._types import TYPES as TYPES
from ._types import ColliderOptions as ColliderOptions
from ._types import ConstraintOptions as ConstraintOptions
from ._types import ForceOptions as ForceOptions
from ._types import Options as Options
from ._types import PerVertex as PerVertex

Vector = ArrayLike
Points = ArrayLike
Values = Union[float, ArrayLike, PerVertex]
Lists = Sequence[Sequence[float]]
Stencils = Union[ArrayLike, Sequence[Sequence[int]]]
Selection = Union[str, ArrayLike, Mapping[str, Any]]

__version__: str

def scene_names() -> list[str]: ...
def material_names() -> list[str]: ...
def write_mesh(path: Union[str, os.PathLike[str]], mesh: Mesh, positions: Optional[ArrayLike] = None) -> None: ...

def read_mesh(path: Union[str, os.PathLike[str]], *, scale: float = ..., up: Literal["z", "y", "x"] = ..., drop_loose: bool = ...) -> Mesh: ...
def lattice_solid(surface: Mesh, *, spacing: float = ...) -> Mesh: ...

class Simulation(_Simulation):
    def __init__(self, *, time_step: float = ..., integrator: Literal["implicit_euler", "bdf2"] = ..., substeps: int = ..., iterations: Union[int, Literal["automatic"]] = ..., step_error: float = ..., most_iterations: int = ..., acceleration: Literal["automatic", "none", "lbfgs", "anderson", "chebyshev"] = ..., damping: float = ..., energy_projection: float = ..., tolerance: float = ..., start: Literal["prediction", "positions", "adaptive"] = ..., backend: Literal["automatic", "eigen", "cholmod"] = ..., ordering: Literal["automatic", "minimum_degree", "nested_dissection"] = ..., precision: Literal["double", "mixed"] = ..., threads: int = ...) -> None: ...
    def set_settings(  # type: ignore[override]
        self, *, time_step: float = ..., integrator: Literal["implicit_euler", "bdf2"] = ..., substeps: int = ..., iterations: Union[int, Literal["automatic"]] = ..., step_error: float = ..., most_iterations: int = ..., acceleration: Literal["automatic", "none", "lbfgs", "anderson", "chebyshev"] = ..., damping: float = ..., energy_projection: float = ..., tolerance: float = ..., start: Literal["prediction", "positions", "adaptive"] = ..., backend: Literal["automatic", "eigen", "cholmod"] = ..., ordering: Literal["automatic", "minimum_degree", "nested_dissection"] = ..., precision: Literal["double", "mixed"] = ..., threads: int = ...) -> None: ...

class Attachment(ConstraintOptions):
    """Constraint `attachment`. E = ½ w (‖z‖ − L)² beyond L, w = k or k·l, z = x − Σ bⱼ xⱼ, p in the vectors of length 0 to L (Bouaziz et al. 2014, Sec. 5)

    Options:
        on: vertices that are tied, default 'all'
        to: the body that they are tied to, which may be the same
        to_on: and what of it, default 'all'
        mode: what a vertex is tied to: see the page of attachments, default 'nearest_vertex'
        direction: of a seam: `nearest` brings its points nearer, `opposite` is the other way, default 'nearest'
        stiffness: of each tie; of seams for each meter. Default: 1e3, of seams 1e5 [N/m or N/m²]
        length: up to which a tie is slack; 0: the points are joined [m], default 0.0
        keep_distance: ties are as long as their points are apart at the start, default False
        closing_time: in which ties shorten from the distance at the start; 0: at once [s], default 0.0
    """
    def __init__(self, *, on: Selection = ..., to: BodyId = ..., to_on: Selection = ..., mode: Literal["nearest_vertex", "nearest_face", "seam", "seam_by_length"] = ..., direction: Literal["nearest", "opposite"] = ..., stiffness: Values = ..., length: float = ..., keep_distance: bool = ..., closing_time: float = ...) -> None: ...

def bar(*, cells: Sequence[int] = ..., size: Sequence[float] = ..., cut: Literal["five", "six"] = ...) -> Mesh:
    """A box of tetrahedra with a corner at the origin.

    Options:
        cells: along x, y, z, default (10, 2, 2)
        size: extent along x, y, z [m], default (1.0, 0.2, 0.2)
        cut: tetrahedra of a cell: `five` or `six`, default 'six'
    """

class Bending(ConstraintOptions):
    """Constraint `bending`. E = ½ κ a (‖v‖ − ‖v_g‖)², z = 1/(2a) Σ (cot α + cot β)(xⱼ − x₀), p in the vectors of length ‖v_g‖ (thesis Sec. 4.4.4, Eq. 4.4)

    Options:
        on: vertices that resist bending, where all their neighbors are selected too, default 'all'
        stencils: center and neighbors (for `signed` in cyclic order); with cotangents and areas
        stiffness: κ of the sheet; cotton about 1e-5, sheet metal 1 and more [N·m], default 0.001
        orientation: `absolute`: a dent costs as much as a bump; `signed`: it costs more, default 'absolute'
        cotangents: cot α + cot β of each neighbor of each stencil
        areas: of each stencil [m²]
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., orientation: Literal["absolute", "signed"] = ..., cotangents: Lists = ..., areas: Values = ...) -> None: ...

class BoxCollider(ColliderOptions):
    """Collider `box`. ‖max(|x − c| − e, 0)‖ + min(max(|x − c| − e), 0) − ρ

    Options:
        center: where it begins [m], default (0.0, 0.0, 0.0)
        size: from face to face along its axes [m], default (1.0, 1.0, 1.0)
        rounding: radius of its edges and corners, at most half of the least size [m], default 0.0
        rotation: how it is turned at the beginning: axis times angle [°], default (0.0, 0.0, 0.0)
        velocity: with which it moves on [m/s], default (0.0, 0.0, 0.0)
        angular_velocity: with which it turns on, about its position: axis times speed [rad/s], default (0.0, 0.0, 0.0)
        surface_velocity: of its surface, as of a conveyor belt; it turns with the collider [m/s], default (0.0, 0.0, 0.0)
        friction: μ of Coulomb's law; default: that of `contact`
    """
    def __init__(self, *, center: Vector = ..., size: Vector = ..., rounding: float = ..., rotation: Vector = ..., velocity: Vector = ..., angular_velocity: Vector = ..., surface_velocity: Vector = ..., friction: Values = ...) -> None: ...

class CapsuleCollider(ColliderOptions):
    """Collider `capsule`. ‖x − segment‖ − R

    Options:
        from_: one end of its axis; it turns about the middle between both [m], default (0.0, 0.0, -0.5)
        to: the other end [m], default (0.0, 0.0, 0.5)
        radius: of its surface about the axis [m], default 0.1
        velocity: with which it moves on [m/s], default (0.0, 0.0, 0.0)
        angular_velocity: with which it turns on, about its position: axis times speed [rad/s], default (0.0, 0.0, 0.0)
        surface_velocity: of its surface, as of a conveyor belt; it turns with the collider [m/s], default (0.0, 0.0, 0.0)
        friction: μ of Coulomb's law; default: that of `contact`
    """
    def __init__(self, *, from_: Vector = ..., to: Vector = ..., radius: float = ..., velocity: Vector = ..., angular_velocity: Vector = ..., surface_velocity: Vector = ..., friction: Values = ...) -> None: ...

def capsule(*, segments: int = ..., radius: float = ..., height: float = ..., top_radius: float = ...) -> Mesh:
    """The hull of two balls, one about the origin, the other above it: a closed surface.

    Options:
        segments: vertices around the axis, default 24
        radius: of the ball at the lower end [m], default 0.1
        height: between the middles of both balls [m], default 0.5
        top_radius: of the ball at the upper end; 0: `radius`, else it tapers: a limb [m], default 0.0
    """

def chain(*, links: int = ..., length: float = ..., direction: Vector = ...) -> Mesh:
    """A line of edges that begins at the origin.

    Options:
        links: edges; vertices are one more, default 10
        length: of the whole chain [m], default 1.0
        direction: from the first vertex, at the origin; of any length but 0, default (0.0, 0.0, -1.0)
    """

def cylinder(*, segments: int = ..., rows: int = ..., radius: float = ..., height: float = ..., top_radius: float = ..., caps: Literal["open", "closed"] = ...) -> Mesh:
    """A surface about the z axis, from z = 0 up.

    Options:
        segments: vertices around the axis, default 24
        rows: vertices along the axis, default 11
        radius: of the circle through the vertices [m], default 0.25
        height: along the axis [m], default 1.0
        top_radius: at the top; 0: `radius`, else a blunt cone: a skirt, a lampshade [m], default 0.0
        caps: its ends: `open` or `closed`, default 'open'
    """

class Drag(ConstraintOptions):
    """Constraint `drag`. E = ½ k ‖Σ bⱼ xⱼ − t‖², z = Σ bⱼ xⱼ, p in the target t (thesis Sec. 5.2, made implicit)

    Options:
        stencils: one to four vertices of an element each
        weights: barycentric coordinates bⱼ of the point, summing to 1; default: equal
        stiffness: of the spring of rest length zero [N/m], default 1000.0
        targets: where to; default: where the point starts [m]
    """
    def __init__(self, *, stencils: Stencils = ..., weights: Lists = ..., stiffness: Values = ..., targets: Points = ...) -> None: ...

class EdgeSpring(ConstraintOptions):
    """Constraint `edge_spring`. E = ½ k (‖x₁ − x₀‖ − L)², z = x₁ − x₀, p in the vectors of length L (thesis Sec. 4.4.3 (w = 2k))

    Options:
        on: vertices whose edges become springs, default 'all'
        stencils: pairs of vertices, in place of the edges of the mesh
        stiffness: of each spring; doubling it halves the stretch and costs no time [N/m], default 10000.0
        rest_length: default: the length at rest [m]
        reduction: `difference`: x₁ − x₀; `identity`: (x₀, x₁), which spreads changes slowly, default 'difference'
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., rest_length: Values = ..., reduction: Literal["difference", "identity"] = ...) -> None: ...

class EdgeStrain(ConstraintOptions):
    """Constraint `edge_strain`. E = ½ w (‖z‖ − 1)², w = EA·L or k·a, z = (x₁ − x₀)/L, p in the vectors of length min to max (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose edges become fibres, default 'all'
        stencils: pairs of vertices, in place of the edges of the mesh
        measure: `rope`: weight EA·L; `cloth`: weight k·a, a a third of the adjacent area, default 'rope'
        stiffness: rope: EA [N]; cloth: k [N/m] [N or N/m], default 1000.0
        rest_length: default: the length at rest [m]
        min_stretch: shortest length over rest length; 0: no pressure, default 1.0
        max_stretch: longest length over rest length, default 1.0
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., measure: Literal["rope", "cloth"] = ..., stiffness: Values = ..., rest_length: Values = ..., min_stretch: Values = ..., max_stretch: Values = ...) -> None: ...

class FibreStrain(ConstraintOptions):
    """Constraint `fibre_strain`. E = ½ k a (‖z‖ − ‖p‖)², z = F d, p in the vectors of length min to max (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose triangles have fibres, default 'all'
        stencils: triples of vertices, in place of the triangles of the mesh
        direction: of the warp, at rest; it is laid into the plane of each triangle
        grain: where no direction is given: `automatic`, v of the texture coordinates, else the axis that lies best in the surface; `uv`, v; `edge`, from the first to the second vertex of each triangle, default 'automatic'
        angle: from the warp to the fibre; 90: the weft [degrees], default 0.0
        stiffness: Young's modulus times thickness along the fibre; woven cloth about 5e3 [N/m], default 1000.0
        min_stretch: smallest stretch left alone, default 1.0
        max_stretch: largest stretch left alone, default 1.0
        taut_factor: how many times as stiff it is beyond `taut_stretch`, as threads whose waves are drawn out, default 1.0
        slack_factor: how many times as stiff it is before that, as threads that are slack at rest, default 1.0
        taut_stretch: stretch at which it is taut, default 1.01
        taut_onset: stretch from which on stiffness rises to that, from `max_stretch` to `taut_stretch`; without it all at once
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., direction: Points = ..., grain: Literal["automatic", "uv", "edge"] = ..., angle: float = ..., stiffness: Values = ..., min_stretch: Values = ..., max_stretch: Values = ..., taut_factor: float = ..., slack_factor: float = ..., taut_stretch: float = ..., taut_onset: Optional[float] = ...) -> None: ...

class Gravity(ForceOptions):
    """Force `gravity`. m g

    Options:
        acceleration: g [m/s²], default (0.0, 0.0, -9.81)
    """
    def __init__(self, *, acceleration: Vector = ...) -> None: ...

def grid(*, columns: int = ..., rows: int = ..., size: Sequence[float] = ..., plane: Literal["xy", "xz", "yz"] = ..., diagonals: Literal["forward", "backward", "alternating", "crossed"] = ...) -> Mesh:
    """A rectangle of triangles with a corner at the origin, row 0 along the first axis; vertex (i, j) is j·columns + i.

    Options:
        columns: vertices along the first axis, default 11
        rows: vertices along the second axis, default 11
        size: extent along the two axes [m], default (1.0, 1.0)
        plane: of the two axes: `xy`, `xz` or `yz`, default 'xz'
        diagonals: of the cells: `forward`, `backward`, `alternating`, or `crossed` in the middle, default 'forward'
    """

class HingeBending(ConstraintOptions):
    """Constraint `hinge`. E = ½ κ/(A₀ + A₁) (‖z‖ − ‖z_g‖)², z = Σ cᵢ xᵢ over two triangles, p in the vectors of length ‖z_g‖ (Bergou et al. 2006, Sec. 4)

    Options:
        on: vertices whose edges resist folding, default 'all'
        stencils: two edge vertices and the two opposite, in place of the edges of the mesh
        stiffness: κ of the sheet; cotton about 1e-5, sheet metal 1 and more [N·m], default 0.001
        orientation: `absolute`: both ways of folding cost the same; `signed`: they do not, default 'absolute'
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., orientation: Literal["absolute", "signed"] = ...) -> None: ...

class InHalfSpace(ConstraintOptions):
    """Constraint `half_space`. E = ½ k dist(xᵢ, half-space)², z = xᵢ, p in the points (p − o)·n ≥ 0, ‖n‖ = 1 (thesis Ch. 7)

    Options:
        on: vertices kept on the side, default 'all'
        stencils: one vertex each, in place of `on`
        stiffness: against going behind the plane [N/m], default 100000.0
        normal: out of the plane to the side that is free, of any length but zero
        origin: a point of the plane; default: where the vertex starts [m]
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., normal: Points = ..., origin: Points = ...) -> None: ...

class Line(ConstraintOptions):
    """Constraint `line`. E = ½ k dist(xᵢ, line)², z = xᵢ, p in the line o + λ d, ‖d‖ = 1 (thesis Sec. 4.4.2, Eq. 4.2)

    Options:
        on: vertices on the line, default 'all'
        stencils: one vertex each, in place of `on`
        stiffness: towards the line [N/m], default 100000.0
        direction: of the line, of any length but zero
        origin: a point of the line; default: where the vertex starts [m]
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., direction: Points = ..., origin: Points = ...) -> None: ...

class MouseSpring(ForceOptions):
    """Force `mouse_spring`. k (‖d‖ − L) d/‖d‖

    Options:
        vertices: on a spring each; or "vertex", an index, default 'all'
        anchor: the other end of the spring, which stays there until it is changed [m], default (0.0, 0.0, 0.0)
        stiffness: k, explicit: stable only while h² k/m < 4; a drag has no such limit [N/m], default 100.0
        rest_length: L [m], default 0.0
    """
    def __init__(self, *, vertices: Selection = ..., anchor: Vector = ..., stiffness: float = ..., rest_length: float = ...) -> None: ...

def net(*, columns: int = ..., rows: int = ..., size: Sequence[float] = ..., plane: Literal["xy", "xz", "yz"] = ..., diagonals: Literal["none", "both"] = ...) -> Mesh:
    """Knots and cords: the vertices of a grid, with edges alone as elements.

    Options:
        columns: knots along the first axis, default 11
        rows: knots along the second axis, default 11
        size: extent along the two axes [m], default (1.0, 1.0)
        plane: of the two axes: `xy`, `xz` or `yz`, default 'xz'
        diagonals: `none`: knots and cords; `both`: cords across the cells as well, default 'none'
    """

class OnPlane(ConstraintOptions):
    """Constraint `plane`. E = ½ k dist(xᵢ, plane)², z = xᵢ, p in the plane (p − o)·n = 0, ‖n‖ = 1 (thesis Ch. 7)

    Options:
        on: vertices in the plane, default 'all'
        stencils: one vertex each, in place of `on`
        stiffness: towards the plane [N/m], default 100000.0
        normal: of the plane, of any length but zero
        origin: a point of the plane; default: where the vertex starts [m]
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., normal: Points = ..., origin: Points = ...) -> None: ...

def panel(*, columns: int = ..., rows: int = ..., bottom: Points = ..., top: Points = ..., left: Points = ..., right: Points = ..., diagonals: Literal["forward", "backward", "alternating", "crossed"] = ...) -> Mesh:
    """A piece of cloth between four sides, which may be curved: a panel of a dress, a gore of a canopy, a sail.

    Options:
        columns: vertices along the bottom and the top, default 21
        rows: vertices along the left and the right, default 21
        bottom: which it goes through, from the left corner to the right one; default: from the origin along x [m], default [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
        top: the same of the upper side; default: from 1 m above the origin along x [m], default [(0.0, 0.0, 1.0), (1.0, 0.0, 1.0)]
        left: which it goes through between its corners, from below; default: straight [m]
        right: the same of the right side; default: straight [m]
        diagonals: of the cells: `forward`, `backward`, `alternating`, or `crossed` in the middle, default 'alternating'
    """

def pillow(*, columns: int = ..., rows: int = ..., size: Sequence[float] = ..., plane: Literal["xy", "xz", "yz"] = ..., gap: float = ...) -> Mesh:
    """Two flat faces sewn together at their border: a closed surface with outward normals.

    Options:
        columns: vertices of a face along the first axis, default 17
        rows: vertices of a face along the second axis, default 17
        size: extent along the two axes [m], default (0.5, 0.5)
        plane: of the seam: `xy`, `xz` or `yz`, default 'xz'
        gap: between the two flat faces; only their border meets [m], default 0.02
    """

class PlaneCollider(ColliderOptions):
    """Collider `plane`. n·(x − c)

    Options:
        position: a point of the plane, about which it turns [m], default (0.0, 0.0, 0.0)
        normal: of any length but zero; points to the side where bodies are, default (0.0, 0.0, 1.0)
        velocity: with which it moves on [m/s], default (0.0, 0.0, 0.0)
        angular_velocity: with which it turns on, about its position: axis times speed [rad/s], default (0.0, 0.0, 0.0)
        surface_velocity: of its surface, as of a conveyor belt; it turns with the collider [m/s], default (0.0, 0.0, 0.0)
        friction: μ of Coulomb's law; default: that of `contact`
    """
    def __init__(self, *, position: Vector = ..., normal: Vector = ..., velocity: Vector = ..., angular_velocity: Vector = ..., surface_velocity: Vector = ..., friction: Values = ...) -> None: ...

class Position(ConstraintOptions):
    """Constraint `position`. E = ½ k ‖xᵢ − t‖², z = xᵢ, p in the target t (thesis Sec. 4.4.1)

    Options:
        on: vertices to pin, default 'all'
        stencils: one vertex each, in place of `on`
        hold: `hard`: exactly at the target; `soft`: drawn to it by the stiffness, default 'hard'
        stiffness: of a soft pin; doubling it halves its distance from the target [N/m], default 100000.0
        targets: where to; default: where the vertex starts [m]
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., hold: Literal["hard", "soft"] = ..., stiffness: Values = ..., targets: Points = ...) -> None: ...

class Pressure(ForceOptions):
    """Force `pressure`. p A n

    Options:
        on: vertices whose triangles hold the pressure; they must close, default 'all'
        model: `constant`, or `gas`: p = (pressure + ambient) V₀/V − ambient, V₀ the rest volume, default 'constant'
        pressure: p inside less outside, of a gas at the rest volume; negative: it draws in [Pa], default 100.0
        ambient: outside, of a gas; the air has 101325, which asks for very small time steps [Pa], default 0.0
    """
    def __init__(self, *, on: Selection = ..., model: Literal["constant", "gas"] = ..., pressure: float = ..., ambient: float = ...) -> None: ...

class SphereCollider(ColliderOptions):
    """Collider `sphere`. ‖x − c‖ − R

    Options:
        center: where it begins [m], default (0.0, 0.0, 0.0)
        radius: of its surface [m], default 0.5
        velocity: with which it moves on [m/s], default (0.0, 0.0, 0.0)
        angular_velocity: with which it turns on, about its position: axis times speed [rad/s], default (0.0, 0.0, 0.0)
        surface_velocity: of its surface, as of a conveyor belt; it turns with the collider [m/s], default (0.0, 0.0, 0.0)
        friction: μ of Coulomb's law; default: that of `contact`
    """
    def __init__(self, *, center: Vector = ..., radius: float = ..., velocity: Vector = ..., angular_velocity: Vector = ..., surface_velocity: Vector = ..., friction: Values = ...) -> None: ...

def sphere(*, subdivisions: int = ..., radius: float = ...) -> Mesh:
    """A closed surface about the origin.

    Options:
        subdivisions: 0 is the icosahedron; each more cuts every triangle into four, default 3
        radius: of the sphere through the vertices [m], default 0.5
    """

class TestForce(ForceOptions):
    """Force `test_force`. F

    Options:
        vertices: it acts on; or "vertex", an index, default 'all'
        force: one for all vertices, or one for each [N]
        frames: [a, b]: it acts in the steps a ≤ n < b; default: always, default (0, 9007199254740992)
    """
    def __init__(self, *, vertices: Selection = ..., force: Points = ..., frames: Sequence[int] = ...) -> None: ...

class TetrahedronNeoHookean(ConstraintOptions):
    """Constraint `tetrahedron_neo_hookean`. E = v (½ μ (I − 3) + ½ λ (J − α)² − ½ μ ln(I + 1)), z = F (3 × 3) (Smith et al. 2018)

    Options:
        on: vertices whose tetrahedra resist strain, default 'all'
        stencils: quadruples of vertices, in place of the tetrahedra of the mesh
        stiffness: Young's modulus [Pa], default 100000.0
        poisson_ratio: by which what is stretched becomes thinner; rubber 0.49, default 0.45
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., poisson_ratio: float = ...) -> None: ...

class TetrahedronStrain(ConstraintOptions):
    """Constraint `tetrahedron_strain`. E = ½ k v ‖F − p‖², z = F (3 × 3), p in F with stretches from min to max, det > 0 (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose tetrahedra resist strain, default 'all'
        stencils: quadruples of vertices, in place of the tetrahedra of the mesh
        stiffness: of the material; half of it is the shear modulus [Pa], default 100000.0
        min_stretch: smallest singular value of F left alone, default 1.0
        max_stretch: largest singular value of F left alone, default 1.0
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., min_stretch: Values = ..., max_stretch: Values = ...) -> None: ...

class TetrahedronStvk(ConstraintOptions):
    """Constraint `tetrahedron_stvk`. E = v (μ ‖G‖² + ½ λ (tr G)²), z = F (3 × 3) (Sifakis and Barbič 2012, Sec. 3.3)

    Options:
        on: vertices whose tetrahedra resist strain, default 'all'
        stencils: quadruples of vertices, in place of the tetrahedra of the mesh
        stiffness: Young's modulus [Pa], default 100000.0
        poisson_ratio: by which what is stretched becomes thinner; rubber 0.49, default 0.45
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., poisson_ratio: float = ...) -> None: ...

class TetrahedronVolume(ConstraintOptions):
    """Constraint `tetrahedron_volume`. E = ½ k v ‖F − p‖², z = F (3 × 3), p in F with det F from min to max (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose tetrahedra keep their volume, default 'all'
        stencils: quadruples of vertices, in place of the tetrahedra of the mesh
        stiffness: against changes of volume [Pa], default 100000.0
        min_volume: smallest volume left alone, as a share of that at rest, default 1.0
        max_volume: largest volume left alone, as a share of that at rest, default 1.0
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., min_volume: Values = ..., max_volume: Values = ...) -> None: ...

def torus(*, major_segments: int = ..., minor_segments: int = ..., major_radius: float = ..., minor_radius: float = ...) -> Mesh:
    """A closed surface about the z axis.

    Options:
        major_segments: vertices around the axis, default 48
        minor_segments: vertices around the tube, default 24
        major_radius: R, from the center to the tube's middle [m], default 0.5
        minor_radius: r, of the tube, less than R [m], default 0.2
    """

class TriangleArea(ConstraintOptions):
    """Constraint `triangle_area`. E = ½ k a ‖F − p‖², z = F (3 × 2), p in F with σ₁ σ₂ from min to max (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose triangles keep their area, default 'all'
        stencils: triples of vertices, in place of the triangles of the mesh
        stiffness: against changes of area [N/m], default 1000.0
        min_area: smallest area left alone, as a share of that at rest, default 1.0
        max_area: largest area left alone, as a share of that at rest, default 1.0
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., min_area: Values = ..., max_area: Values = ...) -> None: ...

class TriangleBending(ConstraintOptions):
    """Constraint `triangle_bending`. E = ½ κ A Σ (‖z‖ − ‖z_g‖)², z = ∇²x of a triangle and its neighbors, 3 rows, p in the vectors of length ‖z_g‖ (Morley 1971; Oñate and Flores 2005)

    Options:
        on: vertices whose triangles resist bending, as if there were no others, default 'all'
        stencils: triangles, in place of those of the mesh
        stiffness: κ of the sheet; cotton about 1e-5, sheet metal 1 and more [N·m], default 0.001
        orientation: `absolute`: a dent costs as much as a bump; `signed`: it costs more, default 'absolute'
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., orientation: Literal["absolute", "signed"] = ...) -> None: ...

class TriangleNeoHookean(ConstraintOptions):
    """Constraint `triangle_neo_hookean`. E = a (½ μ (I − 2J) + ½ (λ + μ) (J − 1)²), z = F (3 × 2) (after Smith et al. 2018)

    Options:
        on: vertices whose triangles resist strain, default 'all'
        stencils: triples of vertices, in place of the triangles of the mesh
        stiffness: Young's modulus times thickness [N/m], default 1000.0
        poisson_ratio: by which what is stretched becomes narrower; rubber 0.49, default 0.3
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., poisson_ratio: float = ...) -> None: ...

class TriangleStrain(ConstraintOptions):
    """Constraint `triangle_strain`. E = ½ k a ‖F − p‖², z = F (3 × 2), p in F with stretches from min to max (Bouaziz et al. 2014, Sec. 5.1)

    Options:
        on: vertices whose triangles resist strain, default 'all'
        stencils: triples of vertices, in place of the triangles of the mesh
        stiffness: Young's modulus times thickness, roughly; cotton about 1e3 [N/m], default 1000.0
        min_stretch: smallest singular value of F left alone, default 1.0
        max_stretch: largest singular value of F left alone, default 1.0
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., min_stretch: Values = ..., max_stretch: Values = ...) -> None: ...

class TriangleStvk(ConstraintOptions):
    """Constraint `triangle_stvk`. E = a (μ ‖G‖² + ½ λ (tr G)²), z = F (3 × 2) (Sifakis and Barbič 2012, Sec. 3.3)

    Options:
        on: vertices whose triangles resist strain, default 'all'
        stencils: triples of vertices, in place of the triangles of the mesh
        stiffness: Young's modulus times thickness [N/m], default 1000.0
        poisson_ratio: by which what is stretched becomes narrower; rubber 0.49, default 0.3
    """
    def __init__(self, *, on: Selection = ..., stencils: Stencils = ..., stiffness: Values = ..., poisson_ratio: float = ...) -> None: ...

def tube(*, points: Points = ..., segments: int = ..., rows: int = ..., radius: float = ..., ends: Literal["open", "closed", "joined"] = ..., inside: Literal["hollow", "solid"] = ...) -> Mesh:
    """A tube around a smooth curve through given points: a hose, a cord, a ring, a knot.

    Options:
        points: which its curve goes through: two or more, of a ring three; default: from the origin 1 m up [m], default [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
        segments: vertices around the curve, default 12
        rows: vertices along the curve, default 41
        radius: of the circle through the vertices [m], default 0.02
        ends: `open`, `closed` by lids, or `joined` to each other: a ring, default 'open'
        inside: `hollow`: triangles; `solid`: filled with tetrahedra, default 'hollow'
    """

class Wind(ForceOptions):
    """Force `wind`. c A (n·(u − v)) n

    Options:
        velocity: of the air, u; model `thesis`: the vector d of Eq. 5.4 [N/m²] [m/s], default (0.0, 5.0, 0.0)
        model: `relative`: F = c A (n·(u − v)) n; `thesis`: F = A (n·d) n, without drag, and past a limit without equilibrium, since it grows with the square of the stretch, default 'relative'
        area: A of a triangle: `current`, or at `rest`: then stretched cloth catches no more wind, default 'current'
        drag: c of the relative wind; doubling it doubles the force [kg/(m² s)], default 1.0
        gust_strength: share of the velocity by which gusts vary it; 0: steady, default 0.0
        gust_period: from gust to gust [s], default 2.0
    """
    def __init__(self, *, velocity: Vector = ..., model: Literal["relative", "thesis"] = ..., area: Literal["current", "rest"] = ..., drag: float = ..., gust_strength: float = ..., gust_period: float = ...) -> None: ...
