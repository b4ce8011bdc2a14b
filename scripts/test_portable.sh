#!/usr/bin/env bash
# Builds the library and its tests for other platforms than this machine's, runs the tests there, and compares what
# built-in scenes become, bit by bit, with the same kernels on this machine. Exit code 77 when Debian packages are
# missing; which ones it says, and installs nothing. It takes an hour and more, so no other script runs it.
#   scripts/test_portable.sh [PLATFORM...]           of aarch64 (qemu), windows (mingw, wine) and web (Emscripten, node);
#                                                    all without one
#   scripts/test_portable.sh --bits [PLATFORM...]    the comparison alone
# PLIANT_JOBS: how many at once; PLIANT_BITS_VERTICES: scenes of up to how many vertices are compared, 3000 unless it
# says so.
# The bits are left in build/bits/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

has_tests=1
if [[ "${1:-}" == --bits ]]; then
  has_tests=0
  shift
fi
platforms=("$@")
((${#platforms[@]})) || platforms=(aarch64 windows web)

# Packages, and what shows that one is there.
declare -A packages=(
  [common]="cmake ninja-build python3 libeigen3-dev libfmt-dev nlohmann-json3-dev doctest-dev"
  [aarch64]="g++-aarch64-linux-gnu qemu-user"
  [windows]="g++-mingw-w64-x86-64-posix wine"
  [web]="emscripten nodejs")
declare -A found_by=([ninja-build]=ninja [libeigen3-dev]=/usr/include/eigen3/Eigen/Core
  [libfmt-dev]=/usr/include/fmt/format-inl.h [nlohmann-json3-dev]=/usr/include/nlohmann/json.hpp
  [doctest-dev]=/usr/include/doctest/doctest.h [g++-aarch64-linux-gnu]=aarch64-linux-gnu-g++ [qemu-user]=qemu-aarch64
  [g++-mingw-w64-x86-64-posix]=x86_64-w64-mingw32-g++-posix [emscripten]=/usr/bin/em++ [nodejs]=node)
missing=()
for platform in common "${platforms[@]}"; do
  if [[ -z "${packages[$platform]:-}" ]]; then
    echo "test_portable.sh: no platform '$platform'; give aarch64, windows or web" >&2
    exit 2
  fi
  for package in ${packages[$platform]}; do
    thing="${found_by[$package]:-$package}"
    [[ "$thing" == /* && -e "$thing" ]] || command -v "$thing" >/dev/null || missing+=("$package")
  done
done
if ((${#missing[@]})); then
  echo "test_portable.sh: not built; missing: ${missing[*]} (apt-get install --no-install-recommends ${missing[*]})" >&2
  exit 77
fi

jobs="${PLIANT_JOBS:-$(nproc)}"
vertices="${PLIANT_BITS_VERTICES:-3000}"
export NODE_PATH=/usr/share/nodejs
export WINEPREFIX="$PWD/build/windows/wine" WINEDEBUG=-all
declare -A runner=([aarch64]="qemu-aarch64 -L /usr/aarch64-linux-gnu" [windows]=wine [web]=node)
declare -A program=([aarch64]=scene_bits [windows]=scene_bits.exe [web]=scene_bits.js)

cmake --preset release
cmake --build --preset release --parallel "$jobs" --target scene_bits_portable
rm -rf build/bits
build/release/tests/scene_bits_portable build/bits/native 60 "$vertices"

# Each platform to its end, so that one that fails hides no other.
failed=()
compared=()
for platform in "${platforms[@]}"; do
  cmake --preset "$platform"
  target=scene_bits
  ((!has_tests)) || target=all  # tests are more than one program
  if ! cmake --build --preset "$platform" --parallel "$jobs" --target "$target"; then
    failed+=("$platform does not build")
    continue
  fi
  if ((has_tests)) && ! ctest --preset "$platform" --parallel "$jobs"; then
    failed+=("tests fail on $platform")
  fi
  # shellcheck disable=SC2086  # the runner is words
  if ${runner[$platform]} "build/$platform/tests/${program[$platform]}" "build/bits/$platform" 60 "$vertices"; then
    compared+=("build/bits/$platform")
  else
    failed+=("scenes fail on $platform")
  fi
done
((!${#compared[@]})) || python3 tests/portable/compare_bits.py build/bits/native "${compared[@]}" || failed+=("no comparison")
if ((${#failed[@]})); then
  printf 'test_portable.sh: FAILED: %s\n' "${failed[@]}" >&2
  exit 1
fi
