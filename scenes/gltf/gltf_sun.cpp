// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_sun.h"

#include "renderer/core/error.h"
#include "scenes/gltf/gltf_axes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace pfseq {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";
constexpr double kLuxPerKilolux = 1000.0;

/// In the light's extras: the exact direction to the sun, in the axes of glTF. A rotation alone
/// cannot hold it, as a float vector is a unit vector only to its last bit.
constexpr const char* kDirectionExtra = "pfseq_direction_to_sun";

/// The extras are believed when they agree with the node to float's precision.
constexpr double kDirectionTolerance = 1e-6;

tinygltf::Value NumbersValue(const Vec3d& numbers) {
  return tinygltf::Value(tinygltf::Value::Array{
      tinygltf::Value(numbers.x()), tinygltf::Value(numbers.y()), tinygltf::Value(numbers.z())});
}

}  // namespace

int LightOfNode(const tinygltf::Node& node) {
  const auto found = node.extensions.find(kExtension);
  return found != node.extensions.end() ? found->second.Get("light").GetNumberAsInt() : -1;
}

Sun SunFromLight(const tinygltf::Light& light,
                 const Eigen::Matrix3d& linear_gltf,
                 const std::string& where) {
  const Vec3d axis = linear_gltf.col(2);
  const double length = axis.norm();
  if (!std::isfinite(length) || length == 0.0) {
    throw InputError("{}: a directional light without a direction", where);
  }
  Vec3d direction_gltf = axis / length;
  const tinygltf::Value exact =
      light.extras.Has(kDirectionExtra) ? light.extras.Get(kDirectionExtra) : tinygltf::Value();
  if (exact.ArrayLen() == 3) {
    const Vec3d direction(exact.Get(0).GetNumberAsDouble(),
                          exact.Get(1).GetNumberAsDouble(),
                          exact.Get(2).GetNumberAsDouble());
    if ((direction - direction_gltf).norm() < kDirectionTolerance) {
      direction_gltf = direction;
    }
  }
  Sun sun;
  sun.direction_to_sun = WorldFromGltf<float>(direction_gltf.cast<float>());
  const double strength_klx = light.intensity / kLuxPerKilolux;
  for (size_t k = 0; k < 3; ++k) {
    sun.irradiance[static_cast<int>(k)] =
        static_cast<float>(strength_klx * (light.color.empty() ? 1.0 : light.color[k]));
  }
  return sun;
}

int AddSun(const Sun& sun, tinygltf::Model& model) {
  const Vec3d direction_gltf = GltfFromWorld<float>(sun.direction_to_sun).cast<double>();
  const double strength_klx = sun.irradiance.maxCoeff();
  tinygltf::Light light;
  light.name = "sun";
  light.type = "directional";
  light.intensity = strength_klx * kLuxPerKilolux;
  for (int k = 0; k < 3; ++k) {
    light.color.push_back(strength_klx > 0.0 ? static_cast<double>(sun.irradiance[k]) / strength_klx
                                             : 1.0);
  }
  light.extras =
      tinygltf::Value(tinygltf::Value::Object{{kDirectionExtra, NumbersValue(direction_gltf)}});

  const auto rotation =
      Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), direction_gltf.normalized());
  tinygltf::Node node;
  node.name = "sun";
  node.rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
  node.extensions[kExtension] = tinygltf::Value(
      tinygltf::Value::Object{{"light", tinygltf::Value(static_cast<int>(model.lights.size()))}});
  model.lights.push_back(light);
  model.nodes.push_back(node);
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace pfseq
