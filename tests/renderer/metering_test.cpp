// SPDX-License-Identifier: Apache-2.0
#include "renderer/metering.h"

#include "tests/support/simple_scenes.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

SequenceSpec SmallSpec() {
  SequenceSpec spec;
  spec.image.size_px = {300, 300};
  spec.lenses = {{"a", LensSpec{.model = "equidistant", .circle_px = 300.0}}};
  spec.cameras = {{"front", {}}};
  return spec;
}

/// Far below the camera: all that it sees is sky.
std::shared_ptr<const Scene> NothingInSight() {
  return BoxScene(Vec3f(-1, -1, -1000), Vec3f(1, 1, -999));
}

double Metered(const SequenceSpec& spec, float sky, int num_threads = 2) {
  const Lighting lighting{std::nullopt, Sky::Constant(Rgb::Constant(sky))};
  return MeteredExposure(spec, NothingInSight(), lighting, num_threads);
}

TEST(MeteredExposure, MakesAnEvenSkyMiddleGrey) {
  EXPECT_DOUBLE_EQ(Metered(SmallSpec(), 2.0F), 0.09);
  EXPECT_DOUBLE_EQ(Metered(SmallSpec(), 0.5F), 0.36);
  EXPECT_DOUBLE_EQ(Metered(SmallSpec(), 0.0F), 0.06) << "black";
}

TEST(MeteredExposure, IsTheSameForAnySizeAndThreads) {
  const std::shared_ptr<const Scene> roof = BoxScene(Vec3f(-4, -4, 3), Vec3f(4, 4, 4));
  const Lighting lighting{std::nullopt, Sky::Constant(Rgb(3.0F, 2.0F, 1.0F))};
  SequenceSpec spec = SmallSpec();
  const double exposure = MeteredExposure(spec, roof, lighting, 1);
  EXPECT_EQ(MeteredExposure(spec, roof, lighting, 3), exposure);
  spec.image.size_px = {600, 600};
  spec.lenses.front().value.circle_px = 600.0;
  EXPECT_EQ(MeteredExposure(spec, roof, lighting, 2), exposure);
  spec.render.samples = 1;
  EXPECT_EQ(MeteredExposure(spec, roof, lighting, 2), exposure);
}

TEST(MeteredExposure, LooksThroughTheFirstCamera) {
  // The roof of a low box darkens what the camera under it sees.
  const std::shared_ptr<const Scene> roof = BoxScene(Vec3f(-4, -4, 3), Vec3f(4, 4, 4));
  const Lighting lighting{std::nullopt, Sky::Constant(Rgb::Constant(1.0F))};
  SequenceSpec spec = SmallSpec();
  const double under = MeteredExposure(spec, roof, lighting, 2);
  EXPECT_GT(under, 0.2);
  spec.cameras.front().value.position_m = {100.0, 0.0, 0.0};
  EXPECT_NEAR(MeteredExposure(spec, roof, lighting, 2), 0.18, 0.01);
}

}  // namespace
}  // namespace pfseq
