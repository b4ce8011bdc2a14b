#!/usr/bin/env bash
# Runs every scene of contact between surfaces, large and varied, and looks for crossings after every step.
#   scripts/check_contact.sh [--list] [--share I/N]
# All of it takes hours. It goes on where it was broken off: lines of runs that are done stand in out/contact.log.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scenes="build/release/tests/contact_scenes"
share="1/1"
list=""

while (($# > 0)); do
  case "$1" in
    --list) list="--list" ;;
    --share)
      share="${2:?check_contact.sh: --share needs I/N, such as 2/4}"
      shift
      ;;
    *)
      echo "check_contact.sh: unknown argument '$1'; give --list or --share I/N" >&2
      exit 2
      ;;
  esac
  shift
done

if [[ ! -x "$scenes" ]]; then
  cmake --preset release
fi
cmake --build --preset release --target contact_scenes
if [[ -n "$list" ]]; then
  exec "$scenes" everything --list --share "$share"
fi

# Each processor takes part of the share.
if [[ ! "$share" =~ ^([0-9]+)/([0-9]+)$ ]]; then
  echo "check_contact.sh: '$share' is no share; give I/N, such as 2/4" >&2
  exit 2
fi
part="${BASH_REMATCH[1]}" parts="${BASH_REMATCH[2]}" processors="$(nproc)"
mkdir -p out
pids=()
for ((i = 0; i < processors; ++i)); do
  "$scenes" everything --threads 1 --share "$((part + i * parts))/$((parts * processors))" --log out/contact.log &
  pids+=($!)
done
status=0
for pid in "${pids[@]}"; do
  wait "$pid" || status=1
done
if ((status != 0)); then
  echo "check_contact.sh: something crossed or failed, see NOT CLEAN in out/contact.log" >&2
fi
exit "$status"
