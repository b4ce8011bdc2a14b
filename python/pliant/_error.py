"""What the library refuses."""


class Error(RuntimeError):
    """What went wrong, in one line: what, where, and what to do about it.

    ``kind`` is ``"input"`` (a value, a file or a scene), ``"diverged"`` (a step would have had a position that is not
    finite), ``"output"`` (a file that cannot be written) or ``"interrupted"``. A call that raises has changed nothing.
    """

    def __init__(self, message: str, kind: str = "input") -> None:
        super().__init__(message)
        self.kind = kind
