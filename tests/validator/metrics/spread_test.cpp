// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/spread.h"

#include "renderer/core/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Uniform in the disc of a radius.
std::vector<Vec2d> InDisc(int count, double radius, uint64_t seed) {
  RandomStream random{seed};
  std::vector<Vec2d> points;
  for (int i = 0; i < count; ++i) {
    const double r = radius * std::sqrt(random.Uniform());
    const double angle = 2.0 * std::numbers::pi * random.Uniform();
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return points;
}

SpreadScores ScoresOf(const std::vector<Vec2d>& points) {
  SpreadCounter counter;
  for (const Vec2d& point : points) {
    counter.Add(point);
  }
  return counter.Scores();
}

TEST(Spread, AUniformDiscHasDeviationAndDistanceOne) {
  const SpreadScores scores = ScoresOf(InDisc(20000, 1.0, 1));
  EXPECT_NEAR(scores.deviation, 1.0, 0.01);
  EXPECT_NEAR(scores.distance, 1.0, 0.02);
  EXPECT_EQ(scores.cells, 1.0);
}

TEST(Spread, HalfTheDiscAcrossHasHalfTheDeviationAndAQuarterOfTheCells) {
  const SpreadScores scores = ScoresOf(InDisc(20000, 0.5, 2));
  EXPECT_NEAR(scores.deviation, 0.5, 0.01);
  EXPECT_NEAR(scores.distance, 0.5, 0.02);
  EXPECT_NEAR(scores.cells, 0.25, 1e-12);
}

TEST(Spread, ACellNeedsTwoPoints) {
  EXPECT_EQ(ScoresOf({Vec2d(0.5, 0.1)}).cells, 0.0);
  EXPECT_EQ(ScoresOf({Vec2d(0.5, 0.1), Vec2d(0.5, 0.11)}).cells, 1.0 / 128.0);
}

TEST(Spread, CoverageOfOnePointIsLeastAndNeverFalls) {
  double sum = 0.0;
  for (int level = 1; level <= 6; ++level) {
    sum += std::pow(0.25, level) / 6.0;
  }
  SpreadCounter counter;
  double previous = 0.0;
  for (const Vec2d& point : InDisc(3000, 1.0, 3)) {
    counter.Add(point);
    const double coverage = counter.Scores().coverage;
    EXPECT_GE(coverage, previous);
    if (previous == 0.0) {
      EXPECT_NEAR(coverage, sum, 1e-12);
    }
    previous = coverage;
  }
  EXPECT_LT(previous, 1.0);
}

TEST(Spread, CoveragePrefersEvenSpacingToClumpsAndRims) {
  // 64 points: one in each cell of 8 x 8, at random, on the rim alone, in a clump.
  std::vector<Vec2d> even, rim, clump;
  for (int ring = 0; ring < 8; ++ring) {
    for (int sector = 0; sector < 8; ++sector) {
      const double angle = 2.0 * std::numbers::pi * (sector + 0.5) / 8.0;
      const double r = std::sqrt((ring + 0.5) / 8.0);
      even.emplace_back(r * std::cos(angle), r * std::sin(angle));
      const double around = 2.0 * std::numbers::pi * (8 * ring + sector) / 64.0;
      rim.emplace_back(0.99 * std::cos(around), 0.99 * std::sin(around));
      clump.emplace_back(0.5 + 0.002 * ring, 0.1 + 0.002 * sector);
    }
  }
  const double random = ScoresOf(InDisc(64, 1.0, 4)).coverage;
  EXPECT_GT(ScoresOf(even).coverage, random);
  EXPECT_GT(random, ScoresOf(rim).coverage);
  EXPECT_GT(ScoresOf(rim).coverage, ScoresOf(clump).coverage);
  // The deviation is fooled by the rim.
  EXPECT_GT(ScoresOf(rim).deviation, ScoresOf(even).deviation);
  // A single point far off changes little.
  std::vector<Vec2d> with_outlier = clump;
  with_outlier.emplace_back(-0.9, -0.3);
  EXPECT_LT(ScoresOf(with_outlier).coverage, ScoresOf(clump).coverage + 0.06);
}

TEST(Uniformity, CountsCellsOf80PixelsWithTwoPoints) {
  // 3 x 2 cells, the right ones 40 pixels wide.
  const std::vector<Vec2d> pixels = {
      {10, 10}, {79, 79}, {81, 10}, {90, 10}, {195, 100}, {199, 159}, {20, 100}};
  EXPECT_NEAR(Uniformity(pixels, 200, 160), 3.0 / 6.0, 1e-12);
  EXPECT_EQ(Uniformity({}, 200, 160), 0.0);
}

}  // namespace
}  // namespace pfseq
