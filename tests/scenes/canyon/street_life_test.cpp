// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_life.h"

#include "tests/scenes/canyon/canyon_test_support.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

CanyonStats StatsOf(double street_life) {
  PartBench bench;
  CanyonSpec canyon;
  canyon.surrounding_blocks = 0;
  BuildCity(bench.Context(1.0, street_life), canyon, {});
  return bench.stats;
}

TEST(StreetLife, ComesInTheAmountAskedFor) {
  const CanyonStats none = StatsOf(0.0);
  const CanyonStats some = StatsOf(0.4);
  const CanyonStats much = StatsOf(2.0);
  EXPECT_EQ(none.num_vehicles + none.num_trees + none.num_people + none.num_wires + none.num_lamps,
            0);
  EXPECT_GT(some.num_vehicles, 5);
  EXPECT_GT(much.num_vehicles, some.num_vehicles);
  EXPECT_GT(much.num_people, some.num_people);
  EXPECT_GT(much.num_trees, 10);
  EXPECT_GT(much.num_wires, some.num_wires);
  EXPECT_GT(much.num_signs, some.num_signs);
}

}  // namespace
}  // namespace pfseq
