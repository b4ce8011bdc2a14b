#!/usr/bin/env bash
# Draws the stills (.png) and the films (.webp) of docs/gallery.md anew, into docs/gallery/. Films need ffmpeg.
#   scripts/gallery.sh [PROGRAM [SCENE...]]   default: build/release/bin/pliant, all scenes
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pliant="${1:-build/release/bin/pliant}"
folder=docs/gallery
if (($# > 1)); then only=" ${*:2} "; else only=""; fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

# The same picture in fewer bytes.
pack() { # FILE
  if command -v ffmpeg >/dev/null; then
    ffmpeg -loglevel error -y -i "$1" -c:v png -pred sub -compression_level 9 "$work/packed.png"
    mv "$work/packed.png" "$1"
  fi
}

draw() { # SCENE STILL FIRST LAST OPTION...: the still after so many steps, the film from step to step
  local name="$1" still="$2" first="$3" last="$4" options=("${@:5}")
  [[ -z "$only" || "$only" == *" $name "* ]] || return 0
  "$pliant" render "$name" --out "$folder/$name.png" --steps "$still" --size 960x540 --quiet
  pack "$folder/$name.png"
  local start="$name"
  if ((first > 0)); then
    "$pliant" run "$name" --steps "$first" --out "$work/$name" --format none --quiet "${options[@]}"
    start="$work/$name/checkpoint.pliant"
    options=()
  fi
  "$pliant" render "$start" --out "$folder/$name.webp" --steps "$last" --fps "${fps:-20}" --size "${size:-480x270}" --quiet "${options[@]}"
  printf '%s: %d kB\n' "$name.webp" "$(($(stat -c %s "$folder/$name.webp") / 1000))"
}

draw storm 87 30 270
draw silk_on_figure 250 0 270
fps=15 size=640x360 draw walkers 200 100 316
draw trampoline_crowd 66 0 210
draw dress 300 48 330
draw parachute 90 0 270
draw towel 240 0 210 --set view.camera.turn_rate=20
draw layers 200 0 210 --set view.camera.turn_rate=20
fps=15 draw chain_mail 200 30 450
draw reef_knot 240 0 240
draw tablecloth 204 60 330
draw soft_rings 45 0 138
