#!/usr/bin/env bash
# Draws the pictures of docs/gallery.md anew, or films of the same scenes.
#   scripts/gallery.sh [PROGRAM]                  into docs/gallery/; default: build/release/bin/pliant
#   scripts/gallery.sh --films FOLDER [PROGRAM]   640 x 360, whole, as .mp4
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
films=""
if [[ "${1-}" == --films ]]; then
  films="${2:?gallery.sh: give the folder of the films}"
  mkdir -p "$films"
  shift 2
fi
pliant="${1:-build/release/bin/pliant}"

draw() { # NAME SCENE STEPS OPTION...
  if [[ -n "$films" ]]; then
    "$pliant" render "$2" --out "$films/$1.mp4" --size 640x360 --quiet
  else
    "$pliant" render "$2" --out "docs/gallery/$1.png" --steps "$3" --size 640x360 --quiet "${@:4}"
  fi
}
draw storm docs/gallery/storm.json 87
draw silk_on_figure docs/gallery/silk_on_figure.json 250
draw trampoline_crowd docs/gallery/trampoline_crowd.json 92
draw dress dress 282
draw parachute parachute 70 --set 'view.camera.position=[0.8, -7, 2.3]' --set 'view.camera.target=[0.2, 0, 2.5]'
draw plank_bridge plank_bridge 130
draw towel towel 240
draw layers layers 200 --set 'view.camera={"elevation": 28}'
draw chain_mail chain_mail 200
draw reef_knot reef_knot 360 --set 'view.camera={"elevation": 35}'
draw tablecloth tablecloth 188
draw soft_rings soft_rings 70
