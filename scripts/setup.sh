#!/usr/bin/env bash
# Installs the Debian packages that Pliant is built from, those that are missing only.
#   scripts/setup.sh         what building and testing need
#   scripts/setup.sh --dev   and what clang builds, formatting, static analysis, benchmarks, the tests of the add-on for
#                            Blender and the glTF validator need; that one comes from npm and goes to node_modules/
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libfmt-dev zlib1g-dev libpugixml-dev nlohmann-json3-dev libcli11-dev doctest-dev
  libsuitesparse-dev libopenblas-serial-dev
  pkg-config libepoxy-dev libegl-dev libglfw3-dev libgl1 libgl1-mesa-dri libimgui-dev libstb-dev libwebp-dev fonts-inter ffmpeg
  python3 python3-numpy python3-scipy python3-jsonschema python3-dev python3-pip python3-venv python3-setuptools python3-wheel
  pybind11-dev assimp-utils xvfb xauth xdotool
)
dev_packages=(ccache man-db groff mandoc zsh fish clang clang-format clang-tidy git libclang-rt-14-dev libtinyobjloader-dev
  librsvg2-bin mypy blender python3-matplotlib)
# Whoever has them from elsewhere could not install Debian's beside them.
command -v node >/dev/null || dev_packages+=(nodejs)
command -v npm >/dev/null || dev_packages+=(npm)

wants_npm=false
case "${1-}" in
  "") ;;
  --dev) packages+=("${dev_packages[@]}"); wants_npm=true ;;
  *) echo "setup.sh: unknown option '$1'; --dev is the only one" >&2; exit 2 ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: there is no apt-get here, so nothing was installed or checked. Needed, by their Debian names:" >&2
  echo "  ${packages[*]}" >&2
  exit 0 # they may be there under other names; CMake names the first that is not
fi

missing=()
for package in "${packages[@]}"; do
  status="$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)"
  [[ "$status" == "install ok installed" ]] || missing+=("$package")
done

install_missing() {
  local as_root=()
  if [[ "$(id -u)" -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      echo "setup.sh: these packages are missing and there is no sudo; as root: apt-get install ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  apt_get() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q "$@"; }

  echo "Installing: ${missing[*]}"
  if ! apt_get update; then
    echo "setup.sh: apt-get update failed, see above; nothing was installed" >&2
    exit 1
  fi
  if ! apt_get install -y --no-install-recommends "${missing[@]}"; then
    echo "setup.sh: could not install all of: ${missing[*]}; see apt-get's message above" >&2
    exit 1
  fi
}
[[ ${#missing[@]} -eq 0 ]] || install_missing

# What package.json names, as package-lock.json has it.
install_npm_packages() {
  cd "$(dirname "${BASH_SOURCE[0]}")/.."
  [[ node_modules/.package-lock.json -nt package-lock.json ]] && return
  if ! npm ci --no-audit --no-fund; then
    echo "setup.sh: npm could not install what package.json names, see above" >&2
    exit 1
  fi
}
[[ "$wants_npm" == false ]] || install_npm_packages
