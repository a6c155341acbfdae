#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The formulas of the comparison with 2014, and that wrong input is told in one line. Usage: likeness_test.sh SOURCE_DIR
set -euo pipefail

likeness=$1/benchmarks/likeness
/usr/bin/python3 -B -m unittest discover -s "$likeness"

status=0
text=$(/usr/bin/python3 -B "$likeness/compare.py" /no/results 2>&1 >/dev/null) || status=$?
if [ "$status" -ne 2 ] || [ "$text" != "compare.py: /no/results/results.csv: No such file or directory" ]; then
  echo "compare.py of a missing folder: status $status: $text" >&2
  exit 1
fi
