// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/rig_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"

#include <array>
#include <cmath>
#include <variant>

#include <yaml-cpp/yaml.h>

namespace pfseq {
namespace {

constexpr const char* kHeader =
    "# Calibration of this sequence. Each camera is rendered with each lens.\n"
    "# Pixels are continuous, with the origin at the image's outer upper-left corner: the first "
    "pixel's centre is at\n"
    "# (0.5, 0.5). Subtract 0.5 from principal_point_px for OpenCV.\n"
    "# Camera frame: x to the right and y down in the image, z along the optical axis.\n"
    "# Rig frame: X forward, Y left, Z up. rotation_xyzw and position_m map camera to rig "
    "coordinates.\n"
    "# r is the distance to the principal point, theta the angle to the optical axis:\n"
    "#   equidistant r = f theta, equisolid r = 2 f sin(theta / 2), stereographic r = 2 f "
    "tan(theta / 2),\n"
    "#   orthographic r = f sin(theta), perspective r = f tan(theta),\n"
    "#   kannala_brandt r = f (theta + k1 theta^3 + k2 theta^5 + k3 theta^7 + k4 theta^9)\n";

std::string LensText(const Named<Lens>& named) {
  const Lens& lens = named.value;
  std::string text = fmt::format("  {}:\n    model: {}\n", named.name, lens.ModelName());
  text += fmt::format("    focal_px: [{}, {}]\n", lens.FocalPx().x(), lens.FocalPx().y());
  text += fmt::format("    principal_point_px: [{}, {}]\n",
                      lens.PrincipalPointPx().x(),
                      lens.PrincipalPointPx().y());
  text += fmt::format(
      "    max_angle_rad: {}  # half of the field of view of {:.6g} degrees; circle of {:.6g} px\n",
      lens.MaxAngleRad(),
      2.0 * DegFromRad(lens.MaxAngleRad()),
      lens.CirclePx());
  if (const auto* model = std::get_if<KannalaBrandt>(&lens.Model())) {
    const std::array<double, 4>& k = model->Coefficients();
    text += fmt::format("    coefficients: [{}, {}, {}, {}]\n", k[0], k[1], k[2], k[3]);
  }
  return text;
}

std::string ChannelText(const std::array<std::array<double, 2>, 3>& polynomials) {
  std::string text =
      "    # Of realistic frames: a channel's mean image height is r + c1 r + c3 r^3 of the height "
      "r "
      "above, in pixels.\n    lateral_color:\n";
  constexpr std::array<const char*, 3> kChannels = {"red", "green", "blue"};
  for (size_t channel = 0; channel < 3; ++channel) {
    text += fmt::format("      {}: [{}, {}]\n",
                        kChannels[channel],
                        polynomials[channel][0],
                        polynomials[channel][1]);
  }
  return text;
}

/// Access to the nodes of a file, with its faults as InputError.
class RigNodes {
 public:
  explicit RigNodes(const std::filesystem::path& path) : path_(path) {
    try {
      root_ = YAML::Load(ReadFile(path));
    } catch (const YAML::Exception& error) {
      throw InputError("{}: expected YAML: {}", path.string(), error.what());
    }
  }

  const YAML::Node& Root() const { return root_; }

  YAML::Node Child(const YAML::Node& parent, const std::string& key) const {
    const YAML::Node child = parent.IsMap() ? parent[key] : YAML::Node();
    if (!child.IsDefined()) {
      throw InputError("{}:{}: {}: missing", path_.string(), parent.Mark().line + 1, key);
    }
    return child;
  }

  double Number(const YAML::Node& parent, const std::string& key) const {
    return ToNumber(Child(parent, key), key);
  }

  template <size_t N>
  std::array<double, N> Numbers(const YAML::Node& parent, const std::string& key) const {
    const YAML::Node node = Child(parent, key);
    if (!node.IsSequence() || node.size() != N) {
      throw InputError(
          "{}:{}: {}: expected {} numbers", path_.string(), node.Mark().line + 1, key, N);
    }
    std::array<double, N> values{};
    for (size_t i = 0; i < N; ++i) {
      values[i] = ToNumber(node[i], key);
    }
    return values;
  }

 private:
  double ToNumber(const YAML::Node& node, const std::string& key) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      throw InputError("{}:{}: {}: expected a number", path_.string(), node.Mark().line + 1, key);
    }
    return value;
  }

  std::filesystem::path path_;
  YAML::Node root_;
};

LensModel ModelFromName(const std::string& name, const RigNodes& nodes, const YAML::Node& node) {
  if (name == KannalaBrandt::kName) {
    return KannalaBrandt(nodes.Numbers<4>(node, "coefficients"));
  }
  const LensModel models[] = {
      Equidistant{}, Equisolid{}, Stereographic{}, Orthographic{}, Perspective{}};
  for (const LensModel& model : models) {
    if (std::visit([](const auto& m) { return std::string(m.kName); }, model) == name) {
      return model;
    }
  }
  throw InputError("rig.yaml: model: unknown lens model '{}'", name);
}

Named<Lens> ReadLens(const RigNodes& nodes, const std::string& name, const YAML::Node& node) {
  const LensModel model =
      ModelFromName(nodes.Child(node, "model").as<std::string>(""), nodes, node);
  const std::array<double, 2> focal_px = nodes.Numbers<2>(node, "focal_px");
  const std::array<double, 2> principal_point_px = nodes.Numbers<2>(node, "principal_point_px");
  return {name,
          Lens(model,
               Vec2d(focal_px[0], focal_px[1]),
               Vec2d(principal_point_px[0], principal_point_px[1]),
               nodes.Number(node, "max_angle_rad"))};
}

RigCamera ReadCamera(const RigNodes& nodes, const std::string& name, const YAML::Node& node) {
  const std::array<double, 3> position_m = nodes.Numbers<3>(node, "position_m");
  const std::array<double, 4> q = nodes.Numbers<4>(node, "rotation_xyzw");
  RigCamera camera{name,
                   {Eigen::Quaterniond(q[3], q[0], q[1], q[2]),
                    Vec3d(position_m[0], position_m[1], position_m[2])}};
  constexpr double kUnitTolerance = 1e-9;
  if (std::abs(camera.rig_from_camera.rotation.norm() - 1.0) > kUnitTolerance) {
    throw InputError("rig.yaml: cameras.{}.rotation_xyzw: expected a unit quaternion", name);
  }
  return camera;
}

}  // namespace

std::string RigFile::ToYaml() const {
  std::string text = kHeader;
  text += fmt::format("image_size_px: [{}, {}]\nmax_distance_m: {}\ncameras:\n",
                      width_px,
                      height_px,
                      max_distance_m);
  for (const RigCamera& camera : cameras) {
    const Vec3d& t = camera.rig_from_camera.translation_m;
    const Eigen::Quaterniond& q = camera.rig_from_camera.rotation;
    text +=
        fmt::format("  {}:\n    position_m: [{}, {}, {}]\n    rotation_xyzw: [{}, {}, {}, {}]\n",
                    camera.name,
                    t.x(),
                    t.y(),
                    t.z(),
                    q.x(),
                    q.y(),
                    q.z(),
                    q.w());
  }
  text += "lenses:\n";
  for (size_t i = 0; i < lenses.size(); ++i) {
    text += LensText(lenses[i]);
    if (i < channel_polynomials.size()) {
      text += ChannelText(channel_polynomials[i]);
    }
  }
  return text;
}

RigFile RigFile::Read(const std::filesystem::path& path) {
  const RigNodes nodes(path);
  RigFile rig;
  const std::array<double, 2> size_px = nodes.Numbers<2>(nodes.Root(), "image_size_px");
  constexpr double kMaxSizePx = 65536.0;
  for (const double side_px : size_px) {
    if (side_px < 1.0 || side_px > kMaxSizePx || side_px != std::floor(side_px)) {
      throw InputError(
          "{}: image_size_px: expected whole numbers from 1 to {}", path.string(), kMaxSizePx);
    }
  }
  rig.width_px = static_cast<int>(size_px[0]);
  rig.height_px = static_cast<int>(size_px[1]);
  rig.max_distance_m = nodes.Number(nodes.Root(), "max_distance_m");
  for (const auto& entry : nodes.Child(nodes.Root(), "cameras")) {
    const auto name = entry.first.as<std::string>();
    rig.cameras.push_back(ReadCamera(nodes, name, entry.second));
  }
  for (const auto& entry : nodes.Child(nodes.Root(), "lenses")) {
    rig.lenses.push_back(ReadLens(nodes, entry.first.as<std::string>(), entry.second));
  }
  if (rig.cameras.empty() || rig.lenses.empty()) {
    throw InputError("{}: expected at least one camera and one lens", path.string());
  }
  return rig;
}

}  // namespace pfseq
