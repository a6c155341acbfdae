// SPDX-License-Identifier: Apache-2.0
// Distance maps against closed forms: every pixel within the image circle, both lenses of the
// default sequence, front camera and rotated rear camera.
#include "renderer/ground_truth.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/lens/camera_rig.h"
#include "renderer/lens/trajectory.h"
#include "tests/support/simple_scenes.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 301;
constexpr double kTolerance = 1e-5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Viewer {
  std::string name;
  Lens lens;
  RigidTransform world_from_camera;
};

Lens MakeLens(const LensModel& model, double circle_px) {
  const double max_angle_rad = RadFromDeg(0.5 * 181.8);
  const double focal_px = Lens::FocalFromCirclePx(model, circle_px, max_angle_rad);
  return {model, Vec2d(focal_px, focal_px), Vec2d(0.5 * kSizePx, 0.5 * kSizePx), max_angle_rad};
}

std::vector<Viewer> Viewers() {
  const RigidTransform world_from_rig = PoseFromYaw(Vec3d(3.0, -2.0, 1.6), RadFromDeg(33.0));
  const RigidTransform rig_from_rear{
      RotationFromXzy({RadFromDeg(-8.0), RadFromDeg(6.0), RadFromDeg(-7.0)}),
      Vec3d(-2.0, 0.0, 0.0)};
  std::vector<Viewer> viewers;
  for (const auto& [model, circle_px] : {std::pair<LensModel, double>(Equidistant{}, 301.0),
                                         std::pair<LensModel, double>(Equisolid{}, 281.9)}) {
    const Lens lens = MakeLens(model, circle_px);
    viewers.push_back({lens.ModelName() + " front", lens, world_from_rig});
    viewers.push_back({lens.ModelName() + " rear", lens, world_from_rig * rig_from_rear});
  }
  return viewers;
}

/// Compares each pixel with the closed form of the distance along a ray (origin, unit direction,
/// world frame).
void ExpectClosedForm(std::shared_ptr<const Scene> scene,
                      const std::function<double(const Vec3d&, const Vec3d&)>& expected_m) {
  const RayScene rays(std::move(scene));
  for (const Viewer& viewer : Viewers()) {
    const LensRaster raster(viewer.lens, kSizePx, kSizePx, 2);
    const GroundTruth truth = RenderGroundTruth(rays, raster, viewer.world_from_camera, 500.0, 2);
    int num_inside = 0;
    double worst = 0.0;
    for (int y = 0; y < kSizePx; ++y) {
      for (int x = 0; x < kSizePx; ++x) {
        const auto direction = viewer.lens.Unproject(Vec2d(x + 0.5, y + 0.5));
        if (!direction.has_value()) {
          ASSERT_EQ(truth.distance_m.At(x, y), 0.0F);
          ASSERT_EQ(truth.sky.At(x, y), 0);
          continue;
        }
        ++num_inside;
        const double distance_m = expected_m(viewer.world_from_camera.translation_m,
                                             viewer.world_from_camera.Direction(*direction));
        const double mapped_m = truth.distance_m.At(x, y);
        ASSERT_EQ(std::isinf(mapped_m), distance_m > 500.0) << viewer.name << " " << x << "," << y;
        ASSERT_EQ(truth.sky.At(x, y), std::isinf(distance_m) ? 255 : 0);
        if (!std::isinf(mapped_m)) {
          worst = std::max(worst, std::abs(mapped_m - distance_m) / distance_m);
        }
      }
    }
    EXPECT_GT(num_inside, 60000) << viewer.name;
    EXPECT_LE(worst, kTolerance) << viewer.name;
    testing::Test::RecordProperty("worst relative error " + viewer.name,
                                  fmt::format("{:.2e}", worst));
  }
}

TEST(GroundTruth, PlaneOverheadMatchesTheClosedFormAndEndsAt500Metres) {
  // A ceiling at z = 12.5, 20 km wide: rays near the horizon meet it beyond 500 m, those below it
  // never.
  constexpr float kHalf = 10000.0F;
  const Mesh ceiling = Quad({-kHalf, -kHalf, 12.5F},
                            {-kHalf, kHalf, 12.5F},
                            {kHalf, kHalf, 12.5F},
                            {kHalf, -kHalf, 12.5F});
  ExpectClosedForm(SceneOfMesh(ceiling), [](const Vec3d& origin_m, const Vec3d& direction) {
    const double distance_m = (12.5 - origin_m.z()) / direction.z();
    const Vec3d point_m = origin_m + distance_m * direction;
    const bool meets =
        direction.z() > 0.0 && std::abs(point_m.x()) < kHalf && std::abs(point_m.y()) < kHalf;
    return meets ? distance_m : kInfinity;
  });
}

TEST(GroundTruth, BoxMatchesTheClosedForm) {
  const Vec3f low_m(-7.25F, -9.5F, -0.1F);
  const Vec3f high_m(120.0F, 6.3F, 31.0F);
  ExpectClosedForm(BoxScene(low_m, high_m), [&](const Vec3d& origin_m, const Vec3d& direction) {
    double nearest_m = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0.0) {
        continue;
      }
      const double wall_m = direction[axis] > 0.0 ? high_m[axis] : low_m[axis];
      nearest_m = std::min(nearest_m, (wall_m - origin_m[axis]) / direction[axis]);
    }
    return nearest_m;
  });
}

TEST(GroundTruth, SphereMatchesTheClosedForm) {
  // 1000 rings: the chords are short of the sphere by at most (1 - cos(pi / 1000)) = 4.9e-6 of the
  // radius.
  const Vec3f center_m(2.0F, -3.0F, 4.0F);
  constexpr double kRadiusM = 20.0;
  ExpectClosedForm(
      SphereScene(center_m, kRadiusM, 1000), [&](const Vec3d& origin_m, const Vec3d& direction) {
        const Vec3d to_center_m = center_m.cast<double>() - origin_m;
        const double along_m = to_center_m.dot(direction);
        return along_m +
               std::sqrt(kRadiusM * kRadiusM - to_center_m.squaredNorm() + along_m * along_m);
      });
}

TEST(GroundTruth, DoesNotDependOnThreads) {
  const RayScene rays(BoxScene(Vec3f(-7, -9, -1), Vec3f(12, 6, 31)));
  const Viewer viewer = Viewers().back();
  const LensRaster raster(viewer.lens, 99, 99, 1);
  const GroundTruth one = RenderGroundTruth(rays, raster, viewer.world_from_camera, 500.0, 1);
  const GroundTruth three = RenderGroundTruth(rays, raster, viewer.world_from_camera, 500.0, 3);
  EXPECT_EQ(one.distance_m, three.distance_m);
  EXPECT_EQ(one.sky, three.sky);
}

}  // namespace
}  // namespace pfseq
