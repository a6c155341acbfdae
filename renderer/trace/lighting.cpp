// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/lighting.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/trace/clouds.h"
#include "renderer/trace/color.h"
#include "renderer/trace/material.h"
#include "renderer/trace/sky_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Illuminance by the sun above the atmosphere, at the mean distance.
constexpr double kSolarIlluminanceKlx = 133.0;
constexpr double kSolarTemperatureK = 5778.0;
/// Depth of the ozone layer at standard temperature and pressure.
constexpr double kOzoneCm = 0.35;

constexpr double kFirstWavelengthNm = 380.0;
constexpr double kWavelengthStepNm = 20.0;
/// Ozone's absorption coefficient per cm at 380, 400, ... 780 nm: Leckner 1978, "The spectral
/// distribution of solar radiation at the earth's surface - elements of a model", table 2 (also
/// Iqbal 1983, table 6.13.1).
constexpr std::array<double, 21> kOzonePerCm = {0.0,   0.0,   0.0,   0.003, 0.006, 0.014, 0.030,
                                                0.048, 0.075, 0.103, 0.120, 0.125, 0.105, 0.079,
                                                0.057, 0.036, 0.023, 0.014, 0.010, 0.007, 0.0};

/// CIE 1931 colour matching functions: Wyman, Sloan and Shirley 2013, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions" (JCGT 2(2)), equation (4).
Vec3d MatchingFunctions(double wavelength_nm) {
  const auto lobe = [wavelength_nm](double center_nm, double below_nm, double above_nm) {
    const double offset = wavelength_nm - center_nm;
    const double t = offset / (offset < 0.0 ? below_nm : above_nm);
    return std::exp(-0.5 * t * t);
  };
  return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) -
              0.065 * lobe(501.1, 20.4, 26.2),
          0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
          1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

/// Planck's law, relative.
double BlackBody(double wavelength_nm, double temperature_k) {
  constexpr double kSecondRadiationConstantNmK = 1.438776877e7;
  return std::pow(wavelength_nm / 550.0, -5.0) /
         std::expm1(kSecondRadiationConstantNmK / (wavelength_nm * temperature_k));
}

/// Share of sunlight that reaches the ground straight (Preetham et al. 1999, appendix A.1).
double Transmittance(size_t wavelength_idx, double turbidity, double optical_mass) {
  const double wavelength_um =
      1e-3 * (kFirstWavelengthNm + kWavelengthStepNm * static_cast<double>(wavelength_idx));
  const double rayleigh = 0.008735 * std::pow(wavelength_um, -4.08);
  const double haze = (0.04608 * turbidity - 0.04586) * std::pow(wavelength_um, -1.3);
  const double ozone = kOzonePerCm[wavelength_idx] * kOzoneCm;
  return std::exp(-(rayleigh + haze + ozone) * optical_mass);
}

/// Air passed through relative to the zenith's (Kasten 1966, as quoted there).
double OpticalMass(double elevation_rad) {
  const double zenith_deg = 90.0 - DegFromRad(elevation_rad);
  return 1.0 / (std::sin(elevation_rad) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
}

}  // namespace

SunDisc::SunDisc(const Vec3d& direction_to_sun, const Rgb& irradiance, double angular_diameter_rad)
    : direction_(direction_to_sun.normalized()), irradiance_(irradiance) {
  PFSEQ_CHECK(angular_diameter_rad > 0.0 && angular_diameter_rad < std::numbers::pi,
              "{} rad",
              angular_diameter_rad);
  const double sin_half = std::sin(0.25 * angular_diameter_rad);
  cap_height_ = 2.0 * sin_half * sin_half;
  cos_radius_ = 1.0 - cap_height_;
  pdf_ = 1.0 / (2.0 * std::numbers::pi * cap_height_);
  // The integral of the cosine over the disc is pi sin^2(radius).
  const double sin_radius = std::sin(0.5 * angular_diameter_rad);
  radiance_ = irradiance / static_cast<float>(std::numbers::pi * sin_radius * sin_radius);
}

Vec3d SunDisc::SampleDirection(const Vec2d& sample) const {
  const double height = sample.x() * cap_height_;
  const double radius = std::sqrt(height * (2.0 - height));
  const double azimuth_rad = 2.0 * std::numbers::pi * sample.y();
  return ShadingFrame(direction_)
      .ToWorld({radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), 1.0 - height});
}

Vec3x8 SunDisc::SampleDirection(Float8 first, Float8 second) const {
  const Float8 height = first * static_cast<float>(cap_height_);
  const Float8 radius = Sqrt(height * (2.0F - height));
  Float8 sine;
  Float8 cosine;
  SinCosOfTurn(second, sine, cosine);
  const ShadingFrame frame(direction_);
  return (radius * cosine) * Broadcast(Vec3f(frame.tangent.cast<float>())) +
         (radius * sine) * Broadcast(Vec3f(frame.bitangent.cast<float>())) +
         (1.0F - height) * Broadcast(Vec3f(frame.normal.cast<float>()));
}

Sun MakeSun(const SunSpec& spec, double turbidity) {
  const double elevation_rad = RadFromDeg(spec.elevation_deg);
  const double azimuth_rad = RadFromDeg(spec.azimuth_deg);
  Sun sun;
  sun.direction_to_sun = Vec3d(std::cos(elevation_rad) * std::cos(azimuth_rad),
                               std::cos(elevation_rad) * std::sin(azimuth_rad),
                               std::sin(elevation_rad))
                             .cast<float>();
  sun.irradiance = Rgb::Zero();
  if (elevation_rad <= 0.0) {
    return sun;
  }
  const double optical_mass = OpticalMass(elevation_rad);
  Vec3d xyz = Vec3d::Zero();
  double unattenuated_y = 0.0;
  for (size_t i = 0; i < kOzonePerCm.size(); ++i) {
    const double wavelength_nm = kFirstWavelengthNm + kWavelengthStepNm * static_cast<double>(i);
    const Vec3d light =
        MatchingFunctions(wavelength_nm) * BlackBody(wavelength_nm, kSolarTemperatureK);
    xyz += light * Transmittance(i, turbidity, optical_mass);
    unattenuated_y += light.y();
  }
  sun.irradiance =
      RgbFromXyz(xyz * (kSolarIlluminanceKlx * spec.strength / unattenuated_y)).max(0.0F);
  return sun;
}

namespace {

void CheckNames(const SkySpec& sky) {
  if (sky.model != "clear" && sky.model != "constant" && sky.model != "map") {
    throw InputError("light.sky.model: expected clear, constant or map, got '{}'", sky.model);
  }
  if (!(sky.turbidity >= kMinTurbidity && sky.turbidity <= kMaxTurbidity)) {
    throw InputError("light.sky.turbidity: expected {} to {}, got {}",
                     kMinTurbidity,
                     kMaxTurbidity,
                     sky.turbidity);
  }
}

Lighting LightingFromMap(const SkySpec& spec) {
  const SkyMap map = SkyMap::Read(spec.map, RadFromDeg(spec.map_rotation_deg));
  Lighting lighting{std::nullopt, Sky::FromMap(map, spec.strength)};
  if (map.Sun().has_value() && spec.strength > 0.0) {
    lighting.sun.emplace(map.Sun()->direction_to_sun,
                         map.Sun()->irradiance * static_cast<float>(spec.strength),
                         RadFromDeg(SunSpec{}.angular_diameter_deg));
  }
  return lighting;
}

Sky ConstantSky(const SkySpec& spec) {
  return Sky::Constant(static_cast<float>(spec.strength) *
                       Rgb(static_cast<float>(spec.radiance[0]),
                           static_cast<float>(spec.radiance[1]),
                           static_cast<float>(spec.radiance[2])));
}

}  // namespace

Lighting MakeLighting(const LightSpec& spec, const std::optional<Sun>& scene_sun) {
  CheckNames(spec.sky);
  if (spec.sky.model == "map") {
    return LightingFromMap(spec.sky);
  }
  const SunSpec sun_spec = spec.sun.value_or(SunSpec{});
  const double diameter_rad = RadFromDeg(sun_spec.angular_diameter_deg);
  Sun sun = spec.sun.has_value() || !scene_sun.has_value() ? MakeSun(sun_spec, spec.sky.turbidity)
                                                           : *scene_sun;
  const Vec3d direction = sun.direction_to_sun.cast<double>();
  Lighting lighting{std::nullopt,
                    spec.sky.model == "constant"
                        ? ConstantSky(spec.sky)
                        : Sky::Clear(direction, spec.sky.turbidity, spec.sky.strength)};
  if (spec.sky.model == "clear" && spec.sky.clouds.share > 0.0) {
    // The sky's strength is that of its clouds too.
    const Clouds clouds(spec.sky.clouds.share,
                        spec.sky.clouds.seed,
                        {direction,
                         sun.irradiance * static_cast<float>(spec.sky.strength),
                         lighting.sky.HorizontalIrradiance(),
                         spec.sky.turbidity});
    lighting.sky = lighting.sky.With(clouds);
    sun.irradiance *= clouds.SunTransmittance(diameter_rad);
  }
  if (sun.irradiance.maxCoeff() > 0.0F) {
    lighting.sun.emplace(direction, sun.irradiance, diameter_rad);
  }
  return lighting;
}

}  // namespace pfseq
