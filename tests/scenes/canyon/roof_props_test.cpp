// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/roof_props.h"

#include "scenes/canyon/shapes.h"
#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(WorldFrame, IsUprightAndRightHanded) {
  const SurfaceFrame frame = WorldFrame({1.0, 2.0, 3.0});
  EXPECT_LT((frame.right.cross(frame.up) - frame.out).norm(), 1e-12);
  EXPECT_LT((frame.At(1.0, 2.0, 3.0) - Vec3d(2.0, -1.0, 5.0)).norm(), 1e-12);
}

TEST(AddBlock, IsABoxWithoutItsBottom) {
  PartBench bench;
  AddBlock(bench.builder, 0, {10.0, 20.0}, {2.0, 3.0}, 4.0, 5.0);
  const Scene scene = bench.TakeScene();
  const Bounds bounds = BoundsOfScene(scene);
  EXPECT_LT((bounds.low_m - Vec3f(9.0F, 18.5F, 4.0F)).norm(), 1e-5F);
  EXPECT_LT((bounds.high_m - Vec3f(11.0F, 21.5F, 5.0F)).norm(), 1e-5F);
  EXPECT_LT((AreaVectorSum(scene) - Vec3d(0.0, 0.0, 6.0)).norm(), 1e-5);
  EXPECT_EQ(scene.NumTriangles(), 10U);
}

TEST(Chimney, IsAStackWithASlabAndPotsOnIt) {
  for (const Vec2d& size_m : {Vec2d(0.58, 2.0), Vec2d(1.2, 0.58), Vec2d(0.58, 0.9)}) {
    PartBench bench;
    RandomStream random({6});
    BuildChimney(bench.Context(), bench.palette.brick[0], {5.0, 7.0}, size_m, 20.0, 23.0, random);
    EXPECT_EQ(bench.stats.num_chimneys, 1);
    const Palette& palette = bench.palette;
    const Scene scene = bench.TakeScene();
    const Bounds stack = BoundsOfScene(PartOf(scene, palette.brick[0]));
    EXPECT_LT((stack.low_m - Vec3f(static_cast<float>(5.0 - 0.5 * size_m.x()),
                                   static_cast<float>(7.0 - 0.5 * size_m.y()),
                                   20.0F))
                  .norm(),
              1e-5F);
    EXPECT_FLOAT_EQ(stack.high_m.z(), 23.0F);
    // The slab is closed, lies on the stack and stands out on all sides.
    const Scene slab = PartOf(scene, palette.coping);
    const Bounds slab_bounds = BoundsOfScene(slab);
    EXPECT_NEAR(
        SignedVolume(slab), (slab_bounds.high_m - slab_bounds.low_m).cast<double>().prod(), 1e-4);
    EXPECT_LT(AreaVectorSum(slab).norm(), 1e-5);
    EXPECT_LT(slab_bounds.low_m.z(), 23.0F);
    EXPECT_GT(slab_bounds.high_m.z(), 23.0F);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GT(stack.low_m[axis] - slab_bounds.low_m[axis], 0.03F);
      EXPECT_GT(slab_bounds.high_m[axis] - stack.high_m[axis], 0.03F);
    }
    // Pots stand in the slab in a row along the stack, within it, and are of eight sides each.
    const Scene pots = PartOf(scene, palette.chimney_pot);
    const Bounds pot_bounds = BoundsOfScene(pots);
    EXPECT_LT(pot_bounds.low_m.z(), slab_bounds.high_m.z());
    EXPECT_GT(pot_bounds.low_m.z(), slab_bounds.low_m.z());
    EXPECT_GT(pot_bounds.high_m.z() - slab_bounds.high_m.z(), 0.25F);
    EXPECT_LT(pot_bounds.high_m.z() - slab_bounds.high_m.z(), 0.7F);
    const double length_m = size_m.maxCoeff();
    const size_t num_pots = pots.NumTriangles() / (8 * 2 + 6);
    EXPECT_EQ(num_pots, static_cast<size_t>(length_m / 0.38));
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GE(pot_bounds.low_m[axis], stack.low_m[axis]);
      EXPECT_LE(pot_bounds.high_m[axis], stack.high_m[axis]);
      EXPECT_NEAR(pot_bounds.low_m[axis] + pot_bounds.high_m[axis], axis == 0 ? 10.0 : 14.0, 1e-4);
      // Side by side along the length alone.
      const bool is_length = size_m[axis] == length_m;
      EXPECT_EQ(pot_bounds.high_m[axis] - pot_bounds.low_m[axis] > 0.3F, is_length && num_pots > 1);
    }
    EXPECT_TRUE(FindBacksFrom(Vec3d::UnitZ(), scene).texts.empty());
  }
}

TEST(Antenna, IsAMastWithAerialsNearItsTop) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    PartBench bench;
    RandomStream random({seed});
    const Vec3d foot_m(3.0, 4.0, 20.0);
    BuildAntenna(bench.Context(), foot_m, random);
    const Scene scene = bench.TakeScene();
    const Bounds bounds = BoundsOfScene(scene);
    EXPECT_FLOAT_EQ(bounds.low_m.z(), 20.0F);
    const double height_m = bounds.high_m.z() - 20.0;
    EXPECT_GT(height_m, 1.79);
    EXPECT_LT(height_m, 3.61);
    double reach_m = 0.0;
    for (const Mesh& mesh : scene.meshes) {
      for (const Vec3f& position_m : mesh.positions_m) {
        const double beside_m = (position_m.head<2>() - Vec2f(3.0F, 4.0F)).norm();
        reach_m = std::max(reach_m, beside_m);
        // Two aerials at most, above the heads on the roof's terrace.
        if (beside_m > 0.1) {
          EXPECT_GT(position_m.z(), 20.0 + height_m - 0.8);
        }
      }
    }
    EXPECT_GT(reach_m, 0.7);
    EXPECT_LT(reach_m, 1.0);
    // The mast, of five sides, has no bottom.
    const double radius_m = 0.024;
    const double foot_m2 = 2.5 * radius_m * radius_m * std::sin(2.0 * std::numbers::pi / 5.0);
    EXPECT_LT((AreaVectorSum(scene) - Vec3d(0.0, 0.0, foot_m2)).norm(), 1e-5);
    EXPECT_GT(SignedVolume(scene), 0.0);
    EXPECT_TRUE(FindBacksFrom(Vec3d::UnitZ(), scene).texts.empty());
  }
}

const std::vector<Lod> kNearStreet = {Lod::kFine, Lod::kFlush, Lod::kFlush, Lod::kFlush};

/// A row house of old plaster with party walls at x = 0 and 14 m.
Building House(const Palette& palette, uint64_t seed, RoofKind roof) {
  Building house = RowHouse(palette, FacadeStyle::kPlaster, 30, 1.0);
  house.roof = roof;
  house.roof_rise_m = roof == RoofKind::kFlat ? 0.5 : 3.0;
  house.seed = seed;
  return house;
}

struct Roofline {
  explicit Roofline(uint64_t seed,
                    RoofKind roof = RoofKind::kFlat,
                    double detail = 1.0,
                    const std::vector<Lod>& lods = kNearStreet) {
    house = House(bench.palette, seed, roof);
    Build(detail, lods);
  }
  explicit Roofline(const Building& given, double detail = 1.0) : house(given) {
    Build(detail, kNearStreet);
  }

  void Build(double detail, const std::vector<Lod>& lods) {
    BuildRoofline(bench.Context(detail), house, lods);
    scene = bench.TakeScene();
  }

  bool Has(int material_idx) const { return !PartOf(scene, material_idx).meshes.empty(); }

  PartBench bench;
  Building house;
  Scene scene;
};

constexpr int kNumHouses = 400;

/// Four standard deviations of the number of hits among `num` draws.
double Spread(double share, int num) { return 4.0 * std::sqrt(share * (1.0 - share) * num); }

TEST(RooflineProps, StacksStandAtPartyWallsAsOftenAsTheDetailSays) {
  for (const RoofKind roof : {RoofKind::kFlat, RoofKind::kMansard}) {
    int num_half = 0;
    int num_normal = 0;
    for (uint64_t seed = 0; seed < kNumHouses; ++seed) {
      num_half += Roofline(seed, roof, 0.5).bench.stats.num_chimneys;
      num_normal += Roofline(seed, roof).bench.stats.num_chimneys;
    }
    EXPECT_NEAR(num_half, 0.4 * 2 * kNumHouses, Spread(0.4, 2 * kNumHouses));
    EXPECT_NEAR(num_normal, 0.8 * 2 * kNumHouses, Spread(0.8, 2 * kNumHouses));
    EXPECT_EQ(Roofline(1, roof, 2.0).bench.stats.num_chimneys, 2);
  }
}

TEST(RooflineProps, StacksStandOnTheirOwnLotAndAboveTheRoof) {
  for (const RoofKind roof : {RoofKind::kFlat, RoofKind::kMansard}) {
    for (uint64_t seed = 0; seed < 50; ++seed) {
      const Roofline roofline(seed, roof, 2.0);
      const Building& house = roofline.house;
      for (const int material_idx :
           {roofline.bench.palette.coping, roofline.bench.palette.chimney_pot}) {
        const Bounds bounds = BoundsOfScene(PartOf(roofline.scene, material_idx));
        EXPECT_GE(bounds.low_m.x(), 0.0F);
        EXPECT_LE(bounds.high_m.x(), 14.0F);
        EXPECT_GE(bounds.low_m.y(), 0.0F);
        EXPECT_LE(bounds.high_m.y(), 11.0F);
        const double roof_m = house.eave_m + (roof == RoofKind::kFlat ? 0.0 : house.roof_rise_m);
        EXPECT_GT(bounds.low_m.z(), roof_m + 0.4);
      }
      // From under the roof.
      const int brick = roofline.bench.palette.brick[seed % roofline.bench.palette.brick.size()];
      const double foot_m = house.eave_m - (roof == RoofKind::kFlat ? house.roof_rise_m : 0.0);
      EXPECT_LT(BoundsOfScene(PartOf(roofline.scene, brick)).low_m.z(), foot_m);
    }
  }
}

TEST(RooflineProps, AreNoneWhereNobodySeesThemOrNothingHoldsThem) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_TRUE(Roofline(seed, RoofKind::kFlat, 2.0, std::vector<Lod>(4, Lod::kCoarse))
                    .scene.meshes.empty());
    // Gables have stacks of their own.
    EXPECT_TRUE(Roofline(seed, RoofKind::kGable, 2.0).scene.meshes.empty());
    PartBench bench;
    Building house = House(bench.palette, seed, RoofKind::kFlat);
    house.lot.edges = {EdgeKind::kStreet, EdgeKind::kCourt, EdgeKind::kCourt, EdgeKind::kCourt};
    EXPECT_EQ(Roofline(house, 2.0).bench.stats.num_chimneys, 0);
    house.lot.edges[0] = EdgeKind::kCourt;
    EXPECT_TRUE(Roofline(house, 2.0).scene.meshes.empty());
  }
}

TEST(RooflineProps, ParapetsHaveARailOrFinialsOrNothing) {
  int num_rails = 0;
  int num_finials = 0;
  for (uint64_t seed = 0; seed < kNumHouses; ++seed) {
    const Roofline roofline(seed);
    const bool has_rail = roofline.Has(roofline.bench.palette.railing);
    const bool has_finials = roofline.Has(roofline.house.trim);
    EXPECT_FALSE(has_rail && has_finials);
    num_rails += has_rail ? 1 : 0;
    num_finials += has_finials ? 1 : 0;
    EXPECT_FALSE(Roofline(seed, RoofKind::kMansard).Has(roofline.bench.palette.railing));
  }
  EXPECT_NEAR(num_rails, 0.2 * kNumHouses, Spread(0.2, kNumHouses));
  EXPECT_NEAR(num_finials, 0.8 * 0.4 * kNumHouses, Spread(0.32, kNumHouses));
}

TEST(RooflineProps, RailsAndFinialsStandOnTheParapet) {
  int num_rails = 0;
  int num_finials = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Roofline roofline(seed);
    for (const bool is_rail : {true, false}) {
      const Scene part =
          PartOf(roofline.scene, is_rail ? roofline.bench.palette.railing : roofline.house.trim);
      if (part.meshes.empty()) {
        continue;
      }
      ++(is_rail ? num_rails : num_finials);
      const Bounds bounds = BoundsOfScene(part);
      // Over the coping, which is a quarter of a metre wide, and not over the street.
      EXPECT_LT(bounds.low_m.z(), roofline.house.eave_m);
      EXPECT_GT(bounds.low_m.z(), roofline.house.eave_m - 0.1);
      EXPECT_NEAR(bounds.high_m.z() - roofline.house.eave_m, is_rail ? 1.0 : 0.95, 0.12);
      EXPECT_GT(bounds.low_m.y(), -0.03F);
      EXPECT_LT(bounds.high_m.y(), 0.3F);
      EXPECT_GE(bounds.low_m.x(), 0.0F);
      EXPECT_NEAR(bounds.low_m.x() + bounds.high_m.x(), 14.0, 1e-3);
    }
  }
  EXPECT_GT(num_rails, 2);
  EXPECT_GT(num_finials, 5);
}

TEST(RooflineProps, ShowNoBackFacesToTheStreet) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const Roofline roofline(seed);
    // A flat roof far and wide behind a parapet.
    PartBench bench;
    const double eave_m = roofline.house.eave_m;
    const double roof_m = eave_m - roofline.house.roof_rise_m;
    AddBox(bench.builder,
           0,
           SurfaceFrame(),
           {0.0, roof_m - 1.0, -0.25},
           {14.0, eave_m, 0.0},
           kFacesAll);
    AddBox(bench.builder,
           0,
           SurfaceFrame(),
           {-99.0, roof_m - 1.0, -99.0},
           {99.0, roof_m, -0.25},
           kFacesAll);
    const SurfaceFaults backs = FindBacksFrom(-Vec3d::UnitY(), roofline.scene, bench.TakeScene());
    EXPECT_TRUE(backs.texts.empty())
        << seed << ": " << backs.texts.size() << " " << backs.texts.front();
  }
}

TEST(RooflineProps, MastsAndArmsStandOnTheRoof) {
  int num_uprights = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    // Hardly any stacks, on which there may be antennas as well.
    const Roofline roofline(seed, RoofKind::kFlat, 1e-3);
    if (roofline.bench.stats.num_chimneys > 0) {
      continue;
    }
    const double roof_m = roofline.house.eave_m - roofline.house.roof_rise_m;
    for (const Mesh& mesh : PartOf(roofline.scene, roofline.bench.palette.pale_metal).meshes) {
      for (const auto& corners : mesh.triangles) {
        std::array<Vec3d, 3> at_m;
        for (size_t i = 0; i < 3; ++i) {
          at_m[i] = mesh.positions_m[corners[i]].cast<double>();
        }
        const auto [low_m, high_m] = std::minmax({at_m[0].z(), at_m[1].z(), at_m[2].z()});
        const Vec3d normal = (at_m[1] - at_m[0]).cross(at_m[2] - at_m[0]).normalized();
        if (std::abs(normal.z()) < 1e-3 && high_m - low_m > 0.3) {
          ++num_uprights;
          EXPECT_LT(low_m, roof_m) << seed;
          EXPECT_GT(low_m, roof_m - 0.1) << seed;
        }
      }
    }
  }
  EXPECT_GT(num_uprights, 100);
}

}  // namespace
}  // namespace pfseq
