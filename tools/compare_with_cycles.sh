#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compares pfseq with Blender Cycles on the same scene, poses, lens and light: cost, error, and the difference of their
# converged images. Installs Debian's Blender and the Python libraries that it needs when they are missing, and builds
# pfseq when build/release is not there. All arguments go to benchmarks/cycles/compare.py; --help lists them.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Debian's own Python, whose libraries are packages; Blender uses the same.
python=/usr/bin/python3
compare=$root/benchmarks/cycles/compare.py
packages=(python3-numpy python3-openimageio python3-yaml)

# has FLAG ARGUMENTS...: whether the flag is among them
has() {
  local flag=$1 word
  shift
  for word in "$@"; do
    [[ $word == "$flag" || $word == "$flag="* ]] && return 0
  done
  return 1
}

is_installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'; }

if [ ! -x "$python" ]; then
  echo "compare_with_cycles.sh: $python is missing: install Debian's package python3" >&2
  exit 2
fi
if has --help "$@" || has -h "$@"; then
  exec "$python" -B "$compare" --help
fi
# Wrong input is told before anything is installed or built.
"$python" -B "$compare" --check-arguments "$@"

has --blender "$@" || packages+=(blender)
missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
      echo "compare_with_cycles.sh: needs root rights to install Debian packages; ask an administrator to run:" \
        "apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 2
    fi
    as_root=(sudo)
  fi
  echo "== installing Debian packages: ${missing[*]}" >&2
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -qq && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    echo "compare_with_cycles.sh: cannot install ${missing[*]} (is there a network?): $(tail -n 1 "$log")" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
fi

if ! has --pfseq "$@" && [ ! -x "$root/build/release/pfseq" ]; then
  "$root/tools/setup.sh" --no-tests >&2
fi
exec "$python" -B "$compare" "$@"
