"""What the tests of hostile input share: runs the program in a folder of its own and says what is wrong with how it ends.

However wrong its input is, the program ends with ten seconds of work, one of its exit codes, in little memory, and with either
a finite result or one line that says where the mistake is, what it is and what to do."""
import csv
import dataclasses
import functools
import io
import itertools
import json
import math
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy

PLIANT = os.environ["PLIANT"]
SOURCE = pathlib.Path(os.environ["PLIANT_SOURCE_DIR"])

DONE, INPUT, DIVERGED, OUTPUT, INTERRUPTED = 0, 2, 3, 4, 130
LEGAL = (DONE, INPUT, DIVERGED)

TIME_LIMIT = 10  # [s] of work; a busy machine may make more of it on the clock
CLOCK_FACTOR = 6
LONGEST_LINE = 1000  # characters
MEMORY_FACTOR = 10  # times the input
JSON_MEMORY_FACTOR = 25  # where it is all JSON: a value of 3 characters, "{},", takes up to 70 bytes (json_text.h)
MEMORY_CONSTANT = 64 << 20  # [bytes], above the program's own
# Past so many cases of a test, one in so many is run; a sanitized program takes ten times as long, and the fuzz targets
# feed the readers under sanitizers too. HOSTILE_ALL=1: all.
DENSE_CASES, STRIDE = 30, 10
SANITIZED_DENSE_CASES, SANITIZED_STRIDE = 6, 75


@functools.cache
def is_sanitized():
    """Sanitizers make the program slow and its memory no measure; some of their own limits end it."""
    program = pathlib.Path(PLIANT).read_bytes()
    return b"__asan_init" in program or b"__tsan_init" in program


def is_left_out(i):
    """Whether case i of a test is passed over, to save time."""
    dense, stride = (SANITIZED_DENSE_CASES, SANITIZED_STRIDE) if is_sanitized() else (DENSE_CASES, STRIDE)
    return i >= dense and i % stride != 0 and "HOSTILE_ALL" not in os.environ


@dataclasses.dataclass
class Case:
    """One attack. `files` are written before the run: bytes, text, or what json.dumps takes; a callable makes anything
    else at the path it is given."""
    name: str
    arguments: list
    files: dict = dataclasses.field(default_factory=dict)
    expect: tuple = LEGAL  # exit codes
    says: str = ""  # what the error must match
    place: str = ""  # what the error names: a file of the user's, an option
    environment: dict = None  # in place of this process's
    launcher: list = dataclasses.field(default_factory=list)  # a program that runs the rest, such as prlimit
    streams: dict = dataclasses.field(default_factory=dict)  # stdin, stdout, stderr, as subprocess takes them
    interrupt_after: float = None  # [s]; SIGINT is sent then, or once the program takes it
    input_size: int = None  # [bytes]; default: that of the files
    memory_factor: int = MEMORY_FACTOR
    plain_only: bool = False  # means nothing under a sanitizer, such as a memory limit
    out: str = "out"  # the folder of the run


@dataclasses.dataclass
class Ending:
    code: int  # below 0: minus the signal
    stdout: bytes
    stderr: bytes
    seconds: float
    peak: int  # [bytes]
    hung: bool


def write_file(path, contents):
    path.parent.mkdir(parents=True, exist_ok=True)
    if callable(contents):
        contents(path)
    elif isinstance(contents, bytes):
        path.write_bytes(contents)
    elif isinstance(contents, str):
        path.write_text(contents, encoding="utf-8", newline="")
    else:
        path.write_text(json.dumps(contents))


def environment():
    options = {"ASAN_OPTIONS": "allocator_may_return_null=1:detect_leaks=0", "UBSAN_OPTIONS": "print_stacktrace=1"}
    return os.environ | options if is_sanitized() else dict(os.environ)


def wait_for(process, seconds):
    """Whether the process ended within that time; it is not reaped."""
    descriptor = os.pidfd_open(process.pid)
    try:
        poll = select.poll()
        poll.register(descriptor, select.POLLIN)
        return bool(poll.poll(1000 * seconds))
    finally:
        os.close(descriptor)


def work_of(process):
    """What a process has worked so far [s]."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def ends_within(process, limit):
    """Whether the process ends with so much more work [s]; one that only waits gets its time by the clock."""
    start, end = work_of(process), time.monotonic() + CLOCK_FACTOR * limit
    while not wait_for(process, 0.5):
        if work_of(process) - start > limit or time.monotonic() > end:
            return False
    return True


def takes_interrupts(process):
    """Whether the program has said by now what SIGINT does; a slow machine may need long to get there."""
    caught = re.search(r"SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{process.pid}/status").read_text())
    return caught is not None and bool(int(caught[1], 16) >> signal.SIGINT - 1 & 1)


def interrupt(process, after, limit):
    """Sends SIGINT after so many seconds, and not before the program takes it; none to one that ends or never does."""
    end = time.monotonic() + CLOCK_FACTOR * limit
    ended = wait_for(process, after)
    while not ended and not takes_interrupts(process) and time.monotonic() < end:
        ended = wait_for(process, 0.1)
    if not ended:
        process.send_signal(signal.SIGINT)


def run_program(arguments, folder, case=None):
    """Runs the program in a folder; its output and errors go through files outside it, unless the case has streams."""
    case = case or Case("", [])
    limit = TIME_LIMIT * (10 if is_sanitized() else 1)
    with tempfile.TemporaryFile() as stdout, tempfile.TemporaryFile() as stderr:
        streams = {"stdin": subprocess.DEVNULL, "stdout": stdout, "stderr": stderr} | case.streams
        command = [*case.launcher, PLIANT, *arguments]
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=folder, env=environment() if case.environment is None else
                                   case.environment, **streams)
        if case.interrupt_after is not None:
            interrupt(process, case.interrupt_after, limit)
        hung = not ends_within(process, limit)
        if hung:
            process.kill()
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        stdout.seek(0)
        stderr.seek(0)
        return Ending(process.returncode, stdout.read(), stderr.read(), seconds, 1024 * usage.ru_maxrss, hung)


@functools.cache
def program_peak():
    """Memory of the program when it does next to nothing [bytes]."""
    return run_program(["--version"], "/").peak


def own_peak():
    """A process starts out with the peak of the one that it was split off from [bytes]; this one's is forgotten first."""
    pathlib.Path("/proc/self/clear_refs").write_text("5")
    status = pathlib.Path("/proc/self/status").read_text()
    return 1024 * int(re.search(r"VmHWM:\s*(\d+)", status)[1])


# ---- what can be wrong with an ending

def control_characters(text):
    return re.findall(r"[\x00-\x1f\x7f-\x9f\u061c\u2028\u2029\u200e\u200f\u202a-\u202e\u2066-\u2069]", text)


def complain_of_lines(ending, case):
    """Of what stands on the standard error."""
    try:
        text = ending.stderr.decode("utf-8")
    except UnicodeDecodeError as error:
        yield f"stderr is not UTF-8: {error}"
        return
    lines = text.split("\n")
    if lines.pop() != "":
        yield "the last line of stderr has no end"
    for line in lines:
        if control_characters(line):
            yield f"control characters {control_characters(line)[:3]} in a line"
        if len(line) >= LONGEST_LINE:
            yield f"a line of {len(line)} characters"
    errors = [line for line in lines if not line.startswith("warning: ")]
    if ending.code in (DONE, INTERRUPTED):
        if errors:
            yield "an error, though the exit code says that all is well"
        return
    if len(errors) != 1:
        yield f"{len(errors)} lines of errors"
        return
    yield from complain_of_message(errors[0], ending.code, case)


def complain_of_message(error, code, case):
    if not error.startswith("pliant: error: "):
        yield "the line does not begin with 'pliant: error: '"
    if ";" not in error and "(known: " not in error:
        yield "no remedy"
    if code != DIVERGED and case.place not in error:
        yield f"does not name {case.place!r}"
    if not re.search(case.says, error):
        yield f"does not say {case.says!r}"


def is_finite_csv(text):
    """Whether every row has as many fields as the head, all of them finite numbers, but for gaps where nothing is near."""
    head, *rows = csv.reader(io.StringIO(text.decode("utf-8", "replace"), newline=""))
    return all(len(row) == len(head) and all(math.isfinite(float(field)) or (name, field) == ("smallest_gap", "inf")
                                             for name, field in zip(head, row)) for row in rows)


def refuse_constant(name):
    raise ValueError(f"{name} in JSON")


def complain_of_folder(folder, code, existed):
    """Of what a run left in its output folder."""
    names = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
    if any(".tmp-" in name for name in names):
        yield f"leftovers: {sorted(names)}"
    if code == OUTPUT or not names:
        return
    try:
        info = json.loads((folder / "run.json").read_text(), parse_constant=refuse_constant)
    except (OSError, ValueError) as error:
        if not (code == INPUT and existed):
            yield f"files without a sound run.json: {sorted(names)}: {error}"
        return
    wanted = {DONE: "ok", INPUT: "failed", DIVERGED: "diverged", INTERRUPTED: "interrupted"}.get(code)
    if not existed and info["outcome"] != wanted:
        yield f"run.json says {info['outcome']!r}, the exit code is {code}"
    yield from complain_of_results(folder, names)


def complain_of_results(folder, names):
    try:
        if "frames.npy" in names and not numpy.isfinite(numpy.load(folder / "frames.npy")).all():
            yield "frames.npy holds numbers that are not finite"
        if "measurements.csv" in names and not is_finite_csv((folder / "measurements.csv").read_bytes()):
            yield "measurements.csv holds what is not a finite number"
        for name in sorted(names):
            if name.endswith(".obj") and re.search(rb"^v.*(nan|inf)", (folder / name).read_bytes(), re.MULTILINE):
                yield f"{name} holds numbers that are not finite"
    except ValueError as error:
        yield f"a result that cannot be read: {error}"


def complain_of_ending(ending, case, input_size, own):
    if ending.hung:
        yield f"still runs after {ending.seconds:.0f} s"
        return
    if ending.code < 0:
        yield f"ended by {signal.Signals(-ending.code).name}"
    elif ending.code not in (DONE, INPUT, DIVERGED, OUTPUT, INTERRUPTED):
        yield f"exit code {ending.code}, which is none of the program's"
    elif ending.code not in case.expect:
        yield f"exit code {ending.code}, not one of {case.expect}"
    if ending.code < 0 or "stderr" not in case.streams:
        yield from complain_of_lines(ending, case)
    limit = case.memory_factor * input_size + max(program_peak(), own) + MEMORY_CONSTANT
    if ending.peak > limit and not is_sanitized():
        yield f"{ending.peak >> 20} MiB of memory for {input_size} bytes of input"


def shortened(value, length=300):
    text = value.decode("utf-8", "backslashreplace") if isinstance(value, bytes) else str(value)
    return text if len(text) <= length else f"{text[:length]}... ({len(text)} characters)"


class HostileTest(unittest.TestCase):
    """Tests by tables: attack() runs all cases, then fails with what was wrong, if anything."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="pliant-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.folder.chmod(0o755)  # for tests that run the program as someone else

    def run_case(self, case):
        """The ending, and what is wrong with it."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        folder.chmod(0o755)
        try:
            for name, contents in case.files.items():
                write_file(folder / name, contents)
            size = case.input_size
            if size is None:
                size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
            out = folder / case.out
            existed = os.path.lexists(out)
            own = own_peak()
            words = [word if isinstance(word, bytes) else os.fsencode(str(word)) for word in case.arguments]
            ending = run_program(words, folder, case)
            complaints = list(complain_of_ending(ending, case, size, own))
            if not ending.hung:
                complaints += complain_of_folder(out, ending.code, existed)
            return ending, complaints
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def attack(self, *tables):
        """Runs the cases of some tables."""
        failures, count, plain_count = {}, 0, 0
        for i, case in enumerate(itertools.chain(*tables)):
            if is_sanitized() and case.plain_only:
                plain_count += 1
                continue
            if is_left_out(i):
                continue
            count += 1
            ending, complaints = self.run_case(case)
            if complaints:
                failures.setdefault(kind_of(complaints, ending), []).append((case, ending, complaints))
        if count == 0 and plain_count > 0:
            self.skipTest("its cases are for programs without a sanitizer")
        self.assertGreater(count, 0, "no case at all")
        if failures:
            total = sum(map(len, failures.values()))
            self.fail(f"{total} of {count} cases, one of each kind:\n" + "\n".join(map(describe, failures.values())))
        return count


def kind_of(complaints, ending):
    """Equal for failures that most likely have one cause."""
    if any("UTF-8" in complaint or "control characters" in complaint for complaint in complaints):
        return "bytes of the user's in a message"
    if any("a line of" in complaint for complaint in complaints):
        return "a long line"
    said = re.sub(rb"'[^']*'|\"[^\"]*\"|[\w.]+(\[\d+\][\w.]*)+|not (a |an )?\w+", b"x", ending.stderr)
    return re.sub(r"0x\w+|[\d.]+(e[-+]\d+)?", "0", f"{complaints}{ending.code}{shortened(said)}")


def describe(alike):
    """The first of some failures that are alike, and how many there are."""
    case, ending, complaints = alike[0]
    more = f" [and {len(alike) - 1} more, such as {alike[-1][0].name}]" if len(alike) > 1 else ""
    lines = [f"* {case.name}{more}: {'; '.join(complaints)}",
             f"    exit code {ending.code}: {shortened(ending.stderr)!r}",
             f"    pliant {' '.join(shortened(argument, 100) for argument in case.arguments)}"]
    for name, contents in case.files.items():
        if not callable(contents):
            text = contents if isinstance(contents, (bytes, str)) else json.dumps(contents)
            lines.append(f"    {name}: {shortened(text, int(os.environ.get('HOSTILE_SHOWN', 200)))!r}")
    return "\n".join(lines)


# ---- what the program says of itself, so that what is new in it is attacked as well

@functools.cache
def help_text(*command):
    return run_program([*command, "--help"], "/").stdout.decode()


@functools.cache
def sub_commands():
    listed = help_text().split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+)", listed, re.MULTILINE)


def options_of(command):
    """(--option, its type as the help has it, empty for a flag) of a sub-command."""
    found = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?:,[\w,-]+)? ?([A-Z]+)?", help_text(command), re.MULTILINE)
    return [(name, kind) for name, kind in found if name != "--help"]


# ---- scenes

def scene_of(mesh, *constraints, **more):
    """A small scene of one body; keys of the body go in `body`."""
    body = {"name": "thing", "mesh": mesh, "mass": {"per_vertex": 0.1}, "constraints": list(constraints)}
    body |= more.pop("body", {})
    return {"pliant": 1, "steps": 2, "settings": {"threads": 1}, "bodies": [body]} | more


def run_scene_case(name, scene, **more):
    """A case that simulates a scene: anything that json.dumps takes, or text, or bytes."""
    files = {"scene.json": scene} | more.pop("files", {})
    return Case(name, ["run", "scene.json", "--out", "out"], files, **({"place": "scene.json"} | more))


def main():
    unittest.main(module=sys.modules["__main__"])
