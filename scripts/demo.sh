#!/usr/bin/env bash
# Installs what is missing, builds what runs and films scenes, simulates a curtain in the wind and films it; where there is
# a display, it opens a window with the curtain at the end.
#   scripts/demo.sh [OPTION...]   options are handed to `pliant run`, for example --steps 60
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scene=scenes/curtain_wind.json
out=out/curtain_wind
pliant=build/release/bin/pliant

scripts/setup.sh
start=$SECONDS
if [[ ! -x "$pliant" ]]; then
  echo "Building takes about four minutes of one processor, two minutes on two; after that, simulating and filming take less than one."
fi
# A folder in which everything was built stays as it is.
[[ -f build/release/CMakeCache.txt ]] || cmake --preset demo
cmake --build build/release --target pliant_cli pliant_blender
built=$SECONDS
"$pliant" run "$scene" --out "$out" "$@"
simulated=$SECONDS
if ! "$pliant" render "$out" --out "$out/film.mp4" || ! "$pliant" render "$out" --out "$out/sheet.png" --sheet; then
  echo "No film of it, for the reason above; the simulation itself is complete."
fi

cat <<EOF

It took $((SECONDS - start)) s: $((built - start)) s to build, $((simulated - built)) s to simulate, $((SECONDS - simulated)) s to film.
What lies in $out:
  frames.npy        the curtain's vertices, frames x vertices x 3 in meters: numpy.load("$out/frames.npy")
  measurements.csv  time, energies, momentum, residual and milliseconds of every step
  run.json          every setting, the versions, the totals
  film.mp4          what it looks like, and sheet.png, twelve frames of that (without ffmpeg: numbered pictures)
Next:
  change $scene, say the wind's velocity, and run this again;
  write a mesh a frame, for Blender and others:
    $pliant run $scene --format obj --out ${out}_obj
  pull at it with the mouse:
    $pliant view $scene
  see the other scenes and options:
    $pliant scenes
    $pliant run --help
  build the rest (pliant sweep, experiment, plot and bench, the tests):
    cmake --preset release && cmake --build --preset release
EOF

if [[ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ]]; then
  echo
  echo "The window shows the same curtain: pull at it, press H for all keys. Closing it ends this."
  "$pliant" view "$scene" || echo "No window, for the reason above."
fi
