// SPDX-License-Identifier: Apache-2.0
// A picture of all directions around (HDR panorama), and the sun in it.
//
// Latitude-longitude, twice as wide as high. The top row is the zenith, the bottom row the nadir;
// the centre column looks toward the world's +X, and as seen from inside +Y is to the left: a
// column at u in [0, 1] has the azimuth pi (1 - 2 u), counter-clockwise from +X seen from above.
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"

#include <filesystem>
#include <optional>

namespace pfseq {

/// A sun that was in a map.
struct MapSun {
  Vec3d direction_to_sun = Vec3d::UnitZ();
  /// On a surface that faces it.
  Rgb irradiance = Rgb::Zero();
};

class SkyMap {
 public:
  /// Radiance of 3 channels, finite and >= 0, width twice the height. `rotation_rad` turns it about
  /// Z, counter-clockwise seen from above. A map finer than the sky's image is made coarser, each
  /// new pixel the mean of whole old ones.
  ///
  /// A sun is looked for above the horizon: where the brightest pixel outshines the median of the
  /// upper half by kSunContrast, the sun is what is connected with it and is within kSunRadiusRad
  /// and over kGlowContrast times as bright as the ring around. It is taken out: the ring's mean
  /// colour stands in its place, the rest of its light is Sun()'s.
  SkyMap(const Image<float>& radiance, double rotation_rad);

  /// From an OpenEXR or HDR file. InputError with the path when it is missing or damaged, is not
  /// twice as wide as high, or has values that are not finite; those below 0 (ringing of a filter)
  /// count as 0.
  static SkyMap Read(const std::filesystem::path& path, double rotation_rad);

  static constexpr float kSunContrast = 100.0F;
  static constexpr float kGlowContrast = 8.0F;
  static constexpr double kSunRadiusRad = 0.0873;  // 5 degrees

  /// Without the sun; toward a unit direction, bilinear.
  Rgb Radiance(const Vec3d& direction) const;

  const std::optional<MapSun>& Sun() const { return sun_; }

 private:
  Vec3d DirectionOf(int column, int row) const;
  double PixelSolidAngle(int row) const;
  void TakeOutSun();

  Image<float> radiance_;
  double rotation_rad_;
  std::optional<MapSun> sun_;
};

}  // namespace pfseq
