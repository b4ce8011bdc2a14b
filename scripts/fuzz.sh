#!/usr/bin/env bash
# Builds the fuzz targets (fuzz/fuzz_*.cpp) and runs each on mutations of its seeds.
#   scripts/fuzz.sh [SECONDS] [TARGET...]   seconds for each target, default 10; all targets when none is named
# What was learned stays in build/asan/fuzzing/corpus/, so a later run goes on from there; an input that breaks a promise is
# kept as build/asan/fuzzing/found/TARGET-*. Fix the cause, and add the input to the tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds="${1:-10}"
shift || true
if ! [[ "$seconds" =~ ^[1-9][0-9]*$ ]]; then
  echo "fuzz.sh: '$seconds' is not a number of seconds; usage: scripts/fuzz.sh [SECONDS] [TARGET...]" >&2
  exit 2
fi

scripts/setup.sh --dev
cmake --preset asan
targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then
  mapfile -t targets < <(basename --suffix=.cpp fuzz/fuzz_*.cpp)
fi
cmake --build --preset asan --target "${targets[@]}"

mkdir -p build/asan/fuzzing/found
run_target() {
  local target="$1" seconds="$2" log="build/asan/fuzzing/$1.log" dictionary=()
  [[ ! -e "fuzz/$target.dict" ]] || dictionary=("-dict=fuzz/$target.dict")
  mkdir -p "build/asan/fuzzing/corpus/$target" "fuzz/seeds/$target"
  if ! "build/asan/fuzz/$target" "build/asan/fuzzing/corpus/$target" "fuzz/seeds/$target" -max_total_time="$seconds" \
    -timeout=10 -rss_limit_mb=2048 -max_len=65536 -artifact_prefix="build/asan/fuzzing/found/$target-" \
    "${dictionary[@]}" -print_final_stats=1 -close_fd_mask=1 >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "fuzz.sh: $target FAILED; the input is in build/asan/fuzzing/found/, the report in $log" >&2
    return 1
  fi
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s, none broke a promise"
}
export -f run_target
printf '%s\0' "${targets[@]}" | xargs -0 -P "$(nproc)" -I{} bash -c 'run_target "$1" "$2"' _ {} "$seconds"
