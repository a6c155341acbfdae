#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare clone to a report: installs what is missing, builds, renders frames 0, 24 and 40 of the default sequence
# with all cameras and lenses, checks them, measures the settings that the report of 2014 shows on them, and writes a
# page about the results.
# Usage: tools/quickstart.sh [OUT]      OUT: folder for the results (default: out/quickstart)
# PFSEQ_RENDER_FLAGS holds more flags for the rendering, for example "--set image.size_px=300 --set render.samples=8".
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-$root/out/quickstart}
started=$SECONDS
"$root/tools/setup.sh" --no-tests
pfseq=$root/build/release/pfseq
built=$SECONDS

echo "== render: frames 0, 24 and 40 of data/sequences/pfseq.yaml to $out/sequence"
# shellcheck disable=SC2086  # the flags are words
"$pfseq" render "$root/data/sequences/pfseq.yaml" --out "$out/sequence" --frames 0,24,40 --resume ${PFSEQ_RENDER_FLAGS:-}
rendered=$SECONDS

echo "== check"
"$pfseq" check "$out/sequence"
checked=$SECONDS

echo "== benchmark: data/grids/highlights.yaml on the equisolid lens"
"$pfseq" bench "$out/sequence" --grid "$root/data/grids/highlights.yaml" --lens equisolid --pairs 0,24,40 --out "$out/bench"
measured=$SECONDS

echo "== report"
"$pfseq" report "$out/bench" --out "$out/report"

cat <<TEXT

Done: set-up and build $((built - started)) s, rendering $((rendered - built)) s, check $((checked - rendered)) s, benchmark $((measured - checked)) s, report $((SECONDS - measured)) s.
  pictures         $out/sequence/equisolid/front/realistic/000000.png, clean/ beside it (README.md, "What is in the folder")
  distance maps    $out/sequence/equisolid/front/distance/000000.exr (metres, float32)
  measures         $out/bench/results.csv
  report           $out/report/report.html
Next:
  $pfseq view $out/sequence                                                    leaf through the frames
  $pfseq render data/sequences/pfseq.yaml --out out/pfseq                      all 64 frames
  $pfseq render data/sequences/pfseq.yaml --out out/seed7 --set scene.canyon.seed=7 --frames 0
  $pfseq keys                                                                  what else can be set
TEXT
