# SPDX-License-Identifier: Apache-2.0
"""Measures one row (a lens and a camera) with both programs in turn."""

import dataclasses
import statistics
import sys

import numpy as np

import errors
import images

# Seeds of the references; measured runs count from 1.
FIRST_REFERENCE_SEED = 1001
BLOCK_SIZES_PX = (1, 4)
# Distances that differ by more than this share are counted.
DISTANCE_TOLERANCE = 1e-3


@dataclasses.dataclass(frozen=True)
class Run:
    """One measured run; num_samples 0 is the start-up alone, which has no image."""

    renderer: str
    num_samples: int
    repetition: int
    cpu_s: float
    peak_mib: float
    # relMSE against the renderer's own converged image, and against pfseq's path-traced one (pfseq alone).
    own_error: float = float("nan")
    path_error: float = float("nan")


@dataclasses.dataclass(frozen=True)
class Point:
    """The runs of one renderer with one number of samples."""

    renderer: str
    num_samples: int
    frame_cpu_s: float
    total_cpu_s: float
    peak_mib: float
    own_error: float
    path_error: float


@dataclasses.dataclass(frozen=True)
class EqualError:
    """What Cycles needs to be as good as pfseq was with so many samples; ratios are Cycles' cost over pfseq's."""

    num_samples: int
    # Which of pfseq's errors: "own" or "path".
    against: str
    error: float
    frame_cpu_s: float
    cycles_frame_cpu_s: float
    ratio: float
    ratio_with_start: float
    # Whether the error lies within those that Cycles was measured at.
    is_interpolated: bool


@dataclasses.dataclass
class RowResult:
    lens: str
    camera: str
    runs: list
    points: list
    curves: dict
    equal_errors: list
    # Of the converged images, pfseq's path tracer over Cycles, not sky: by the size of blocks in pixels.
    agreements: dict
    # The same for two images of which each is half pfseq's and half Cycles': what noise alone would show.
    noise_agreements: dict
    # relMSE that the noise of each reference makes up.
    reference_noise: dict
    distances: dict


def say(text):
    print(text, file=sys.stderr, flush=True)


def measured_pixels(folder, row, frames, motion_blur):
    """The mask of a row's frames, one above the other: the image circle without the sun."""
    lens = folder.lenses[row[0]]
    circle = images.circle_mask(folder.image_size_px, lens)
    exposure = lambda frame: (folder.exposure(row[1], frame) if motion_blur
                              else [folder.world_from_camera(row[1], frame)] * 2)
    return np.concatenate([images.without_sun(circle, lens, exposure(frame), folder.sun()) for frame in frames])


def compare_distances(ours_m, cycles_m, mask):
    """Where both meet something, and how many pixels only one of them calls sky."""
    both = mask & np.isfinite(ours_m) & np.isfinite(cycles_m)
    difference_m = np.abs(ours_m[both] - cycles_m[both])
    relative = difference_m / ours_m[both]
    return {
        "num_pixels": int(both.sum()),
        "num_sky_in_one_only": int((mask & (np.isfinite(ours_m) != np.isfinite(cycles_m))).sum()),
        "median_m": float(np.median(difference_m)),
        "p99_m": float(np.percentile(difference_m, 99)),
        "max_m": float(difference_m.max()),
        "num_beyond_tolerance": int((relative > DISTANCE_TOLERANCE).sum()),
    }


def agreements_of_blocks(first, second, mask):
    """errors.agreement by the size of blocks in pixels."""
    found = {}
    for size_px in BLOCK_SIZES_PX:
        first_blocks, inside = errors.blocks(first, mask, size_px)
        second_blocks, _ = errors.blocks(second, mask, size_px)
        found[size_px] = errors.agreement(first_blocks, second_blocks, inside)
    return found


class RowComparison:
    """The measurements of one row. Images of several frames are stacked one above the other."""

    def __init__(self, options, row, frames, pfseq, pfseq_path, cycles, truth):
        self._options = options
        self._row = row
        self._frames = frames
        self._pfseq = pfseq
        self._pfseq_path = pfseq_path
        self._cycles = cycles
        folder, distances_m = truth
        lens = folder.lenses[row[0]]
        self._circle = np.concatenate([images.circle_mask(folder.image_size_px, lens)] * len(frames))
        self._mask = measured_pixels(folder, row, frames, options.motion_blur)
        self._distance_m = np.concatenate(distances_m)
        self._runs = []
        self._start_cpu_s = {}

    def _render(self, renderer, num_samples, seed):
        usage, frames = renderer.measure(self._row, self._frames, num_samples, seed)
        return usage, np.concatenate(frames)

    def _reference(self, renderer, num_samples):
        say(f"  converged image of {renderer.name}: {self._options.reference_seeds} x {num_samples} samples")
        return errors.Reference.of([self._render(renderer, num_samples, FIRST_REFERENCE_SEED + i)[1]
                                    for i in range(self._options.reference_seeds)])

    def references(self):
        """The converged images by the renderer's name."""
        renderers = {r.name: r for r in (self._pfseq_path, self._pfseq, self._cycles)}
        return {name: self._reference(r, self._options.reference_spp if r.light != "cached"
                                      else self._options.cached_reference_spp) for name, r in renderers.items()}

    def _measure_start(self, renderer, repetition):
        usage = renderer.measure_start(self._row, self._frames)
        self._start_cpu_s[renderer.name] = usage.cpu_s
        self._runs.append(Run(renderer.name, 0, repetition, usage.cpu_s, usage.peak_mib))

    def _measure(self, renderer, num_samples, repetition, references):
        usage, image = self._render(renderer, num_samples, repetition)
        # Of all converged images that of pfseq has the least noise: both programs' errors are taken in its unit.
        scale = references[self._pfseq.name].image
        path_error = float("nan")
        if renderer is not self._cycles:
            path_error = references[self._pfseq_path.name].error_of(image, self._mask, scale)
        own_error = references[renderer.name].error_of(image, self._mask, scale)
        # Pictures of several frames would share one start-up.
        cpu_s = usage.cpu_s - (usage.num_processes - 1) * self._start_cpu_s[renderer.name]
        say(f"  {renderer.name:12s} {num_samples:6d} samples: {cpu_s:8.2f} CPU-s, relMSE {own_error:.6f}")
        self._runs.append(Run(renderer.name, num_samples, repetition, cpu_s, usage.peak_mib, own_error, path_error))

    def measure(self, references):
        """Both programs in turn: A B A B."""
        for repetition in range(1, self._options.repeats + 1):
            say(f"  repetition {repetition} of {self._options.repeats}")
            self._measure_start(self._pfseq, repetition)
            self._measure_start(self._cycles, repetition)
            for pfseq_spp, cycles_spp in zip(self._options.pfseq_spp_list, self._options.spp_list):
                self._measure(self._pfseq, pfseq_spp, repetition, references)
                self._measure(self._cycles, cycles_spp, repetition, references)

    def _point(self, renderer, num_samples):
        runs = [r for r in self._runs if (r.renderer, r.num_samples) == (renderer.name, num_samples)]
        start_s = statistics.median(r.cpu_s for r in self._runs if (r.renderer, r.num_samples) == (renderer.name, 0))
        total_s = statistics.median(r.cpu_s for r in runs)
        return Point(renderer.name, num_samples, (total_s - start_s) / len(self._frames), total_s,
                     max(r.peak_mib for r in runs), statistics.fmean(r.own_error for r in runs),
                     statistics.fmean(r.path_error for r in runs))

    def _equal_errors(self, points, curve):
        if not curve.is_usable:
            return []
        cycles = [p for p in points if p.renderer == self._cycles.name]
        cycles_start_s = statistics.median(r.cpu_s for r in self._runs
                                           if (r.renderer, r.num_samples) == (self._cycles.name, 0))
        found = []
        for point in points:
            if point.renderer == self._cycles.name:
                continue
            for against, error in (("own", point.own_error), ("path", point.path_error)):
                if error <= 0.0 or (against == "path" and self._pfseq is self._pfseq_path):
                    continue
                cycles_s = curve.cost_at(error)
                cycles_total_s = cycles_s * len(self._frames) + cycles_start_s
                found.append(EqualError(point.num_samples, against, error, point.frame_cpu_s, cycles_s,
                                        cycles_s / max(point.frame_cpu_s, 1e-3), cycles_total_s / point.total_cpu_s,
                                        min(c.own_error for c in cycles) <= error <= max(c.own_error for c in cycles)))
        return found

    def result(self, references, difference_path):
        """Sums up what measure() has found, and writes the picture of the difference."""
        points = [self._point(self._pfseq, n) for n in self._options.pfseq_spp_list]
        points += [self._point(self._cycles, n) for n in self._options.spp_list]
        curves = {}
        for renderer in (self._pfseq, self._cycles):
            own = [p for p in points if p.renderer == renderer.name]
            curves[renderer.name] = errors.CostCurve.fit([p.num_samples for p in own], [p.frame_cpu_s for p in own],
                                                         [max(p.own_error, 1e-12) for p in own])
        ours = references[self._pfseq_path.name]
        theirs = references[self._cycles.name]
        ground = self._mask & np.isfinite(self._distance_m)
        images.write_difference(difference_path, ours.image, theirs.image, ground)
        mixed = [np.mean(ours.parts[i::2] + theirs.parts[i::2], axis=0) for i in (0, 1)]
        cycles_m = np.concatenate(self._cycles.distances(self._row, self._frames))
        return RowResult(*self._row, self._runs, points, curves,
                         self._equal_errors(points, curves[self._cycles.name]),
                         agreements_of_blocks(ours.image, theirs.image, ground), agreements_of_blocks(*mixed, ground),
                         {name: r.own_relative_mse(self._mask) for name, r in references.items()},
                         compare_distances(self._distance_m, cycles_m, self._circle))
