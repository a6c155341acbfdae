# SPDX-License-Identifier: Apache-2.0
"""Text, CSV and JSON of a comparison."""

import csv
import dataclasses
import json


def row_text(result):
    """What was measured for one lens and camera."""
    lines = [f"== {result.lens}, camera {result.camera}", ""]
    lines += ["CPU seconds of whole runs (0 samples: start-up, an image of 16 px):"]
    by_point = {}
    for run in result.runs:
        by_point.setdefault((run.renderer, run.num_samples), []).append(run.cpu_s)
    for (renderer, num_samples), cpu_s in sorted(by_point.items()):
        lines.append(f"  {renderer:12s} {num_samples:6d} samples  " + "  ".join(f"{s:8.2f}" for s in cpu_s))
    lines += ["", f"  {'':12s} {'samples':>8s} {'CPU-s a frame':>14s} {'peak MiB':>9s} {'relMSE, own':>12s}"
              f" {'relMSE, path':>13s}"]
    for p in result.points:
        path_error = f"{p.path_error:13.6f}" if p.path_error == p.path_error else f"{'':13s}"
        lines.append(f"  {p.renderer:12s} {p.num_samples:8d} {p.frame_cpu_s:14.2f} {p.peak_mib:9.0f} {p.own_error:12.6f}"
                     f" {path_error}")
    lines += ["", "Cycles at pfseq's errors (its cost and error from the fits below):"]
    if not result.equal_errors:
        lines.append("  cannot be told: the frames are too short to measure; raise --size, --spp-list or --repeats")
    for e in result.equal_errors:
        lines.append(f"  {e.num_samples:6d} samples of pfseq, relMSE ({e.against}) {e.error:.6f}: pfseq {e.frame_cpu_s:.2f}"
                     f" CPU-s a frame, Cycles {e.cycles_frame_cpu_s:.2f}: ratio {e.ratio:.2f}, whole runs"
                     f" {e.ratio_with_start:.2f}{'' if e.is_interpolated else ' (extrapolated)'}")
    for name, c in result.curves.items():
        lines.append(f"  {name:12s} relMSE = {c.factor:.4g} N^-{c.exponent:.2f}, CPU-s = {c.per_sample_s:.4g} N"
                     f" {c.offset_s:+.3g}")
    lines += ["", "Converged images, pfseq path / Cycles, not sky:"]
    for size_px, a in result.agreements.items():
        percentiles = ", ".join(f"{p:g} %: {v:.4f}" for p, v in a.percentiles.items())
        rgb = " ".join(f"{c:.4f}" for c in a.ratio_of_means_rgb)
        noise = result.noise_agreements[size_px]
        lines.append(f"  {size_px} x {size_px} px ({a.num_pixels}): ratio of means {a.ratio_of_means:.4f} (RGB {rgb}), mean of"
                     f" ratios {a.mean_of_ratios:.4f}, within 3 %: {100 * a.within_3_percent:.2f} %"
                     f" ({100 * noise.within_3_percent:.2f} % if only noise differed)")
        lines.append(f"    percentiles of the ratio: {percentiles}")
    lines.append("  relMSE of their own noise: " + ", ".join(f"{n} {v:.2g}" for n, v in result.reference_noise.items()))
    d = result.distances
    lines.append(f"Distances ({d['num_pixels']} pixels): median difference {d['median_m']:.2g} m, 99 % {d['p99_m']:.2g} m,"
                 f" largest {d['max_m']:.2g} m; {d['num_beyond_tolerance']} pixels differ by more than 0.1 %, "
                 f"{d['num_sky_in_one_only']} are sky in one only")
    return "\n".join(lines) + "\n"


def write_csv(path, results):
    """One line a run."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["lens", "camera", "renderer", "num_samples", "repetition", "cpu_s", "peak_mib",
                         "relmse_own", "relmse_path"])
        for result in results:
            for run in result.runs:
                writer.writerow([result.lens, result.camera, run.renderer, run.num_samples, run.repetition,
                                 f"{run.cpu_s:.3f}", f"{run.peak_mib:.1f}", f"{run.own_error:.8g}", f"{run.path_error:.8g}"])


def without_nan(value):
    """JSON knows no NaN: null."""
    if isinstance(value, dict):
        return {key: without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(item) for item in value]
    return None if isinstance(value, float) and value != value else value


def write_json(path, settings, results):
    """All that was measured, with the settings."""
    content = {"settings": settings, "rows": [dataclasses.asdict(result) for result in results]}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(without_nan(content), file, indent=1)
        file.write("\n")
