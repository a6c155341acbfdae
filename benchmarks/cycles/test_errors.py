# SPDX-License-Identifier: Apache-2.0
"""Tests of the comparison's formulas. Run: python3 -m unittest discover -s benchmarks/cycles"""

import math
import pathlib
import tempfile
import unittest

import numpy as np

import cycles_job
import errors
from sequence_folder import Lens, SequenceFolder, rotation_from_quaternion

FOV_RAD = math.radians(181.8)


def gray(*values):
    """A row of grey pixels."""
    return np.repeat(np.array(values, float)[None, :, None], 3, axis=2)


class RelativeMse(unittest.TestCase):
    def test_divides_by_the_mean_of_the_reference(self):
        mask = np.ones((1, 2), bool)
        # Reference 1 and 3: divided by its mean 0.5 and 1.5; the image is 0.25 more in the first.
        expected = 0.5 * 0.25 ** 2 / (0.5 ** 2 + 0.01)
        self.assertAlmostEqual(errors.relative_mse(gray(1.5, 3), gray(1, 3), mask), expected)

    def test_does_not_depend_on_the_unit(self):
        mask = np.ones((1, 3), bool)
        image, reference = gray(1, 0.1, 7), gray(2, 0.0, 6)
        self.assertAlmostEqual(errors.relative_mse(1000 * image, 1000 * reference, mask),
                               errors.relative_mse(image, reference, mask))

    def test_ignores_pixels_outside_the_mask(self):
        mask = np.array([[True, False]])
        self.assertEqual(errors.relative_mse(gray(1, 99), gray(1, 1), mask), 0.0)


class NoiseOfPair(unittest.TestCase):
    def test_is_the_relative_mse_of_either(self):
        random = np.random.default_rng(3)
        truth = np.tile([0.5, 1.5], (300, 150))[:, :, None].repeat(3, axis=2)
        mask = np.ones((300, 300), bool)
        noisy = lambda: truth * (1 + 0.1 * random.standard_normal(truth.shape))
        first = noisy()
        expected = errors.relative_mse(first, truth, mask)
        self.assertAlmostEqual(errors.noise_of_pair(first, noisy(), truth, mask), expected, delta=0.03 * expected)
        # The unit does not matter.
        self.assertAlmostEqual(errors.noise_of_pair(5 * first, 5 * first + 1, 5 * truth, mask),
                               errors.noise_of_pair(first, first + 0.2, truth, mask))

    def test_ignores_pixels_outside_the_mask(self):
        mask = np.array([[True, False]])
        self.assertEqual(errors.noise_of_pair(gray(1, 99), gray(1, 1), gray(1, 1), mask), 0.0)


class TwoPairs(unittest.TestCase):
    """Images of one thing and of another that is brighter by a known share, with noise."""

    def setUp(self):
        random = np.random.default_rng(5)
        truth = np.tile([0.5, 1.5], (400, 200))[:, :, None].repeat(3, axis=2)
        noisy = lambda share: truth * share * (1 + 0.2 * random.standard_normal((400, 400, 1)))
        self.mask = np.ones((400, 400), bool)
        self.scale = truth
        self.second = [noisy(1.0), noisy(1.0)]
        self.brighter = [noisy(1.04), noisy(1.04)]
        self.same = [noisy(1.0), noisy(1.0)]

    def test_squared_bias_has_no_noise(self):
        expected = np.mean([0.04 ** 2 * r ** 2 / (r ** 2 + 0.01) for r in (0.5, 1.5)])
        self.assertAlmostEqual(errors.squared_bias(self.brighter, self.second, self.scale, self.mask), expected, delta=0.15 * expected)
        self.assertAlmostEqual(errors.squared_bias(self.same, self.second, self.scale, self.mask), 0.0, delta=0.15 * expected)

    def test_difference_tells_noise_apart(self):
        same = errors.Difference.of(self.same, self.second, self.scale, self.mask)
        self.assertAlmostEqual(same.mean, 0.0, delta=0.003)
        self.assertAlmostEqual(same.absolute, same.absolute_noise, delta=0.03 * same.absolute)
        self.assertAlmostEqual(same.percentile_99, same.percentile_99_noise, delta=0.1 * same.percentile_99)
        brighter = errors.Difference.of(self.brighter, self.second, self.scale, self.mask)
        self.assertAlmostEqual(brighter.mean, 0.04, delta=0.003)
        self.assertGreater(brighter.absolute, same.absolute)

    def test_difference_ignores_pixels_outside_the_mask_and_black_ones(self):
        mask = np.array([[True, True, False]])
        pair = lambda *values: [gray(*values), gray(*values)]
        difference = errors.Difference.of(pair(2, 0, 99), pair(1, 0, 1), gray(1, 0, 1), mask)
        self.assertAlmostEqual(difference.mean, 1.0)
        self.assertAlmostEqual(difference.absolute, 1.0)
        self.assertAlmostEqual(difference.absolute_noise, 0.0)


class Reference(unittest.TestCase):
    def test_takes_its_own_noise_off(self):
        random = np.random.default_rng(1)
        truth = np.ones((200, 200, 3))
        mask = np.ones((200, 200), bool)
        noisy = lambda: truth + 0.1 * random.standard_normal(truth.shape)
        reference = errors.Reference.of([noisy() for _ in range(4)])
        self.assertAlmostEqual(reference.own_relative_mse(mask), 0.1 ** 2 / 1.01 / 4, delta=1e-4)
        self.assertAlmostEqual(reference.error_of(noisy(), mask, truth), 0.1 ** 2 / 1.01, delta=4e-4)

    def test_finds_a_small_error_below_a_noisy_reference(self):
        random = np.random.default_rng(2)
        truth = np.tile([0.5, 1.5], (300, 150))[:, :, None].repeat(3, axis=2)
        mask = np.ones((300, 300), bool)
        reference = errors.Reference.of([truth * (1 + 0.1 * random.standard_normal(truth.shape)) for _ in range(2)])
        image = truth * 1.02
        expected = errors.relative_mse(image, truth, mask)
        self.assertAlmostEqual(reference.error_of(image, mask, truth), expected, delta=0.3 * expected)
        self.assertGreater(errors.relative_mse(image, reference.image, mask), 10 * expected)


class Agreement(unittest.TestCase):
    def test_counts_and_ratios(self):
        mask = np.array([[True, True, True, True, False]])
        found = errors.agreement(gray(1.02, 2.08, 1, 0.98, 50), gray(1, 2, 1, 1, 1), mask)
        self.assertEqual(found.num_pixels, 4)
        self.assertAlmostEqual(found.ratio_of_means, 5.08 / 5)
        self.assertAlmostEqual(found.mean_of_ratios, (1.02 + 1.04 + 1 + 0.98) / 4)
        self.assertEqual(found.within_3_percent, 0.75)

    def test_tells_channels_apart(self):
        first = np.array([[[2.0, 1.0, 1.0]]])
        found = errors.agreement(first, np.ones((1, 1, 3)), np.array([[True]]))
        self.assertEqual(found.ratio_of_means_rgb, [2.0, 1.0, 1.0])

    def test_blocks_lie_inside_with_all_their_pixels(self):
        image = np.arange(16.0).reshape(4, 4, 1)
        mask = np.ones((4, 4), bool)
        mask[3, 0] = False
        means, inside = errors.blocks(image, mask, 2)
        self.assertEqual(means[0, 1, 0], (2 + 3 + 6 + 7) / 4)
        self.assertEqual(inside.tolist(), [[True, True], [False, True]])


class CostCurve(unittest.TestCase):
    def test_finds_the_law_that_made_the_points(self):
        samples = [4, 16, 64]
        curve = errors.CostCurve.fit(samples, [0.5 * n + 2 for n in samples], [3 * n ** -1.25 for n in samples])
        self.assertAlmostEqual(curve.exponent, 1.25)
        self.assertAlmostEqual(curve.cost_at(3 * 100 ** -1.25), 52.0, places=5)

    def test_costs_nothing_less_than_zero(self):
        curve = errors.CostCurve.fit([10, 100], [0.5, 10.0], [0.2, 0.02])
        self.assertEqual(curve.offset_s, 0.0)
        self.assertAlmostEqual(curve.per_sample_s, (0.05 / 0.05 ** 2 + 0.1 / 0.1 ** 2) / (1 / 0.05 ** 2 + 1 / 0.1 ** 2))

    def test_is_of_no_use_when_more_samples_seem_cheaper(self):
        self.assertTrue(errors.CostCurve.fit([4, 16], [1.0, 1.5], [0.2, 0.1]).is_usable)
        self.assertFalse(errors.CostCurve.fit([4, 16], [1.0, 0.9], [0.2, 0.1]).is_usable)
        self.assertFalse(errors.CostCurve.fit([4, 16], [1.0, 1.5], [0.2, 0.3]).is_usable)

    def test_needs_two_sample_counts(self):
        with self.assertRaises(ValueError):
            errors.CostCurve.fit([4, 4], [1, 1], [1, 1])


class CyclesLens(unittest.TestCase):
    def test_equisolid_focal_length_in_millimetres(self):
        # 1200 px, circle 1124 px, 181.8 degrees on a sensor of 36 mm.
        focal_px = 562 / (2 * math.sin(FOV_RAD / 4))
        lens = Lens("equisolid", (focal_px, focal_px), (600, 600), FOV_RAD / 2)
        self.assertAlmostEqual(cycles_job.cycles_lens(lens, (1200, 1200))["fisheye_lens"], 11.829279, places=6)
        self.assertAlmostEqual(lens.circle_radius_px(), 562)

    def test_equidistant_spans_the_frame(self):
        focal_px = 500 / (FOV_RAD / 2)
        lens = Lens("equidistant", (focal_px, focal_px), (600, 600), FOV_RAD / 2)
        self.assertAlmostEqual(cycles_job.cycles_lens(lens, (1200, 1200))["fisheye_fov"], FOV_RAD * 1.2)

    def test_refuses_what_cycles_cannot(self):
        for lens, size_px in ((Lens("equidistant", (100, 100), (50, 51), 1), (100, 100)),
                              (Lens("equidistant", (100, 101), (50, 50), 1), (100, 100)),
                              (Lens("equidistant", (100, 100), (60, 50), 1), (120, 100)),
                              (Lens("stereographic", (100, 100), (50, 50), 1), (100, 100))):
            with self.assertRaises(ValueError):
                cycles_job.cycles_lens(lens, size_px)

    def test_counts_bounces_after_the_first(self):
        self.assertEqual(cycles_job.cycles_bounces(6), 5)
        with self.assertRaises(ValueError):
            cycles_job.cycles_bounces(0)


class Exposure(unittest.TestCase):
    def test_is_that_of_the_frame_or_its_own_pose_twice(self):
        with tempfile.TemporaryDirectory() as name:
            folder = SequenceFolder.__new__(SequenceFolder)
            folder.path = pathlib.Path(name)
            (folder.path / "trajectory_front.txt").write_text("0 1 0 0 0 0 0 1\n1 5 0 0 0 0 0 1\n")
            still = folder.exposure("front", 1)
            self.assertEqual([pose[0, 3] for pose in still], [5, 5])
            (folder.path / "exposure_front.txt").write_text(
                "".join(f"{t} {x} 0 0 0 0 0 1\n" for t, x in ((-0.1, 1), (0.1, 2), (0.9, 4), (1.1, 6))))
            self.assertEqual([pose[0, 3] for pose in folder.exposure("front", 1)], [4, 6])


class Geometry(unittest.TestCase):
    def test_quarter_turn_about_z(self):
        turn = rotation_from_quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))
        np.testing.assert_allclose(turn @ [1, 0, 0], [0, 1, 0], atol=1e-12)

    def test_project_beyond_the_plane(self):
        lens = Lens("equidistant", (100, 100), (200, 200), 2.0)
        theta_rad = 1.7
        direction = (math.sin(theta_rad) * math.cos(0.3), math.sin(theta_rad) * math.sin(0.3), math.cos(theta_rad))
        np.testing.assert_allclose(lens.project(direction), (200 + 170 * math.cos(0.3), 200 + 170 * math.sin(0.3)))


if __name__ == "__main__":
    unittest.main()
