#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The peer comparison's formulas, and that wrong input is told in one line before anything is installed or rendered.
# Usage: cycles_test.sh SOURCE_DIR; exit status 77 (skipped) without Debian's python3-numpy and python3-yaml.
set -euo pipefail

root=$1
python=/usr/bin/python3
"$python" -c 'import numpy, yaml' 2>/dev/null || exit 77
"$python" -B -m unittest discover -s "$root/benchmarks/cycles"

# refuses_of PROGRAM TEXT FLAGS...: exit status 2 and one line that holds the text
refuses_of() {
  local program=$1 expected=$2 text status=0
  shift 2
  text=$("$program" "$@" 2>&1 >/dev/null) || status=$?
  if [ "$status" -ne 2 ] || [ "$(wc -l <<<"$text")" -ne 1 ] || [[ $text != *"$expected"* ]]; then
    echo "$program $*: status $status: $text; expected status 2 and one line with: $expected" >&2
    exit 1
  fi
}

refuses() { refuses_of "$root/tools/compare_with_cycles.sh" "$@"; }

refuses "--size: expected whole numbers from 16 to 8192" --size large
refuses "--frames: expected whole numbers" --frames 3,-1
refuses "--spp-list: expected at least two different numbers" --spp-list 16,16
refuses "--pfseq-spp-list: expected as many numbers" --spp-list 4,16 --pfseq-spp-list 1,2,3
refuses "--reference-seeds: expected an even number" --reference-seeds 3
refuses "no such file" "$root/no.yaml"
refuses "--materials: invalid choice" --materials shiny
"$root/tools/compare_with_cycles.sh" --help | grep -q -- --reference-spp

bias=$root/benchmarks/light_bias.py
refuses_of "$bias" "--size: expected whole numbers from 16 to 8192" --size huge
refuses_of "$bias" "--qualities: expected numbers" --qualities fine
refuses_of "$bias" "--set: expected KEY=VALUE" --set light
refuses_of "$bias" "no such file: $root/no.yaml" "$root/no.yaml"
refuses_of "$bias" "no such file: $root/no_program" --pfseq "$root/no_program"
"$bias" --help | grep -q -- --path-samples
