#!/usr/bin/env python3
"""Checks who includes whom: a folder of src/pliant is a layer, and sees only the layers listed for it.

  scripts/check_layers.py              checks this tree; prints file:line of each offence, exit code 1 if there is one
  scripts/check_layers.py --self-test  checks this script
"""
import re
import sys
import tempfile
from pathlib import Path

# What a layer may include besides itself: whole layers, or single headers of a layer.
LAYERS = {
    "core": [],
    "mesh": ["core"],
    "constraints": ["core", "mesh"],
    "forces": ["core", "mesh"],
    "collision": ["core", "mesh", "constraints/constraint_group.h"],
    "solver": ["core", "constraints/constraint_group.h", "forces/force.h"],
    "simulation": ["core", "mesh", "constraints", "forces", "collision", "solver"],
}
LAYERS["scene"] = LAYERS["recorder"] = LAYERS["simulation"] + ["simulation"]

# The solver knows numbers, not files.
HIDDEN_FROM = {"solver": ["core/atomic_file.h"]}
FILE_HEADERS = {"fstream", "filesystem", "cstdio"}
NO_FILES = {"solver"}

# Folders outside the library; they use its public headers.
USERS = ["apps", "benchmarks", "examples", "experiments", "python", "tests", "web"]

# Third-party headers by the start of their name, and the folders whose sources may include them. Only the first two are
# known to the users of an installed library, so only they may stand in its public headers.
THIRD_PARTY = {
    "Eigen/": ["src/pliant", "apps", "benchmarks", "examples", "experiments", "python", "tests", "web"],
    "unsupported/Eigen/": [],
    "fmt/": ["src/pliant", "apps", "benchmarks", "experiments", "tests"],
    "nlohmann/": ["src/pliant/scene", "src/pliant/recorder", "apps", "tests"],
    "CLI/": ["apps"],
    "zlib": ["src/pliant/core"],
    "cholmod": ["src/pliant/solver/factorization", "apps/bench", "benchmarks"],
    "epoxy/": ["apps/render"],
    "GLFW/": ["apps/viewer", "tests"],
    "imgui": ["apps/render", "apps/viewer"],
    "backends/imgui": ["apps/render", "apps/viewer"],
    "stb/": ["apps/render", "tests"],
    "doctest/": ["tests"],
}
IN_PUBLIC_HEADERS = ["Eigen/"]

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


def library_offence(layer, target):
    """What is wrong with a file of `layer` (None: the umbrella header) including "pliant/`target`"."""
    target_layer = target.split("/")[0] if "/" in target else None
    if "/detail/" in target and target_layer != layer:
        return f"pliant/{target} is private to {target_layer}"
    if layer is None:
        return None
    if target_layer is None:
        return f"pliant/{target} is for users of the library, not for its layers"
    if target_layer not in LAYERS:
        return f"pliant/{target} is in no layer that scripts/check_layers.py knows"
    if target in HIDDEN_FROM.get(layer, []):
        return f"{layer} must not include pliant/{target}"
    if target_layer != layer and not is_allowed(target, LAYERS[layer]):
        return f"{layer} may include {', '.join(LAYERS[layer]) or 'no other layer'}; not pliant/{target}"
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


def file_offences(root, path):
    """Yields (line number, message) for one source or header."""
    file = path.relative_to(root).as_posix()
    parts = file.split("/")
    in_library = parts[:2] == ["src", "pliant"]
    layer = parts[2] if in_library and len(parts) > 3 else None
    if layer is not None and layer not in LAYERS:
        yield 1, f"src/pliant/{layer} is no layer that scripts/check_layers.py knows"
        return
    is_public_header = in_library and path.suffix == ".h" and "detail" not in parts
    for number, name, is_quoted in includes(path):
        message = None
        if name.startswith("pliant/"):
            target = name[len("pliant/"):]
            if in_library and not is_quoted:
                message = f'<{name}> is our own: write "{name}"'
            elif in_library:
                message = library_offence(layer, target)
            elif "/detail/" in target:
                message = f"{name} is private to the library"
        elif in_library and is_quoted:
            message = f'"{name}" should be written "pliant/<layer>/<file>.h"'
        elif climbs_out(file, name):
            message = f'"{name}" leaves {parts[0]}/; the library is included as "pliant/<layer>/<file>.h"'
        elif layer in NO_FILES and name in FILE_HEADERS:
            message = f"{layer} must not read or write files: <{name}>"
        else:
            message = third_party_offence(file, name, is_public_header)
        if message:
            yield number, message


def tree_offences(root):
    """All offences of a tree as lines "file:line: message", and the number of files looked at."""
    files = sorted(
        path for folder in ["src/pliant", *USERS] for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp"))
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
    ("src/pliant/mesh/io/a.cpp", '"pliant/core/b.h"', False),
    ("src/pliant/mesh/io/a.cpp", '"pliant/constraints/b.h"', True),
    ("src/pliant/mesh/a.cpp", '"pliant/pliant.h"', True),
    ("src/pliant/constraints/a.h", '"pliant/mesh/b.h"', False),
    ("src/pliant/constraints/a.h", '"pliant/forces/b.h"', True),
    ("src/pliant/constraints/a.h", '"pliant/solver/b.h"', True),
    ("src/pliant/forces/a.h", '"pliant/constraints/b.h"', True),
    ("src/pliant/collision/a.h", '"pliant/constraints/constraint_group.h"', False),
    ("src/pliant/collision/a.h", '"pliant/constraints/batch.h"', True),
    ("src/pliant/solver/a.h", '"pliant/constraints/constraint_group.h"', False),
    ("src/pliant/solver/a.h", '"pliant/forces/force.h"', False),
    ("src/pliant/solver/a.h", '"pliant/forces/wind.h"', True),
    ("src/pliant/solver/a.h", '"pliant/constraints/batch.h"', True),
    ("src/pliant/solver/a.h", '"pliant/mesh/mesh.h"', True),
    ("src/pliant/solver/a.cpp", '"pliant/core/atomic_file.h"', True),
    ("src/pliant/solver/a.cpp", "<fstream>", True),
    ("src/pliant/solver/a.cpp", "<nlohmann/json.hpp>", True),
    ("src/pliant/solver/a.cpp", "<cholmod.h>", True),
    ("src/pliant/solver/factorization/a.cpp", "<cholmod.h>", False),
    ("src/pliant/solver/factorization/a.h", "<cholmod.h>", True),
    ("src/pliant/simulation/a.cpp", '"pliant/solver/b.h"', False),
    ("src/pliant/simulation/a.cpp", '"pliant/scene/b.h"', True),
    ("src/pliant/scene/a.cpp", '"pliant/simulation/b.h"', False),
    ("src/pliant/scene/a.cpp", '"pliant/recorder/b.h"', True),
    ("src/pliant/scene/a.cpp", "<nlohmann/json.hpp>", False),
    ("src/pliant/scene/a.h", "<nlohmann/json.hpp>", True),
    ("src/pliant/scene/detail/a.h", "<nlohmann/json.hpp>", False),
    ("src/pliant/scene/a.cpp", '"pliant/scene/detail/b.h"', False),
    ("src/pliant/recorder/a.cpp", '"pliant/scene/b.h"', True),
    ("src/pliant/recorder/a.cpp", '"pliant/simulation/detail/b.h"', True),
    ("src/pliant/helpers/a.cpp", "<vector>", True),
    ("src/pliant/pliant.h", '"pliant/simulation/b.h"', False),
    ("src/pliant/pliant.h", "<nlohmann/json.hpp>", True),
    ("apps/cli/a.cpp", '"pliant/scene/b.h"', False),
    ("apps/cli/a.cpp", '"pliant/scene/detail/b.h"', True),
    ("apps/cli/a.cpp", "<CLI/CLI.hpp>", False),
    ("apps/cli/a.cpp", '"../../src/pliant/scene/b.h"', True),
    ("examples/a.cpp", '"pliant/pliant.h"', False),
    ("examples/a.cpp", "<fmt/format.h>", True),
    ("tests/mesh/a.cpp", "<doctest/doctest.h>", False),
    ("examples/a.cpp", "<pliant/pliant.h>", False),
    ("tests/mesh/a.cpp", '"tests/support/b.h"', False),
    ("tests/mesh/a.cpp", '"../support/b.h"', False),
    ("tests/mesh/a.cpp", '"../../src/pliant/mesh/b.h"', True),
    ("tests/mesh/a.cpp", '"pliant/mesh/detail/b.h"', True),
    ("src/pliant/mesh/io/a.cpp", '"pliant/mesh/io/detail/b.h"', False),
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
