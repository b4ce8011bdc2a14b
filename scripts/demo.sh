#!/usr/bin/env bash
# Installs what is missing, builds Pliant and simulates a curtain in the wind.
#   scripts/demo.sh [OPTION...]   options are handed to `pliant run`, for example --steps 60
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scene=scenes/curtain_wind.json
out=out/curtain_wind

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target pliant_cli
build/release/bin/pliant run "$scene" --out "$out" "$@"

cat <<EOF

$out now holds
$(ls -l --human-readable "$out" | awk 'NR > 1 {printf "  %-24s %s\n", $NF, $5}' | head -n 12)

Next:
  change $scene, say the wind's velocity, and run this again;
  write frames that Blender and other programs read:
    build/release/bin/pliant run $scene --out ${out}_obj --format obj
  see what else there is:
    build/release/bin/pliant run --help
EOF
