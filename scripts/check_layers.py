#!/usr/bin/env python3
"""Checks who includes whom: a folder of src/pliant or src/pliant_io is a layer, and sees only the layers listed for it.

  scripts/check_layers.py              checks this tree; prints file:line of each offence, exit code 1 if there is one
  scripts/check_layers.py --self-test  checks this script
"""
import re
import sys
import tempfile
from pathlib import Path

# What a layer may include besides itself: whole targets or layers, or single headers of a layer.
LAYERS = {
    "pliant/core": [],
    "pliant/mesh": ["pliant/core"],
    "pliant/collision": ["pliant/core", "pliant/mesh"],
    "pliant/constraints": ["pliant/core", "pliant/mesh"],
    "pliant/forces": ["pliant/core", "pliant/mesh", "pliant/constraints/constraint_group.h", "pliant/constraints/batch.h",
                      "pliant/constraints/reorder.h"],
    "pliant/solver": ["pliant/core", "pliant/constraints/constraint_group.h",
                      "pliant/constraints/kernels/local_kernels.h", "pliant/constraints/linear_forces.h", "pliant/forces/force.h",
                      "pliant/collision/contact", "pliant/collision/pairs"],
    "pliant/simulation": ["pliant/core", "pliant/mesh", "pliant/collision/colliders", "pliant/collision/contact",
                          "pliant/collision/pairs", "pliant/collision/crossings.h",
                          "pliant/constraints", "pliant/forces", "pliant/solver"],
}
LAYERS["pliant/timeline"] = LAYERS["pliant/simulation"] + ["pliant/simulation"]
LAYERS["pliant/materials"] = LAYERS["pliant/simulation"] + ["pliant/simulation"]
# All of the algorithm, and of files what is below.
LAYERS["pliant_io/files"] = ["pliant"]
LAYERS["pliant_io/mesh"] = LAYERS["pliant_io/files"] + ["pliant_io/files"]
LAYERS["pliant_io/scene"] = LAYERS["pliant_io/mesh"] + ["pliant_io/mesh"]
LAYERS["pliant_io/checkpoint"] = LAYERS["pliant_io/scene"] + ["pliant_io/scene"]
LAYERS["pliant_io/recorder"] = LAYERS["pliant_io/mesh"] + ["pliant_io/mesh"]
LAYERS["pliant_io/export"] = LAYERS["pliant_io/recorder"] + ["pliant_io/recorder"]
TARGETS = ["pliant", "pliant_io"]

# The algorithm knows numbers, not files.
FILE_HEADERS = {"fstream", "filesystem", "cstdio"}

# Folders outside the library; they use its public headers.
USERS = ["apps", "examples", "experiments", "python", "tests", "web"]

# Third-party headers by the start of their name, and the folders whose sources may include them. Only the first two are
# known to the users of an installed library, so only they may stand in its public headers.
THIRD_PARTY = {
    "Eigen/": ["src", "apps", "examples", "experiments", "python", "tests", "web"],
    "unsupported/Eigen/": [],
    "fmt/": ["src", "apps", "experiments", "tests"],
    "nlohmann/": ["src/pliant_io", "apps", "experiments", "tests"],
    "CLI/": ["apps", "tests/pairs"],
    "zlib": ["src/pliant_io/files"],
    "pugixml": ["src/pliant_io/mesh"],
    "cholmod": ["src/pliant/solver/global/factorization", "apps/bench"],
    "epoxy/": ["apps/render"],
    "GLFW/": ["apps/viewer", "tests"],
    "imgui": ["apps/render", "apps/viewer"],
    "backends/imgui": ["apps/render", "apps/viewer"],
    "stb/": ["apps/render", "tests"],
    "webp/": ["apps/viewer"],
    "doctest/": ["tests"],
    "pybind11/": ["python"],
}
IN_PUBLIC_HEADERS = ["Eigen/"]

# Headers of one operating system, and the files of src/ and apps/ that may include them: by their folder, or by the end
# of their name.
SYSTEM_HEADERS = re.compile(
    r"(arpa|linux|net|netinet|sys)/.+|(aio|csignal|dirent|dlfcn|execinfo|fcntl|glob|grp|io|langinfo|link|malloc|mqueue"
    r"|netdb|poll|pthread|pwd|sched|semaphore|shlobj|signal|spawn|strings|syslog|termios|unistd|wait|windows|winsock2)(\.h)?")
SYSTEM_FOLDERS = ["apps/system"]
SYSTEM_SOURCES = ("_posix.cpp", "_windows.cpp")

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def includes(path):
    """Yields (line number, name, is_quoted) of each include of a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1] or match[2], match[1] is not None


def is_allowed(target, allowed):
    """Whether `target`, a path below src/pliant, is one of the headers, or lies in one of the layers, of `allowed`."""
    return any(target == entry or target.startswith(entry + "/") for entry in allowed)


def climbs_out(file, name):
    """Whether "name", taken from where `file` lies, leaves the top folder that `file` is in."""
    depth = file.count("/") - 1
    for part in name.split("/"):
        depth += -1 if part == ".." else 1
        if depth < 0:
            return True
    return False


def layer_of(path):
    """The layer "pliant/core" of a path below src; None for an umbrella header."""
    parts = path.split("/")
    return "/".join(parts[:2]) if len(parts) > 2 else None


def library_offence(layer, target):
    """What is wrong with a file of `layer` (None: an umbrella header) including `target`, a path below src."""
    target_layer = layer_of(target)
    if "/detail/" in target and target_layer != layer and (layer is None or target.startswith("pliant/")):
        return f"{target} is private to {target_layer}"
    if layer is None:
        return None
    if target_layer is None:
        return f"{target} is for users of the library, not for its layers"
    if target_layer not in LAYERS:
        return f"{target} is in no layer that scripts/check_layers.py knows"
    if target_layer != layer and not is_allowed(target, LAYERS[layer]):
        return f"{layer} may include {', '.join(LAYERS[layer]) or 'no other layer'}; not {target}"
    return None


def third_party_offence(file, name, is_public_header):
    """What is wrong with `file`, a path below the root, including <name>."""
    for prefix, folders in THIRD_PARTY.items():
        if not name.startswith(prefix):
            continue
        if not is_allowed(file, folders):
            return f"<{name}> belongs to {', '.join(folders) or 'nobody'}"
        if is_public_header and prefix not in IN_PUBLIC_HEADERS:
            return f"<{name}> in a public header, which an installed library cannot serve; move it to a source or detail/"
    return None


def system_offence(file, name):
    """What is wrong with `file`, a path below the root, including <name> of an operating system."""
    is_checked = file.startswith(("src/", "apps/")) and SYSTEM_HEADERS.fullmatch(name)
    if not is_checked or is_allowed(file, SYSTEM_FOLDERS) or file.endswith(SYSTEM_SOURCES):
        return None
    return (f"<{name}> is of one operating system; it belongs behind an interface, in {', '.join(SYSTEM_FOLDERS)} or a "
            f"source {' or '.join(SYSTEM_SOURCES)}")


def file_offences(root, path):
    """Yields (line number, message) for one source or header."""
    file = path.relative_to(root).as_posix()
    parts = file.split("/")
    in_library = parts[0] == "src"
    layer = layer_of(file[len("src/"):]) if in_library else None
    if in_library and layer is not None and layer not in LAYERS:
        yield 1, f"src/{layer} is no layer that scripts/check_layers.py knows"
        return
    is_public_header = in_library and path.suffix == ".h" and "detail" not in parts
    for number, name, is_quoted in includes(path):
        message = None
        if name.split("/")[0] in TARGETS:
            if in_library and not is_quoted:
                message = f'<{name}> is our own: write "{name}"'
            elif in_library and parts[1] == "pliant" and not name.startswith("pliant/"):
                message = f"the algorithm needs no files: not {name}"
            elif in_library:
                message = library_offence(layer, name)
            elif "/detail/" in name:
                message = f"{name} is private to the library"
        elif in_library and is_quoted:
            message = f'"{name}" should be written "{parts[1]}/<layer>/<file>.h"'
        elif climbs_out(file, name):
            message = f'"{name}" leaves {parts[0]}/; the library is included as "pliant/<layer>/<file>.h"'
        elif in_library and parts[1] == "pliant" and name in FILE_HEADERS:
            message = f"the algorithm must not read or write files: <{name}>"
        else:
            message = system_offence(file, name) or third_party_offence(file, name, is_public_header)
        if message:
            yield number, message


def tree_offences(root):
    """All offences of a tree as lines "file:line: message", and the number of files looked at."""
    files = sorted(path for folder in ["src", *USERS] for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp"))
    lines = [f"{path.relative_to(root)}:{number}: {message}"
             for path in files for number, message in file_offences(root, path)]
    return lines, len(files)


# One include a case: the file, its include, and whether it is an offence.
SELF_TEST = [
    ("src/pliant/core/a.h", "<vector>", False),
    ("src/pliant/core/a.h", '"pliant/core/b.h"', False),
    ("src/pliant/core/a.h", '"pliant/mesh/b.h"', True),
    ("src/pliant/core/a.h", '"b.h"', True),
    ("src/pliant/core/a.h", "<pliant/core/b.h>", True),
    ("src/pliant/core/a.h", "<Eigen/Core>", False),
    ("src/pliant/core/a.h", "<fmt/format.h>", True),
    ("src/pliant/core/a.cpp", "<fmt/format.h>", False),
    ("src/pliant_io/mesh/a.cpp", '"pliant/core/b.h"', False),
    ("src/pliant_io/mesh/a.cpp", '"pliant/constraints/b.h"', False),
    ("src/pliant/mesh/a.cpp", '"pliant/pliant.h"', True),
    ("src/pliant/collision/a.h", '"pliant/mesh/b.h"', False),
    ("src/pliant/collision/a.cpp", '"pliant/solver/b.h"', True),
    ("src/pliant/constraints/a.h", '"pliant/mesh/b.h"', False),
    ("src/pliant/constraints/a.h", '"pliant/forces/b.h"', True),
    ("src/pliant/constraints/a.h", '"pliant/solver/b.h"', True),
    ("src/pliant/forces/a.h", '"pliant/constraints/b.h"', True),
    ("src/pliant/forces/a.h", '"pliant/constraints/constraint_group.h"', False),
    ("src/pliant/solver/a.h", '"pliant/constraints/constraint_group.h"', False),
    ("src/pliant/solver/a.h", '"pliant/forces/force.h"', False),
    ("src/pliant/solver/a.h", '"pliant/forces/wind.h"', True),
    ("src/pliant/solver/a.h", '"pliant/constraints/batch.h"', True),
    ("src/pliant/solver/a.h", '"pliant/mesh/mesh.h"', True),
    ("src/pliant/solver/a.cpp", '"pliant_io/files/atomic_file.h"', True),
    ("src/pliant/solver/a.cpp", "<fstream>", True),
    ("src/pliant/solver/a.cpp", "<nlohmann/json.hpp>", True),
    ("src/pliant/solver/a.cpp", "<cholmod.h>", True),
    ("src/pliant/solver/global/factorization/a.cpp", "<cholmod.h>", False),
    ("src/pliant/solver/global/factorization/a.h", "<cholmod.h>", True),
    ("src/pliant/simulation/a.cpp", '"pliant/solver/b.h"', False),
    ("src/pliant/simulation/a.cpp", '"pliant_io/scene/b.h"', True),
    ("src/pliant_io/scene/a.cpp", '"pliant/simulation/b.h"', False),
    ("src/pliant_io/scene/a.cpp", '"pliant_io/recorder/b.h"', True),
    ("src/pliant_io/scene/a.cpp", "<nlohmann/json.hpp>", False),
    ("src/pliant_io/scene/a.h", "<nlohmann/json.hpp>", True),
    ("src/pliant_io/scene/detail/a.h", "<nlohmann/json.hpp>", False),
    ("src/pliant_io/scene/a.cpp", '"pliant_io/scene/detail/b.h"', False),
    ("src/pliant_io/recorder/a.cpp", '"pliant_io/scene/b.h"', True),
    ("src/pliant_io/recorder/a.cpp", '"pliant/simulation/detail/b.h"', True),
    ("src/pliant/helpers/a.cpp", "<vector>", True),
    ("src/pliant/pliant.h", '"pliant/simulation/b.h"', False),
    ("src/pliant/pliant.h", "<nlohmann/json.hpp>", True),
    ("apps/cli/a.cpp", '"pliant_io/scene/b.h"', False),
    ("apps/cli/a.cpp", '"pliant_io/scene/detail/b.h"', True),
    ("apps/cli/a.cpp", "<CLI/CLI.hpp>", False),
    ("apps/cli/a.cpp", '"../../src/pliant_io/scene/b.h"', True),
    ("examples/a.cpp", '"pliant/pliant.h"', False),
    ("examples/a.cpp", "<fmt/format.h>", True),
    ("tests/mesh/a.cpp", "<doctest/doctest.h>", False),
    ("examples/a.cpp", "<pliant/pliant.h>", False),
    ("tests/mesh/a.cpp", '"tests/support/b.h"', False),
    ("tests/mesh/a.cpp", '"../support/b.h"', False),
    ("tests/mesh/a.cpp", '"../../src/pliant/mesh/b.h"', True),
    ("tests/mesh/a.cpp", '"pliant/mesh/detail/b.h"', True),
    ("src/pliant_io/mesh/a.cpp", '"pliant_io/mesh/detail/b.h"', False),
    ("src/pliant/core/a.cpp", "<nlohmann/json.hpp>", True),
    ("src/pliant/core/a.cpp", "<zlib.h>", True),
    ("src/pliant/timeline/a.cpp", '"pliant_io/mesh/b.h"', True),
    ("src/pliant/pliant.h", '"pliant_io/mesh/b.h"', True),
    ("src/pliant_io/files/a.cpp", "<zlib.h>", False),
    ("src/pliant_io/files/a.cpp", '"pliant_io/mesh/b.h"', True),
    ("src/pliant_io/pliant_io.h", '"pliant_io/scene/b.h"', False),
    ("src/pliant_io/export/a.cpp", '"pliant_io/checkpoint/b.h"', True),
    ("src/pliant/core/a.cpp", "<unistd.h>", True),
    ("src/pliant_io/files/a.cpp", "<sys/stat.h>", True),
    ("src/pliant_io/files/detail/a_posix.cpp", "<fcntl.h>", False),
    ("src/pliant_io/files/detail/a_windows.cpp", "<windows.h>", False),
    ("apps/cli/a.cpp", "<csignal>", True),
    ("apps/system/a.cpp", "<sys/resource.h>", False),
    ("tests/cli/a.cpp", "<sys/wait.h>", False),
]


def self_test():
    """Each case in a tree of its own: an offence is reported with its line, and nothing else is."""
    failures = 0
    for file, include, is_offence in SELF_TEST:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, file)
            path.parent.mkdir(parents=True)
            path.write_text(f"#pragma once\n// a comment\n#include {include}\n", encoding="utf-8")
            lines, count = tree_offences(Path(folder))
        in_unknown_layer = file.startswith("src/pliant/helpers/")
        place = f"{file}:{1 if in_unknown_layer else 3}: "
        expected = count == 1 and (len(lines) == 1 and lines[0].startswith(place) if is_offence else not lines)
        if not expected:
            failures += 1
            print(f"check_layers.py --self-test: {file} with #include {include}: "
                  f"expected {'an offence' if is_offence else 'none'}, found {lines}", file=sys.stderr)
    return failures


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    lines, count = tree_offences(Path(__file__).resolve().parent.parent)
    if count == 0:
        print("check_layers.py: found no C++ files to check", file=sys.stderr)
        return 1
    for line in lines:
        print(line)
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
