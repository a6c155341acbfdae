#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that pfseq needs and that are missing, then configures and builds build/release.
# Sourced or called by quickstart.sh and test.sh; can be called alone. Options: --no-tests leaves the tests out.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
build_tests=ON
[ "${1:-}" = "--no-tests" ] && build_tests=OFF

packages=(g++ cmake ninja-build pkg-config
  libeigen3-dev libfmt-dev libtbb-dev libyaml-cpp-dev nlohmann-json3-dev libssl-dev libcli11-dev libnanoflann-dev zlib1g-dev
  libembree-dev libopenimageio-dev openimageio-tools libopenexr-dev libtinygltf-dev libopencv-dev
  libcpp-httplib-dev gnuplot-nox libgtest-dev libgmock-dev)
# The pages are tested by clicks.
[ "$build_tests" = ON ] && packages+=(chromium chromium-driver python3-selenium)

is_installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
  echo "== set-up: installing ${#missing[@]} Debian packages: ${missing[*]}"
  if [ "$(id -u)" -eq 0 ]; then
    as_root=()
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo)
  else
    echo "set-up: these packages are missing and need root rights; ask an administrator to run:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 2
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
else
  echo "== set-up: all Debian packages are there"
fi

echo "== build: $build"
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPFSEQ_BUILD_TESTS=$build_tests "${launcher[@]}" \
  --log-level=WARNING >/dev/null
cmake --build "$build"
