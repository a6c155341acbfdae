// SPDX-License-Identifier: Apache-2.0
#include "renderer/frame_renderer.h"

#include "renderer/core/units.h"
#include "tests/support/simple_scenes.h"

#include <numbers>
#include <optional>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kSizePx = 64;

/// A large black floor far below, under a constant sky of radiance 2.
class ConstantSkyTest : public testing::Test {
 protected:
  ConstantSkyTest()
      : rays_(SceneOfMesh(Quad({-1, -1, -50}, {1, -1, -50}, {1, 1, -50}, {-1, 1, -50}))),
        textures_(rays_.PlainScene()),
        lighting_(ConstantSky()),
        tracer_(rays_, textures_, lighting_, PathTracerOptions{}),
        lens_(Equidistant{},
              Vec2d::Constant(FocalPx()),
              Vec2d::Constant(0.5 * kSizePx),
              RadFromDeg(90.0)) {}

  static Lighting ConstantSky() {
    LightSpec light;
    light.sun = SunSpec{.strength = 0.0};
    light.sky.model = "constant";
    light.sky.radiance = {2.0, 2.0, 2.0};
    return MakeLighting(light, std::nullopt);
  }

  static double FocalPx() { return Lens::FocalFromCirclePx(Equidistant{}, 48.0, RadFromDeg(90.0)); }

  View MakeView(uint64_t frame, uint64_t view_idx) const {
    return {&lens_, {}, kSizePx, kSizePx, 1, frame, view_idx};
  }

  RayScene rays_;
  TextureSet textures_;
  Lighting lighting_;
  PathTracer tracer_;
  Lens lens_;
};

TEST_F(ConstantSkyTest, IsTheSkyInsideTheCircleBlackOutsideAndCoverageOnItsEdge) {
  const Image<float> image = RenderRadiance(tracer_, MakeView(0, 0), 64, 2, nullptr, {});
  double area_px = 0.0;
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      const double radius_px = (Vec2d(x + 0.5, y + 0.5) - Vec2d::Constant(0.5 * kSizePx)).norm();
      const float value = image.At(x, y, 1);
      if (radius_px < 23.0) {
        ASSERT_FLOAT_EQ(value, 2.0F);
      } else if (radius_px > 25.0) {
        ASSERT_EQ(value, 0.0F);
      }
      area_px += value / 2.0;
    }
  }
  // The area of the circle of 48 px, from the share of samples inside it.
  EXPECT_NEAR(area_px, std::numbers::pi * 24.0 * 24.0, 1.0);
}

/// A street of two walls: its noise tells which random numbers were used.
class NoisyWallsTest : public ConstantSkyTest {
 protected:
  NoisyWallsTest()
      : walls_(BoxScene(Vec3f(-20, -5, -1), Vec3f(20, 5, 30))),
        wall_textures_(walls_.PlainScene()),
        wall_lighting_(DefaultLight()),
        wall_tracer_(walls_, wall_textures_, wall_lighting_, PathTracerOptions{}) {}

  static Lighting DefaultLight() {
    LightSpec light;
    light.sun = SunSpec{};
    return MakeLighting(light, std::nullopt);
  }

  View Outside(uint64_t frame, uint64_t view_idx) const {
    View view = MakeView(frame, view_idx);
    view.world_from_camera.translation_m = Vec3d(30, 0, 5);
    return view;
  }

  RayScene walls_;
  TextureSet wall_textures_;
  Lighting wall_lighting_;
  PathTracer wall_tracer_;
};

TEST_F(NoisyWallsTest, DoesNotDependOnThreads) {
  const Image<float> one = RenderRadiance(wall_tracer_, Outside(3, 1), 4, 1, nullptr, {});
  EXPECT_EQ(RenderRadiance(wall_tracer_, Outside(3, 1), 4, 3, nullptr, {}), one);
}

TEST_F(NoisyWallsTest, FramesAndViewsHaveNoiseOfTheirOwn) {
  const Image<float> image = RenderRadiance(wall_tracer_, Outside(3, 1), 4, 2, nullptr, {});
  EXPECT_NE(RenderRadiance(wall_tracer_, Outside(4, 1), 4, 2, nullptr, {}), image);
  EXPECT_NE(RenderRadiance(wall_tracer_, Outside(3, 2), 4, 2, nullptr, {}), image);
}

TEST_F(NoisyWallsTest, APixelAloneEqualsItsPlaceInTheImage) {
  const View view = Outside(3, 1);
  const Image<float> image = RenderRadiance(wall_tracer_, view, 4, 2, nullptr, {});
  const Rgb pixel = RenderPixel(wall_tracer_, view, 4, 20, 33);
  EXPECT_EQ(pixel[0], image.At(20, 33, 0));
  EXPECT_EQ(pixel[2], image.At(20, 33, 2));
  EXPECT_GT(pixel[1], 0.0F);
}

}  // namespace
}  // namespace pfseq
