#!/usr/bin/env bash
# Serves the page in the browser from this machine to this machine; builds it first where that has not been done.
#   scripts/serve_web.sh [PORT]   default: 8000
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../web"

if [[ ! -e dist/index.html ]]; then
  [[ -d node_modules ]] || npm ci
  npm run build
fi
echo "http://127.0.0.1:${1:-8000}/ (Ctrl C ends it)"
exec python3 -m http.server "${1:-8000}" --bind 127.0.0.1 --directory dist
