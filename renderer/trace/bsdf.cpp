// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/bsdf.h"

#include "renderer/trace/specular_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Neither lobe is chosen less often than this where both reflect: the other's samples then never
/// get large weights.
constexpr double kMinLobeProbability = 0.1;

double Albedo(const SpecularAlbedo::Scales& scales, double f0, double f90) {
  return f0 * scales.f0_scale + f90 * scales.f90_scale;
}

/// A direction with density cosine / pi (Malley's method).
Vec3d SampleCosine(const Vec2d& sample) {
  const double radius = std::sqrt(sample.x());
  const double azimuth_rad = 2.0 * std::numbers::pi * sample.y();
  return {
      radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), std::sqrt(1.0 - sample.x())};
}

}  // namespace

Bsdf::Bsdf(const BsdfParameters& parameters, const Vec3d& to_viewer)
    : to_viewer_(to_viewer),
      ggx_(static_cast<double>(parameters.roughness) * parameters.roughness),
      roughness_(parameters.roughness) {
  const double ior = parameters.ior;
  const double reflection = (ior - 1.0) / (ior + 1.0);
  dielectric_f0_ = reflection * reflection;
  dielectric_f90_ = ior > 1.0 ? 1.0 : 0.0;
  const float metallic = parameters.metallic;
  const Rgb metal_f0 = metallic * parameters.base_color;
  specular_.f0 = metal_f0 + (1.0F - metallic) * static_cast<float>(dielectric_f0_);
  specular_.f90 = Rgb::Constant(metallic + (1.0F - metallic) * static_cast<float>(dielectric_f90_));
  diffuse_ = (1.0F - metallic) * std::numbers::inv_pi_v<float> * parameters.base_color;
  if (specular_.f90[0] == 0.0F) {
    return;
  }
  viewer_lambda_ = ggx_.Lambda(to_viewer);
  const SpecularAlbedo& table = SpecularAlbedo::Table();
  mean_albedo_ = Albedo(table.Mean(roughness_), dielectric_f0_, dielectric_f90_);
  const double viewer_share = DiffuseShare(to_viewer.z());
  diffuse_ *= static_cast<float>(viewer_share / (1.0 - mean_albedo_));

  const SpecularAlbedo::Scales scales = table.Directional(to_viewer.z(), roughness_);
  const double specular_albedo = Albedo(scales, Luminance(specular_.f0), Luminance(specular_.f90));
  const double diffuse_albedo = Luminance(diffuse_) * std::numbers::pi * (1.0 - mean_albedo_);
  specular_probability_ = diffuse_albedo > 0.0
                              ? std::clamp(specular_albedo / (specular_albedo + diffuse_albedo),
                                           kMinLobeProbability,
                                           1.0 - kMinLobeProbability)
                              : 1.0;
}

double Bsdf::DiffuseShare(double cosine) const {
  return 1.0 - Albedo(SpecularAlbedo::Table().Directional(cosine, roughness_),
                      dielectric_f0_,
                      dielectric_f90_);
}

Rgb Bsdf::EvaluateDiffuse(const Vec3d& to_light) const {
  const double cosine = to_light.z();
  if (cosine <= 0.0) {
    return Rgb::Zero();
  }
  const double diffuse_share = dielectric_f90_ > 0.0 ? DiffuseShare(cosine) : 1.0;
  return diffuse_ * static_cast<float>(diffuse_share * cosine);
}

BsdfValue Bsdf::EvaluateSpecular(const Vec3d& to_light) const {
  if (to_light.z() <= 0.0 || specular_probability_ == 0.0) {
    return {};
  }
  const Vec3d half = (to_viewer_ + to_light).normalized();
  const double density = ggx_.Density(half);
  // f = F D G2 / (4 v_z l_z), of which l_z cancels with the cosine.
  const double common = density / (4.0 * to_viewer_.z());
  const double masking = 1.0 / (1.0 + viewer_lambda_ + ggx_.Lambda(to_light));
  const auto weight = static_cast<float>(SchlickWeight(to_viewer_.dot(half)));
  const Rgb fresnel = specular_.f0 + (specular_.f90 - specular_.f0) * weight;
  return {fresnel * static_cast<float>(common * masking), common / (1.0 + viewer_lambda_)};
}

BsdfValue Bsdf::Evaluate(const Vec3d& to_light) const {
  if (to_light.z() <= 0.0) {
    return {};
  }
  const BsdfValue specular = EvaluateSpecular(to_light);
  return {EvaluateDiffuse(to_light) + specular.value_cosine,
          (1.0 - specular_probability_) * to_light.z() * std::numbers::inv_pi +
              specular_probability_ * specular.pdf};
}

Rgb Bsdf::DiffuseReflectance() const {
  return diffuse_ * static_cast<float>(std::numbers::pi * (1.0 - mean_albedo_));
}

Rgb Bsdf::SpecularReflectance() const {
  if (specular_probability_ == 0.0) {
    return Rgb::Zero();
  }
  const SpecularAlbedo::Scales scales =
      SpecularAlbedo::Table().Directional(to_viewer_.z(), roughness_);
  return specular_.f0 * static_cast<float>(scales.f0_scale) +
         specular_.f90 * static_cast<float>(scales.f90_scale);
}

std::optional<BsdfSample> Bsdf::SampleSpecular(const Vec2d& direction_sample) const {
  if (specular_probability_ == 0.0) {
    return std::nullopt;
  }
  const Vec3d half = ggx_.SampleVisibleNormal(to_viewer_, direction_sample);
  const Vec3d to_light = (2.0 * to_viewer_.dot(half) * half - to_viewer_).normalized();
  const BsdfValue value = EvaluateSpecular(to_light);
  if (!(value.pdf > 0.0) || value.value_cosine.maxCoeff() <= 0.0F) {
    return std::nullopt;
  }
  return BsdfSample{to_light, value.value_cosine / static_cast<float>(value.pdf), value.pdf};
}

std::optional<BsdfSample> Bsdf::Sample(double lobe_sample, const Vec2d& direction_sample) const {
  Vec3d to_light;
  if (lobe_sample < specular_probability_) {
    const Vec3d half = ggx_.SampleVisibleNormal(to_viewer_, direction_sample);
    to_light = (2.0 * to_viewer_.dot(half) * half - to_viewer_).normalized();
  } else {
    to_light = SampleCosine(direction_sample);
  }
  const BsdfValue value = Evaluate(to_light);
  if (!(value.pdf > 0.0) || value.value_cosine.maxCoeff() <= 0.0F) {
    return std::nullopt;
  }
  return BsdfSample{to_light, value.value_cosine / static_cast<float>(value.pdf), value.pdf};
}

}  // namespace pfseq
