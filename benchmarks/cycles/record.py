# SPDX-License-Identifier: Apache-2.0
"""Measures a record: all lenses and cameras of the frames together, with distance maps.

Errors are those of noise: two renders with different seeds differ by nothing else. pfseq's cached light has a bias as well,
against its own paths. What Cycles converges to, the comparison of single rows tells.
"""

import dataclasses
import statistics

import numpy as np

import comparison
import errors

# What each run writes beside the radiance; Cycles has no sky mask.
TRUTH = ("distance", "sky")
SEEDS = (1, 2)


@dataclasses.dataclass(frozen=True)
class Point:
    """One renderer with one number of samples: of all images of the record, and the mean of their errors."""

    renderer: str
    num_samples: int
    cpu_s: float
    peak_mib: float
    error: float


@dataclasses.dataclass(frozen=True)
class RecordResult:
    rows: list
    num_frames: int
    # pfseq's light, computed once: what the first run took beyond the second.
    light_cpu_s: float
    start_cpu_s: dict
    points: list
    curves: dict
    # Mean of the images' squared bias by cached light; None: not measured.
    squared_bias: float | None


class RecordComparison:
    """`truth` is the sequence's folder; rows are all pairs of lenses and cameras."""

    def __init__(self, options, rows, frames, pfseq, pfseq_path, cycles, folder):
        self._options = options
        self._rows = rows
        self._frames = frames
        self._pfseq = pfseq
        self._pfseq_path = pfseq_path
        self._cycles = cycles
        self._masks = {row: comparison.measured_pixels(folder, row, frames, options.motion_blur) for row in rows}

    def _render(self, renderer, num_samples, seed):
        usage, frames_of_row = renderer.measure_rows(self._rows, self._frames, num_samples, seed, TRUTH)
        comparison.say(f"  {renderer.name:12s} {num_samples:6d} samples: {usage.cpu_s:8.2f} CPU-s")
        return usage, {row: np.concatenate(frames) for row, frames in frames_of_row.items()}

    def _point(self, renderer, num_samples, start_cpu_s, runs, scale):
        images = [images_of_row for _, images_of_row in runs]
        row_errors = [errors.noise_of_pair(images[0][row], images[1][row], scale[row], mask)
                      for row, mask in self._masks.items()]
        return Point(renderer.name, num_samples,
                     statistics.fmean(usage.cpu_s - usage.num_processes * start_cpu_s for usage, _ in runs),
                     max(usage.peak_mib for usage, _ in runs), statistics.fmean(row_errors))

    def _squared_bias(self, cached, scale):
        num_samples = self._options.record_path_spp
        if num_samples == 0 or self._pfseq.light != "cached":
            return None
        paths = [self._render(self._pfseq_path, num_samples, seed)[1] for seed in SEEDS]
        return statistics.fmean(errors.squared_bias([images[row] for images in cached], [images[row] for images in paths],
                                                    scale[row], mask)
                                for row, mask in self._masks.items())

    def measure(self):
        """Both programs in turn. Before pfseq is measured with a seed, a run with it computes the light that it needs."""
        self._pfseq.forget_light()
        start_cpu_s = {r.name: r.measure_start(self._rows[0], self._frames).cpu_s for r in (self._pfseq, self._cycles)}
        most = max(self._options.pfseq_spp_list)
        runs = {}
        first_usage = None
        for seed in SEEDS:
            usage, _ = self._render(self._pfseq, most, seed)
            first_usage = first_usage or usage
            for counts in zip(self._options.pfseq_spp_list, self._options.spp_list):
                for renderer, num_samples in zip((self._pfseq, self._cycles), counts):
                    runs.setdefault((renderer, num_samples), []).append(self._render(renderer, num_samples, seed))
        best = runs[self._pfseq, most]
        light_cpu_s = first_usage.cpu_s - best[0][0].cpu_s
        scale = {row: np.mean([images[row] for _, images in best], axis=0) for row in self._rows}
        points = [self._point(renderer, n, start_cpu_s[renderer.name], pair, scale) for (renderer, n), pair in runs.items()]
        curves = {}
        for renderer in (self._pfseq, self._cycles):
            own = [p for p in points if p.renderer == renderer.name]
            curves[renderer.name] = errors.CostCurve.fit([p.num_samples for p in own], [p.cpu_s for p in own],
                                                         [p.error for p in own])
        squared_bias = self._squared_bias([images for _, images in best], scale)
        return RecordResult(self._rows, len(self._frames), light_cpu_s, start_cpu_s, points, curves, squared_bias)


def record_text(result):
    """What was measured, and what Cycles needs for pfseq's errors."""
    rows = ", ".join(f"{lens} {camera}" for lens, camera in result.rows)
    lines = [f"== {result.num_frames} x {len(result.rows)} images ({rows}), with distance maps", ""]
    lines.append(f"Light of pfseq, once: {result.light_cpu_s:.1f} CPU-s. Start-up, taken off each process below: "
                 + ", ".join(f"{name} {cpu_s:.1f}" for name, cpu_s in result.start_cpu_s.items()) + " CPU-s.")
    lines += ["", f"  {'':12s} {'samples':>8s} {'CPU-s in all':>13s} {'peak MiB':>9s} {'relMSE, noise':>14s}"]
    for p in sorted(result.points, key=lambda p: (p.renderer, p.num_samples)):
        lines.append(f"  {p.renderer:12s} {p.num_samples:8d} {p.cpu_s:13.2f} {p.peak_mib:9.0f} {p.error:14.6f}")
    cycles = [p for p in result.points if p.renderer == "Cycles"]
    curve = result.curves["Cycles"]
    if result.squared_bias is not None:
        lines.append(f"  squared bias of pfseq cached against pfseq path: {result.squared_bias:.6f}")
    lines += ["", "Cycles at pfseq's errors:"]
    biases = {"noise": 0.0} if result.squared_bias is None else {"noise": 0.0, "noise and bias": result.squared_bias}
    for p in result.points:
        if p.renderer == "Cycles" or not curve.is_usable:
            continue
        for name, squared_bias in biases.items():
            error = p.error + squared_bias
            cycles_cpu_s = curve.cost_at(error)
            is_measured = min(c.error for c in cycles) <= error <= max(c.error for c in cycles)
            lines.append(f"  {p.num_samples:6d} samples of pfseq, relMSE {error:.6f} ({name}): pfseq {p.cpu_s:.1f} CPU-s, Cycles"
                         f" {cycles_cpu_s:.0f}: ratio {cycles_cpu_s / max(p.cpu_s, 1e-3):.1f}"
                         f"{'' if is_measured else ' (extrapolated)'}")
    for name, c in result.curves.items():
        lines.append(f"  {name:12s} relMSE = {c.factor:.4g} N^-{c.exponent:.2f}, CPU-s = {c.per_sample_s:.4g} N"
                     f" {c.offset_s:+.3g}")
    return "\n".join(lines) + "\n"
