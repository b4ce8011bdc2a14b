#!/usr/bin/env bash
# Installs what is missing, builds Pliant, simulates a curtain in the wind and films it; where there is a display, it
# opens a window with the curtain at the end.
#   scripts/demo.sh [OPTION...]   options are handed to `pliant run`, for example --steps 60
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scene=scenes/curtain_wind.json
out=out/curtain_wind

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target pliant_cli
build/release/bin/pliant run "$scene" --out "$out" "$@"
if ! build/release/bin/pliant render "$out" --out "$out/film.mp4" ||
  ! build/release/bin/pliant render "$out" --out "$out/sheet.png" --sheet; then
  echo "No film of it, for the reason above; the simulation itself is complete."
fi

cat <<EOF

What lies in $out:
  frames.npy        the curtain's vertices, frames x vertices x 3 in meters: numpy.load("$out/frames.npy")
  measurements.csv  time, energies, momentum, residual and milliseconds of every step
  run.json          every setting, the versions, the totals
  film.mp4          what it looks like, and sheet.png, twelve frames of that (without ffmpeg: numbered pictures)
Next:
  change $scene, say the wind's velocity, and run this again;
  write a mesh a frame, for Blender and others:
    build/release/bin/pliant run $scene --format obj --out ${out}_obj
  pull at it with the mouse:
    build/release/bin/pliant view $scene
  see the other scenes and options:
    build/release/bin/pliant scenes
    build/release/bin/pliant run --help
EOF

if [[ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ]]; then
  echo
  echo "The window shows the same curtain: pull at it, press H for all keys. Closing it ends this."
  build/release/bin/pliant view "$scene" || echo "No window, for the reason above."
fi
