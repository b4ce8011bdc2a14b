#!/usr/bin/env bash
# Draws the pictures of the README and the documents anew, from the built-in scenes, into docs/pictures/.
#   scripts/figures.sh [PROGRAM]   default: build/release/bin/pliant
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pliant="${1:-build/release/bin/pliant}"
out=docs/pictures
mkdir -p "$out"

picture() { # NAME SCENE OPTION...
  "$pliant" render "$2" --out "$out/$1.png" --size 640x360 --quiet "${@:3}"
}
picture curtain curtain_wind --steps 100
picture bridge rope_bridge --steps 170
picture pillow pillow --steps 150 --colour energy
picture net net --steps 200
"$pliant" render torus --out "$out/torus.png" --size 960x540 --steps 140 --frames 6 --sheet --wireframe --quiet
