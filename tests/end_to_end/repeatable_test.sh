#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The same description gives the same bytes: for any number of threads, order of frames, split into shards, and after
# kills at any moment.
source "$(dirname "$0")/common.sh"

"$pfseq" render "$tiny" --out one --threads 1 --quiet >/dev/null
[ -f one/manifest.json ] || fail "no manifest"

"$pfseq" render "$tiny" --out two --threads 2 --quiet >/dev/null
expect_same_folders one two

# Stored light changes no byte, wherever it comes from: computed anew each time, left by a run of other frames, or from
# a file that was cut off.
render_with_light() {
  "$pfseq" render "$tiny" --out "$1" --light-cache "$2" --frames "$3" --cameras front --quiet \
    >/dev/null 2>stderr.txt || fail "$(cat stderr.txt)"
}
render_with_light no_cache none 1,3
render_with_light other_frames kept 0,2
render_with_light kept_light kept 1,3
expect_same_folders no_cache kept_light
light=(kept/*.light)
[ ${#light[@]} -eq 1 ] || fail "expected one file of stored light, got: ${light[*]}"
truncate -s -5000 "${light[0]}"
render_with_light cut_light kept 1,3
grep -q "is damaged" stderr.txt || fail "a damaged file of stored light is not told of: $(cat stderr.txt)"
expect_same_folders no_cache cut_light
render_with_light made_good kept 1,3
[ ! -s stderr.txt ] || fail "the damaged file was not made anew: $(cat stderr.txt)"
expect_same_folders no_cache made_good

# The scene itself, on one processor and on all; another seed makes another one.
taskset -c "$(taskset -cp $$ | sed 's/.*: \([0-9]*\).*/\1/')" "$pfseq" scene "$tiny" --out single.glb
"$pfseq" scene "$tiny" --out all.glb --map plan.png
cmp single.glb all.glb || fail "the scene depends on the number of processors"
cmp one/scene.glb all.glb || fail "the scene of a sequence is not that of its description"
"$pfseq" scene "$tiny" --out other.glb --set scene.canyon.seed=2
! cmp -s all.glb other.glb || fail "another seed makes the same scene"
[ "$(head -c 4 plan.png | tail -c 3)" = PNG ] || fail "--map wrote no PNG"

for frame in 3 1 0 2; do
  "$pfseq" render "$tiny" --out order --frames $frame --resume --quiet >/dev/null
done
expect_same_folders one order

"$pfseq" render "$tiny" --out shards --shard 1/2 --quiet >shard.txt
[ ! -f shards/manifest.json ] || fail "half of the shards wrote a manifest"
grep -q "other shards" shard.txt || fail "a shard does not tell that others are missing"
"$pfseq" render "$tiny" --out shards --shard 0/2 --quiet >/dev/null
expect_same_folders one shards

"$pfseq" render "$tiny" --out together --shard 0/2 --quiet >/dev/null &
"$pfseq" render "$tiny" --out together --shard 1/2 --quiet >/dev/null
wait $!
expect_same_folders one together

# Killed after longer and longer times, in the middle of whatever it does, until a run comes through.
kills=0
for delay in 0.3 0.6 0.9 1.2 1.5 1.7 1.9 2.1 2.3 2.5 3 4 5 7 10 15 30 60 120; do
  if timeout --signal=KILL "$delay" "$pfseq" render "$tiny" --out killed --resume --quiet >/dev/null 2>&1; then
    break
  fi
  kills=$((kills + 1))
  [ -d killed ] || continue
  for file in $(find killed -name '*.png' -o -name '*.exr'); do
    cmp -s "$file" "one/${file#killed/}" || fail "half a file under a final name: $file"
  done
done
[ "$kills" -ge 2 ] || fail "no run was killed"
expect_same_folders one killed

# A sequence renders again from its own folder, and from its scene.glb.
"$pfseq" render one/sequence.yaml --out again --quiet >/dev/null
expect_same_folders one again
"$pfseq" render "$tiny" --out from_glb --set scene.gltf="$work/one/scene.glb" --quiet >/dev/null
for lens in equidistant equisolid; do
  for camera in front rear; do
    expect_same_folders one/$lens/$camera from_glb/$lens/$camera
  done
done
cmp one/scene.glb from_glb/scene.glb || fail "scene.glb changes when it is read and written again"

# The benchmark's results are repeatable too, for any threads, shards and interruptions.
settings=(--setting "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce" --setting "CenSurE pol 16 10 3 FREAK 11.0 RatioTest"
  --setting "ORB nopol 500 ORB 3 BruteForce")
"$pfseq" bench one --out bench_1 "${settings[@]}" --threads 1 --quiet >/dev/null
"$pfseq" bench one --out bench_2 "${settings[@]}" --threads 2 --quiet >/dev/null
for shard in 0 1; do
  "$pfseq" bench one --out bench_3 "${settings[@]}" --shard $shard/2 --quiet >/dev/null
done
[ ! -e bench_3/results.csv ] || fail "a shard alone wrote results"
"$pfseq" bench one --out bench_3 "${settings[@]}" --resume --quiet >/dev/null
timeout -s KILL 1 "$pfseq" bench one --out bench_4 "${settings[@]}" --threads 1 --quiet >/dev/null || true
"$pfseq" bench one --out bench_4 "${settings[@]}" --resume --quiet >/dev/null
# Times, and the command with its folder and threads.
rm bench_?/times.csv bench_?/run.json
find bench_4 -name '*.partial' -delete
for i in 2 3 4; do
  expect_same_folders bench_1 bench_$i
done
expect_failure 2 "--variant realistic" "$pfseq" bench one --out bench_5 --variant realistic
expect_failure 2 "frame 99" "$pfseq" bench one --out bench_5 --pairs 99
[ ! -e bench_5 ] || fail "a refused benchmark left a folder behind"
echo "passed; $kills runs were killed"
