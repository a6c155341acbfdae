#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How time and memory grow with frames, image size and triangles.
# Usage: benchmarks/growth.sh [PFSEQ_PROGRAM [frames|size|triangles ...]]     without a word: all three
# Prints wall seconds, CPU seconds and peak memory of whole runs (scene, acceleration structure and writing included),
# first with the light to be computed, then with the light that the first has kept.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
pfseq=${1:-$root/build/release/pfseq}
words=" ${*:2} "
[ "$words" = "  " ] && words=" frames size triangles "
for word in $words; do
  case $word in
    frames | size | triangles) ;;
    *) echo "growth.sh: $word: expected frames, size or triangles" >&2; exit 2 ;;
  esac
done
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# run LABEL FLAGS...: renders one camera with one lens
run() {
  local label=$1
  shift
  rm -rf "$out/light"
  for light in new kept; do
    rm -rf "$out/sequence"
    /usr/bin/time -f "%e %U %M" -o "$out/time" "$pfseq" render "$root/data/sequences/pfseq.yaml" --out "$out/sequence" \
      --cameras front --lenses equisolid --light-cache "$out/light" --quiet "$@" >/dev/null
    awk -v label="$label, light $light" \
      '{ printf "%-46s %8.1f s wall %8.1f s CPU %8.0f MiB\n", label, $1, $2, $3 / 1024 }' "$out/time"
  done
}

if [[ $words == *" frames "* ]]; then
  for frames in 1 4 16 64; do
    run "$frames frames of 300 px" --set image.size_px=300 --frames 0:$frames
  done
fi
if [[ $words == *" size "* ]]; then
  for size_px in 300 600 1200 2400; do
    run "1 frame of $size_px px" --set image.size_px=$size_px --frames 0
  done
fi
[[ $words == *" triangles "* ]] || exit 0
# Detail, rows of blocks, lengths of the streets.
while read -r detail blocks street_m; do
  city=(--set "scene.canyon.detail=$detail" --set "scene.canyon.surrounding_blocks=$blocks"
    --set "trajectory.drive.first_street_m=$street_m" --set "trajectory.drive.cross_street_m=$street_m"
    --set "trajectory.drive.last_street_m=$street_m")
  triangles=$("$pfseq" scene "$root/data/sequences/pfseq.yaml" --stats "${city[@]}" | sed -n 's/.*  triangles \([0-9]*\)$/\1/p')
  run "1 frame of 600 px, $triangles triangles" --set image.size_px=600 --frames 0 "${city[@]}"
done <<< "0 0 40
1 2 60
2 4 60
2 12 200"
