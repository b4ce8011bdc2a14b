"""The program `pliant`: where it is, what it is made to do, and what it says."""

import atexit
import ctypes
import json
import os
import shutil
import signal
import subprocess
import tempfile

import bpy


class ProgramError(Exception):
    """What the program, or looking for it, said; one line."""


PATIENCE = 5  # [s] with a program that is to say who it is


class PliantPreferences(bpy.types.AddonPreferences):
    """What holds for all files."""

    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program",
        description="The program pliant; without it the one on the search path is taken",
        subtype="FILE_PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "program")
        try:
            self.layout.label(text=version(), icon="CHECKMARK")
        except ProgramError as error:
            self.layout.label(text=str(error), icon="ERROR")


def path():
    """The program's path. Raises ProgramError where there is none."""
    addon = bpy.context.preferences.addons.get(__package__)
    chosen = bpy.path.abspath(addon.preferences.program) if addon and addon.preferences.program else ""
    if chosen:
        if os.path.isfile(chosen) and os.access(chosen, os.X_OK):
            return chosen
        raise ProgramError(f"{chosen}: no program there; correct its path in the add-on's preferences")
    found = shutil.which("pliant")
    if found is None:
        raise ProgramError("The program pliant was not found; give its path in the add-on's preferences")
    return found


def _ask(*command):
    """What a program answers, or the ProgramError that it does not."""
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=True).stdout
    except subprocess.CalledProcessError as error:
        said = error.stderr.strip().splitlines()
        return ProgramError(f"{command[0]} is not Pliant" + (f": {said[-1]}" if said else ""))
    except (OSError, subprocess.SubprocessError, UnicodeError) as error:
        return ProgramError(f"{command[0]} is not Pliant, or does not run: {error}")


_answers = {}


def _ask_once(*arguments):
    """What the program answers, asked anew only where another one has taken its place."""
    where = path()
    key = (where, os.stat(where).st_mtime_ns, arguments)
    if key not in _answers:
        _answers[key] = _ask(where, *arguments)
    if isinstance(_answers[key], ProgramError):
        raise _answers[key]
    return _answers[key]


def version():
    """Its name and version."""
    return _ask_once("--version").strip()


def check():
    """Raises ProgramError where there is no program, or it is another one."""
    if not version().startswith("pliant "):
        raise ProgramError(f"{path()} is not Pliant; give its path in the add-on's preferences")


def materials(kind):
    """Its materials, dicts with "name", "description" and numbers; `kind` is "sheet" or "solid"."""
    try:
        return [each for each in json.loads(_ask_once("materials", "--json")) if each["kind"] == kind]
    except ValueError as error:
        raise ProgramError(f"{path()} is not Pliant: {error}") from None


_running = set()
_c_library = ctypes.CDLL(None)
_SET_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of Linux


def _end_with_blender():
    """In the child: it is told to end when Blender crashes."""
    _c_library.prctl(_SET_DEATH_SIGNAL, signal.SIGTERM)



class Run:
    """The program at work beside Blender."""

    def __init__(self, *arguments):
        # Into a file: a pipe that nobody empties would hold up the program.
        self._said = tempfile.TemporaryFile()
        try:
            self._process = subprocess.Popen(
                [path(), *arguments],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=self._said,
                preexec_fn=_end_with_blender,
            )
        except OSError as error:
            raise ProgramError(f"{path()} does not run: {error}") from None
        _running.add(self._process)

    def is_running(self):
        """Whether it is still at work."""
        if self._process.poll() is None:
            return True
        _running.discard(self._process)
        return False

    def stop(self):
        """Asks it to end, which it does after the step that it is in, or within seconds."""
        if self.is_running():
            self._process.terminate()

    def exit_code(self):
        """0: done, 130: stopped; others come with a message."""
        code = self._process.returncode
        return 130 if code in (130, -signal.SIGTERM, -signal.SIGINT) else code

    def messages(self):
        """What it has said once it has ended, line by line, as it is but for its name and the kind of message."""
        with self._said:
            self._said.seek(0)
            said = self._said.read().decode(errors="replace")
        lines = (line.removeprefix("pliant: ").removeprefix("error: ") for line in said.splitlines())
        return [line.removeprefix("warning: ") for line in lines if line.strip()]


@atexit.register
def _stop_all():
    for process in _running:
        process.terminate()
    _running.clear()


def register():
    bpy.utils.register_class(PliantPreferences)


def unregister():
    _stop_all()
    bpy.utils.unregister_class(PliantPreferences)
