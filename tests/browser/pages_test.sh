#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The pages of report and study and the viewer in headless Chromium: PFSEQ_PROGRAM SOURCE_FOLDER [SCREENSHOTS]
# Debian's Python has Debian's selenium.
source "$(dirname "$0")/../end_to_end/common.sh"
tests=$source_folder/tests/browser
# A few noisy samples are enough to click at.
"$pfseq" render "$tiny" --out sequence --frames 0,1 --lenses equisolid --outputs clean,distance,sky --set image.size_px=240 \
  --set render.light=path --set render.samples=2 --set render.max_samples=2 --set render.max_bounces=2 --quiet >/dev/null
cat >grid.yaml <<'YAML'
detectors:
  - {algorithm: SIFT, polar: [false, true], contrastThreshold: [0.01, 0.02, 0.04], edgeThreshold: [5, 10]}
  - {algorithm: ORB, nfeatures: [300, 1000]}
descriptors:
  - algorithm: SIFT
  - {algorithm: ORB, WTA_K: [2, 3]}
matchers:
  - algorithm: BruteForce
  - algorithm: RatioTest
YAML
"$pfseq" bench sequence --grid grid.yaml --out results --pairs 0 --quiet >/dev/null
"$pfseq" report results --out report --quiet >report.txt
"$pfseq" bench sequence --grid grid.yaml --out later --pairs 1 --quiet >/dev/null
"$pfseq" report results later --out both --no-pictures --quiet >/dev/null
# What is left when a run had no pairs.
mkdir none
/usr/bin/python3 - <<'PYTHON'
import json
results = json.load(open("results/results.json"))
results["pairs"] = results["settings"] = []
json.dump(results, open("none/results.json", "w"))
PYTHON
"$pfseq" report none --out empty --quiet >/dev/null
cat >study.yaml <<YAML
base: $tiny
set: {image.size_px: 200, render.light: path, render.samples: 2, render.max_samples: 2, render.max_bounces: 2}
factors:
  exposure: {title: Exposure (s), key: shutter.exposure_s, values: [0, 0.2]}
  lens: {title: Lens model, key: lenses.equisolid.model, values: [equisolid, stereographic]}
pairs: [1, 2]
lenses: equisolid
tolerance_m: 0.15
grid: grid.yaml
YAML
"$pfseq" study study.yaml --out study --quiet >/dev/null
status=0
/usr/bin/python3 "$tests/report_page_test.py" report results empty both ${3:+"$3"} || status=$?
[ "$status" -eq 0 ] || exit "$status"
/usr/bin/python3 "$tests/study_page_test.py" study ${3:+"$3"}
/usr/bin/python3 "$tests/view_page_test.py" "$pfseq" sequence ${3:+"$3"}
