#!/usr/bin/env bash
# Runs clang-tidy with the rules of .clang-tidy over the sources, and the headers that they include.
#   scripts/tidy.sh [--naming] [--changed | FILE.cpp...]
#     --naming    names and function sizes only, which is quick
#     --changed   only sources that differ from the last commit
# All sources when neither --changed nor files are given, but for those of the Python module, which clang does not build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

arguments=(--quiet -p build/tidy)
changed=0
files=()
for argument in "$@"; do
  case "$argument" in
    --naming) arguments+=("--checks=-*,readability-identifier-naming,readability-function-size") ;;
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
elif [[ ${#files[@]} -eq 0 ]]; then
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.cpp' ':!examples/consumer' ':!fuzz' ':!python' |
    while read -r file; do [[ ! -e "$file" ]] || echo "$file"; done)
fi
if [[ ${#files[@]} -eq 0 ]]; then
  echo "tidy.sh: found no sources to check" >&2
  exit 1
fi

# Every source by itself, as clang-tidy reads them; nothing but what CMake generates is built.
cmake --preset clang -B build/tidy -DCMAKE_UNITY_BUILD=OFF >/dev/null
cmake --build build/tidy --target pliant_generated_sources >/dev/null
if ! printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy "${arguments[@]}"; then
  echo "tidy.sh: clang-tidy found what is listed above" >&2
  exit 1
fi
echo "clang-tidy: ${#files[@]} sources are fine."
