#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints results of `pfseq bench --grid data/grids/highlights.yaml` beside the tables of 2014.

For each pair: how many detectors have as many detections (within a factor 1.5), the mean absolute difference of
repeatability over detectors x distances and of matching score over triplets x distances, ours less theirs on the mean,
and Kendall's tau-b of the orders at 4 cm. With --cells every setting, ours over theirs.
"""
import argparse
import pathlib
import sys

import likeness

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "data/reference/pfseq_2014_features.csv"
PAIRS = ("0", "40", "24")
# Of the twelve distances, those that --cells shows.
SHOWN_M = (0.005, 0.01, 0.02, 0.04, 0.08, 0.15)


def text(value, form="{:.2f}"):
    return "-" if value is None else form.format(value)


def count_text(value):
    return text(value, "{:.0f}")


def cell_row(name, ours, theirs):
    values = " ".join(f"{text(ours[i]):>5}" for i in map(likeness.TOLERANCES_M.index, SHOWN_M))
    reference = " ".join(f"{text(theirs[i]):>5}" for i in map(likeness.TOLERANCES_M.index, SHOWN_M))
    return f"  {name:<46} {values}   {reference}"


def print_cells(pair, ours, theirs):
    print(f"pair {pair}: detections, ours and theirs")
    for comparison in likeness.compare_detections(pair, ours, theirs):
        print(f"  {comparison.setup:<46} {count_text(comparison.ours):>6} {count_text(comparison.theirs):>6}"
              f"  x {text(comparison.ratio)}")
    for metric in likeness.SHARES:
        print(f"pair {pair}: {metric} within {', '.join(f'{100 * m:g}' for m in SHOWN_M)} cm, ours and theirs")
        for setup in likeness.setups(pair, metric, ours, theirs):
            print(cell_row(setup, ours[pair, metric, setup], theirs[pair, metric, setup]))


def print_summary(pair, ours, theirs):
    counts = likeness.compare_detections(pair, ours, theirs)
    known = [comparison for comparison in counts if comparison.ratio is not None]
    near = [comparison for comparison in known if comparison.is_near]
    ratio = likeness.geometric_mean(comparison.ratio for comparison in known)
    parts = [f"pair {pair:>2}", f"detections {len(near)} of {len(known)} (x {text(ratio)})"]
    for metric, label in (("repeatability", "repeatability"), ("matching_score", "score")):
        result = likeness.compare_shares(pair, metric, ours, theirs)
        parts.append(f"{label} {text(result.absolute, '{:.3f}')} ({text(result.signed, '{:+.3f}')})"
                     f" tau {text(result.tau)}")
    print("   ".join(parts))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Example:\n  benchmarks/likeness/compare.py out/bench --cells")
    parser.add_argument("results", nargs="+", type=pathlib.Path, help="folders that pfseq bench wrote")
    parser.add_argument("--cells", action="store_true", help="print every setting too")
    parser.add_argument("--lens", default="equisolid", help="the report's is equisolid")
    arguments = parser.parse_args()
    try:
        theirs = likeness.read_reference(REFERENCE)
        for folder in arguments.results:
            ours = likeness.read_results(folder / "results.csv", arguments.lens)
            print(folder)
            for pair in PAIRS:
                if arguments.cells:
                    print_cells(pair, ours, theirs)
                print_summary(pair, ours, theirs)
    except likeness.InputError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
