#!/usr/bin/env bash
# Compiles the library and its tests to WebAssembly with Debian's Emscripten, and runs the tests in node. Needs no
# network. Exit code 77 when a Debian package is missing; which one it says, and installs nothing.
#   scripts/build_web.sh [OPTION...]   options for ctest
#   scripts/build_web.sh --module      the npm package alone, in build/web/npm
#   scripts/build_web.sh --page        that and the page, in web/dist; scripts/test_web.sh tests both. Needs npm, its
#                                      registry for the first time, and node 20.19 or newer, which Debian 12 does not have
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(emscripten nodejs cmake ninja-build libeigen3-dev libfmt-dev nlohmann-json3-dev doctest-dev)
declare -A found_by=([emscripten]=/usr/bin/em++ [nodejs]=node [cmake]=cmake [ninja-build]=ninja
  [libeigen3-dev]=/usr/include/eigen3/Eigen/Core [libfmt-dev]=/usr/include/fmt/format-inl.h
  [nlohmann-json3-dev]=/usr/include/nlohmann/json.hpp [doctest-dev]=/usr/include/doctest/doctest.h)
missing=()
for package in "${packages[@]}"; do
  thing="${found_by[$package]}"
  [[ -e "$thing" ]] || command -v "$thing" >/dev/null || missing+=("$package")
done
if ((${#missing[@]})); then
  echo "build_web.sh: not built; missing: ${missing[*]} (apt-get install --no-install-recommends ${missing[*]})" >&2
  exit 77
fi

# What web/package.json names, as web/package-lock.json has it; then the page.
build_page() {
  if [[ "$(printf '%s\n' v20.19 "$(node --version)" | sort -V | head -1)" != v20.19 ]]; then
    echo "build_web.sh: no page: it is built with node 20.19 or newer, and this is $(node --version); see nodejs.org" >&2
    exit 77
  fi
  if ! command -v npm >/dev/null; then
    echo "build_web.sh: no page: missing: npm (apt-get install --no-install-recommends npm)" >&2
    exit 77
  fi
  cd web
  [[ node_modules/.package-lock.json -nt package-lock.json ]] || npm ci --no-audit --no-fund
  npx vite build
}

# Debian's Emscripten finds its own JavaScript there, and leaves setting the path to its users.
export NODE_PATH=/usr/share/nodejs
jobs="${PLIANT_JOBS:-$(nproc)}"
cmake --preset web
if [[ "${1:-}" == --module || "${1:-}" == --page ]]; then
  cmake --build --preset web --parallel "$jobs" --target pliant_web
  [[ "$1" == --module ]] || build_page
  exit
fi
cmake --build --preset web --parallel "$jobs"
if ! ctest --preset web --parallel "$jobs" "$@"; then
  echo "build_web.sh: tests FAILED in node, see above" >&2
  exit 1
fi
for file in build/web/npm/*.wasm; do
  echo "$file: $(stat -c %s "$file") bytes, $(gzip -9 -c "$file" | wc -c) gzipped"
done
