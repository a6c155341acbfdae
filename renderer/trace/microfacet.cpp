// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {

Ggx::Ggx(double alpha) : alpha_(std::max(alpha, kMinAlpha)) {}

double Ggx::Density(const Vec3d& half_vector) const {
  // Walter et al. 2007, equation (33), written so that nothing cancels for narrow lobes.
  const Vec2d stretched = half_vector.head<2>() / alpha_;
  const double norm = stretched.squaredNorm() + half_vector.z() * half_vector.z();
  return 1.0 / (std::numbers::pi * alpha_ * alpha_ * norm * norm);
}

double Ggx::Lambda(const Vec3d& direction) const {
  const double squared_cosine = direction.z() * direction.z();
  const double squared_tangent = std::max(0.0, 1.0 - squared_cosine) / squared_cosine;
  return 0.5 * (std::sqrt(1.0 + alpha_ * alpha_ * squared_tangent) - 1.0);
}

Vec3d Ggx::SampleVisibleNormal(const Vec3d& to_viewer, const Vec2d& sample) const {
  // In the space where the lobe is a hemisphere, reflections off the visible half are uniform on a
  // spherical cap.
  const Vec3d viewer =
      Vec3d(alpha_ * to_viewer.x(), alpha_ * to_viewer.y(), to_viewer.z()).normalized();
  const double azimuth_rad = 2.0 * std::numbers::pi * sample.x();
  const double z = (1.0 - sample.y()) * (1.0 + viewer.z()) - viewer.z();
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  const Vec3d half =
      viewer + Vec3d(radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), z);
  return Vec3d(alpha_ * half.x(), alpha_ * half.y(), half.z()).normalized();
}

double SchlickWeight(double cosine) {
  const double complement = std::clamp(1.0 - cosine, 0.0, 1.0);
  const double squared = complement * complement;
  return squared * squared * complement;
}

}  // namespace pfseq
