#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bad input gets one clear line and exit status 2, the world's failures exit status 1; nothing is lost or half-written.
source "$(dirname "$0")/common.sh"

expect_failure 2 "missing.yaml" "$pfseq" render missing.yaml --out out
expect_failure 2 "did you mean size_px" "$pfseq" render "$tiny" --out out --set image.siz_px=3
expect_failure 2 "--set image.size_px=-3" "$pfseq" render "$tiny" --out out --set image.size_px=-3
expect_failure 2 "--set image.size_px=nan" "$pfseq" render "$tiny" --out out --set image.size_px=nan
expect_failure 2 "--set render.samples=1e99" "$pfseq" render "$tiny" --out out --set render.samples=1e99
expect_failure 2 "lenses.equisolid.fov_deg" "$pfseq" render "$tiny" --out out --set lenses.equisolid.fov_deg=400
expect_failure 2 "--frames 0,x" "$pfseq" render "$tiny" --out out --frames 0,x
expect_failure 2 "--frames 99: the sequence has frames 0 to 3" "$pfseq" render "$tiny" --out out --frames 99
expect_failure 2 "--cameras left: the sequence has front, rear" "$pfseq" render "$tiny" --out out --cameras left
expect_failure 2 "--lenses pinhole" "$pfseq" render "$tiny" --out out --lenses pinhole
expect_failure 2 "got 'depth'" "$pfseq" render "$tiny" --out out --outputs depth
expect_failure 2 "--shard 2/2" "$pfseq" render "$tiny" --out out --shard 2/2
expect_failure 2 "--out" "$pfseq" render "$tiny"
expect_failure 2 "nowhere.glb" "$pfseq" render "$tiny" --out out --set scene.gltf=nowhere.glb
expect_failure 2 "no_facades.yaml" "$pfseq" render "$tiny" --out out --set scene.canyon.facades=no_facades.yaml
expect_failure 2 "scene.canyon.street_life" "$pfseq" render "$tiny" --out out --set scene.canyon.street_life=9
expect_failure 2 "--map plan.jpg" "$pfseq" scene "$tiny" --map plan.jpg
head -c 1000 /dev/urandom >noise.glb
expect_failure 2 "noise.glb" "$pfseq" render "$tiny" --out out --set scene.gltf=noise.glb
expect_failure 2 "none.txt" "$pfseq" render "$tiny" --out out --set trajectory.tum=none.txt
expect_failure 2 "nothing" "$pfseq" check nothing
expect_failure 2 "nothing" "$pfseq" bench nothing --out results
expect_failure 2 "--out" "$pfseq" bench nothing
printf 'detectors:\n  - algorithm: SIFT\n    sigm: 1.6\n' >grid.yaml
expect_failure 2 "grid.yaml:3" "$pfseq" bench --grid grid.yaml --list
expect_failure 2 "expected pol or nopol" "$pfseq" bench --setting "SIFT 0.04" --list
expect_failure 2 "--shard 2/2" "$pfseq" bench nothing --out results --shard 2/2
expect_failure 2 "nothing/results.json" "$pfseq" report nothing --out results
expect_failure 2 "--out" "$pfseq" report nothing
expect_failure 2 "nothing: expected the folder of a sequence" "$pfseq" view nothing --port 0
[ ! -e results ] || fail "a refused benchmark left a folder behind"
[ ! -e out ] || fail "a refused run left a folder behind"

printf 'name: x\nimage: {size_px: 10\n' >broken.yaml
expect_failure 2 "broken.yaml:" "$pfseq" render broken.yaml --out out

# A second run into the folder of another description.
"$pfseq" render "$tiny" --out out --frames 0 --outputs distance --quiet >/dev/null
cp -r out before
expect_failure 2 "already holds a sequence" "$pfseq" render "$tiny" --out out --quiet
expect_failure 2 "another description" "$pfseq" render "$tiny" --out out --resume --set render.seed=99 --quiet
expect_same_folders before out
"$pfseq" render "$tiny" --out out --overwrite --set render.seed=99 --frames 1 --outputs sky --quiet >/dev/null
[ ! -e out/equisolid/front/distance/000000.exr ] || fail "--overwrite left a file of the old sequence"
mkdir other && touch other/precious
expect_failure 2 "holds other things" "$pfseq" render "$tiny" --out other --overwrite --quiet
[ -e other/precious ] || fail "somebody else's file is gone"

# A disk that takes no more: files beyond 64 KiB fail, as they do on a full one.
limited() { (trap '' XFSZ; ulimit -f 64; exec "$@"); }
expect_failure 1 "cannot write full/" limited "$pfseq" render "$tiny" --out full --set image.size_px=300 --quiet
[ ! -e full/manifest.json ] || fail "a failed run wrote a manifest"
[ -z "$(find full -name '*.partial')" ] || fail "a failed run left a temporary file"

# A folder that must not be written, as somebody who is not root: with copies that anybody can reach.
mkdir locked && chmod 555 locked
cp "$pfseq" program && cp "$tiny" copy.yaml
chmod 755 "$work" program && chmod 644 copy.yaml
run=()
if [ "$(id -u)" -eq 0 ]; then
  run=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
if "${run[@]}" ./program --version >/dev/null 2>&1; then
  expect_failure 1 "Permission denied" "${run[@]}" ./program render copy.yaml --out locked/here --quiet
else
  echo "the folder that must not be written was left out: another user cannot run a program in $work"
fi
echo "passed"
