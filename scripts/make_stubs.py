"""Prints python/pliant/__init__.pyi, made from the lists of the library:

    PYTHONPATH=build/release/python python3 scripts/make_stubs.py > python/pliant/__init__.pyi
"""
import textwrap

import pliant
from pliant._types import doc_of, python_name

HEAD = '''\
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
'''


def annotation(field):
    text = field["type"]
    optional = text.endswith(" | None")
    parts = text[: -len(" | None")].split(" | ") if optional else text.split(" | ")
    made = parts[0] if len(parts) == 1 else f"Union[{', '.join(parts)}]"
    return f"Optional[{made}]" if optional else made


def arguments(fields):
    return ", ".join(f"{python_name(field['name'])}: {annotation(field)} = ..." for field in fields)


def doc(text, indent):
    return textwrap.indent('"""' + text.rstrip() + '\n"""', indent)


def stub():
    lines = [HEAD]
    fields = {name: described["fields"] for name, described in pliant.TYPES.items()}
    lines.append(f"def read_mesh(path: Union[str, os.PathLike[str]], *, {arguments(fields['ImportOptions'])}) -> Mesh: ...")
    lines.append(f"def lattice_solid(surface: Mesh, *, {arguments(fields['LatticeOptions'])}) -> Mesh: ...\n")
    lines.append("class Simulation(_Simulation):")
    lines.append(f"    def __init__(self, *, {arguments(fields['SolverSettings'])}) -> None: ...")
    lines.append(f"    def set_settings(  # type: ignore[override]\n        self, *, {arguments(fields['SolverSettings'])}) -> None: ...\n")
    for name, described in pliant.TYPES.items():
        kind = described["kind"]
        if kind == "shape":
            lines.append(f"def {described['scene_name']}(*, {arguments(described['fields'])}) -> Mesh:")
            lines.append(doc(doc_of(described), "    ") + "\n")
        elif kind != "settings":
            lines.append(f"class {name}({kind.capitalize()}Options):")
            lines.append(doc(doc_of(described), "    "))
            lines.append(f"    def __init__(self, *, {arguments(described['fields'])}) -> None: ...\n")
    return "\n".join(lines).rstrip() + "\n"


if __name__ == "__main__":
    print(stub(), end="")
