#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches glTF scenes that others made, from Debian's packages, without installing anything:
# - a van, a car, buses, trucks, trees and lamp posts of sweethome3d-furniture (CC-BY-3.0 and CC0; the licences lie in
#   CACHE/furniture), converted from OBJ to GLB in metres by assimp;
# - the glTF test models of assimp-testmodels (BSD-3-Clause), several of them broken on purpose.
# Then reads each with `pfseq scene`, where that is built, and lists how it went.
# Usage: tools/sample_scenes.sh [CACHE]      CACHE: folder for all of it (default: build/sample_scenes, some 800 MB)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${1:-$root/build/sample_scenes}
mkdir -p "$cache/packages"
cache=$(cd "$cache" && pwd)
pfseq=$root/build/release/pfseq

# Model and height in metres, as the library's catalogue gives it (the OBJ files are in centimetres or in no unit at
# all). A name that ends with a slash is a folder that holds a model of its name.
models=(
  scopia/van/ 2.565
  scopia/smart-car/ 1.546
  scopia/bus/ 3.667
  scopia/cityBus/ 3.02
  scopia/truck/ 3.4
  blendswap-cc-by/dafTruck/ 4.005
  scopia/bicycle/ 0.843
  scopia/ficusTree/ 5.0
  scopia/coconutTree/ 11.0
  scopia/bush/ 1.312
  katorlegaz/classic-lamppost/ 2.5
  katorlegaz/park-light/ 3.0
)

fetch() {
  local package=$1
  if ! compgen -G "$cache/packages/${package}_*.deb" >/dev/null; then
    echo "== download $package"
    if ! (cd "$cache/packages" && apt-get download -q "$package" >download.log 2>&1); then
      echo "sample_scenes.sh: cannot download the Debian package $package: is there a network, and has apt-get update" \
        "been run? (see $cache/packages/download.log)" >&2
      exit 1
    fi
  fi
  dpkg -x "$cache/packages/${package}"_*.deb "$cache/root"
}

if [ ! -e "$cache/packages/unpacked" ]; then
  for package in assimp-testmodels assimp-utils libassimp5 libdraco7 libminizip1 sweethome3d-furniture; do
    fetch "$package"
  done
  mkdir -p "$cache/furniture"
  for library in "$cache"/root/usr/share/sweethome3d/furniture/*.sh3f; do
    (cd "$cache/furniture" && cmake -E tar xf "$library")
    mv "$cache/furniture/LICENSE.TXT" "$cache/furniture/LICENSE-$(basename "$library" .sh3f).txt"
  done
  touch "$cache/packages/unpacked"
fi

assimp() {
  LD_LIBRARY_PATH=$(dirname "$(find "$cache/root" -name 'libassimp.so.5' -print -quit)") "$cache/root/usr/bin/assimp" "$@"
}

# Scales an OBJ file's vertices so that the model gets the height.
scale() {
  LC_ALL=C awk -v height="$3" '
    NR == FNR { if ($1 == "v") { if (!n++ || $3 < low) low = $3; if (n == 1 || $3 > high) high = $3 } next }
    $1 == "v" { s = height / (high - low); printf "v %.9g %.9g %.9g\n", $2 * s, $3 * s, $4 * s; next }
    { print }' "$1" "$1" >"$2"
}

echo "== convert"
for ((i = 0; i < ${#models[@]}; i += 2)); do
  name=$(basename "${models[i]}")
  folder=$cache/models/$name
  if [ ! -e "$folder/$name.glb" ]; then
    mkdir -p "$folder"
    cp -r "$cache/furniture/${models[i]}." "$folder"
    scale "$cache/furniture/${models[i]}$name.obj" "$folder/$name.obj" "${models[i + 1]}"
    # -fd: without it assimp writes indices out of nowhere for faces of two corners.
    if ! assimp export "$folder/$name.obj" "$folder/part.glb" -fd >"$folder/assimp.log" 2>&1; then
      echo "sample_scenes.sh: assimp cannot convert $name (see $folder/assimp.log)" >&2
      exit 1
    fi
    mv "$folder/part.glb" "$folder/$name.glb"
  fi
  echo "$folder/$name.glb"
done

if [ ! -x "$pfseq" ]; then
  echo "To see how they are read, build $pfseq (tools/setup.sh) and run this again."
  exit 0
fi

read_scene() {
  local text
  if text=$("$pfseq" scene "$root/data/sequences/tiny.yaml" --set "scene.gltf=$1" --stats 2>&1); then
    echo "read     ${1#"$cache"/}: $(awk '/^triangles:|^extent_m:/' <<<"$text" | paste -sd' ')"
  else
    echo "refused  $(tail -n 1 <<<"$text")"
  fi
}

echo "== read the converted models"
for ((i = 0; i < ${#models[@]}; i += 2)); do
  name=$(basename "${models[i]}")
  read_scene "$cache/models/$name/$name.glb"
done
echo "== read assimp's test models (glTF/ holds glTF 1.0 files, which are to be refused)"
find "$cache/root/usr/share/assimp/models" -name '*.gl[tb]*' | LC_ALL=C sort | while read -r path; do
  read_scene "$path"
done
