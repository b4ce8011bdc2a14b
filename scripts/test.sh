#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test.
#   scripts/test.sh [PRESET [OPTION...]]   a preset of CMakePresets.json; release when none is given; options for ctest
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset="${1:-release}"
shift $(($# > 0 ? 1 : 0))

scripts/setup.sh
cmake --preset "$preset"
cmake --build --preset "$preset"
if ! ctest --preset "$preset" --parallel "$(nproc)" "$@"; then
  echo "test.sh: tests FAILED (preset $preset), see above" >&2
  exit 1
fi
echo "All tests passed (preset $preset)."
