// SPDX-License-Identifier: Apache-2.0
// The radiance of the sky by direction. World frame, Z up; radiance in kcd/m^2, irradiance in klx
// (per channel of linear Rec. 709, so that the luminance of the colour is the photometric value).
#pragma once

#include "renderer/core/vector.h"
#include "renderer/trace/clear_sky.h"
#include "renderer/trace/dome.h"

#include <memory>

namespace pfseq {

class Clouds;
class SkyMap;

/// Any sky: either the same in all directions or an image of all directions made once, so that
/// looking it up costs the same for all. Copies share the image.
class Sky {
 public:
  /// The same radiance in all directions, below the horizon too.
  static Sky Constant(const Rgb& radiance);

  /// ClearSky above the horizon. Below it the scene's geometry is thought to go on as a Lambertian
  /// ground of albedo 0.2 that the sky lights (not the sun): one radiance.
  static Sky Clear(const Vec3d& direction_to_sun, double turbidity, double strength);

  /// Clouds before this sky; the ground below the horizon follows.
  Sky With(const Clouds& clouds) const;

  /// A map of all directions, times `strength`.
  static Sky FromMap(const SkyMap& map, double strength);

  /// Toward a unit direction of either precision; looked up in single precision.
  template <typename Direction>
  Rgb Radiance(const Eigen::MatrixBase<Direction>& direction) const {
    if (images_ == nullptr) {
      return constant_;
    }
    const Vec3f direction_f = direction.template cast<float>();
    return (direction_f.z() >= 0.0F ? images_->upper : images_->lower).At(direction_f);
  }

  struct DirectionSample {
    Vec3d direction;
    /// By solid angle.
    double pdf;
  };

  /// A direction with a density near proportional to luminance, from two numbers in [0, 1).
  DirectionSample SampleDirection(const Vec2d& sample) const;

  /// SampleDirection's density, by solid angle; above 0 for all directions.
  double Pdf(const Vec3d& direction) const;

  /// Irradiance on a horizontal surface that sees nothing but the sky above the horizon, by
  /// quadrature.
  Rgb HorizontalIrradiance() const { return horizontal_irradiance_; }

  bool IsBlack() const { return is_black_; }

 private:
  struct Images {
    Images(DomeImage upper_image, DomeImage lower_image);

    DomeImage upper;
    /// By the direction mirrored at the horizon.
    DomeImage lower;
    DomeSampler upper_sampler;
    DomeSampler lower_sampler;
    /// Share of samples that go to the upper half.
    double upper_share = 0.5;
  };

  Sky() = default;
  Sky(DomeImage upper, DomeImage lower);

  bool is_black_ = true;
  Rgb constant_ = Rgb::Zero();
  Rgb horizontal_irradiance_ = Rgb::Zero();
  /// Null for a constant sky.
  std::shared_ptr<const Images> images_;
};

}  // namespace pfseq
