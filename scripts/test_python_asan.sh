#!/usr/bin/env bash
# Compiles the Python module with the address and undefined-behavior sanitizers, with clang, and runs those of its tests
# that are about memory: arrays that look at the state of a simulation, projections in NumPy, threads, scenes. It takes
# some ten minutes, so scripts/test.sh leaves it out. Exit code 77 when clang or its run-time library is missing.
#   scripts/test_python_asan.sh [TEST...]   of tests/python: test_views, for one
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tests=("$@")
((${#tests[@]})) || tests=(test_views test_own test_scenes test_threads test_options)
for test in "${tests[@]}"; do
  if [[ ! -e "tests/python/$test.py" ]]; then
    echo "test_python_asan.sh: no test '$test'; give names of tests/python without .py" >&2
    exit 2
  fi
done

runtime="$(clang++ -print-file-name=libclang_rt.asan-x86_64.so 2>/dev/null || true)"
standard_library="$(clang++ -print-file-name=libstdc++.so.6 2>/dev/null || true)"
if [[ ! -e "$runtime" ]]; then
  echo "test_python_asan.sh: not run; missing: clang libclang-rt-14-dev (apt-get install --no-install-recommends clang libclang-rt-14-dev)" >&2
  exit 77
fi

cmake --preset asan-python
cmake --build --preset asan-python
export PYTHONPATH="$PWD/build/asan-python/python" PLIANT_SOURCE_DIR="$PWD" PYTHONMALLOC=malloc
# Python itself keeps memory to its end, and NumPy's libraries too. Exceptions of C++ need their library from the start.
export ASAN_OPTIONS=detect_leaks=0
failed=()
for test in "${tests[@]}"; do
  echo "$test:"
  LD_PRELOAD="$runtime:$standard_library" /usr/bin/python3 "tests/python/$test.py" || failed+=("$test")
done
if ((${#failed[@]})); then
  echo "test_python_asan.sh: FAILED: ${failed[*]}" >&2
  exit 1
fi
echo "All of ${tests[*]} passed with the sanitizers."
