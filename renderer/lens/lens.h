// SPDX-License-Identifier: Apache-2.0
// A central, radially symmetric lens: directions in the camera frame to pixels and back.
#pragma once

#include "renderer/core/vector.h"
#include "renderer/lens/equidistant.h"
#include "renderer/lens/equisolid.h"
#include "renderer/lens/kannala_brandt.h"
#include "renderer/lens/orthographic.h"
#include "renderer/lens/perspective.h"
#include "renderer/lens/stereographic.h"

#include <optional>
#include <string>
#include <variant>

namespace pfseq {

/// How the incidence angle theta maps to the image height of a lens of unit focal length. Each
/// model has
///   static constexpr const char* kName
///   static constexpr bool kReachesLimit           whether the limit angle has a finite image
///   height double ImageHeight(double theta_rad) const    for theta in [0, LimitAngleRad()) double
///   IncidenceAngleRad(double height) const the inverse; NaN or infinity for heights that are not
///   reached double LimitAngleRad() const                  the model is one-to-one below this angle
using LensModel =
    std::variant<Equidistant, Equisolid, Stereographic, Orthographic, Perspective, KannalaBrandt>;

/// Whether the model can have this half field of view: in (0, limit), or at the limit where that
/// has a finite height.
bool LensModelCovers(const LensModel& model, double max_angle_rad);

/// "> 0 and < 180 degrees for perspective": the full fields of view that a model covers, for
/// messages.
std::string LensModelFieldText(const LensModel& model);

/// Pixels: continuous, origin at the image's outer upper-left corner. Camera frame: x to the right,
/// y down in the image, z along the optical axis. Never divides by z: angles of 90 degrees and more
/// are ordinary.
class Lens {
 public:
  /// max_angle_rad is half the field of view, one that the model covers. focal_px along x and y, >
  /// 0. InputError otherwise.
  Lens(LensModel model, Vec2d focal_px, Vec2d principal_point_px, double max_angle_rad);

  /// The focal length that gives an image circle of this diameter to this half field of view.
  static double FocalFromCirclePx(const LensModel& model, double circle_px, double max_angle_rad);

  /// The pixel of a direction (any length > 0); nothing beyond the field of view, and nothing for
  /// -z, which no single pixel shows.
  std::optional<Vec2d> Project(const Vec3d& direction_camera) const;

  /// The unit direction of a pixel; nothing where its incidence angle exceeds MaxAngleRad().
  std::optional<Vec3d> Unproject(const Vec2d& pixel_px) const;

  /// Angle to the optical axis, in [0, pi], exact near 0 and pi.
  static double IncidenceAngleRad(const Vec3d& direction_camera);

  double MaxAngleRad() const { return max_angle_rad_; }
  /// Diameter along x of the circle that MaxAngleRad maps to.
  double CirclePx() const;
  const Vec2d& FocalPx() const { return focal_px_; }
  const Vec2d& PrincipalPointPx() const { return principal_point_px_; }
  const LensModel& Model() const { return model_; }
  std::string ModelName() const;

 private:
  LensModel model_;
  Vec2d focal_px_;
  Vec2d principal_point_px_;
  double max_angle_rad_;
};

}  // namespace pfseq
