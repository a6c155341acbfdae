// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_sun.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <Eigen/Geometry>

namespace pfseq {
namespace {

tinygltf::Light DirectionalLight(double intensity_lux, const std::vector<double>& color) {
  tinygltf::Light light;
  light.type = "directional";
  light.intensity = intensity_lux;
  light.color = color;
  return light;
}

Eigen::Matrix3d LinearOf(const tinygltf::Node& node) {
  return Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])
      .toRotationMatrix();
}

TEST(GltfSun, StandsOppositeToWhereTheLightShines) {
  // Unturned, a light shines along -Z of glTF, which is +Y of the world: the sun stands at -Y.
  const Sun sun = SunFromLight(DirectionalLight(1000, {}), Eigen::Matrix3d::Identity(), "here");
  EXPECT_EQ(sun.direction_to_sun, Vec3f(0, -1, 0));
  // Turned about X by -90 degrees it shines down: -Y of glTF.
  const Eigen::Matrix3d down =
      Eigen::AngleAxisd(-std::numbers::pi / 2, Vec3d::UnitX()).toRotationMatrix();
  const Sun noon = SunFromLight(DirectionalLight(1000, {}), down, "here");
  EXPECT_NEAR(noon.direction_to_sun.z(), 1.0F, 1e-7F);
}

TEST(GltfSun, IsMeasuredInKilolux) {
  const Sun sun =
      SunFromLight(DirectionalLight(100000, {1.0, 0.5, 0.25}), Eigen::Matrix3d::Identity(), "here");
  EXPECT_TRUE((sun.irradiance == Rgb(100.0F, 50.0F, 25.0F)).all());
}

TEST(GltfSun, NeedsADirection) {
  EXPECT_EQ(MessageOf<InputError>(
                [] { SunFromLight(DirectionalLight(1, {}), Eigen::Matrix3d::Zero(), "here"); }),
            "here: a directional light without a direction");
}

TEST(GltfSun, ComesBackFromTheModelBitForBit) {
  const std::array<Vec3f, 5> directions = {Vec3f(0.3F, -0.4F, 0.7F).normalized(),
                                           Vec3f(0, 0, 1),
                                           Vec3f(0, 1, 0),
                                           Vec3f(0, -1, 0),
                                           Vec3f(-0.2F, 1e-6F, 0.9F).normalized()};
  for (const Vec3f& direction : directions) {
    Sun sun;
    sun.direction_to_sun = direction;
    sun.irradiance = Rgb(97.3F, 0.1F, 81.7F);
    tinygltf::Model model;
    const tinygltf::Node& node = model.nodes[static_cast<size_t>(AddSun(sun, model))];
    ASSERT_EQ(LightOfNode(node), 0);
    const Sun again = SunFromLight(model.lights[0], LinearOf(node), "here");
    EXPECT_EQ(again.direction_to_sun, sun.direction_to_sun);
    EXPECT_TRUE((again.irradiance == sun.irradiance).all());
    // The node alone, without the extras, tells the same to the precision of float.
    model.lights[0].extras = {};
    const Sun plain = SunFromLight(model.lights[0], LinearOf(node), "here");
    EXPECT_LT((plain.direction_to_sun - sun.direction_to_sun).norm(), 1e-7F);
  }
}

TEST(GltfSun, BelievesTheNodeWhenItWasTurnedSince) {
  tinygltf::Model model;
  const int node_idx = AddSun(Sun{}, model);
  EXPECT_EQ(node_idx, 0);
  const Sun turned = SunFromLight(model.lights[0], Eigen::Matrix3d::Identity(), "here");
  EXPECT_EQ(turned.direction_to_sun, Vec3f(0, -1, 0));
}

TEST(GltfSun, WritesColoursOfAtMostOne) {
  Sun sun;
  sun.irradiance = Rgb(50.0F, 100.0F, 25.0F);
  tinygltf::Model model;
  AddSun(sun, model);
  EXPECT_EQ(model.lights[0].intensity, 100000.0);
  EXPECT_EQ(model.lights[0].color, (std::vector<double>{0.5, 1.0, 0.25}));
}

}  // namespace
}  // namespace pfseq
