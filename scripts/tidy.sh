#!/usr/bin/env bash
# Runs clang-tidy with the rules of .clang-tidy over the sources, and the headers that they include.
#   scripts/tidy.sh [--naming] [--changed | FILE.cpp...]
#     --naming    names and function sizes only, which is quick: all sources are read in the units that compile together
#     --changed   only sources that differ from the last commit
# All sources when neither --changed nor files are given, but for those of the Python module, which clang does not build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

arguments=(--quiet)
naming=0
changed=0
files=()
for argument in "$@"; do
  case "$argument" in
    --naming) naming=1; arguments+=("--checks=-*,readability-identifier-naming,readability-function-size") ;;
    --changed) changed=1 ;;
    -*) echo "tidy.sh: unknown option '$argument'" >&2; exit 2 ;;
    *) files+=("$argument") ;;
  esac
done
if ((changed)); then
  mapfile -t files < <({ git diff --name-only --diff-filter=d HEAD; git ls-files --others --exclude-standard; } |
    grep '\.cpp$' | grep -Ev '^(examples/consumer|fuzz|python)/' || true)
  if [[ ${#files[@]} -eq 0 ]]; then
    echo "clang-tidy: no source differs from the last commit, nothing was checked."
    exit 0
  fi
elif [[ ${#files[@]} -eq 0 ]] && ((!naming)); then
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.cpp' ':!examples/consumer' ':!fuzz' ':!python' |
    while read -r file; do [[ ! -e "$file" ]] || echo "$file"; done)
fi
# Nothing but what CMake generates is built. Names and sizes are checked in units of several sources, all else in every
# source by itself: there a unit would hide an include that is missing.
build=build/tidy
unity=OFF
if [[ ${#files[@]} -eq 0 ]] && ((naming)); then
  build=build/tidy_units
  unity=ON
fi
cmake --preset clang -B "$build" -DCMAKE_UNITY_BUILD="$unity" >/dev/null
cmake --build "$build" --target pliant_generated_sources >/dev/null
units=("${files[@]}")
if [[ "$unity" == ON ]]; then
  mapfile -t units < <(sed -n 's/^  "file": "\(.*\)".*/\1/p' "$build/compile_commands.json" |
    grep -Ev "^$PWD/$build/(generated|_deps)/")
fi
if [[ ${#units[@]} -eq 0 ]]; then
  echo "tidy.sh: found no sources to check" >&2
  exit 1
fi

if ! printf '%s\0' "${units[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" "${arguments[@]}"; then
  echo "tidy.sh: clang-tidy found what is listed above" >&2
  exit 1
fi
echo "clang-tidy: ${#units[@]} $([[ "$unity" == ON ]] && echo units || echo sources) are fine."
