// SPDX-License-Identifier: Apache-2.0
#include "renderer/cached_frame_renderer.h"

#include "tests/renderer/two_boxes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = TwoBoxesStage::kSizePx;

Image<float> Render(const TwoBoxesStage& stage,
                    const CachedLight& light,
                    const PixelSampling& sampling,
                    int num_threads = 2) {
  return RenderCachedRadiance(
      light.Tracer(), stage.Raster(), stage.MakeView(), sampling, num_threads, nullptr, {});
}

TEST(RenderCachedRadiance, AgreesWithThePathTracerToTwoPercent) {
  const TwoBoxesStage stage;
  const auto light = stage.MakeCachedLight();
  const Image<float> cached = Render(stage, *light, PixelSampling{.num_samples = 16});
  const RenderSpec spec = CoarseLightSpec();
  const PathTracer tracer(stage.Rays(), stage.Textures(), stage.Light(), {spec.max_bounces, 0.3F});
  const Image<float> reference = RenderRadiance(tracer, stage.MakeView(), 64, 2, nullptr, {});
  // Blocks of 6 x 6 pixels, to be rid of the reference's noise.
  constexpr int kBlockPx = 6;
  double sum = 0.0;
  double sum_of_errors = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    for (int y = 0; y < kSizePx; y += kBlockPx) {
      for (int x = 0; x < kSizePx; x += kBlockPx) {
        double error = 0.0;
        double block = 0.0;
        for (int i = 0; i < kBlockPx * kBlockPx; ++i) {
          const int px = x + i % kBlockPx;
          const int py = y + i / kBlockPx;
          error += cached.At(px, py, channel) - reference.At(px, py, channel);
          block += reference.At(px, py, channel);
        }
        sum += block;
        sum_of_errors += std::abs(error);
        EXPECT_LT(std::abs(error), 0.06 * block + 0.05) << x << "," << y;
      }
    }
  }
  EXPECT_GT(sum, 1000.0);
  EXPECT_LT(sum_of_errors, 0.02 * sum);
}

TEST(RenderCachedRadiance, TexturesLieWhereThePathTracerHasThem) {
  // A glowing floor, red growing to the east and green to the south: a shift shows as a difference.
  constexpr int kTexels = 64;
  Texture ramp;
  ramp.is_srgb = false;
  ramp.texels = Image<uint8_t>(kTexels, kTexels, 4, 255);
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      ramp.texels.At(x, y, 0) = static_cast<uint8_t>(4 * x);
      ramp.texels.At(x, y, 1) = static_cast<uint8_t>(4 * y);
    }
  }
  Scene scene;
  scene.textures = {ramp};
  scene.materials = {LambertianMaterial(Rgb::Zero())};
  scene.materials[0].emission = Rgb::Ones();
  scene.materials[0].emission_texture_idx = 0;
  Mesh floor;
  floor.positions_m = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
  floor.texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {floor};
  const TwoBoxesStage stage(scene, ConstantSkyLight(Rgb::Zero()));
  const auto light = stage.MakeCachedLight();
  const Image<float> cached =
      Render(stage, *light, PixelSampling{.num_samples = 8, .max_samples = 8});
  const PathTracer tracer(stage.Rays(), stage.Textures(), stage.Light(), {});
  const Image<float> reference = RenderRadiance(tracer, stage.MakeView(), 64, 2, nullptr, {});
  Eigen::Array2d error = Eigen::Array2d::Zero();
  Eigen::Array2d per_pixel = Eigen::Array2d::Zero();
  for (int y = kSizePx / 2 - 6; y < kSizePx / 2 + 6; ++y) {
    for (int x = kSizePx / 2 - 6; x < kSizePx / 2 + 6; ++x) {
      error += Eigen::Array2d(cached.At(x, y, 0) - reference.At(x, y, 0),
                              cached.At(x, y, 1) - reference.At(x, y, 1));
      per_pixel += Eigen::Array2d(reference.At(x + 1, y, 0) - reference.At(x, y, 0),
                                  reference.At(x, y + 1, 1) - reference.At(x, y, 1));
    }
  }
  ASSERT_GT(per_pixel.abs().minCoeff(), 1.0);
  // In pixels.
  EXPECT_LT((error / per_pixel).abs().maxCoeff(), 0.02);
}

TEST(RenderCachedRadiance, DoesNotDependOnThreadsNorOnWhatWasComputedBefore) {
  const TwoBoxesStage stage;
  const PixelSampling sampling{.num_samples = 4, .max_samples = 16};
  const Image<float> one = Render(stage, *stage.MakeCachedLight(), sampling, 1);
  EXPECT_EQ(Render(stage, *stage.MakeCachedLight(), sampling, 3), one);
  const auto prepared = stage.MakeCachedLight();
  prepared->Prepare({{&stage.Raster(), stage.MakeView(5, Vec3d(1.0, -0.5, 3.0))},
                     {&stage.Raster(), stage.MakeView()}},
                    sampling,
                    2,
                    true);
  EXPECT_EQ(Render(stage, *prepared, sampling, 2), one);
  // Little memory: most records are computed again and again.
  LightCacheOptions little;
  little.max_memory_bytes = 100000;
  const PixelSampling few{.num_samples = 1, .max_samples = 1};
  EXPECT_EQ(Render(stage, *stage.MakeCachedLight(little), few, 2),
            Render(stage, *prepared, few, 2));
}

TEST(RenderCachedRadiance, FramesHaveRandomNumbersOfTheirOwn) {
  const TwoBoxesStage stage;
  const auto light = stage.MakeCachedLight();
  const PixelSampling sampling{.num_samples = 2, .max_samples = 2};
  const Image<float> first = Render(stage, *light, sampling);
  EXPECT_NE(RenderCachedRadiance(
                light->Tracer(), stage.Raster(), stage.MakeView(1), sampling, 2, nullptr, {}),
            first);
}

TEST(RenderCachedRadiance, IsTheSkyInsideTheCircleBlackOutsideAndCoverageOnItsEdge) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {FloorMesh(0.01F, 0)};
  const TwoBoxesStage stage(scene, ConstantSkyLight(Rgb::Constant(2.0F)));
  const auto light = stage.MakeCachedLight();
  const Image<float> image =
      Render(stage, *light, PixelSampling{.num_samples = 64, .max_samples = 64});
  double area_px = 0.0;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const double radius_px = (Vec2d(x + 0.5, y + 0.5) - Vec2d::Constant(0.5 * kSizePx)).norm();
      const float value = image.At(x, y, 1);
      if (radius_px < 22.0 && radius_px > 3.0) {
        ASSERT_FLOAT_EQ(value, 2.0F);
      } else if (radius_px > 24.0) {
        ASSERT_EQ(value, 0.0F);
      }
      area_px += value / 2.0;
    }
  }
  EXPECT_NEAR(area_px, std::numbers::pi * 23.0 * 23.0, 1.0);
}

TEST(RenderCachedRadiance, MoreSamplesGoToEdgesAlone) {
  // No sun: shadows have no edges.
  const TwoBoxesStage stage(TwoBoxes(), ConstantSkyLight(Rgb::Ones()));
  const auto light = stage.MakeCachedLight();
  const Image<float> first =
      Render(stage, *light, PixelSampling{.num_samples = 8, .max_samples = 8});
  const Image<float> more =
      Render(stage, *light, PixelSampling{.num_samples = 8, .max_samples = 64});
  const Image<float> most =
      Render(stage, *light, PixelSampling{.num_samples = 64, .max_samples = 64});
  const View view = stage.MakeView();
  // Mesh at each pixel's corner, -1 for the sky, -2 outside the circle.
  Image<int> seen(kSizePx + 1, kSizePx + 1, 1);
  for (int y = 0; y <= kSizePx; ++y) {
    for (int x = 0; x <= kSizePx; ++x) {
      const std::optional<Vec3d> direction = stage.OwnLens().Unproject(Vec2d(x, y));
      if (!direction.has_value()) {
        seen.At(x, y) = -2;
        continue;
      }
      const auto hit = stage.Rays().Intersect(view.world_from_camera.translation_m,
                                              Vec3d(view.world_from_camera.Direction(*direction)));
      seen.At(x, y) = hit.has_value() ? static_cast<int>(hit->mesh_idx) : -1;
    }
  }
  int num_flat = 0;
  int num_edge = 0;
  int num_changed = 0;
  for (int y = 2; y + 2 < kSizePx; ++y) {
    for (int x = 2; x + 2 < kSizePx; ++x) {
      std::set<int> own;
      std::set<int> near;
      for (int j = -2; j <= 3; ++j) {
        for (int i = -2; i <= 3; ++i) {
          near.insert(seen.At(x + i, y + j));
          if (i >= 0 && i <= 1 && j >= 0 && j <= 1) {
            own.insert(seen.At(x + i, y + j));
          }
        }
      }
      if (near.size() == 1) {
        ++num_flat;
        ASSERT_EQ(more.At(x, y, 1), first.At(x, y, 1)) << x << "," << y;
      } else if (own.size() > 1 && own.count(-1) == 1 && own.count(-2) == 0) {
        // The floor's edge before the bright sky.
        ++num_edge;
        num_changed += more.At(x, y, 1) != first.At(x, y, 1) ? 1 : 0;
        // Sixty-four samples where they are needed are those that all pixels would have got.
        EXPECT_NEAR(more.At(x, y, 1), most.At(x, y, 1), 0.1F);
      }
    }
  }
  EXPECT_GT(num_flat, 400);
  EXPECT_GT(num_edge, 30);
  // But where an edge cuts off so little that a few more samples miss it.
  EXPECT_GE(num_changed, num_edge * 17 / 20);
}

TEST(RenderCachedRadiance, NeighboursOfEdgesGetMoreSamplesToo) {
  // The middle of the image, where there is no sky of equal samples.
  const TwoBoxesStage stage;
  const auto light = stage.MakeCachedLight();
  const Image<float> first =
      Render(stage, *light, PixelSampling{.num_samples = 4, .max_samples = 4});
  const Image<float> more =
      Render(stage, *light, PixelSampling{.num_samples = 4, .max_samples = 32, .tolerance = 0.05F});
  int num_changed = 0;
  int num_alone = 0;
  for (int y = 12; y < kSizePx - 12; ++y) {
    for (int x = 12; x < kSizePx - 12; ++x) {
      if (more.At(x, y, 1) == first.At(x, y, 1)) {
        continue;
      }
      ++num_changed;
      int num_changed_around = 0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          num_changed_around += more.At(x + i, y + j, 1) != first.At(x + i, y + j, 1) ? 1 : 0;
        }
      }
      num_alone += num_changed_around < 4 ? 1 : 0;
    }
  }
  EXPECT_GT(num_changed, 100);
  EXPECT_EQ(num_alone, 0);
}

TEST(WantedRecords, ArePerViewAndOnlyOnce) {
  const TwoBoxesStage stage;
  const auto light = stage.MakeCachedLight();
  const size_t num_first =
      WantedRecords(light->Tracer(), stage.Raster(), stage.MakeView(), PixelSampling(), 2).size();
  EXPECT_GT(num_first, 500U);
  EXPECT_TRUE(
      WantedRecords(light->Tracer(), stage.Raster(), stage.MakeView(), PixelSampling(), 1).empty());
  const View other = stage.MakeView(1, Vec3d(2.0, 1.0, 3.0));
  EXPECT_GT(WantedRecords(light->Tracer(), stage.Raster(), other, PixelSampling(), 2).size(), 50U);
}

}  // namespace
}  // namespace pfseq
