// SPDX-License-Identifier: Apache-2.0
#include "validator/metrics/redundancy.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(NonRedundantCount, CountsSeparatePointsInFull) {
  NonRedundantCount count(400, 300);
  for (int i = 0; i < 5; ++i) {
    count.Add({Vec2d(40.0 + 70.0 * i, 150.0), 20.0});
  }
  EXPECT_NEAR(count.Count(), 5.0, 1e-4);
}

TEST(NonRedundantCount, CountsTheSamePlaceOnce) {
  NonRedundantCount count(400, 300);
  for (int i = 0; i < 5; ++i) {
    count.Add({Vec2d(100.0, 150.0), 20.0});
  }
  EXPECT_NEAR(count.Count(), 1.0, 1e-4);
}

TEST(NonRedundantCount, OverlapsLieBetweenAndOrderDoesNotMatter) {
  const Support a{Vec2d(100.0, 150.0), 24.0};
  const Support b{Vec2d(106.0, 150.0), 16.0};
  NonRedundantCount forth(400, 300), back(400, 300);
  forth.Add(a);
  forth.Add(b);
  back.Add(b);
  back.Add(a);
  EXPECT_NEAR(forth.Count(), back.Count(), 1e-5);
  EXPECT_GT(forth.Count(), 1.2);
  EXPECT_LT(forth.Count(), 1.95);
}

TEST(NonRedundantCount, PlacesAtTheRimAndBeyondAreNoTrouble) {
  NonRedundantCount count(50, 50);
  for (const Vec2d& place : {Vec2d(0.0, 0.0), Vec2d(50.0, 25.0), Vec2d(-100.0, 25.0)}) {
    count.Add({place, 1000.0});
    count.Add({place, 0.0});
  }
  EXPECT_GT(count.Count(), 0.2);
  EXPECT_LT(count.Count(), 4.0);
}

}  // namespace
}  // namespace pfseq
