// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade_clutter.h"

#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// On the first floor.
const Opening kWindow = {{2.0, 5.0}, {3.2, 6.8}};

/// What hangs at a window of a house's front in the plane y = 0, whose street is at y < 0.
Scene ClutterAt(const Opening& opening,
                uint64_t seed,
                double street_life = 1.0,
                double detail = 1.0,
                bool has_balcony = false) {
  PartBench bench;
  RandomStream random({seed});
  BuildWindowClutter(
      bench.Context(detail, street_life), SurfaceFrame(), opening, has_balcony, random);
  return bench.TakeScene();
}

/// The material that tells a thing from the others.
struct Marks {
  int flower_box;
  int air_conditioner;
  int flag;
};
Marks MarksOf(const Palette& palette) {
  return {palette.chimney_pot, palette.tyre, palette.cloth[0]};
}

/// The first thing of this kind.
Scene FirstWith(int material_idx) {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    Scene scene = ClutterAt(kWindow, seed);
    if (!PartOf(scene, material_idx).meshes.empty()) {
      return scene;
    }
  }
  ADD_FAILURE() << "expected one in 2000 windows";
  return {};
}

struct Shares {
  double flower_box = 0.0;
  double air_conditioner = 0.0;
  double flag = 0.0;
  double nothing = 0.0;
};
constexpr int kNumWindows = 4000;
Shares SharesOf(const Opening& opening, double street_life) {
  const Palette palette = PlainPalette();
  Shares shares;
  for (uint64_t seed = 0; seed < kNumWindows; ++seed) {
    const Scene scene = ClutterAt(opening, seed, street_life);
    const auto has = [&](int material_idx) { return !PartOf(scene, material_idx).meshes.empty(); };
    const bool has_cloth = has(palette.cloth[0]) || has(palette.cloth[1]);
    shares.flower_box += has(MarksOf(palette).flower_box) ? 1.0 / kNumWindows : 0.0;
    shares.air_conditioner += has(MarksOf(palette).air_conditioner) ? 1.0 / kNumWindows : 0.0;
    shares.flag += has_cloth ? 1.0 / kNumWindows : 0.0;
    shares.nothing += scene.meshes.empty() ? 1.0 / kNumWindows : 0.0;
  }
  return shares;
}

/// Four standard deviations of a share.
double Spread(double share) { return 4.0 * std::sqrt(share * (1.0 - share) / kNumWindows); }

TEST(WindowClutter, ComesAsOftenAsTheStreetIsAlive) {
  for (const double street_life : {0.5, 1.0, 2.0}) {
    const Shares shares = SharesOf(kWindow, street_life);
    EXPECT_NEAR(shares.flower_box, 0.1 * street_life, Spread(0.1 * street_life));
    EXPECT_NEAR(shares.air_conditioner, 0.05 * street_life, Spread(0.05 * street_life));
    EXPECT_NEAR(shares.flag, 0.015 * street_life, Spread(0.015 * street_life));
    EXPECT_NEAR(shares.nothing, 1.0 - 0.165 * street_life, Spread(0.165 * street_life));
  }
}

TEST(WindowClutter, LeavesHeadRoomUnderAirConditioners) {
  // They hang below the sill; under a low window there are none.
  EXPECT_EQ(SharesOf({{2.0, 4.4}, {3.2, 6.0}}, 2.0).air_conditioner, 0.0);
  const Scene scene = FirstWith(MarksOf(PlainPalette()).air_conditioner);
  EXPECT_LT(BoundsOfScene(scene).high_m.z(), 5.0F);
  // At the lowest window that has one, 4.5 m up.
  EXPECT_GT(BoundsOfScene(scene).low_m.z() - 0.5, kKerbHeight_m + 2.7);
}

TEST(WindowClutter, IsNoneAtBalconiesAndOnBareWallsAndInEmptyStreets) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    EXPECT_TRUE(ClutterAt(kWindow, seed, 2.0, 1.0, true).meshes.empty());
    EXPECT_TRUE(ClutterAt(kWindow, seed, 2.0, 0.0).meshes.empty());
    EXPECT_TRUE(ClutterAt(kWindow, seed, 0.0).meshes.empty());
  }
}

TEST(WindowClutter, FlowerBoxesStandOnTheSill) {
  const Palette palette = PlainPalette();
  const Scene scene = FirstWith(MarksOf(palette).flower_box);
  const Scene box = PartOf(scene, palette.chimney_pot);
  const Bounds bounds = BoundsOfScene(box);
  EXPECT_NEAR(bounds.low_m.z(), 5.0, 0.01);
  EXPECT_GT(bounds.low_m.x(), 2.0F);
  EXPECT_LT(bounds.high_m.x(), 3.2F);
  EXPECT_NEAR(bounds.low_m.x() + bounds.high_m.x(), 2.0 + 3.2, 1e-5);
  EXPECT_LT(bounds.high_m.y(), 0.0F);
  // A closed box.
  const Vec3d size_m = (bounds.high_m - bounds.low_m).cast<double>();
  EXPECT_NEAR(SignedVolume(box), size_m.prod(), 1e-6);
  EXPECT_LT(AreaVectorSum(box).norm(), 1e-6);
  // Leaves grow out of it and leave most of the window free.
  int num_leaves = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (IsSheet(mesh)) {
      num_leaves += static_cast<int>(mesh.triangles.size()) / 2;
      for (const Vec3f& position_m : mesh.positions_m) {
        EXPECT_GT(position_m.z(), 5.0F);
        EXPECT_LT(position_m.z(), 5.5F);
        EXPECT_LT(position_m.y(), 0.02F);
      }
    }
  }
  EXPECT_GT(num_leaves, 20);
}

TEST(WindowClutter, AirConditionersAndFlagsShowNoBackFacesToTheStreet) {
  const Marks marks = MarksOf(PlainPalette());
  PartBench bench;
  bench.builder.Rectangle(0, SurfaceFrame(), {-99.0, -99.0}, {99.0, 99.0}, 0.0);
  const Scene wall = bench.TakeScene();
  for (const int material_idx : {marks.air_conditioner, marks.flag}) {
    const Scene scene = FirstWith(material_idx);
    const SurfaceFaults backs = FindBacksFrom(-Vec3d::UnitY(), scene, wall);
    EXPECT_TRUE(backs.texts.empty()) << backs.texts.size() << " " << backs.texts.front();
    EXPECT_TRUE(FindDegenerate(scene).texts.empty());
    // Fixed to the wall.
    EXPECT_GE(BoundsOfScene(scene).high_m.y(), -1e-6F);
    EXPECT_LT(BoundsOfScene(scene).high_m.y(), 0.05F);
  }
}

TEST(WindowClutter, FlagsHangFromStaffsThatLeanOutAndUp) {
  const Palette palette = PlainPalette();
  const Scene scene = FirstWith(palette.cloth[0]);
  // The staff leaves the wall beside the window; its upper end is its outer one.
  const Scene staff = PartOf(scene, palette.pale_metal);
  double outer_z_m = 0.0;
  double outer_y_m = 0.0;
  for (const Mesh& mesh : staff.meshes) {
    for (const Vec3f& position_m : mesh.positions_m) {
      EXPECT_GT(position_m.x(), 3.2F);
      if (position_m.y() < outer_y_m) {
        outer_y_m = position_m.y();
        outer_z_m = position_m.z();
      }
    }
  }
  EXPECT_NEAR(outer_z_m, BoundsOfScene(staff).high_m.z(), 0.05);
  EXPECT_LT(outer_y_m, -1.0);
  EXPECT_GT(outer_z_m - BoundsOfScene(staff).low_m.z(), 0.9);
  // The cloth is closed and hangs clear of the heads below.
  Scene cloth = PartOf(scene, palette.cloth[0]);
  for (const Mesh& mesh : PartOf(scene, palette.cloth[1]).meshes) {
    cloth.meshes.push_back(mesh);
  }
  EXPECT_LT(AreaVectorSum(cloth).norm(), 1e-6);
  EXPECT_GT(SignedVolume(cloth), 1e-3);
  EXPECT_GT(BoundsOfScene(cloth).low_m.z(), kKerbHeight_m + 2.7);
  EXPECT_LT(BoundsOfScene(cloth).high_m.z(), outer_z_m);
}

/// A sign on a shop whose front has its door's head at this height.
struct HangingSign {
  HangingSign(double head_m, uint64_t seed) {
    RandomStream random({seed});
    BuildHangingSign(bench.Context(), SurfaceFrame(), 4.0, head_m, random);
    scene = bench.TakeScene();
  }

  PartBench bench;
  Scene scene;
};

TEST(HangingSign, LeavesHeadRoomOverThePavement) {
  for (const double head_m : {2.0, 3.0, 3.8, 4.2, 6.0}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const HangingSign sign(head_m, seed);
      const Bounds bounds = BoundsOfScene(sign.scene);
      EXPECT_GE(bounds.low_m.z(), kKerbHeight_m + 2.7 - 1e-5) << head_m;
      // Where there is room, it hangs beside the head of the shop's front.
      EXPECT_LT(bounds.low_m.z(), std::max(head_m, 2.9)) << head_m;
      EXPECT_EQ(sign.bench.stats.num_signs, 1);
    }
  }
}

TEST(HangingSign, IsAClosedBoardHeldByTheWall) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const HangingSign sign(4.0, seed);
    const Bounds bounds = BoundsOfScene(sign.scene);
    // Brackets begin in the wall; a lorry at the kerb does not touch the board.
    EXPECT_GT(bounds.high_m.y(), 0.0F);
    EXPECT_LT(bounds.high_m.y(), 0.1F);
    EXPECT_LT(bounds.low_m.y(), -0.6F);
    EXPECT_GT(bounds.low_m.y(), -1.0F);
    // Across the wall, about the place it was asked for.
    EXPECT_NEAR(0.5 * (bounds.low_m.x() + bounds.high_m.x()), 4.0, 1e-5);
    EXPECT_LT(bounds.high_m.x() - bounds.low_m.x(), 0.2F);
    EXPECT_LT(AreaVectorSum(sign.scene).norm(), 1e-5);
    // The board fills its bounds but for the gap to the wall.
    const Bounds board = BoundsOfScene(PartOf(sign.scene, sign.bench.palette.street_picture));
    const double board_m3 = (board.high_m - board.low_m).cast<double>().prod();
    EXPECT_GT(SignedVolume(sign.scene), board_m3);
    EXPECT_LT(SignedVolume(sign.scene), 1.05 * board_m3);
    for (const Vec3d& side : {Vec3d(Vec3d::UnitX()), Vec3d(-Vec3d::UnitX())}) {
      const SurfaceFaults backs = FindBacksFrom(side, sign.scene);
      EXPECT_TRUE(backs.texts.empty()) << backs.texts.size() << " " << backs.texts.front();
    }
  }
}

TEST(HangingSign, ReadsFromLeftToRightOnBothSides) {
  const HangingSign sign(4.0, 5);
  const Scene pictures = PartOf(sign.scene, sign.bench.palette.street_picture);
  EXPECT_EQ(FindMirrored(pictures).num_checked, 2 * 2 * 3);
  EXPECT_TRUE(FindMirrored(pictures).texts.empty());
  EXPECT_LT(AreaVectorSum(pictures).norm(), 1e-5);
}

}  // namespace
}  // namespace pfseq
