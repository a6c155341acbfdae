# SPDX-License-Identifier: Apache-2.0
"""Figures of the comparison: errors against a reference, agreement of two images, costs at equal error."""

import dataclasses
import itertools
import math

import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
# Keeps dark pixels from deciding alone; as a share of the square of the reference's mean.
RELATIVE_MSE_OFFSET = 0.01


def relative_mse(image, reference, mask):
    """mean((I - R)^2 / (R^2 + 0.01)) over the mask's pixels and the channels, both divided by the mean of R first."""
    scale = 1.0 / reference[mask].mean()
    i = scale * image[mask]
    r = scale * reference[mask]
    return float(np.mean((i - r) ** 2 / (r ** 2 + RELATIVE_MSE_OFFSET)))


def _weighted_mean(product, scale, mask):
    """Mean over the mask's pixels of a product of two differences, weighted as relative_mse weighs a square; `scale` stands
    for R in the denominator."""
    mean = scale[mask].mean()
    return float(np.mean(product[mask] / (scale[mask] ** 2 + RELATIVE_MSE_OFFSET * mean ** 2)))


def noise_of_pair(first, second, scale, mask):
    """relative_mse that the noise of either of two images makes up, which differ by their noise alone; `scale` stands for R
    in the denominator."""
    return _weighted_mean((first - second) ** 2, scale, mask) / 2


def squared_bias(first, second, scale, mask):
    """Estimate of relative_mse between what two kinds of images converge to, from a pair I, J and a pair P, Q: the weighted
    mean of (I - P)(J - Q), in which all noise falls out.

    `scale` stands for R in the denominator; its noise must be little and no other image's.
    """
    (i, j), (p, q) = first, second
    return _weighted_mean((i - p) * (j - q), scale, mask)


@dataclasses.dataclass(frozen=True)
class Difference:
    """How far the mean of a pair I, J is from that of P, Q, in luminance; `scale` as in squared_bias."""

    # Ratio of the mean luminances, less 1.
    mean: float
    # The pixels' differences over the scale, without sign: mean and 99th percentile, and the same that noise alone would
    # leave.
    absolute: float
    absolute_noise: float
    percentile_99: float
    percentile_99_noise: float

    @staticmethod
    def of(first, second, scale, mask):
        i, j, p, q, r = (image[mask] @ LUMINANCE for image in (*first, *second, scale))
        lit = r > 0
        error = np.abs(i + j - p - q)[lit] / (2.0 * r[lit])
        # Of the same spread as the noise of what is above.
        noise = np.abs(i - j + p - q)[lit] / (2.0 * r[lit])
        return Difference(float((i + j).sum() / (p + q).sum() - 1.0), float(error.mean()), float(noise.mean()),
                          float(np.percentile(error, 99)), float(np.percentile(noise, 99)))


@dataclasses.dataclass(frozen=True)
class Reference:
    """A converged image: the mean of independent renders, and what noise is left in it."""

    image: np.ndarray
    parts: list

    @staticmethod
    def of(parts):
        return Reference(np.mean(parts, axis=0), list(parts))

    def own_relative_mse(self, mask):
        """Estimate of the relative error of the mean itself, from the spread of its parts."""
        n = len(self.parts)
        spread = sum(relative_mse(part, self.image, mask) for part in self.parts) / (n - 1)
        return spread / n

    def error_of(self, image, mask, scale):
        """Estimate of an independent image's relative_mse against what the parts would converge to.

        The mean of (I - P)(I - Q) over pairs of parts P, Q: their noise is independent, so it falls out, however much
        there is of it. `scale` is an image with little noise that stands for R in the denominator, where the parts' noise
        would not fall out.
        """
        unit = scale[mask].mean() / self.image[mask].mean()
        differences = [unit * (image - part) for part in self.parts]
        pairs = itertools.combinations(differences, 2)
        return max(float(np.mean([_weighted_mean(p * q, scale, mask) for p, q in pairs])), 0.0)


@dataclasses.dataclass(frozen=True)
class Agreement:
    """How two images agree: ratios of the first to the second."""

    num_pixels: int
    ratio_of_means: float
    ratio_of_means_rgb: list
    mean_of_ratios: float
    within_3_percent: float
    percentiles: dict


PERCENTILES = (0.5, 5, 25, 50, 75, 95, 99.5)


def agreement(first, second, mask):
    """Of luminances over the mask's pixels; channels apart only for the ratio of the means."""
    a = first[mask]
    b = second[mask]
    luminance = b @ LUMINANCE
    lit = luminance > 0
    ratios = (a @ LUMINANCE)[lit] / luminance[lit]
    return Agreement(int(lit.sum()), float((a @ LUMINANCE).mean() / luminance.mean()),
                     [float(c) for c in a.mean(axis=0) / b.mean(axis=0)], float(ratios.mean()),
                     float(np.mean(np.abs(ratios - 1.0) <= 0.03)),
                     {p: float(np.percentile(ratios, p)) for p in PERCENTILES})


def blocks(image, mask, size_px):
    """Means over whole blocks of pixels, and the blocks that lie in the mask with all their pixels."""
    height, width = (side // size_px for side in mask.shape)
    cut = image[:height * size_px, :width * size_px].reshape(height, size_px, width, size_px, -1)
    inside = mask[:height * size_px, :width * size_px].reshape(height, size_px, width, size_px)
    return cut.mean(axis=(1, 3)), inside.all(axis=(1, 3))


@dataclasses.dataclass(frozen=True)
class CostCurve:
    """A renderer's way from cost to error: cost_s = per_sample_s N + offset_s, error = factor N^-exponent."""

    per_sample_s: float
    offset_s: float
    factor: float
    exponent: float

    @staticmethod
    def fit(samples, costs_s, errors):
        """Least squares: the cost over N, the logarithm of the error over that of N. At least two different N.

        Costs that would be below 0 without samples are the clock's noise: the line goes through 0 then.
        """
        n = np.asarray(samples, float)
        if len(set(samples)) < 2:
            raise ValueError("a curve needs at least two sample counts")
        # Relative residuals: the dear runs would outweigh the cheap ones otherwise.
        weights = 1.0 / np.maximum(np.asarray(costs_s, float), 1e-3)
        per_sample_s, offset_s = np.polyfit(n, costs_s, 1, w=weights)
        if offset_s < 0.0:
            per_sample_s = np.sum(weights ** 2 * n * costs_s) / np.sum(weights ** 2 * n ** 2)
            offset_s = 0.0
        slope, intercept = np.polyfit(np.log(n), np.log(errors), 1)
        return CostCurve(float(per_sample_s), float(offset_s), math.exp(intercept), -float(slope))

    @property
    def is_usable(self):
        """Whether more samples cost more and leave less error; with tiny images the clock's noise decides."""
        return self.per_sample_s > 0.0 and self.exponent > 0.0

    def samples_at(self, error):
        return (self.factor / error) ** (1.0 / self.exponent)

    def cost_at(self, error):
        """CPU seconds at which this error is reached; at least those of one sample."""
        return self.per_sample_s * max(self.samples_at(error), 1.0) + self.offset_s
