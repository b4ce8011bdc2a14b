#!/usr/bin/env bash
# Installs a finished build to a place of its own, sees that all is there, then builds and runs examples/consumer against
# what was installed, and examples/window, which without a display says so; then builds (without optimizing, which is quick) and installs the algorithm alone, with headers in
# the way that refuse JSON, zlib and XML, and examples/algorithm_only.
#   scripts/check_install.sh [PRESET]   release when none is given; it must have been built
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset="${1:-release}"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cmake --install "build/$preset" --prefix "$work/prefix" >"$work/install.log"
for file in bin/pliant share/man/man1/pliant.1 share/bash-completion/completions/pliant \
  share/zsh/site-functions/_pliant share/fish/vendor_completions.d/pliant.fish share/pliant/scene.schema.json share/pliant/pliant_blender.zip \
  share/pliant/scenes/curtain.json share/doc/pliant/README.md share/doc/pliant/LICENSE share/doc/pliant/docs/scenes.md; do
  if [[ ! -s "$work/prefix/$file" ]]; then
    echo "check_install.sh: $file was not installed, or is empty; see cmake/install.cmake" >&2
    exit 1
  fi
done

# Builds an example against what was installed under a prefix, away from this tree, so that nothing else is found.
#   build_example NAME PREFIX [CMAKE_OPTION...]
build_example() {
  cp -r "examples/$1" "$work/$1"
  cmake -S "$work/$1" -B "$work/$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$2" "${@:3}"
  cmake --build "$work/$1/build"
}
# The same, and runs it.
run_example() {
  build_example "$@"
  (cd "$work/$1/build" && "./$1")
}
run_example consumer "$work/prefix"
(cd "$work" && prefix/bin/pliant --version)
display=()
if command -v xvfb-run >/dev/null; then display=(xvfb-run -a -s "-screen 0 1280x800x24 -noreset"); fi
build_example window "$work/prefix"
if ((${#display[@]} > 0)); then
  (cd "$work/window/build" && "${display[@]}" ./window 0.5)
fi
if (cd "$work/window/build" && env -u DISPLAY -u WAYLAND_DISPLAY ./window 0.5 2>"$work/refusal"); then
  echo "check_install.sh: examples/window ran without a display" >&2
  exit 1
fi
grep -q "there is no display for a window" "$work/refusal"

mkdir -p "$work/refused/nlohmann"
echo '#error "the algorithm needs no JSON"' >"$work/refused/nlohmann/json.hpp"
echo '#error "the algorithm needs no zlib"' >"$work/refused/zlib.h"
echo '#error "the algorithm needs no XML"' >"$work/refused/pugixml.hpp"
without_files=(-DCMAKE_CXX_FLAGS="-I$work/refused" -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_pugixml=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
cmake --preset "$preset" -B "$work/algorithm" -DPLIANT_BUILD_IO=OFF -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 \
  "${without_files[@]}"
cmake --build "$work/algorithm"
cmake --install "$work/algorithm" --prefix "$work/algorithm/prefix" >>"$work/install.log"
run_example algorithm_only "$work/algorithm/prefix" "${without_files[@]}"
echo "The installed package works, and so does the algorithm alone."
