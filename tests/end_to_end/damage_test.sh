#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pfseq check finds nothing in a sound sequence, and names the file and the fault in damaged ones.
source "$(dirname "$0")/common.sh"

"$pfseq" render "$tiny" --out sound --set render.samples=1 --quiet >/dev/null
"$pfseq" check sound --quiet >report.txt || fail "a sound sequence has faults: $(cat report.txt)"

# expect_fault FILE TEXT: check of ./damaged ends with status 1 and has a line with FILE and TEXT
expect_fault() {
  local status=0
  "$pfseq" check damaged --quiet >report.txt 2>&1 || status=$?
  [ "$status" -eq 1 ] || fail "expected exit status 1, got $status for $1"
  grep -F -- "$1" report.txt | grep -qF -- "$2" || fail "expected a line with '$1' and '$2', got: $(cat report.txt)"
}
restore() { rm -rf damaged && cp -r sound damaged; }
# The manifest made anew: what is left to find is in the data alone.
reseal() { rm damaged/manifest.json && "$pfseq" render "$tiny" --out damaged --set render.samples=1 --resume --quiet >/dev/null; }

restore
printf '\x55' | dd of=damaged/equisolid/front/clean/000001.png bs=1 seek=300 conv=notrunc status=none
expect_fault equisolid/front/clean/000001.png "SHA-256"

restore
truncate -s -200 damaged/equidistant/rear/clean/000002.png
expect_fault equidistant/rear/clean/000002.png "truncated"

restore
truncate -s -400 damaged/equidistant/rear/distance/000002.exr
expect_fault equidistant/rear/distance/000002.exr "truncated"

restore
rm damaged/equisolid/rear/sky/000003.png
expect_fault equisolid/rear/sky/000003.png "missing"

restore
rm damaged/manifest.json
expect_fault manifest.json "resume"

restore
for output in distance sky; do
  suffix=$([ $output = sky ] && echo png || echo exr)
  mv damaged/equisolid/front/$output/000003.$suffix kept
  mv damaged/equisolid/rear/$output/000003.$suffix damaged/equisolid/front/$output/000003.$suffix
  mv kept damaged/equisolid/rear/$output/000003.$suffix
done
reseal
expect_fault equisolid/front/distance/000003.exr "rear"

restore
# Frame 3 moves by 10 cm, in poses.csv alone.
awk -F, -v OFS=, '$1 == "3" { $3 = $3 + 0.1 } { print }' sound/poses.csv >damaged/poses.csv
expect_fault poses.csv "frame 3"
echo "passed"
