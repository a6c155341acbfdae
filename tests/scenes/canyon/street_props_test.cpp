// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_props.h"

#include "tests/scenes/canyon/canyon_test_support.h"
#include "tests/scenes/canyon/surface_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

using PropBuilder = std::function<void(const BuildContext&, const SurfaceFrame&, RandomStream&)>;

TEST(StreetProps, ShowNoBackFacesAndStandOnThePavement) {
  const std::vector<PropBuilder> builders = {
      [](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
        BuildLampPost(context, frame, 7.0);
      },
      [](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
        BuildBollard(context, frame);
      },
      BuildTrafficLight,
      BuildSignPost,
      BuildPerson,
      BuildAdvertisingColumn,
      BuildBusShelter,
      BuildCabinet};
  for (size_t i = 0; i < builders.size(); ++i) {
    PartBench bench;
    RandomStream random({4, i});
    builders[i](bench.Context(), SurfaceFrame(), random);
    const Scene scene = bench.TakeScene();
    const SurfaceFaults backs = FindBacksFrom(Vec3d::UnitZ(), scene);
    EXPECT_TRUE(backs.texts.empty())
        << i << ": " << backs.texts.size() << " " << backs.texts.front();
    EXPECT_NEAR(BoundsOfScene(scene).low_m.z(), -0.015, 0.015) << i;
    EXPECT_TRUE(FindDegenerate(scene).texts.empty()) << i;
  }
}

/// A prop on a pavement at z = 0 whose street is at y < 0.
struct Prop {
  Prop(const PropBuilder& build, uint64_t seed) {
    RandomStream random({seed});
    build(bench.Context(), SurfaceFrame(), random);
    scene = bench.TakeScene();
    bounds = BoundsOfScene(scene);
  }

  Scene Part(int Palette::*member) const { return PartOf(scene, bench.palette.*member); }

  PartBench bench;
  Scene scene;
  Bounds bounds;
};

TEST(LampPost, HoldsItsLampOverTheStreetFacingDown) {
  for (const double height_m : {5.0, 8.0}) {
    const Prop prop(
        [=](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
          BuildLampPost(context, frame, height_m);
        },
        1);
    EXPECT_EQ(prop.bench.stats.num_lamps, 1);
    EXPECT_NEAR(prop.bounds.high_m.z(), height_m, 0.03);
    const Scene lamp = prop.Part(&Palette::head_lamp);
    const Bounds bounds = BoundsOfScene(lamp);
    EXPECT_LT(bounds.high_m.y(), -0.5F);
    EXPECT_GT(bounds.low_m.y(), prop.bounds.low_m.y());
    EXPECT_GT(bounds.low_m.z(), height_m - 0.3);
    // Open above, where the head is: what is left of its area looks down.
    const Vec3f size_m = bounds.high_m - bounds.low_m;
    EXPECT_LT((AreaVectorSum(lamp) + size_m.x() * size_m.y() * Vec3d::UnitZ()).norm(), 1e-5);
  }
}

TEST(TrafficLight, ShowsOneOfThreeLightsToCarsAndOneOfTwoToPeople) {
  constexpr size_t kTrianglesPerLight = 10;
  std::set<std::pair<size_t, bool>> states;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const Prop prop(BuildTrafficLight, seed);
    EXPECT_EQ(prop.bench.stats.num_signs, 1);
    const Scene green = prop.Part(&Palette::signal_green);
    const Scene other = prop.Part(&Palette::tail_lamp);
    EXPECT_EQ(green.NumTriangles() + other.NumTriangles(), 2 * kTrianglesPerLight);
    EXPECT_EQ(prop.Part(&Palette::tyre).NumTriangles(), 3 * kTrianglesPerLight);
    // Green is the lowest light.
    if (!green.meshes.empty()) {
      EXPECT_LT(BoundsOfScene(green).high_m.z(), 2.3F + 0.06F + 0.21F + 1e-4F);
    }
    states.insert({green.NumTriangles(), BoundsOfScene(other).high_m.z() > 2.9F});
    // No head is bumped at the signals.
    EXPECT_GT(BoundsOfScene(prop.Part(&Palette::tyre)).low_m.z(), 2.1F);
  }
  EXPECT_EQ(states.size(), 3U);
}

TEST(SignPost, CarriesOneToThreePlatesThatReadAlongTheStreet) {
  std::set<size_t> counts;
  std::set<bool> ways;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Prop prop(BuildSignPost, seed);
    EXPECT_EQ(prop.bench.stats.num_signs, 1);
    EXPECT_GT(prop.bounds.high_m.z(), 2.55F);
    EXPECT_LT(prop.bounds.high_m.z(), 3.31F);
    const Scene pictures = prop.Part(&Palette::street_picture);
    // Two triangles on each side of a plate.
    EXPECT_EQ(pictures.NumTriangles() % 4, 0U);
    counts.insert(pictures.NumTriangles() / 4);
    const Bounds plates = BoundsOfScene(pictures);
    EXPECT_LT(plates.high_m.z(), prop.bounds.high_m.z());
    EXPECT_GT(plates.low_m.z(), 1.25F);
    // Before or behind the post, as seen along the street, which is the x axis.
    EXPECT_LT(plates.high_m.x() - plates.low_m.x(), 0.0101F);
    EXPECT_GT(std::abs(plates.low_m.x()), 0.03F);
    ways.insert(plates.low_m.x() > 0.0F);
    EXPECT_TRUE(FindMirrored(pictures).texts.empty());
    EXPECT_LT(AreaVectorSum(pictures).norm(), 1e-5);
    EXPECT_TRUE(FindOverlaps(pictures).texts.empty());
  }
  EXPECT_EQ(counts, (std::set<size_t>{1, 2, 3}));
  EXPECT_EQ(ways.size(), 2U);
}

TEST(Bollard, ReachesToTheHip) {
  const Prop prop(
      [](const BuildContext& context, const SurfaceFrame& frame, RandomStream&) {
        BuildBollard(context, frame);
      },
      1);
  EXPECT_NEAR(prop.bounds.high_m.z(), 0.93, 0.01);
  // The band goes all round.
  const Bounds band = BoundsOfScene(prop.Part(&Palette::pale_metal));
  const Bounds post = BoundsOfScene(prop.Part(&Palette::railing));
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_LT(band.low_m[axis], post.low_m[axis]);
    EXPECT_GT(band.high_m[axis], post.high_m[axis]);
  }
}

TEST(Person, IsOfHumanSizeAndClosed) {
  float shortest_m = 9.0F;
  float tallest_m = 0.0F;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Prop prop(BuildPerson, seed);
    EXPECT_EQ(prop.bench.stats.num_people, 1);
    shortest_m = std::min(shortest_m, prop.bounds.high_m.z());
    tallest_m = std::max(tallest_m, prop.bounds.high_m.z());
    EXPECT_LT((prop.bounds.high_m - prop.bounds.low_m).head<2>().maxCoeff(), 1.0F);
    EXPECT_LT(AreaVectorSum(prop.scene).norm(), 1e-5);
    // 50 to 120 litres, and a bag.
    EXPECT_GT(SignedVolume(prop.scene), 0.05);
    EXPECT_LT(SignedVolume(prop.scene), 0.2);
  }
  EXPECT_NEAR(shortest_m, 1.55, 0.02);
  EXPECT_NEAR(tallest_m, 1.9, 0.02);
}

TEST(AdvertisingColumn, IsCoveredWithBillsAllRound) {
  const Prop prop(BuildAdvertisingColumn, 3);
  EXPECT_EQ(prop.bench.stats.num_signs, 1);
  EXPECT_NEAR(prop.bounds.high_m.z(), 3.6, 0.01);
  const Scene bills = prop.Part(&Palette::street_picture);
  EXPECT_TRUE(FindMirrored(bills).texts.empty());
  EXPECT_LT(AreaVectorSum(bills).norm(), 1e-5);
  // All sides of a regular prism of twelve, from its foot to its roof.
  const Bounds bounds = BoundsOfScene(bills);
  const double side_m = 2.0 * 0.62 * std::sin(std::numbers::pi / 12.0);
  double area_m2 = 0.0;
  for (const Mesh& mesh : bills.meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3f area = (mesh.positions_m[b] - mesh.positions_m[a])
                             .cross(mesh.positions_m[c] - mesh.positions_m[a]);
      area_m2 += 0.5 * area.norm();
      EXPECT_GT(area.dot(mesh.positions_m[a]), 0.0F) << "faces inwards";
    }
  }
  EXPECT_NEAR(area_m2, 12.0 * side_m * (bounds.high_m.z() - bounds.low_m.z()), 1e-4);
  // Foot and roof overlap them.
  const Scene metal = prop.Part(&Palette::railing);
  EXPECT_GT(bounds.low_m.z(), BoundsOfScene(metal).low_m.z() + 0.4F);
  EXPECT_LT(bounds.high_m.z(), BoundsOfScene(metal).high_m.z() - 0.4F);
}

TEST(BusShelter, HasARoofPanesAndAPosterAtItsEnd) {
  const Prop prop(BuildBusShelter, 3);
  EXPECT_EQ(prop.bench.stats.num_signs, 1);
  const Vec3f size_m = prop.bounds.high_m - prop.bounds.low_m;
  EXPECT_NEAR(size_m.x(), 4.3, 0.01);
  EXPECT_NEAR(size_m.y(), 1.4, 0.01);
  // It stands behind its place, away from the street; people can stand in it.
  EXPECT_GE(prop.bounds.low_m.y(), 0.0F);
  const Scene panes = prop.Part(&Palette::car_glass);
  EXPECT_NEAR(SignedVolume(panes), 2 * 1.9 * 2.1 * 0.01, 1e-5);
  EXPECT_GT(BoundsOfScene(panes).low_m.y(), 1.2F);
  const Scene poster = prop.Part(&Palette::street_picture);
  EXPECT_EQ(poster.NumTriangles(), 4U);
  EXPECT_TRUE(FindMirrored(poster).texts.empty());
  EXPECT_GT(BoundsOfScene(poster).low_m.x(), 1.9F);
}

TEST(Cabinet, IsABoxOfAMansHeightAtMost) {
  std::set<int> materials;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Prop prop(BuildCabinet, seed);
    const Vec3f size_m = prop.bounds.high_m - prop.bounds.low_m;
    EXPECT_EQ(prop.scene.NumTriangles(), 10U);
    // Open below alone.
    EXPECT_LT((AreaVectorSum(prop.scene) - size_m.x() * size_m.y() * Vec3d::UnitZ()).norm(), 1e-5);
    EXPECT_GE(size_m.x(), 0.5F);
    EXPECT_LE(size_m.x(), 1.2F);
    EXPECT_GE(prop.bounds.high_m.z(), 0.9F);
    EXPECT_LE(prop.bounds.high_m.z(), 1.3F);
    materials.insert(prop.scene.meshes.at(0).material_idx);
  }
  EXPECT_EQ(materials.size(), 2U);
}

}  // namespace
}  // namespace pfseq
