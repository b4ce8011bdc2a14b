#!/usr/bin/env bash
# Runs the experiments over several seeds and compares the verdicts. Ends with 1 where a verdict changes from one seed to
# another, where a claim does not hold that is not listed in experiments/known_failures.txt, or one that is listed holds.
#   scripts/experiments.sh [--seeds N] [--out FOLDER] [--program PROGRAM] [EXPERIMENT...]
# Defaults: one seed, build/experiments, build/release/bin/pliant, all experiments. All take about ten minutes a seed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seeds=1
out=build/experiments
program=build/release/bin/pliant
names=()
while (($#)); do
  case "$1" in
    --seeds | --out | --program)
      (($# > 1)) || { echo "experiments.sh: $1 wants a value" >&2; exit 2; }
      printf -v "${1#--}" '%s' "$2"
      shift 2
      ;;
    -*) echo "experiments.sh: unknown option '$1'; there are --seeds, --out and --program" >&2; exit 2 ;;
    *) names+=("$1"); shift ;;
  esac
done
[[ "$seeds" =~ ^[1-9][0-9]*$ ]] || { echo "experiments.sh: --seeds wants a number from 1 on, not '$seeds'" >&2; exit 2; }
((${#names[@]})) || names=(all)

reports=()
for ((seed = 0; seed < seeds; ++seed)); do
  folder="$out/seed-$seed"
  # The pictures of one seed are enough.
  options=(--quiet --seed "$seed" --out "$folder")
  ((seed == 0)) || options+=(--no-pictures)
  "$program" experiment "${names[@]}" "${options[@]}"
  reports+=("$folder/report.json")
done
exec python3 scripts/compare_verdicts.py experiments/known_failures.txt "${reports[@]}"
