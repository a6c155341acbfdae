// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/lens.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <cmath>

namespace pfseq {
namespace {

void CheckLens(const LensModel& model,
               const Vec2d& focal_px,
               const Vec2d& principal_point_px,
               double max_angle_rad) {
  if (!LensModelCovers(model, max_angle_rad)) {
    throw InputError("field of view: expected {}, got {}",
                     LensModelFieldText(model),
                     2.0 * DegFromRad(max_angle_rad));
  }
  if (!focal_px.allFinite() || !(focal_px.minCoeff() > 0.0)) {
    throw InputError("focal length: expected pixels > 0, got ({}, {})", focal_px.x(), focal_px.y());
  }
  if (!principal_point_px.allFinite()) {
    throw InputError("principal point: expected finite pixels, got ({}, {})",
                     principal_point_px.x(),
                     principal_point_px.y());
  }
}

}  // namespace

bool LensModelCovers(const LensModel& model, double max_angle_rad) {
  return std::visit(
      [&](const auto& m) {
        const double limit_rad = m.LimitAngleRad();
        return max_angle_rad > 0.0 &&
               (m.kReachesLimit ? max_angle_rad <= limit_rad : max_angle_rad < limit_rad);
      },
      model);
}

std::string LensModelFieldText(const LensModel& model) {
  return std::visit(
      [](const auto& m) {
        return fmt::format("> 0 and {} {:.10g} degrees for {}",
                           m.kReachesLimit ? "<=" : "<",
                           2.0 * DegFromRad(m.LimitAngleRad()),
                           m.kName);
      },
      model);
}

Lens::Lens(LensModel model, Vec2d focal_px, Vec2d principal_point_px, double max_angle_rad)
    : model_(std::move(model)),
      focal_px_(std::move(focal_px)),
      principal_point_px_(std::move(principal_point_px)),
      max_angle_rad_(max_angle_rad) {
  CheckLens(model_, focal_px_, principal_point_px_, max_angle_rad_);
}

double Lens::FocalFromCirclePx(const LensModel& model, double circle_px, double max_angle_rad) {
  const double height =
      std::visit([&](const auto& m) { return m.ImageHeight(max_angle_rad); }, model);
  return 0.5 * circle_px / height;
}

double Lens::IncidenceAngleRad(const Vec3d& direction_camera) {
  return std::atan2(std::hypot(direction_camera.x(), direction_camera.y()), direction_camera.z());
}

std::optional<Vec2d> Lens::Project(const Vec3d& direction_camera) const {
  const double sideways = std::hypot(direction_camera.x(), direction_camera.y());
  const double theta_rad = std::atan2(sideways, direction_camera.z());
  if (!(theta_rad <= max_angle_rad_)) {
    return std::nullopt;
  }
  if (sideways == 0.0) {
    // Straight ahead is a point; straight behind would be the whole rim of a 360 degree lens.
    return direction_camera.z() > 0.0 ? std::optional<Vec2d>(principal_point_px_) : std::nullopt;
  }
  const double height = std::visit([&](const auto& m) { return m.ImageHeight(theta_rad); }, model_);
  return Vec2d(
      principal_point_px_.x() + focal_px_.x() * height * (direction_camera.x() / sideways),
      principal_point_px_.y() + focal_px_.y() * height * (direction_camera.y() / sideways));
}

std::optional<Vec3d> Lens::Unproject(const Vec2d& pixel_px) const {
  const double x = (pixel_px.x() - principal_point_px_.x()) / focal_px_.x();
  const double y = (pixel_px.y() - principal_point_px_.y()) / focal_px_.y();
  const double height = std::hypot(x, y);
  if (height == 0.0) {
    return Vec3d(0.0, 0.0, 1.0);
  }
  const double theta_rad =
      std::visit([&](const auto& m) { return m.IncidenceAngleRad(height); }, model_);
  // Heights that the model cannot reach have no angle (NaN) or an infinite one.
  if (!(theta_rad <= max_angle_rad_)) {
    return std::nullopt;
  }
  const double sideways = std::sin(theta_rad);
  return Vec3d(sideways * (x / height), sideways * (y / height), std::cos(theta_rad));
}

double Lens::CirclePx() const {
  return 2.0 * focal_px_.x() *
         std::visit([&](const auto& m) { return m.ImageHeight(max_angle_rad_); }, model_);
}

std::string Lens::ModelName() const {
  return std::visit([](const auto& m) { return std::string(m.kName); }, model_);
}

}  // namespace pfseq
