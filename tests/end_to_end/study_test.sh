#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A study of a small sequence: forecast, resume, shards, shared files, report; what is wrong with one is told in one line.
source "$(dirname "$0")/common.sh"

# Bare walls are quick.
"$pfseq" scene "$tiny" --materials untextured --out walls.glb
cat >study.yaml <<YAML
base: $tiny
set: {image.size_px: 96, render.light: path, render.samples: 2, render.max_bounces: 1, scene.gltf: walls.glb}
factors:
  exposure: {key: shutter.exposure_s, values: [0, 0.2]}
  lens: {key: lenses.equisolid.model, values: [equisolid, stereographic]}
repetitions: {render.seed: [1, 2]}
pairs: 1
lenses: equisolid
tolerance_m: 0.15
grid: {settings: [SIFT nopol 0.02 20.0 1.0 SIFT BruteForce, SIFT nopol 0.02 20.0 1.0 FREAK 22.0 BruteForce]}
YAML
"$pfseq" study study.yaml --list >list.txt
grep -q '^2 factors (exposure 2 levels, lens 2 levels), one at a time, 2 repetitions: 6 variants$' list.txt || fail "no plan: $(cat list.txt)"
grep -q '^forecast: .* by stored rates and a trial of this machine$' list.txt || fail "no forecast: $(cat list.txt)"
grep -qx 'exposure_0.2__2' list.txt || fail "no list of variants: $(cat list.txt)"

# In shards; the last to finish makes the report.
"$pfseq" study study.yaml --out shards --shard 0/2 --quiet >first.txt
grep -q 'shard 0/2 done' first.txt || fail "a shard does not tell that others are missing: $(cat first.txt)"
[ ! -e shards/report ] || fail "half of a study made a report"
"$pfseq" study study.yaml --out shards --shard 1/2 --quiet >second.txt
[ -s shards/report/study.html ] || fail "the last shard made no report"

# Stopped in the middle: by a kill once the first variant is done.
"$pfseq" study study.yaml --out whole --quiet >/dev/null &
runner=$!
for _ in $(seq 600); do [ -e whole/variants/base__1/time.json ] && break; sleep 0.05; done
kill -KILL "$runner" 2>/dev/null || fail "the study was over before it could be stopped"
wait "$runner" 2>/dev/null || true
touch -d '2001-01-01' whole/variants/base__1/bench/results.json
expect_failure 2 "already holds a study" "$pfseq" study study.yaml --out whole
"$pfseq" study study.yaml --out whole --resume --list >list.txt
grep -qx 'base__1  (done)' list.txt || fail "what is done is not told: $(cat list.txt)"
grep -q 'by the variants that are done$' list.txt || fail "the forecast did not learn: $(cat list.txt)"
"$pfseq" study study.yaml --out whole --resume --quiet >/dev/null
[ "$(stat -c %Y whole/variants/base__1/bench/results.json)" -lt 1000000000 ] || fail "a finished variant was measured again"

# The same results either way.
for folder in whole/variants/*; do
  name=${folder##*/}
  cmp -s "$folder/bench/results.csv" "shards/variants/$name/bench/results.csv" || fail "results of $name depend on shards or a stop"
  cmp -s "$folder/sequence/manifest.json" "shards/variants/$name/sequence/manifest.json" || fail "the sequence $name depends on shards or a stop"
done
for name in exposure_0.2__1 lens_stereographic__2; do
  "$pfseq" check "whole/variants/$name/sequence" --quiet >check.txt || fail "$name is faulty: $(cat check.txt)"
done
cmp -s whole/report/tables/effects.csv shards/report/tables/effects.csv || fail "the report depends on shards or a stop"
truth=equisolid/front/distance/000001.exr
[ "$(stat -c %h "whole/variants/base__1/sequence/$truth")" -gt 1 ] || fail "the distance map of the same views was made twice"
[ "$(stat -c %h "whole/variants/lens_stereographic__1/sequence/$truth")" -lt 5 ] || fail "lenses share a distance map"
[ "$(stat -c %h whole/variants/lens_stereographic__1/sequence/scene.glb)" -eq 6 ] || fail "the scene is not shared by all variants"

# As if the base sequence had changed since.
sed -i 's/samples: 2/samples: 3/' whole/variants/base__2/variant.yaml
expect_failure 2 "variant.yaml: was made from another study (line" "$pfseq" study study.yaml --out whole --resume
sed 's/values: \[0, 0.2\]/values: [0, 0.3]/' study.yaml >other.yaml
expect_failure 2 "was made from another study (line" "$pfseq" study other.yaml --out whole --resume
expect_failure 2 "missing.yaml" "$pfseq" study missing.yaml --out out
expect_failure 2 "--out DIR" "$pfseq" study study.yaml
sed 's/exposure_s/exposur_s/' study.yaml >wrong.yaml
expect_failure 2 "wrong.yaml:4: shutter.exposur_s" "$pfseq" study wrong.yaml --out out
sed 's/\[0, 0.2\]/[0, 0]/' study.yaml >twice.yaml
expect_failure 2 "label '0' given twice" "$pfseq" study twice.yaml --out out
sed 's/\[0, 0.2\]/[]/' study.yaml >empty.yaml
expect_failure 2 "factors.exposure.values: expected a list" "$pfseq" study empty.yaml --out out
expect_failure 2 "--shard 2/2" "$pfseq" study study.yaml --out out --shard 2/2
mkdir other && touch other/precious
expect_failure 2 "holds other things" "$pfseq" study study.yaml --out other
[ ! -e out ] || fail "a refused study left a folder behind"
limited() { (trap '' XFSZ; ulimit -f 16; exec "$@"); }
expect_failure 1 "cannot write full/" limited "$pfseq" study study.yaml --out full --quiet
[ -z "$(find full -name '*.partial')" ] || fail "a full disk left a temporary file"
echo "passed"
