#!/usr/bin/env bash
# Serves the page in the browser from this machine to this machine; builds first what is not up to date.
#   scripts/serve_web.sh [PORT]   default: 8000
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
port="${1:-8000}"

scripts/build_web.sh --page
echo "http://127.0.0.1:$port/ (Ctrl C ends it)"
exec python3 -m http.server "$port" --bind 127.0.0.1 --directory web/dist
