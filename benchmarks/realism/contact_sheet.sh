#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders one view through each effect of the camera alone and all together, and lays 1:1 crops of it beside each other:
# a row an effect (first the clean picture), columns: image centre, half-way to the rim, rim. Needs oiiotool.
#
# Usage: contact_sheet.sh SHEET.png [FRAME [SEQUENCE.yaml]]      default: frame 40 of data/sequences/pfseq.yaml
#   PFSEQ      the program (default: build/release/pfseq)
#   CAMERA, LENS   the view (default: front, equisolid)
#   FLAGS      more flags for the rendering, for example "--set image.size_px=600"
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sheet=${1:?usage: contact_sheet.sh SHEET.png [FRAME [SEQUENCE.yaml]]}
frame=${2:-40}
sequence=${3:-$root/data/sequences/pfseq.yaml}
pfseq=${PFSEQ:-$root/build/release/pfseq}
camera=${CAMERA:-front}
lens=${LENS:-equisolid}
crop=240

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# render NAME FLAGS...: the view as NAME.png
render() {
  local name=$1
  shift
  echo "== $name" >&2
  # shellcheck disable=SC2086  # the flags are words
  "$pfseq" render "$sequence" --out "$work/$name" --frames "$frame" --cameras "$camera" --lenses "$lens" --quiet ${FLAGS:-} "$@" >&2
  find "$work/$name" \( -path '*/realistic/*' -o -path '*/clean/*' \) -name '*.png' -exec mv {} "$work/$name.png" \;
  rm -rf "${work:?}/$name"
}

still="shutter.exposure_s=0"
render clean --outputs clean
names=(clean)
render motion --outputs realistic --set optics="$root/data/optics/off.yaml"
names+=(motion)
for file in "$root"/data/optics/*.yaml; do
  name=$(basename "$file" .yaml)
  [[ $name == off || $name == pfseq || $name == strong ]] && continue
  render "$name" --outputs realistic --set optics="$file" --set "$still"
  names+=("$name")
done
render noise --outputs realistic --set optics="$root/data/optics/off.yaml" --set "$still" --set sensor.white_electrons=4000
names+=(noise)
for name in pfseq strong; do
  render "$name" --outputs realistic --set optics="$root/data/optics/$name.yaml"
  names+=("$name")
done

size=$(oiiotool "$work/clean.png" --echo "{TOP.width}" | head -n 1)
# Without a font there are no labels; the rows are told at the end.
has_font=0
oiiotool --create 64x64 3 --text:size=10 x -o "$work/label.png" >/dev/null 2>&1 && has_font=1
crops=()
for name in "${names[@]}"; do
  for share in 0 0.5 0.9; do
    # Upward from the centre, where the facades stand.
    left=$(((size - crop) / 2))
    top=$(awk -v s="$size" -v c="$crop" -v f="$share" \
      'BEGIN { t = int(s / 2 - f * s / 2 * 1124 / 1200 - c / 2); print t < 0 ? 0 : t }')
    label=()
    [[ $share == 0 && $has_font == 1 ]] && label=(--text:x=8:y=24:size=20:color=1,1,0:shadow=2 "$name")
    oiiotool "$work/$name.png" --ch 0,1,2 --cut "${crop}x${crop}+$left+$top" "${label[@]}" -o "$work/$name-$share.png"
    crops+=("$work/$name-$share.png")
  done
done
oiiotool "${crops[@]}" --mosaic:pad=4 "3x${#names[@]}" -o "$sheet"
echo "$sheet, rows from above: ${names[*]}"
