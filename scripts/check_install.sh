#!/usr/bin/env bash
# Installs a finished build to a place of its own, then builds and runs examples/consumer against what was installed.
#   scripts/check_install.sh [PRESET]   release when none is given; it must have been built
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset="${1:-release}"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cmake --install "build/$preset" --prefix "$work/prefix" >"$work/install.log"
cp -r examples/consumer "$work/source" # away from this tree, so that nothing but the installed package is found
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/build"
(cd "$work/build" && ./consumer)
(cd "$work" && prefix/bin/pliant --version)
echo "The installed package works."
