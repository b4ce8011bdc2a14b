#!/usr/bin/env bash
# Draws the pictures of the documents anew, from the built-in scenes, into docs/pictures/; those of the gallery, which
# the README shows too, are scripts/gallery.sh's.
#   scripts/figures.sh [PROGRAM]   default: build/release/bin/pliant
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=docs/pictures
mkdir -p "$out"

# The window, pulled at by a real mouse: what this script does with --window, on a display of its own.
draw_window() { # PROGRAM
  "$1" view trampoline --color energy --size 1200x700 &
  local program=$!
  xdotool search --sync --onlyvisible --name 'trampoline - Pliant' windowfocus
  sleep 3
  xdotool mousemove 560 335 sleep 0.3 mousedown 1 sleep 0.3 mousemove 570 315 sleep 0.3 mousemove 640 150 sleep 1.5
  ffmpeg -loglevel error -y -f x11grab -draw_mouse 1 -video_size 1200x700 -i "$DISPLAY" -frames:v 1 "$out/window.png"
  xdotool mouseup 1
  kill -TERM "$program"
  wait "$program" || true # ended from outside
}
if [[ "${1-}" == --window ]]; then
  draw_window "$2"
  exit
fi
pliant="${1:-build/release/bin/pliant}"

picture() { # NAME SCENE OPTION...
  "$pliant" render "$2" --out "$out/$1.png" --size 640x360 --quiet "${@:3}"
}
"$pliant" render "$out/finishes.json" --out "$out/finishes.png" --size 960x480 --quiet
picture towel towel
"$pliant" render dress_from_panels --out "$out/sewn_dress.png" --size 960x960 --frames 9 --sheet --quiet
"$pliant" render torus --out "$out/torus.png" --size 960x540 --steps 140 --frames 6 --sheet --wireframe --quiet

# Of the report on the torus, the last three pictures: jumps of 1 m without bending, with absolute, with signed bending.
draw_experiment() {
  local folder
  folder="$(mktemp -d)"
  "$pliant" experiment torus --out "$folder" --quiet
  python3 - "$folder" <<'PYTHON'
import base64, re, sys
pictures = re.findall(r'data:image/png;base64,([^"]+)', open(sys.argv[1] + "/index.html", encoding="utf-8").read())
for i, picture in enumerate(pictures[-3:]):
    open(f"{sys.argv[1]}/{i}.png", "wb").write(base64.b64decode(picture))
PYTHON
  convert "$folder"/[0-2].png -append -resize 960x "$out/experiments.png"
  rm -r "$folder"
}
if command -v convert >/dev/null; then
  draw_experiment
else
  echo "figures.sh: $out/experiments.png is left as it is; it needs imagemagick" >&2
fi

if command -v xvfb-run >/dev/null && command -v xdotool >/dev/null && command -v ffmpeg >/dev/null; then
  xvfb-run -a -s "-screen 0 1200x700x24 -noreset" bash scripts/figures.sh --window "$pliant"
else
  echo "figures.sh: $out/window.png is left as it is; it needs xvfb, xdotool and ffmpeg" >&2
fi
