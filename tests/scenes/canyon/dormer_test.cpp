// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/dormer.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Building House(const Palette& palette) {
  Building house = RowHouse(palette, FacadeStyle::kPlaster, 3, 1.0);
  house.bay_width_m = 2.7;
  return house;
}

TEST(Dormer, StaysBehindTheFrontAndUnderTheRidge) {
  for (const double rise_per_m : {0.7, 2.6}) {
    PartBench bench;
    const Building house = House(bench.palette);
    RandomStream random({1});
    BuildDormers(bench.Context(), house, 0, {rise_per_m, 3.0}, 1, 1.0, Lod::kFine, random);
    EXPECT_GE(bench.stats.num_dormers, 3);
    const Bounds bounds = BoundsOfScene(bench.TakeScene());
    EXPECT_GT(bounds.low_m.y(), 0.0F);
    EXPECT_LT(bounds.high_m.y(), 3.0 / rise_per_m);
    EXPECT_LT(bounds.high_m.z(), house.eave_m + 3.0);
  }
}

TEST(Dormer, NeedsARoofThatIsHighEnough) {
  PartBench bench;
  RandomStream random({1});
  BuildDormers(bench.Context(), House(bench.palette), 0, {0.7, 1.5}, 1, 1.0, Lod::kFine, random);
  EXPECT_EQ(bench.stats.num_dormers, 0);
}

}  // namespace
}  // namespace pfseq
