#!/usr/bin/env bash
# Builds the page in the browser and tests it: types, parts in node, and the page itself in Debian's Chromium, without
# which that part is skipped with a word. scripts/test.sh leaves this out: compiling to WebAssembly takes minutes.
#   scripts/test_web.sh [--scenes]   --scenes: lets every scene of up to 3,000 vertices run for 10 s too, some 6 minutes
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../web"

if ! command -v npm >/dev/null; then
  echo "test_web.sh: no npm (apt-get install npm)" >&2
  exit 77
fi
[[ -d node_modules ]] || npm ci
npm test
[[ "${1:-}" != --scenes ]] || npm run test:scenes
