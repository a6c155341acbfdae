#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sky map becomes part of the sequence, which renders again from its own folder; maps that are no good get one clear line.
source "$(dirname "$0")/common.sh"

# A picture twice as wide as high, in radiance: what the fisheye sees will do.
render_map() { "$pfseq" render "$tiny" --out "$1" --set image.size_px="$2" --frames 0 --cameras front --lenses equidistant \
  --outputs linear --set render.samples=1 --quiet >/dev/null; }
render_map picture '[96, 48]'
mkdir maps && cp picture/equidistant/front/linear/000000.exr maps/sky.exr

# The description names the map; its copy is what the folder points to.
"$pfseq" render "$tiny" --out one --set light.sky.map=maps/sky.exr --set light.sky.map_rotation_deg=30 --frames 0,1 --quiet >/dev/null
cmp maps/sky.exr one/sky_map.exr || fail "the copy of the map is not the map"
grep -q "map: sky_map.exr" one/sequence.yaml || fail "sequence.yaml does not point to the copy"
! grep -q "  sun:" one/sequence.yaml || fail "a sequence with a map has a sun"
grep -q '"sky_map.exr"' one/manifest.json || fail "the manifest does not list the map"
rm maps/sky.exr
"$pfseq" render one/sequence.yaml --out again --frames 0,1 --threads 1 --quiet >/dev/null
expect_same_folders one again
"$pfseq" check one --quiet >/dev/null || fail "a sequence with a map has faults"
"$pfseq" render "$tiny" --out plain --frames 0 --cameras front --lenses equidistant --quiet >/dev/null
! cmp -s {one,plain}/equidistant/front/clean/000000.png || fail "the map changes nothing"

# What is no map.
expect_failure 2 "none.exr" "$pfseq" render "$tiny" --out bad --set light.sky.map=none.exr
head -c 700 one/sky_map.exr >cut.exr
expect_failure 2 "cut.exr" "$pfseq" render "$tiny" --out bad --set light.sky.map=cut.exr
head -c 5000 /dev/urandom >noise.hdr
expect_failure 2 "noise.hdr" "$pfseq" render "$tiny" --out bad --set light.sky.map=noise.hdr
expect_failure 2 "expected an OpenEXR or Radiance HDR file" "$pfseq" render "$tiny" --out bad --set light.sky.map=one/equidistant/front/sky/000000.png
render_map square 48
expect_failure 2 "twice as wide as high" "$pfseq" render "$tiny" --out bad \
  --set light.sky.map=square/equidistant/front/linear/000000.exr
expect_failure 2 "brings its own sun" "$pfseq" render "$tiny" --out bad --set light.sky.map=one/sky_map.exr --set light.sun.strength=1
expect_failure 2 "expected a time when the sun is up" "$pfseq" render "$tiny" --out bad --set light.sun.date_time=2014-06-21T23:00:00Z
expect_failure 2 "expected a date from 1900" "$pfseq" render "$tiny" --out bad --set light.sun.date_time=2014-06-31T12:00:00Z
[ ! -e bad ] || fail "a refused run left a folder behind"

# Exposure: settled once for the sequence, and a number stays as it is.
grep -qE "^  exposure: 0\.[0-9]+$" one/sequence.yaml || fail "sequence.yaml has no exposure: $(grep exposure one/sequence.yaml)"
"$pfseq" render "$tiny" --out number --set sensor.exposure=0.0721 --frames 0 --outputs sky --quiet >/dev/null
grep -q "^  exposure: 0.0721$" number/sequence.yaml || fail "another exposure: $(grep exposure number/sequence.yaml)"

# A sun by date and place, under clouds.
"$pfseq" render "$tiny" --out dated --set light.sun.date_time=2014-06-21T15:30:00+02:00 --set light.sky.clouds.share=0.5 \
  --frames 0 --cameras front --quiet >/dev/null
"$pfseq" render dated/sequence.yaml --out dated_again --frames 0 --cameras front --threads 1 --quiet >/dev/null
expect_same_folders dated dated_again
echo "passed"
