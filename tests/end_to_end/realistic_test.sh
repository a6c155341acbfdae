#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Realistic frames beside clean ones: the same bytes whatever the threads and interruptions, the same ground truth as
# without faults, and pictures of all kinds that check and bench can read.
source "$(dirname "$0")/common.sh"

faults=(--set "optics=$source_folder/data/optics/strong.yaml" --set shutter.exposure_s=0.1 --set sensor.white_electrons=4000)
everything=realistic,clean,linear,distance,sky,blur,flare
"$pfseq" render "$tiny" --out clean --frames 0,3 --quiet >/dev/null
[ ! -e clean/equisolid/front/realistic ] || fail "realistic frames of a perfect camera"

"$pfseq" render "$tiny" --out one "${faults[@]}" --frames 0,3 --outputs $everything --threads 1 --quiet >/dev/null
"$pfseq" render "$tiny" --out two "${faults[@]}" --frames 3 --outputs realistic --threads 2 --quiet >/dev/null
"$pfseq" render "$tiny" --out two "${faults[@]}" --frames 0,3 --outputs $everything --resume --threads 2 --quiet >/dev/null
expect_same_folders one two
for lens in equidistant equisolid; do
  for camera in front rear; do
    for kind in clean distance sky; do
      expect_same_folders one/$lens/$camera/$kind clean/$lens/$camera/$kind
    done
    ! cmp -s one/$lens/$camera/realistic/000003.png one/$lens/$camera/clean/000003.png ||
      fail "the faults change nothing in $lens/$camera"
  done
done
"$pfseq" render one/sequence.yaml --out again --frames 0,3 --outputs $everything --quiet >/dev/null
expect_same_folders one again
"$pfseq" check one --quiet >check.txt || fail "check: $(cat check.txt)"

setting=(--setting "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce" --pairs 0 --quiet)
"$pfseq" bench one --out bench_realistic "${setting[@]}" >/dev/null
"$pfseq" bench clean --out bench_clean "${setting[@]}" >/dev/null
! cmp -s bench_realistic/results.csv bench_clean/results.csv || fail "bench does not look at realistic frames"

# A camera that writes JPEG, and one with a grey 16-bit sensor.
"$pfseq" render "$tiny" --out jpeg "${faults[@]}" --set sensor.jpeg_quality=85 --frames 0 --quiet >/dev/null
[ -f jpeg/equisolid/rear/realistic/000000.jpg ] || fail "no JPEG"
"$pfseq" render "$tiny" --out grey "${faults[@]}" --set sensor.bits=16 --set sensor.color=grey --frames 0 --quiet >/dev/null
for kind in jpeg grey; do
  "$pfseq" check $kind --quiet >check.txt || fail "check $kind: $(cat check.txt)"
  "$pfseq" bench $kind --out bench_$kind "${setting[@]}" >/dev/null
done
truncate -s -100 grey/equisolid/rear/realistic/000000.png
if "$pfseq" check grey --quiet >check.txt 2>&1; then fail "check does not see a damaged realistic frame"; fi

expect_failure 2 "nowhere.yaml" "$pfseq" render "$tiny" --out bad --set optics=nowhere.yaml
[ ! -e bad ] || fail "something was written"
