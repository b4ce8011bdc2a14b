#!/usr/bin/env bash
# Installs the Debian packages that Pliant is built from, those that are missing only.
#   scripts/setup.sh         what building and testing need
#   scripts/setup.sh --dev   and what clang builds, formatting, static analysis and benchmarks need
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libfmt-dev nlohmann-json3-dev libcli11-dev doctest-dev
  libsuitesparse-dev libopenblas-dev
  python3 python3-numpy
)
dev_packages=(ccache clang clang-format clang-tidy git libtinyobjloader-dev)

case "${1-}" in
  "") ;;
  --dev) packages+=("${dev_packages[@]}") ;;
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
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
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
