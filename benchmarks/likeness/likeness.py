# SPDX-License-Identifier: Apache-2.0
"""Formulas that compare results with the tables of 2014; compare.py prints them.

A curve is a list of values, one for each distance, None where there is none. Curves are kept by (pair, metric, setup).
"""
import csv
import dataclasses
import math

TOLERANCES_M = (0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.15)
# The tolerance at which the report of 2014 gives its expectations.
VERDICT_M = 0.04
# A count agrees within this factor.
COUNT_FACTOR = 1.5
SHARES = {"repeatability": "matches", "matching_score": "correct_matches"}


class InputError(Exception):
    """A table that cannot be read; the text says which and why."""


def _read_rows(path, columns):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            missing = [name for name in columns if name not in (rows.fieldnames or [])]
            if missing:
                raise InputError(f"{path}: expected a column {missing[0]}, got {', '.join(rows.fieldnames or [])}")
            yield from rows
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error


def _number(text):
    """None for an empty cell, nan and the report's -1."""
    value = float(text) if text else math.nan
    return None if math.isnan(value) or value < 0.0 else value


def _add(curves, key, tolerance_m, value):
    if tolerance_m in TOLERANCES_M:
        curves.setdefault(key, [None] * len(TOLERANCES_M))[TOLERANCES_M.index(tolerance_m)] = value


def read_reference(path):
    """The curves of data/reference/pfseq_2014_features.csv."""
    curves = {}
    for row in _read_rows(path, ("pair", "metric", "setup", "tolerance_m", "value")):
        _add(curves, (row["pair"], row["metric"], row["setup"]), float(row["tolerance_m"]), _number(row["value"]))
    return curves


def reference_detections(curves, pair, detector):
    """The fewer of both views' detections: matches / repeatability at the widest distance; None where unknown."""
    matches = curves.get((pair, "matches", detector), [None])[-1]
    share = curves.get((pair, "repeatability", detector), [None])[-1]
    return matches / share if matches and share else None


def differences(ours, theirs):
    """Ours less theirs at each distance that both have."""
    return [a - b for a, b in zip(ours, theirs) if a is not None and b is not None]


def mean(values):
    """None of nothing."""
    values = list(values)
    return sum(values) / len(values) if values else None


def kendall_tau_b(pairs):
    """Kendall 1945: concordant less discordant pairs of items, over the geometric mean of the pairs untied in either
    ranking. None where one ranking is all ties."""
    pairs = list(pairs)
    balance = untied_first = untied_second = 0
    for i, (a, b) in enumerate(pairs):
        for c, d in pairs[:i]:
            first = (a > c) - (a < c)
            second = (b > d) - (b < d)
            balance += first * second
            untied_first += first != 0
            untied_second += second != 0
    if not untied_first or not untied_second:
        return None
    return balance / math.sqrt(untied_first * untied_second)


def geometric_mean(values):
    """None of nothing."""
    logarithm = mean(math.log(value) for value in values)
    return None if logarithm is None else math.exp(logarithm)


def read_results(path, lens):
    """The curves of a results.csv of pfseq bench, and its numbers of detections as curves of one value."""
    curves = {}
    for row in _read_rows(path, ("lens", "pair", "metric", "setup", "tolerance_m", "value")):
        if row["lens"] != lens:
            continue
        key = (row["pair"], row["metric"], row["setup"])
        if row["metric"].startswith("detections_"):
            curves[key] = [_number(row["value"])]
        elif row["tolerance_m"]:
            _add(curves, key, float(row["tolerance_m"]), _number(row["value"]))
    return curves


def setups(pair, metric, ours, theirs):
    """What both have of a metric on a pair, by name."""
    return sorted(setup for (p, m, setup) in theirs if (p, m) == (pair, metric) and (p, m, setup) in ours)


@dataclasses.dataclass
class Count:
    """Detections of a detector; None where unknown."""
    setup: str
    ours: float | None
    theirs: float | None

    @property
    def ratio(self):
        return self.ours / self.theirs if self.ours and self.theirs else None

    @property
    def is_near(self):
        return self.ratio is not None and 1.0 / COUNT_FACTOR <= self.ratio <= COUNT_FACTOR


def compare_detections(pair, ours, theirs):
    """The fewer of both views' detections of each detector."""
    counts = []
    for setup in setups(pair, "repeatability", ours, theirs):
        views = [ours.get((pair, f"detections_{view}", setup), [None])[0] for view in ("first", "second")]
        fewer = None if None in views else min(views)
        counts.append(Count(setup, fewer, reference_detections(theirs, pair, setup)))
    return counts


@dataclasses.dataclass
class Shares:
    """How a metric differs on a pair; None where nothing can be compared."""
    absolute: float | None
    signed: float | None
    tau: float | None


def compare_shares(pair, metric, ours, theirs):
    """Over all cells that both have; the order is that at VERDICT_M."""
    cells, order = [], []
    verdict = TOLERANCES_M.index(VERDICT_M)
    for setup in setups(pair, metric, ours, theirs):
        curves = ours[pair, metric, setup], theirs[pair, metric, setup]
        cells += differences(*curves)
        if None not in (curves[0][verdict], curves[1][verdict]):
            order.append((curves[0][verdict], curves[1][verdict]))
    return Shares(mean(map(abs, cells)), mean(cells), kendall_tau_b(order))
