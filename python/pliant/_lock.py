"""One run a folder, with the locks that the program pliant takes."""
from __future__ import annotations

import os
import sys
from types import TracebackType
from typing import Optional, Type, Union

from ._error import Error

try:
    import fcntl
except ImportError:  # no locks there
    fcntl = None  # type: ignore[assignment]

NOTE = ".pliant-lock"


class FolderLock:
    """Makes a folder and keeps other runs out of it, until it is closed or the process ends.

    `.pliant-lock` tells them who has it. Where the folder cannot be made or opened nothing is locked: who writes to it
    will say why.
    """

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self._folder: Optional[int] = None
        self._process = os.getpid()
        self._note = os.path.join(folder, NOTE)
        try:
            os.makedirs(folder, exist_ok=True)
            descriptor = os.open(folder, os.O_RDONLY | getattr(os, "O_DIRECTORY", 0))
        except OSError:
            return
        try:
            if fcntl is not None:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(descriptor)
            raise Error(f"{os.fspath(folder)}: {self._owner()} writes here; wait until it ends, or give another folder",
                        "output") from None
        except OSError:  # a file system without locks
            pass
        self._folder = descriptor
        self._write_note()

    def close(self) -> None:
        if self._folder is None:
            return
        if os.getpid() == self._process:  # a process that was forked from it has no lock of its own to give up
            try:
                os.unlink(self._note)
            except OSError:
                pass
            try:
                if fcntl is not None:
                    fcntl.flock(self._folder, fcntl.LOCK_UN)  # forked processes may have the folder open
            except OSError:  # a file system without locks
                pass
        os.close(self._folder)
        self._folder = None

    def __enter__(self) -> "FolderLock":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_folder", None) is not None:
            self.close()

    def _write_note(self) -> None:
        """For people: without it the lock is as good. What stands in its place goes first and is not followed."""
        command = " ".join(sys.argv).replace("\n", " ") or "python"
        try:
            if os.path.lexists(self._note):
                os.unlink(self._note)
            with open(self._note, "x", encoding="utf-8", errors="replace") as file:
                file.write(f"{os.getpid()}\n{command}\n")
        except OSError:
            pass

    def _owner(self) -> str:
        try:
            with open(self._note, encoding="utf-8", errors="replace") as file:
                process, command = file.read(4096).splitlines()[:2]
            printable = "".join(c if c.isprintable() else "?" for c in command)
            number = int(process)
        except (OSError, ValueError):
            return "another process"
        try:
            os.kill(number, 0)
        except ProcessLookupError:
            return f"what process {number} ({printable[:300]}) started still"
        except (OSError, OverflowError):  # it is another user's
            pass
        return f"process {number} ({printable[:300]})"
