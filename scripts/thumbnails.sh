#!/usr/bin/env bash
# Draws the small pictures by which the window and the page in the browser list their scenes:
# web/page/public/thumbnails/. Needs ffmpeg and jq.
#   scripts/thumbnails.sh [PROGRAM [SCENE...]]   default: build/release/bin/pliant, all scenes
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
pliant="${1:-build/release/bin/pliant}"
folder=web/page/public/thumbnails
# The moment of each that shows most [steps]; the others after 120.
declare -A steps=([storm]=87 [silk_on_figure]=250 [walkers]=200 [trampoline_crowd]=66 [dress]=282 [parachute]=70 [plank_bridge]=130
  [towel]=240 [layers]=200 [chain_mail]=200 [reef_knot]=360 [tablecloth]=188 [soft_rings]=70 [ball]=90 [pile]=150)

if (($# > 1)); then
  scenes=("${@:2}")
else
  mapfile -t scenes < <("$pliant" scenes --json | jq -r ".[].name")
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"
for name in "${scenes[@]}"; do
  "$pliant" render "$name" --out "$work/$name.png" --steps "${steps[$name]:-120}" --size 256x160 \
    --set view.wind_arrow=false --quiet >/dev/null
  ffmpeg -loglevel error -y -i "$work/$name.png" -c:v libwebp -quality 60 -compression_level 6 "$folder/$name.webp"
done
echo "$(find "$folder" -name '*.webp' | wc -l) pictures, $(du -bs "$folder" | cut -f1) bytes"
