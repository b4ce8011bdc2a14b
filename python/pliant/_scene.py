"""Scenes, with their events, runs and checkpoints."""
from __future__ import annotations

import json
import os
import tempfile
from types import TracebackType
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Tuple, Type, Union, overload

from . import _pliant
from ._error import Error
from ._lock import FolderLock
from ._picture import Picture, picture_of
from ._simulation import SCENE_NAMES, Simulation


class Scene:
    """A scene that was read, with its events; a context in which it is run."""

    def __init__(self, made: Any) -> None:
        self._made = made
        self.simulation = Simulation._of(made.simulation)

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        return None

    @property
    def name(self) -> str:
        return self._made.name

    @property
    def description(self) -> str:
        return self._made.description

    @property
    def steps(self) -> int:
        """That the scene asks for."""
        return self._made.steps

    @property
    def warnings(self) -> List[str]:
        return self._made.warnings

    def step(self) -> None:
        """Lets the events act that are due, and takes one step. When this raises, nothing has changed."""
        self._made.step()

    def run(self, *, steps: Optional[int] = None, out: Union[str, "os.PathLike[str]", None] = None) -> None:
        """Takes so many steps, by default up to the last one of the scene, without the interpreter's lock.

        ``out``: the folder for frames, measurements.csv, run.json and a checkpoint, as `pliant run` writes them; a run
        that is recorded begins at the present state, and no other run gets its folder meanwhile. Ctrl-C ends it with what
        was recorded whole.
        """
        left = max(0, self.steps - self.simulation.steps_taken) if steps is None else steps
        if left < 0:
            raise Error(f"run: steps: {left} is out of range; give a number from 0 up")
        if out is None:
            self._made.run("", left)
            return
        with FolderLock(out):
            self._made.run(os.fspath(out), left)

    @overload
    def save(self) -> bytes: ...
    @overload
    def save(self, path: Union[str, "os.PathLike[str]"]) -> None: ...

    def save(self, path: Union[str, "os.PathLike[str]", None] = None) -> Optional[bytes]:
        """Writes a checkpoint to a file; without a path, returns its bytes."""
        if path is not None:
            self._made.save(os.fspath(path))
            return None
        with tempfile.TemporaryDirectory() as folder:
            place = os.path.join(folder, "checkpoint.pliant")
            self._made.save(place)
            with open(place, "rb") as file:
                return file.read()

    def picture(self, *, size: Tuple[int, int] = (640, 400), color: str = "none", program: str = "pliant") -> Picture:
        """What it looks like now, with the view of the scene; see Simulation.picture.

        ``color`` may be "energy" as well.
        """
        return picture_of(self.simulation, SCENE_NAMES, self, size, color, program)

    def _repr_mimebundle_(self, **_: Any) -> Dict[str, Any]:
        return {"text/plain": repr(self), **self.picture()._repr_mimebundle_()}

    def __repr__(self) -> str:
        return f"<pliant.Scene {self.name!r}: step {self.simulation.steps_taken} of {self.steps}>"


def _changes(set: Optional[Mapping[str, Any]], overrides: Mapping[str, Any]) -> Iterator[str]:
    for name, value in overrides.items():
        field = "settings." + name if name != "steps" else name
        yield f"{field}={json.dumps(value)}"
    for path, value in (set or {}).items():
        yield f"{path}={json.dumps(value)}"


def open_scene(scene: Union[str, "os.PathLike[str]", Mapping[str, Any]], *, set: Optional[Mapping[str, Any]] = None,
               **overrides: Any) -> Scene:
    """Opens a scene: a built-in one by its name, a file, a mesh by itself, or a dictionary as scene files have it.

    Settings by keyword, such as ``iterations=20``, and ``steps``, take the place of the scene's own; ``set`` changes
    anything else by its path: ``{"bodies[curtain].constraints[bend].stiffness": 1e-3}``.
    """
    changes = list(_changes(set, overrides))
    if isinstance(scene, Mapping):
        return Scene(_pliant.parse_scene(json.dumps(scene), os.getcwd(), changes))
    return Scene(_pliant.open_scene(os.fspath(scene), changes))


def load_checkpoint(saved: Union[str, "os.PathLike[str]", bytes], *,
                    prepare: Optional[Callable[[Scene], object]] = None) -> Scene:
    """The scene as it was when it was saved, from a file or from bytes: the steps that follow have the same bits.

    ``prepare`` is called with the scene at its start, and adds again what had been added to it.
    """
    if isinstance(saved, bytes):
        content, name, folder = saved, "checkpoint", ""
    else:
        name = os.fspath(saved)
        content, folder = _pliant.read_file(name), os.path.dirname(os.path.abspath(name))
    made = _pliant.open_checkpoint(content, name, folder)
    scene = Scene(made)
    if prepare is not None:
        prepare(scene)
    made.restore(content, name)
    return scene
