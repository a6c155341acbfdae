#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches the facade photographs that data/facades/torcs.yaml describes: downloads Debian's package torcs-data (330 MB,
# not installed), keeps the images named there and the package's copyright file in data/facades/torcs, and removes the rest.
# Usage: tools/fetch_facades.sh [torcs-data_*.deb]     a package that is there already
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
description=$root/data/facades/torcs.yaml
target=$root/data/facades/torcs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ $# -gt 0 ]; then
  [ -f "$1" ] || { echo "fetch_facades: $1: expected a Debian package torcs-data" >&2; exit 2; }
  package=$1
else
  echo "== fetching torcs-data"
  if ! (cd "$work" && apt-get download -qq torcs-data); then
    echo "fetch_facades: apt-get cannot download torcs-data; is main in the sources and was apt-get update run?" >&2
    exit 1
  fi
  package=$(echo "$work"/torcs-data_*.deb)
fi

dpkg-deb --fsys-tarfile "$package" | tar -x -C "$work" --wildcards \
  './usr/share/games/torcs/tracks/road/e-track-2/*.png' './usr/share/doc/torcs-data/copyright'
mkdir -p "$target"
sed -n 's/^ *file: torcs\///p' "$description" | while read -r name; do
  cp "$work/usr/share/games/torcs/tracks/road/e-track-2/$name" "$target/$name"
done
cp "$work/usr/share/doc/torcs-data/copyright" "$target/copyright"
echo "== $(find "$target" -name '*.png' | wc -l) photographs in $target"
