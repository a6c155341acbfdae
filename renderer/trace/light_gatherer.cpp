// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_gatherer.h"

#include "renderer/trace/material.h"
#include "renderer/trace/scatter_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace pfseq {
namespace {

constexpr float kInversePi = std::numbers::inv_pi_v<float>;

/// Surfaces below this roughness, and metals, mirror too much for their reflection to count as
/// diffuse.
constexpr float kSmoothRoughness = 0.4F;
constexpr float kMetal = 0.5F;

/// Share of the rays reflected by far panes that are followed.
constexpr float kFollowedReflections = 0.25F;

/// The first scattering event after which a path may end early.
constexpr int kFirstRouletteBounce = 3;

/// Directions have the density (z + c) / (pi (1 + 2 c)), z the cosine to the normal: near
/// proportional to what they count for the irradiance, but bounded from below, so that the
/// integral's components in the plane have a bounded variance as well.
constexpr float kDensityOffset = 0.15F;

struct Frame {
  explicit Frame(const Vec3f& unit_normal) : normal(unit_normal) {
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited" (JCGT 6(1)).
    const float sign = std::copysign(1.0F, unit_normal.z());
    const float a = -1.0F / (sign + unit_normal.z());
    const float b = unit_normal.x() * unit_normal.y() * a;
    tangent = {
        1.0F + sign * unit_normal.x() * unit_normal.x() * a, sign * b, -sign * unit_normal.x()};
    bitangent = {b, sign + unit_normal.y() * unit_normal.y() * a, -unit_normal.y()};
  }
  Vec3f ToWorld(float x, float y, float z) const {
    return x * tangent + y * bitangent + z * normal;
  }

  Vec3f tangent;
  Vec3f bitangent;
  Vec3f normal;
};

/// A point in each cell of a grid of n x n over the unit square, so that each of n^2 rows and of
/// n^2 columns has one too: Chiu, Shirley and Wang 1994, "Multi-jittered Sampling" (Graphics Gems
/// IV), with shuffles that go through each column and row as well. Roofs and eaves are edges nearly
/// along the rows and columns of the hemisphere.
class MultiJitteredGrid {
 public:
  MultiJitteredGrid(int n, RandomStream& random) : n_(n), shuffled_(2 * static_cast<size_t>(n)) {
    for (int i = 0; i < n; ++i) {
      shuffled_[static_cast<size_t>(i)] = Vec2f::Constant(static_cast<float>(i));
    }
    for (int i = n - 1; i > 0; --i) {
      Vec2f& last = shuffled_[static_cast<size_t>(i)];
      std::swap(last.x(), shuffled_[static_cast<size_t>(random.Integer(0, i))].x());
      std::swap(last.y(), shuffled_[static_cast<size_t>(random.Integer(0, i))].y());
    }
    std::copy_n(shuffled_.begin(), n, shuffled_.begin() + n);
  }

  int CellsAcross() const { return n_; }

  /// The point of a cell, in cells along rows and columns.
  Vec2f At(int row, int column, RandomStream& jitter) const {
    const Vec2f in_cell(shuffled_[static_cast<size_t>(row + column)].x(),
                        shuffled_[static_cast<size_t>(row - column + n_)].y());
    const auto u = static_cast<float>(jitter.Uniform());
    const auto v = static_cast<float>(jitter.Uniform());
    return Vec2f(static_cast<float>(row), static_cast<float>(column)) +
           (in_cell + Vec2f(u, v)) / static_cast<float>(n_);
  }

 private:
  int n_;
  /// Two permutations of 0 to n - 1, twice, for what runs over the end.
  std::vector<Vec2f> shuffled_;
};

/// The directions of a packet and what each counts for the integral over the hemisphere.
struct BundleOfRays {
  Vec3x8 directions;
  std::array<float, kPacketSize> weights;
};

/// Two rows of height by four columns of azimuth of a grid of strata over the hemisphere.
BundleOfRays SampleBundle(const Frame& frame,
                          const MultiJitteredGrid& grid,
                          int height_start,
                          int azimuth_start,
                          RandomStream& jitter) {
  std::array<float, kPacketSize> first;
  std::array<float, kPacketSize> second;
  for (int i = 0; i < kPacketSize; ++i) {
    const auto lane = static_cast<size_t>(i);
    const Vec2f point = grid.At(height_start + i / 4, azimuth_start + i % 4, jitter);
    first[lane] = point.x();
    second[lane] = point.y();
  }
  const float share = 1.0F / static_cast<float>(grid.CellsAcross());
  // The inverse of the running integral of 2 pi (z + c) / (pi (1 + 2 c)) over z.
  constexpr float kNorm = 1.0F + 2.0F * kDensityOffset;
  const Float8 z = Min(
      Sqrt(kDensityOffset * kDensityOffset + Float8(first) * share * kNorm) - kDensityOffset, 1.0F);
  const Float8 radius = Sqrt(Max(1.0F - z * z, 0.0F));
  Float8 sine;
  Float8 cosine;
  SinCosOfTurn(Float8(second) * share, sine, cosine);
  const Float8 weight = std::numbers::pi_v<float> * kNorm * share * share / (z + kDensityOffset);
  return {Normalized((radius * cosine) * Broadcast(frame.tangent) +
                     (radius * sine) * Broadcast(frame.bitangent) + z * Broadcast(frame.normal)),
          weight.Values()};
}

/// The scattering at a point, with the directions to and from the world's frame.
struct Scatterer {
  Scatterer(const ShadingPoint& point, const Vec3f& direction)
      : frame(point.normal.cast<double>()),
        bsdf(point.parameters, frame.ToLocal(-direction.cast<double>())) {}
  ShadingFrame frame;
  Bsdf bsdf;
};

}  // namespace

LightGatherer::LightGatherer(const RayScene& rays,
                             const SurfaceTable& surfaces,
                             const Lighting& lighting,
                             const GatherOptions& options)
    : rays_(rays),
      surfaces_(surfaces),
      lighting_(lighting),
      options_(options),
      rays_across_(std::max(
          4,
          4 * static_cast<int>(std::ceil(std::sqrt(static_cast<double>(options.num_rays)) / 4.0)))),
      coarse_(surfaces,
              options.patch_m,
              [this](const Vec3f& origin_m, const Vec3f& normal, RandomStream& random) {
                return CoarseIrradiance(origin_m, normal, random);
              }) {
  if (lighting.sun.has_value()) {
    sun_irradiance_ = lighting.sun->Radiance() * static_cast<float>(1.0 / lighting.sun->Pdf());
    direction_to_sun_ = lighting.sun->DirectionToSun().cast<float>();
  }
}

int LightGatherer::RaysAcross(ShareOfRays share) const {
  switch (share) {
    case ShareOfRays::kAll:
      break;
    case ShareOfRays::kQuarter:
      return (rays_across_ / 4 + 1) / 2 * 4;
    case ShareOfRays::kSixteenth:
      return std::max(4, (rays_across_ / 8 + 1) / 2 * 4);
  }
  return rays_across_;
}

bool LightGatherer::IsSmooth(const ShadingPoint& point) const {
  return !point.IsLambertian() &&
         (point.parameters.roughness < kSmoothRoughness || point.parameters.metallic > kMetal);
}

Rgb LightGatherer::FarReflection(const ShadingPoint& point, const Vec3f& direction) const {
  const Rgb irradiance =
      coarse_.Irradiance(point.triangle_idx, point.u, point.v, point.is_front) * kInversePi;
  if (point.IsLambertian()) {
    return point.emission + point.parameters.base_color * irradiance;
  }
  // The specular lobe's reflection of its surroundings counts as that of their mean.
  const Scatterer scatterer(point, direction);
  return point.emission +
         (scatterer.bsdf.DiffuseReflectance() + scatterer.bsdf.SpecularReflectance()) * irradiance;
}

Rgb LightGatherer::SmoothReflection(const ShadingPoint& point,
                                    const Vec3f& direction,
                                    bool is_sunlit,
                                    RandomStream& random) const {
  const Scatterer scatterer(point, direction);
  Rgb irradiance = coarse_.Irradiance(point.triangle_idx, point.u, point.v, point.is_front);
  Rgb radiance = point.emission;
  if (is_sunlit) {
    irradiance += sun_irradiance_ *
                  (point.normal_length * std::max(0.0F, point.normal.dot(direction_to_sun_)));
    radiance +=
        scatterer.bsdf.EvaluateSpecular(scatterer.frame.ToLocal(direction_to_sun_.cast<double>()))
            .value_cosine *
        sun_irradiance_;
  }
  radiance += scatterer.bsdf.DiffuseReflectance() * irradiance * kInversePi;
  // Panes reflect little: not all rays are worth following.
  const float share = point.parameters.metallic > kMetal ? 1.0F : kFollowedReflections;
  if (!(static_cast<float>(random.Uniform()) < share)) {
    return radiance;
  }
  const double first = random.Uniform();
  const std::optional<BsdfSample> sample = scatterer.bsdf.SampleSpecular({first, random.Uniform()});
  if (!sample.has_value()) {
    return radiance;
  }
  const Vec3f mirrored = scatterer.frame.ToWorld(sample->to_light).normalized().cast<float>();
  if (mirrored.dot(point.geometric_normal) <= 0.0F) {
    return radiance;
  }
  const Vec3f origin_m = point.RayOriginM();
  const std::optional<PacketHit> hit = rays_.Intersect(origin_m, mirrored);
  Rgb seen = Rgb::Zero();
  if (!hit.has_value()) {
    seen = lighting_.sky.Radiance(mirrored);
  } else if (options_.max_bounces > 2) {
    const ShadingPoint next = ShadeWide(*hit, origin_m, mirrored);
    const Rgb sunlight = Sunlight(next, mirrored, random);
    seen = FarReflection(next, mirrored) + sunlight;
  }
  return radiance + seen * sample->weight / share;
}

ShadingPoint LightGatherer::ShadeWide(const PacketHit& hit,
                                      const Vec3f& origin_m,
                                      const Vec3f& direction) const {
  // A ray of a path stands for a wide bundle.
  constexpr float kSpread = 0.2F;
  return surfaces_.Shade(
      hit, origin_m, direction, kSpread * hit.distance_m, options_.min_indirect_roughness);
}

Rgb LightGatherer::Sunlight(const ShadingPoint& point,
                            const Vec3f& direction,
                            RandomStream& random) const {
  if (!lighting_.sun.has_value()) {
    return Rgb::Zero();
  }
  const double first = random.Uniform();
  const Vec3d to_sun = lighting_.sun->SampleDirection({first, random.Uniform()});
  if (point.geometric_normal.cast<double>().dot(to_sun) <= 0.0) {
    return Rgb::Zero();
  }
  Rgb value;
  if (point.IsLambertian()) {
    value = point.parameters.base_color *
            (kInversePi * std::max(0.0F, point.normal.dot(to_sun.cast<float>())));
  } else {
    const Scatterer scatterer(point, direction);
    value = scatterer.bsdf.Evaluate(scatterer.frame.ToLocal(to_sun)).value_cosine;
  }
  if (value.maxCoeff() <= 0.0F || rays_.Occluded(point.RayOriginM(), Vec3f(to_sun.cast<float>()))) {
    return Rgb::Zero();
  }
  return value * sun_irradiance_;
}

Rgb LightGatherer::PathLight(ShadingPoint point,
                             Vec3f direction,
                             int bounce,
                             bool ends_in_coarse_light,
                             RandomStream& random) const {
  Rgb radiance = Rgb::Zero();
  Rgb throughput = Rgb::Ones();
  for (;; ++bounce) {
    radiance += throughput * point.emission;
    if (bounce >= options_.max_bounces) {
      break;
    }
    radiance += throughput * Sunlight(point, direction, random);
    const Scatterer scatterer(point, direction);
    const double lobe = random.Uniform();
    const double first = random.Uniform();
    const std::optional<BsdfSample> sample = scatterer.bsdf.Sample(lobe, {first, random.Uniform()});
    if (!sample.has_value()) {
      break;
    }
    const Vec3f next_direction =
        scatterer.frame.ToWorld(sample->to_light).normalized().cast<float>();
    if (next_direction.dot(point.geometric_normal) <= 0.0F) {
      break;
    }
    throughput *= sample->weight;
    if (bounce + 1 >= kFirstRouletteBounce) {
      const float survival = std::min(1.0F, throughput.maxCoeff());
      if (!(static_cast<float>(random.Uniform()) < survival)) {
        break;
      }
      throughput /= survival;
    }
    const Vec3f origin_m = point.RayOriginM();
    const std::optional<PacketHit> hit = rays_.Intersect(origin_m, next_direction);
    if (!hit.has_value()) {
      radiance += throughput * lighting_.sky.Radiance(next_direction);
      break;
    }
    point = ShadeWide(*hit, origin_m, next_direction);
    direction = next_direction;
    if (ends_in_coarse_light && bounce + 1 < options_.max_bounces &&
        hit->distance_m >= options_.near_m && !IsSmooth(point)) {
      const Rgb sunlight = Sunlight(point, direction, random);
      radiance += throughput * (FarReflection(point, direction) + sunlight);
      break;
    }
  }
  return radiance.isFinite().all() ? radiance : Rgb(Rgb::Zero());
}

CoarseLight::PointEstimate LightGatherer::CoarseIrradiance(const Vec3f& origin_m,
                                                           const Vec3f& normal,
                                                           RandomStream& random) const {
  const double squared_radius = random.Uniform();
  const double azimuth_rad = 2.0 * std::numbers::pi * random.Uniform();
  const auto radius = static_cast<float>(std::sqrt(squared_radius));
  const Vec3f direction = Frame(normal)
                              .ToWorld(radius * static_cast<float>(std::cos(azimuth_rad)),
                                       radius * static_cast<float>(std::sin(azimuth_rad)),
                                       static_cast<float>(std::sqrt(1.0 - squared_radius)))
                              .normalized();
  const std::optional<PacketHit> hit = rays_.Intersect(origin_m, direction);
  if (!hit.has_value()) {
    return {lighting_.sky.Radiance(direction) * std::numbers::pi_v<float>};
  }
  const ShadingPoint point = ShadeWide(*hit, origin_m, direction);
  // The patch itself is the second vertex at the earliest.
  return {PathLight(point, direction, 2, false, random) * std::numbers::pi_v<float>,
          !point.is_front};
}

LightGatherer::FarSurfaces LightGatherer::ShadeFar(
    const std::array<ShadingPoint, kPacketSize>& points,
    uint32_t far,
    const RayPacket& rays,
    RandomStream& random) const {
  const ScatterPacket surface(points, far, rays);
  std::array<Rgb, kPacketSize> coarse;
  coarse.fill(Rgb::Zero());
  for (uint32_t lanes = far; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<size_t>(std::countr_zero(lanes));
    const ShadingPoint& point = points[lane];
    coarse[lane] = coarse_.Irradiance(point.triangle_idx, point.u, point.v, point.is_front);
  }
  Rgb8 irradiance = Transposed(coarse);
  FarSurfaces shaded;
  if (lighting_.sun.has_value()) {
    const Vec3x8 to_middle = Broadcast(direction_to_sun_);
    const Float8 cosine = surface.MeanCosine(to_middle);
    const uint32_t facing =
        far & ((cosine > 0.0F) & (Dot(surface.geometric_normal, to_middle) > 0.0F)).Bits();
    if (facing != 0) {
      const auto first = static_cast<float>(random.Uniform());
      const auto second = static_cast<float>(random.Uniform());
      // One direction for all: that of the disc does not matter over many packets.
      const Vec3x8 to_sun = lighting_.sun->SampleDirection(first, second);
      shaded.sunlit = facing & ~rays_.Occluded(MakeRayPacket(surface.RayOriginM(), to_sun, facing),
                                               Coherence::kCoherent);
      const Rgb8 sunlight = cosine * Broadcast(sun_irradiance_);
      irradiance = irradiance + Select(Mask8::FromBits(shaded.sunlit), sunlight, Rgb8{});
    }
  }
  // The specular lobe's reflection of its surroundings counts as that of their mean.
  const Rgb8 radiance =
      surface.emission +
      Float8(kInversePi) *
          ((surface.DiffuseReflectance() + surface.SpecularReflectance()) * irradiance);
  shaded.radiance = Transposed(radiance);
  return shaded;
}

float LightGatherer::ShareFromBehind(const Vec3f& origin_m,
                                     const Vec3f& normal,
                                     uint64_t key) const {
  constexpr int kStrata = 4;
  const Frame frame(normal);
  RandomStream jitter(key);
  const MultiJitteredGrid grid(kStrata, jitter);
  int num_from_behind = 0;
  for (int height_start = 0; height_start < kStrata; height_start += 2) {
    const BundleOfRays bundle = SampleBundle(frame, grid, height_start, 0, jitter);
    const RayPacket packet = MakeRayPacket(Broadcast(origin_m), bundle.directions, kAllLanes);
    HitPacket hits;
    rays_.Intersect(packet, Coherence::kIncoherent, hits);
    for (uint32_t lanes = hits.hit; lanes != 0; lanes &= lanes - 1) {
      const int i = std::countr_zero(lanes);
      num_from_behind += surfaces_.Locate(hits.Of(i), packet.Direction(i)).is_front ? 0 : 1;
    }
  }
  return static_cast<float>(num_from_behind) / (kStrata * kStrata);
}

GatheredLight LightGatherer::GatherBy(int rays_across,
                                      const Vec3f& origin_m,
                                      const Vec3f& normal,
                                      uint64_t key) const {
  const Frame frame(normal);
  const int n = rays_across;
  // What the footprint of one ray is at unit distance.
  const float spread = std::sqrt(2.0F * std::numbers::pi_v<float>) / static_cast<float>(n);
  RandomStream jitter(key);
  const MultiJitteredGrid grid(n, jitter);
  VectorIrradiance sum;
  int num_from_behind = 0;
  float sum_of_inverse_distances = 0.0F;
  for (int block = 0; block < n * n / kPacketSize; ++block) {
    // Four neighbours in azimuth by two in height: a packet's rays go nearly the same way.
    const int azimuth_start = block % (n / 4) * 4;
    const int height_start = block / (n / 4) * 2;
    const BundleOfRays bundle = SampleBundle(frame, grid, height_start, azimuth_start, jitter);
    const RayPacket packet = MakeRayPacket(Broadcast(origin_m), bundle.directions, kAllLanes);
    HitPacket hits;
    rays_.Intersect(packet, Coherence::kCoherent, hits);

    std::array<ShadingPoint, kPacketSize> points;
    uint32_t far = 0;
    for (uint32_t lanes = hits.hit; lanes != 0; lanes &= lanes - 1) {
      const int i = std::countr_zero(lanes);
      const PacketHit hit = hits.Of(i);
      ShadingPoint& point = points[static_cast<size_t>(i)];
      point = surfaces_.Shade(hit,
                              origin_m,
                              packet.Direction(i),
                              spread * hit.distance_m,
                              options_.min_indirect_roughness);
      num_from_behind += point.is_front ? 0 : 1;
      sum_of_inverse_distances += 1.0F / hit.distance_m;
      if (!(hit.distance_m < options_.near_m) && options_.max_bounces >= 2) {
        far |= 1U << i;
      }
    }
    const FarSurfaces far_surfaces =
        far != 0 ? ShadeFar(points, far, packet, jitter) : FarSurfaces{};
    for (int i = 0; i < kPacketSize; ++i) {
      const auto lane = static_cast<size_t>(i);
      const Vec3f direction = packet.Direction(i);
      Rgb radiance;
      if (!hits.IsHit(i)) {
        radiance = lighting_.sky.Radiance(direction);
      } else if ((far >> i & 1U) == 0) {
        RandomStream random({key, static_cast<uint64_t>(block * kPacketSize + i)});
        radiance = PathLight(points[lane], direction, 1, true, random);
      } else if (IsSmooth(points[lane])) {
        radiance =
            SmoothReflection(points[lane], direction, (far_surfaces.sunlit >> i & 1U) != 0, jitter);
      } else {
        radiance = far_surfaces.radiance[lane];
      }
      const Rgb weighted = radiance * bundle.weights[lane];
      const Eigen::Array4f light(weighted[0], weighted[1], weighted[2], 0.0F);
      sum.x += light * direction.x();
      sum.y += light * direction.y();
      sum.z += light * direction.z();
    }
  }
  const auto num_rays = static_cast<float>(n * n);
  return {sum, 2 * num_from_behind > n * n, num_rays / sum_of_inverse_distances};
}

}  // namespace pfseq
