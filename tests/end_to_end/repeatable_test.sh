#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The same description gives the same bytes: for any number of threads, order of frames, split into shards, and after
# kills at any moment.
source "$(dirname "$0")/common.sh"

"$pfseq" render "$tiny" --out one --threads 1 --quiet
[ -f one/manifest.json ] || fail "no manifest"

"$pfseq" render "$tiny" --out two --threads 2 --quiet
expect_same_folders one two

for frame in 3 1 0 2; do
  "$pfseq" render "$tiny" --out order --frames $frame --resume --quiet
done
expect_same_folders one order

"$pfseq" render "$tiny" --out shards --shard 1/2 --quiet >shard.txt
[ ! -f shards/manifest.json ] || fail "half of the shards wrote a manifest"
grep -q "other shards" shard.txt || fail "a shard does not tell that others are missing"
"$pfseq" render "$tiny" --out shards --shard 0/2 --quiet
expect_same_folders one shards

"$pfseq" render "$tiny" --out together --shard 0/2 --quiet &
"$pfseq" render "$tiny" --out together --shard 1/2 --quiet
wait $!
expect_same_folders one together

# Killed after 0.05 s, 0.10 s, ... until a run comes through.
kills=0
for delay in $(seq 0.05 0.05 20); do
  if timeout --signal=KILL "$delay" "$pfseq" render "$tiny" --out killed --resume --quiet >/dev/null 2>&1; then
    break
  fi
  kills=$((kills + 1))
  find killed -name '*.png' -print -o -name '*.exr' -print 2>/dev/null | while read -r file; do
    cmp -s "$file" "one/${file#killed/}" || fail "half a file under a final name: $file"
  done
done
[ "$kills" -ge 2 ] || fail "no run was killed"
expect_same_folders one killed

# A sequence renders again from its own folder, and from its scene.glb.
"$pfseq" render one/sequence.yaml --out again --quiet
expect_same_folders one again
"$pfseq" render "$tiny" --out from_glb --set scene.gltf="$work/one/scene.glb" --quiet
for lens in equidistant equisolid; do
  for camera in front rear; do
    expect_same_folders one/$lens/$camera from_glb/$lens/$camera
  done
done
cmp one/scene.glb from_glb/scene.glb || fail "scene.glb changes when it is read and written again"

# The benchmark's results are repeatable too.
"$pfseq" bench one --out bench_1 --threads 1 --quiet >/dev/null
"$pfseq" bench one --out bench_2 --threads 2 --quiet >/dev/null
rm bench_1/times.csv bench_2/times.csv
expect_same_folders bench_1 bench_2
echo "passed; $kills runs were killed"
