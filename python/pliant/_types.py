"""The classes of options: one for each type that the library lists, made from what the type says of itself."""
from __future__ import annotations

import inspect
import keyword
from typing import Any, Dict, List

from . import _pliant


def python_name(name: str) -> str:
    """`from_` for an option `from`, which Python has as a word of its own."""
    return name + "_" if keyword.iskeyword(name) else name


class PerVertex:
    """Numbers of which each vertex of a body has one; a constraint has the mean of its vertices'."""

    def __init__(self, values: Any) -> None:
        self.per_vertex = values

    def __repr__(self) -> str:
        return f"PerVertex({self.per_vertex!r})"


class Options:
    """Options by keyword. Those that are left out have their defaults; all can be read as attributes."""

    _fields: List[Dict[str, Any]] = []

    def __init__(self, **given: Any) -> None:
        words = {python_name(field["name"]): field["name"] for field in self._fields}
        self._given = {words.get(name, name): value for name, value in given.items()}
        _pliant.check_options(type(self).__name__, self._given)

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            for field in self._fields:
                if python_name(field["name"]) == name:
                    return self._given.get(field["name"], field["default"])
        raise AttributeError(f"{type(self).__name__} has no option '{name}'")

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *(python_name(field["name"]) for field in self._fields)]

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and repr(self) == repr(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        given = ", ".join(f"{python_name(name)}={value!r}" for name, value in self._given.items())
        return f"{type(self).__name__}({given})"


class ConstraintOptions(Options):
    """What all types of constraints are: ``simulation.add(body, ...)`` adds a group of them."""


class ForceOptions(Options):
    """What all forces of the library are: ``simulation.add(...)`` adds one, for all bodies or for one."""


class ColliderOptions(Options):
    """What all colliders are: ``simulation.add(...)`` adds one."""


_BASES = {"constraint": ConstraintOptions, "force": ForceOptions, "collider": ColliderOptions}


def option_line(field: Dict[str, Any]) -> str:
    """'stiffness: k of Hooke's law [N/m], default 1000.0'."""
    line = f"{python_name(field['name'])}: {field['doc']}"
    if field["unit"]:
        line += f" [{field['unit']}]"
    return line if field["default"] is None else line + f", default {field['default']!r}"


def option_lines(fields: List[Dict[str, Any]]) -> str:
    return "\n".join(f"    {option_line(field)}" for field in fields)


def doc_of(described: Dict[str, Any]) -> str:
    kind = described["kind"]
    head = {"shape": "", "settings": "Settings."}.get(kind, f"{kind.capitalize()} `{described['scene_name']}`.")
    head = f"{head} {described['summary']}".strip()
    return f"{head}\n\nOptions:\n{option_lines(described['fields'])}\n"


def signature_of(fields: List[Dict[str, Any]]) -> inspect.Signature:
    parameters = [
        inspect.Parameter(python_name(field["name"]), inspect.Parameter.KEYWORD_ONLY, default=field["default"],
                          annotation=field["type"])
        for field in fields
    ]
    return inspect.Signature(parameters)


TYPES: Dict[str, Dict[str, Any]] = _pliant.describe_types()


def make_classes() -> Dict[str, type]:
    classes: Dict[str, type] = {}
    for name, described in TYPES.items():
        base = _BASES.get(described["kind"])
        if base is not None:
            classes[name] = type(name, (base,), {
                "__doc__": doc_of(described), "__module__": "pliant", "_fields": described["fields"],
                "__signature__": signature_of(described["fields"])})
    return classes


def make_shapes() -> Dict[str, Any]:
    def shape_of(class_name: str, described: Dict[str, Any]) -> Any:
        def shape(**options: Any) -> Any:
            return _pliant.make_shape(class_name, options)

        shape.__name__ = shape.__qualname__ = described["scene_name"]
        shape.__module__ = "pliant"
        shape.__doc__ = doc_of(described)
        shape.__signature__ = signature_of(described["fields"])  # type: ignore[attr-defined]
        return shape

    return {described["scene_name"]: shape_of(name, described)
            for name, described in TYPES.items() if described["kind"] == "shape"}
