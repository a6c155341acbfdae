// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/scatter_packet.h"

#include "renderer/trace/microfacet.h"
#include "renderer/trace/ray_lift.h"
#include "renderer/trace/specular_albedo.h"

#include <numbers>

namespace pfseq {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInversePi = std::numbers::inv_pi_v<float>;

/// Keeps spreads of cosines off zero where they are divided by.
constexpr float kLeastSpread = 1e-9F;

/// The same of cosines to normals that may lie beyond the horizon.
constexpr float kLeastCosine = 1e-3F;

/// Values of eight lanes that are written one by one and read as one.
struct alignas(32) Lanes {
  std::array<float, kPacketSize> values{};

  float& operator[](int i) { return values[static_cast<size_t>(i)]; }
  Float8 Load() const { return Float8(values); }
};

struct Lanes3 {
  std::array<Lanes, 3> parts;

  template <typename Vector>
  void Set(int i, const Vector& vector) {
    for (int k = 0; k < 3; ++k) {
      parts[static_cast<size_t>(k)][i] = vector[k];
    }
  }
  Vec3x8 Vector() const { return {parts[0].Load(), parts[1].Load(), parts[2].Load()}; }
  Rgb8 Color() const { return {parts[0].Load(), parts[1].Load(), parts[2].Load()}; }
};

/// Walter et al. 2007, equation (34), in the form of Heitz 2014, "Understanding the
/// Masking-Shadowing Function in Microfacet-Based BRDFs" (JCGT 3(2)), equation (72).
Float8 SmithLambda(Float8 cosine, Float8 squared_alpha) {
  const Float8 squared_cosine = cosine * cosine;
  const Float8 squared_tangent = Max(1.0F - squared_cosine, 0.0F) / squared_cosine;
  return 0.5F * (Sqrt(1.0F + squared_alpha * squared_tangent) - 1.0F);
}

Float8 Albedo(const SpecularAlbedo::Scales8& scales, Float8 f0, Float8 f90) {
  return f0 * scales.f0_scale + f90 * scales.f90_scale;
}

}  // namespace

ScatterPacket::ScatterPacket(const std::array<ShadingPoint, kPacketSize>& points,
                             uint32_t active,
                             const RayPacket& rays)
    : to_viewer{-Float8(rays.direction_x), -Float8(rays.direction_y), -Float8(rays.direction_z)} {
  Lanes3 position_lanes;
  Lanes3 geometric_lanes;
  Lanes3 normal_lanes;
  Lanes3 emission_lanes;
  Lanes3 color_lanes;
  Lanes length_lanes;
  Lanes roughness_lanes;
  Lanes metallic_lanes;
  Lanes ior_lanes;
  for (int i = 0; i < kPacketSize; ++i) {
    if ((active >> i & 1U) == 0) {
      continue;
    }
    const ShadingPoint& point = points[static_cast<size_t>(i)];
    position_lanes.Set(i, point.position_m);
    geometric_lanes.Set(i, point.geometric_normal);
    normal_lanes.Set(i, point.normal);
    emission_lanes.Set(i, point.emission);
    color_lanes.Set(i, point.parameters.base_color);
    length_lanes[i] = point.normal_length;
    roughness_lanes[i] = point.parameters.roughness;
    metallic_lanes[i] = point.parameters.metallic;
    ior_lanes[i] = point.parameters.ior;
  }
  position_m = position_lanes.Vector();
  geometric_normal = geometric_lanes.Vector();
  normal = normal_lanes.Vector();
  normal_length = length_lanes.Load();
  roughness = roughness_lanes.Load();
  emission = emission_lanes.Color();
  viewer_cosine = Dot(normal, to_viewer);

  const Float8 ior = ior_lanes.Load();
  const Float8 metallic = metallic_lanes.Load();
  const Float8 dielectric = 1.0F - metallic;
  const Rgb8 base_color = color_lanes.Color();
  const Float8 reflection = (ior - 1.0F) / (ior + 1.0F);
  dielectric_f0_ = reflection * reflection;
  dielectric_f90_ = Select(ior > 1.0F, 1.0F, 0.0F);
  const Float8 dielectric_part = dielectric * dielectric_f0_;
  f0_ = metallic * base_color + Rgb8{dielectric_part, dielectric_part, dielectric_part};
  f90_ = metallic + dielectric * dielectric_f90_;
  is_specular = f90_ > 0.0F;
  alpha_ = Max(roughness * roughness, static_cast<float>(kMinAlpha));

  const Rgb8 albedo = dielectric * base_color;
  if ((is_specular.Bits() & active) == 0) {
    diffuse_reflectance_ = albedo;
    diffuse_ = kInversePi * albedo;
    return;
  }
  const SpecularAlbedo& table = SpecularAlbedo::Table();
  const Float8 mean_albedo = Albedo(table.Mean(roughness), dielectric_f0_, dielectric_f90_);
  const SpecularAlbedo::Scales8 scales = table.Directional(viewer_cosine, roughness);
  const Float8 viewer_share = 1.0F - Albedo(scales, dielectric_f0_, dielectric_f90_);
  diffuse_reflectance_ = viewer_share * albedo;
  diffuse_ = (kInversePi / (1.0F - mean_albedo)) * diffuse_reflectance_;
  const Float8 f90_part = f90_ * scales.f90_scale;
  specular_reflectance_ = scales.f0_scale * f0_ + Rgb8{f90_part, f90_part, f90_part};
  viewer_lambda_ = SmithLambda(viewer_cosine, alpha_ * alpha_);
}

Rgb8 ScatterPacket::SpecularForward() const {
  const SpecularAlbedo::Scales8 scales = SpecularAlbedo::Table().Forward(viewer_cosine, roughness);
  const Float8 f90_part = f90_ * scales.f90_scale;
  return scales.f0_scale * f0_ + Rgb8{f90_part, f90_part, f90_part};
}

Vec3x8 ScatterPacket::Forward() const {
  const Vec3x8 in_plane = viewer_cosine * normal - to_viewer;
  return (1.0F / Sqrt(Max(Dot(in_plane, in_plane), kLeastSpread))) * in_plane;
}

Float8 ScatterPacket::DiffuseShare(Float8 cosine) const {
  return 1.0F - Albedo(SpecularAlbedo::Table().Directional(cosine, roughness),
                       dielectric_f0_,
                       dielectric_f90_);
}

Float8 ScatterPacket::MeanCosine(const Vec3x8& to_light) const {
  const Float8 cosine = Dot(normal, to_light);
  const Float8 mean = normal_length * cosine;
  const Float8 variance =
      0.5F * Max(1.0F - normal_length * normal_length, 0.0F) * Max(1.0F - cosine * cosine, 0.0F);
  const Float8 half_spread = Sqrt(3.0F * variance);
  const Float8 above = mean + half_spread;
  const Float8 straddling = above * above / (4.0F * Max(half_spread, kLeastSpread));
  return Select(half_spread > mean, Select(above > 0.0F, straddling, 0.0F), Max(mean, 0.0F));
}

Rgb8 ScatterPacket::EvaluateDiffuse(const Vec3x8& to_light) const {
  const Float8 cosine = MeanCosine(to_light);
  if (is_specular.Bits() == 0) {
    return cosine * diffuse_;
  }
  return (DiffuseShare(cosine) * cosine) * diffuse_;
}

ScatterPacket::Specular ScatterPacket::EvaluateSpecular(const Vec3x8& to_light) const {
  const Float8 light_cosine = Dot(normal, to_light);
  const Vec3x8 half = Normalized(to_viewer + to_light);
  const Float8 half_cosine = Dot(normal, half);
  // Walter et al. 2007, equation (33), with the sine of the vector across the normal, so that
  // nothing cancels for narrow lobes.
  const Vec3x8 across = half - half_cosine * normal;
  const Float8 norm = Dot(across, across) / (alpha_ * alpha_) + half_cosine * half_cosine;
  const Float8 density = 1.0F / (kPi * alpha_ * alpha_ * norm * norm);
  // Where normals spread, those that mirror lie between the mean and the half vector, by the shares
  // that their slopes and the facets' have of the variance; what the viewer sees of them and how
  // they mask each other goes by those.
  const Float8 squared_alpha = alpha_ * alpha_;
  const Float8 spread = Min(2.0F * Max(1.0F - normal_length, 0.0F), squared_alpha);
  const Vec3x8 mirroring = Normalized(half_cosine * normal + (spread / squared_alpha) * across);
  const Float8 own_squared_alpha =
      Max(squared_alpha - spread, static_cast<float>(kMinAlpha * kMinAlpha));
  const Float8 mirroring_viewer = Max(Dot(mirroring, to_viewer), kLeastCosine);
  const Float8 mirroring_light = Max(Dot(mirroring, to_light), kLeastCosine);
  const Float8 masking = 1.0F / (1.0F + SmithLambda(mirroring_viewer, own_squared_alpha) +
                                 SmithLambda(mirroring_light, own_squared_alpha));
  const Float8 value = density / (4.0F * mirroring_viewer) * masking;
  const Float8 complement = Max(1.0F - Dot(to_viewer, half), 0.0F);
  const Float8 squared = complement * complement;
  const Float8 weight = squared * squared * complement;
  const Rgb8 f90{f90_, f90_, f90_};
  const Rgb8 fresnel = f0_ + weight * (f90 - f0_);
  const Mask8 is_above = (light_cosine > 0.0F) & is_specular;
  return {Select(is_above, value * fresnel, Rgb8{}),
          Select(is_above, density / (4.0F * viewer_cosine * (1.0F + viewer_lambda_)), 0.0F)};
}

ScatterPacket::SpecularSample ScatterPacket::SampleSpecular(Float8 first, Float8 second) const {
  // A frame about the normal as ShadingFrame's.
  const Float8 sign = CopySign(1.0F, normal.z);
  const Float8 a = -1.0F / (sign + normal.z);
  const Float8 b = normal.x * normal.y * a;
  const Vec3x8 tangent{1.0F + sign * normal.x * normal.x * a, sign * b, -(sign * normal.x)};
  const Vec3x8 bitangent{b, sign + normal.y * normal.y * a, -normal.y};
  // As Ggx::SampleVisibleNormal.
  const Vec3x8 viewer = Normalized(
      Vec3x8{alpha_ * Dot(tangent, to_viewer), alpha_ * Dot(bitangent, to_viewer), viewer_cosine});
  Float8 sine;
  Float8 cosine;
  SinCosOfTurn(first, sine, cosine);
  const Float8 z = (1.0F - second) * (1.0F + viewer.z) - viewer.z;
  const Float8 radius = Sqrt(Max(1.0F - z * z, 0.0F));
  const Vec3x8 cap{
      alpha_ * (viewer.x + radius * cosine), alpha_ * (viewer.y + radius * sine), viewer.z + z};
  const Vec3x8 half = Normalized(cap.x * tangent + cap.y * bitangent + cap.z * normal);
  SpecularSample sample;
  sample.to_light = Normalized((2.0F * Dot(to_viewer, half)) * half - to_viewer);
  const Specular value = EvaluateSpecular(sample.to_light);
  sample.pdf = value.pdf;
  sample.weight = (1.0F / value.pdf) * value.value_cosine;
  sample.is_valid = (value.pdf > 0.0F) & (Dot(sample.to_light, geometric_normal) > 0.0F);
  return sample;
}

Vec3x8 ScatterPacket::RayOriginM() const {
  const auto size = [](Float8 value) { return Max(value, -value); };
  const Float8 largest = Max(Max(size(position_m.x), size(position_m.y)), size(position_m.z));
  const Float8 lift_m =
      static_cast<float>(kLeastLiftM) + static_cast<float>(kRelativeLift) * largest;
  return position_m + lift_m * geometric_normal;
}

}  // namespace pfseq
