// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_store.h"

#include "tests/trace/stored_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(LightStore, IsBilinearOverAParallelogram) {
  // Records a metre apart: 4 x 4 cells (the slanted edge is longer than 3 m), the outermost ones a
  // fifth of a cell off the edges.
  StoredScene stored(Spacing(1.0F));
  constexpr std::array<float, 5> kRecords = {0.05F, 0.25F, 0.5F, 0.75F, 0.95F};
  const auto light = [&](float s, float t) {
    return stored.store.Lookup(FloorPoint(s, t), LightDetail::kSeen);
  };
  RandomStream random({1});
  double contrast = 0.0;
  for (int i = 0; i < 400; ++i) {
    const auto column = static_cast<size_t>(random.Integer(0, 3));
    const auto row = static_cast<size_t>(random.Integer(0, 3));
    const float s0 = kRecords[column];
    const float s1 = kRecords[column + 1];
    const float t0 = kRecords[row];
    const float t1 = kRecords[row + 1];
    const auto x = static_cast<float>(random.Uniform(0.01, 0.99));
    const auto y = static_cast<float>(random.Uniform(0.01, 0.99));
    const VectorIrradiance here = light(s0 + (s1 - s0) * x, t0 + (t1 - t0) * y);
    const std::array<VectorIrradiance, 4> corners = {
        light(s0, t0), light(s1, t0), light(s0, t1), light(s1, t1)};
    const std::array<float, 4> weights = {
        (1.0F - x) * (1.0F - y), x * (1.0F - y), (1.0F - x) * y, x * y};
    Eigen::Array4f expected_x = Eigen::Array4f::Zero();
    Eigen::Array4f expected_z = Eigen::Array4f::Zero();
    for (size_t k = 0; k < 4; ++k) {
      expected_x += weights[k] * corners[k].x;
      expected_z += weights[k] * corners[k].z;
      contrast = std::max(contrast, static_cast<double>(std::abs(corners[k].z[0] - here.z[0])));
    }
    EXPECT_LT((here.x - expected_x).head<3>().abs().maxCoeff(), 1e-3F);
    EXPECT_LT((here.z - expected_z).head<3>().abs().maxCoeff(), 1e-3F);
  }
  EXPECT_GT(contrast, 0.3);
  EXPECT_EQ(stored.store.NumRecords(), 25);
  // Beyond the outermost records nothing changes.
  EXPECT_TRUE(IsSame(light(0.01F, 0.5F), light(0.05F, 0.5F)));
  EXPECT_TRUE(IsSame(light(0.5F, 1.0F), light(0.5F, 0.95F)));
}

TEST(LightStore, HasNoStepsWithinTriangles) {
  // Lines over all triangles of the ball: steps much smaller than the records' distance.
  StoredScene stored(Spacing(0.03F));
  const uint32_t first = stored.lit.surfaces.TriangleIdx(6, 0);
  for (uint32_t k = 50; k < 250; k += 23) {
    ShadingPoint point;
    point.triangle_idx = first + k;
    float before = -1.0F;
    float least = 1e9F;
    float most = 0.0F;
    float widest_step = 0.0F;
    constexpr int kNumSteps = 400;
    for (int i = 1; i < kNumSteps; ++i) {
      const float t = static_cast<float>(i) / kNumSteps;
      point.u = 0.05F + 0.6F * t;
      point.v = 0.9F - 0.85F * t;
      const VectorIrradiance light = stored.store.Lookup(point, LightDetail::kSeen);
      const float value = std::abs(light.x[1]) + std::abs(light.y[1]) + std::abs(light.z[1]);
      widest_step = before < 0.0F ? 0.0F : std::max(widest_step, std::abs(value - before));
      least = std::min(least, value);
      most = std::max(most, value);
      before = value;
    }
    // Some ten records lie along the line.
    EXPECT_LE(widest_step, 0.1F * (most - least) + 1e-4F) << k;
  }
}

TEST(LightStore, ShadowsOfThinThingsAreNoWiderThanTheyAre) {
  // A bar of 6 x 3 cm that lies 3 cm above the floor, over a row of records.
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Constant(0.5F))};
  scene.meshes = {FloorMesh(2.0F, 0)};
  AddBox({-0.03F, -2.0F, 0.03F}, {0.06F, 4.0F, 0.03F}, 0, &scene.meshes);
  scene.meshes.push_back(
      ParallelogramMesh({-0.03F, -2.0F, 0.03F}, {0.0F, 4.0F, 0.0F}, {0.06F, 0.0F, 0.0F}, 0));
  StoredScene stored(Spacing(0.25F), std::move(scene));
  const auto light_at = [&](float x_m) {
    const Vec3f origin_m(x_m, 0.1F, 0.02F);
    const Vec3f down(0.0F, 0.0F, -1.0F);
    const ShadingPoint point =
        stored.lit.surfaces.Locate(*stored.lit.rays.Intersect(origin_m, down), down);
    return stored.store.Lookup(point, LightDetail::kSeen).z[1];
  };
  const float shaded = light_at(0.0F);
  const float open = light_at(1.0F);
  EXPECT_LT(shaded, 0.6F * open);
  // Interpolated to the next record, it would be less than three quarters here.
  EXPECT_GT(light_at(0.12F), 0.85F * open);
  EXPECT_GT(light_at(-0.12F), 0.85F * open);
}

TEST(LightStore, GapsBetweenBodiesHaveLightOfTheirOwn) {
  // A gap of 3 cm between a block on the floor, within which records are buried, and a board just
  // over it, under which they are dark.
  for (const float gap_m : {0.0F, 0.02F, 0.05F}) {
    Scene scene;
    scene.materials = {LambertianMaterial(Rgb::Constant(0.5F))};
    scene.meshes = {FloorMesh(2.0F, 0)};
    AddBox({gap_m + 0.015F, -1.0F, 0.0F}, {0.5F, 2.0F, 0.02F}, 0, &scene.meshes);
    AddBox({gap_m - 0.515F, -1.0F, 0.004F}, {0.5F, 2.0F, 0.006F}, 0, &scene.meshes);
    scene.meshes.push_back(ParallelogramMesh(
        {gap_m - 0.515F, -1.0F, 0.004F}, {0.0F, 2.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, 0));
    StoredScene stored(Spacing(0.25F), std::move(scene));
    const Vec3f origin_m(gap_m, 0.1F, 0.02F);
    const Vec3f down(0.0F, 0.0F, -1.0F);
    ShadingPoint point =
        stored.lit.surfaces.Locate(*stored.lit.rays.Intersect(origin_m, down), down);
    point.position_m = {origin_m.x(), origin_m.y(), 0.0F};
    const float here = stored.lit.gatherer.Gather(point.RayOriginM(), -down, 1).light.z[1];
    EXPECT_GT(here, 0.5F);
    EXPECT_NEAR(stored.store.Lookup(point, LightDetail::kSeen).z[1], here, 0.25F * here) << gap_m;
  }
}

TEST(LightStore, RecordsInACornerDoNotStandForTheirCell) {
  // The outermost records lie 5 cm off the floor's edge, 2 mm off a step of 4 cm: they see half of
  // the sky, the floor at its edge most of it.
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  scene.meshes = {FloorMesh(2.0F, 0)};
  AddBox({-1.948F, -2.0F, -0.01F}, {0.4F, 4.0F, 0.05F}, 0, &scene.meshes);
  StoredScene stored(Spacing(0.25F), std::move(scene));
  for (const float x_m : {-1.99F, -1.975F}) {
    const Vec3f origin_m(x_m, 0.1F, 0.02F);
    const Vec3f down(0.0F, 0.0F, -1.0F);
    ShadingPoint point =
        stored.lit.surfaces.Locate(*stored.lit.rays.Intersect(origin_m, down), down);
    point.position_m = {origin_m.x(), origin_m.y(), 0.0F};
    const float truth = stored.lit.gatherer.Gather(point.RayOriginM(), -down, 1).light.z[1];
    EXPECT_NEAR(stored.store.Lookup(point, LightDetail::kSeen).z[1], truth, 0.12F * truth) << x_m;
  }
}

TEST(LightStore, SidesOfATriangleAreApart) {
  StoredScene stored(Spacing(0.5F));
  const VectorIrradiance front =
      stored.store.Lookup(FloorPoint(0.4F, 0.3F, true), LightDetail::kSeen);
  const VectorIrradiance back =
      stored.store.Lookup(FloorPoint(0.4F, 0.3F, false), LightDetail::kSeen);
  EXPECT_GT(front.z[2], 1.0F);
  // From below, the sky alone.
  EXPECT_NEAR(back.z[2], -3.1416F, 0.1F);
}

TEST(LightStore, DoesNotDependOnOrderNorThreads) {
  StoredScene one(Spacing(0.25F));
  const std::vector<ShadingPoint> points = one.Points(600);
  std::vector<LightStore::RecordId> records = one.ComputeMissing(points, 1);
  EXPECT_GT(records.size(), 500U);
  const std::string bytes = one.store.Serialize();

  StoredScene three(Spacing(0.25F));
  std::reverse(records.begin(), records.end());
  three.Compute(records, 3);
  EXPECT_TRUE(three.store.Serialize() == bytes);

  // By lookups alone, the last first.
  StoredScene asked(Spacing(0.25F));
  for (size_t i = points.size(); i-- > 0;) {
    asked.store.Lookup(points[i], LightDetail::kSeen);
  }
  EXPECT_GT(asked.store.NumRecords(), 500);
  // Where light changes fast, a lookup may do without some of the regular records.
  asked.ComputeMissing(points, 1);
  EXPECT_TRUE(asked.store.Serialize() == bytes);
}

TEST(LightStore, WantsEachRecordOnceAndComputesNoOther) {
  StoredScene stored(Spacing(0.25F));
  const std::vector<ShadingPoint> points = stored.Points(300);
  const std::vector<LightStore::RecordId> records = stored.Missing(points);
  EXPECT_TRUE(stored.Missing(points).empty());
  EXPECT_EQ(stored.store.NumRecords(), 0);
  stored.Compute(records, 2);
  const size_t num_finer = stored.ComputeMissing(points, 2).size();
  EXPECT_GT(num_finer, 0U);
  EXPECT_TRUE(stored.Missing(points).empty());
  const auto num_records = static_cast<int64_t>(records.size() + num_finer);
  EXPECT_EQ(stored.store.NumRecords(), num_records);
  for (const ShadingPoint& point : points) {
    stored.store.Lookup(point, LightDetail::kSeen);
  }
  // All were there.
  EXPECT_EQ(stored.store.NumRecords(), num_records);
}

TEST(LightStore, IsRightOnASlabBesideAWallThroughIt) {
  // A black wall of 1.6 m stands on, and goes through, a slab with records each half metre: those
  // in the middle lie within the wall, its outer ones can be moved out of it, and between them lie
  // finer ones.
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  scene.meshes = {FloorMesh(4.0F, 0)};
  AddBox({-0.8F, -6.0F, -1.0F}, {1.6F, 12.0F, 1.5F}, 0, &scene.meshes);
  StoredScene stored(Spacing(0.5F), scene);
  const auto light_at = [&](float x_m) {
    return stored.store.Lookup(FloorPoint((x_m + 4.0F) / 8.0F, 0.53F), LightDetail::kSeen).z[0];
  };
  for (const float x_m : {-1.0F, -0.9F, -0.81F, 0.81F, 0.85F, 0.95F, 1.2F}) {
    const float truth =
        stored.lit.gatherer.Gather({x_m, 0.24F, 1e-4F}, Vec3f::UnitZ(), 1).light.z[0];
    EXPECT_GT(truth, 1.0F) << x_m;
    EXPECT_NEAR(light_at(x_m), truth, 0.15F * truth) << x_m;
  }
  // Where there is nothing but buried records, they count.
  EXPECT_LT(light_at(0.0F), 0.1F);
}

/// A floor under two black boards that leave a gap around x = 0.75 m, at which records half a metre
/// apart do not lie: what the store says of its middle, and what there is, means over its length.
std::array<float, 2> LightInGap(float width_m) {
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  scene.meshes = {FloorMesh(4.0F, 0)};
  const float left_m = 0.75F - 0.5F * width_m;
  const float right_m = 0.75F + 0.5F * width_m;
  AddBox({-4.5F, -6.0F, -1.0F}, {left_m + 4.5F, 12.0F, 1.05F}, 0, &scene.meshes);
  AddBox({right_m, -6.0F, -1.0F}, {4.5F - right_m, 12.0F, 1.05F}, 0, &scene.meshes);
  StoredScene stored(Spacing(0.5F), scene);
  float looked_up = 0.0F;
  float truth = 0.0F;
  constexpr int kNumPoints = 100;
  for (int i = 0; i < kNumPoints; ++i) {
    const float across = 0.3F + 0.4F * static_cast<float>(i) / kNumPoints;
    ShadingPoint point = FloorPoint((0.75F + 4.0F) / 8.0F, across);
    point.position_m = {0.75F, across * 8.0F - 4.0F, 0.0F};
    const Vec3f origin_m = point.RayOriginM();
    looked_up += stored.store.Lookup(point, LightDetail::kSeen).z[0] / kNumPoints;
    truth +=
        stored.lit.gatherer.Gather(origin_m, point.geometric_normal, 1).light.z[0] / kNumPoints;
  }
  return {looked_up, truth};
}

TEST(LightStore, RecordsMoveIntoGapsBetweenBodies) {
  const auto [stored, truth] = LightInGap(0.2F);
  EXPECT_GT(truth, 1.0F);
  EXPECT_NEAR(stored, truth, 0.4F * truth);
}

TEST(LightStore, GapsWithoutRecordsAreNotBlack) {
  const auto [stored, truth] = LightInGap(0.01F);
  EXPECT_GT(truth, 0.05F);
  EXPECT_NEAR(stored, truth, 0.5F * truth);
}

TEST(LightStore, LittleMemoryGivesTheSameLookups) {
  StoredScene plenty(Spacing(0.25F));
  const std::vector<ShadingPoint> points = plenty.Points(100);
  for (const int64_t max_bytes : {int64_t{0}, int64_t{1000}, int64_t{4000}}) {
    LightStoreOptions options = Spacing(0.25F);
    options.max_bytes = max_bytes;
    StoredScene little(options);
    little.Compute(little.Missing(points), 2);
    for (const ShadingPoint& point : points) {
      ASSERT_TRUE(IsSame(little.store.Lookup(point, LightDetail::kSeen),
                         plenty.store.Lookup(point, LightDetail::kSeen)))
          << max_bytes;
    }
    // A record takes 24 bytes.
    EXPECT_LE(little.store.NumRecords() * 24, max_bytes);
    EXPECT_EQ(little.store.NumRecords() > 0, max_bytes > 0);
    EXPECT_LT(little.store.NumRecords(), plenty.store.NumRecords());
  }
}

TEST(LightStore, SpacingGrowsWithTheDistanceToTheNearestViewpoint) {
  const auto num_records = [](const std::vector<Vec3f>& viewpoints_m) {
    LightStoreOptions options = Spacing(0.25F);
    options.viewpoints_m = viewpoints_m;
    StoredScene stored(options);
    std::vector<LightStore::RecordId> missing;
    for (int i = 0; i <= 100; ++i) {
      for (int k = 0; k <= 100; ++k) {
        stored.store.Want(
            FloorPoint(static_cast<float>(i) / 100.0F, static_cast<float>(k) / 100.0F),
            LightDetail::kSeen,
            missing);
      }
    }
    return missing.size();
  };
  const size_t everywhere = num_records({});
  EXPECT_EQ(everywhere, 17U * 14U);
  EXPECT_EQ(num_records({Vec3f(0.0F, 0.0F, 2.0F)}), everywhere);
  // 0.03 * (40 - 0.6 * 4) m: about 1.13 m.
  EXPECT_EQ(num_records({Vec3f(0.0F, 0.0F, 40.0F)}), 5U * 4U);
  // The nearest of them counts.
  EXPECT_EQ(num_records({Vec3f(0.0F, 0.0F, 40.0F), Vec3f(0.0F, 0.0F, 2.0F)}), everywhere);
}

TEST(LightStore, WhatIsReflectedHasFewerRecordsOfItsOwn) {
  StoredScene stored(Spacing(0.25F));
  const auto num_missing = [&](LightDetail detail) {
    std::vector<LightStore::RecordId> missing;
    for (int i = 0; i <= 40; ++i) {
      for (int k = 0; k <= 40; ++k) {
        stored.store.Want(FloorPoint(static_cast<float>(i) / 40.0F, static_cast<float>(k) / 40.0F),
                          detail,
                          missing);
      }
    }
    return missing.size();
  };
  // A metre apart.
  EXPECT_EQ(num_missing(LightDetail::kReflected), 5U * 5U);
  EXPECT_EQ(num_missing(LightDetail::kSeen), 17U * 14U);
  // Coarser, but the same light.
  float sum_seen = 0.0F;
  float sum_of_differences = 0.0F;
  for (int i = 1; i < 20; ++i) {
    const ShadingPoint point = FloorPoint(static_cast<float>(i) / 20.0F, 0.2F);
    const float seen = stored.store.Lookup(point, LightDetail::kSeen).z[1];
    sum_seen += seen;
    sum_of_differences += std::abs(stored.store.Lookup(point, LightDetail::kReflected).z[1] - seen);
  }
  EXPECT_GT(sum_seen, 19.0F);
  EXPECT_LT(sum_of_differences, 0.1F * sum_seen);
  EXPECT_GT(sum_of_differences, 0.0F);
}

TEST(LightStore, SmallFacesHaveTheSameRecordForBoth) {
  // All faces need one record.
  StoredScene stored(Spacing(20.0F));
  for (const ShadingPoint& point : stored.Points(50)) {
    ASSERT_TRUE(IsSame(stored.store.Lookup(point, LightDetail::kSeen),
                       stored.store.Lookup(point, LightDetail::kReflected)));
  }
  EXPECT_TRUE(stored.Missing(stored.Points(50)).empty());
}

TEST(LightStore, RecordsOfSmallCellsNeedFewerRays) {
  // Squares far from each other under a constant sky: their light differs by its noise alone.
  constexpr uint32_t kNumSquares = 100;
  constexpr float kSide_m = 0.5F;
  Scene scene;
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  for (uint32_t i = 0; i < kNumSquares; ++i) {
    scene.meshes.push_back(ParallelogramMesh({50.0F * static_cast<float>(i), 0.0F, 0.0F},
                                             {kSide_m, 0.0F, 0.0F},
                                             {0.0F, kSide_m, 0.0F},
                                             0));
  }
  const GatheredScene lit(scene, ConstantSkyLight(Rgb::Ones()));
  const auto noise_at = [&](float spacing_m, LightDetail detail) {
    LightStore store(lit.surfaces, lit.gatherer, Spacing(spacing_m));
    float sum_of_squares = 0.0F;
    for (uint32_t i = 0; i < kNumSquares; ++i) {
      // A corner, where the light is that of one record.
      ShadingPoint corner = FloorPoint(0.0F, 0.0F);
      corner.triangle_idx += 2 * i;
      const float error = store.Lookup(corner, detail).z[0] - std::numbers::pi_v<float>;
      sum_of_squares += error * error;
    }
    return std::sqrt(sum_of_squares / kNumSquares);
  };
  // Squares of four records; one for all, seen by reflection; for a twelfth and a twentieth of the
  // spacing.
  const float all = noise_at(0.6F, LightDetail::kSeen);
  EXPECT_GT(noise_at(0.6F, LightDetail::kReflected), 1.5F * all);
  const float quarter = noise_at(6.0F, LightDetail::kSeen);
  EXPECT_GT(quarter, 1.5F * all);
  EXPECT_GT(noise_at(10.0F, LightDetail::kSeen), 1.5F * quarter);
}

}  // namespace
}  // namespace pfseq
