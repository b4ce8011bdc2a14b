#!/usr/bin/env bash
# The library compiled to WebAssembly, and its tests in node. Skipped where scripts/build_web.sh is.
set -euo pipefail
cd "$PLIANT_SOURCE_DIR"
exec scripts/build_web.sh
