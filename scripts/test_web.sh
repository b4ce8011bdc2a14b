#!/usr/bin/env bash
# Builds the page in the browser and tests it: types, the npm package and the parts in node, and the page itself in
# Debian's Chromium, without which that part is skipped with a word. scripts/test.sh leaves this out: compiling to
# WebAssembly takes minutes.
#   scripts/test_web.sh [--scenes]   --scenes: lets every scene of up to 3,000 vertices run for 10 s too, some 8 minutes
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build_web.sh --page
cd web
npm test
[[ "${1:-}" != --scenes ]] || npm run test:scenes
