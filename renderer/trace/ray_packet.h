// SPDX-License-Identifier: Apache-2.0
// Eight rays at a time, in float, for shading: four times the rate of single rays where neighbours
// go the same way. Ground truth uses RayScene's single rays or its exact packets.
#pragma once

#include "renderer/core/simd.h"
#include "renderer/core/vector.h"

#include <array>
#include <cstdint>

namespace pfseq {

inline constexpr int kPacketSize = kSimdWidth;
inline constexpr uint32_t kAllLanes = (1U << kPacketSize) - 1U;

/// Rays from origins along unit directions. Bit i of `active` says whether ray i is traced.
struct RayPacket {
  alignas(32) std::array<float, kPacketSize> origin_x_m{};
  alignas(32) std::array<float, kPacketSize> origin_y_m{};
  alignas(32) std::array<float, kPacketSize> origin_z_m{};
  alignas(32) std::array<float, kPacketSize> direction_x{};
  alignas(32) std::array<float, kPacketSize> direction_y{};
  alignas(32) std::array<float, kPacketSize> direction_z{};
  uint32_t active = 0;

  void Set(int i, const Vec3f& origin_m, const Vec3f& direction) {
    const auto lane = static_cast<size_t>(i);
    origin_x_m[lane] = origin_m.x();
    origin_y_m[lane] = origin_m.y();
    origin_z_m[lane] = origin_m.z();
    direction_x[lane] = direction.x();
    direction_y[lane] = direction.y();
    direction_z[lane] = direction.z();
    active |= 1U << i;
  }
  bool IsActive(int i) const { return (active >> i & 1U) != 0; }
  Vec3f Origin(int i) const {
    const auto lane = static_cast<size_t>(i);
    return {origin_x_m[lane], origin_y_m[lane], origin_z_m[lane]};
  }
  Vec3f Direction(int i) const {
    const auto lane = static_cast<size_t>(i);
    return {direction_x[lane], direction_y[lane], direction_z[lane]};
  }
};

inline RayPacket MakeRayPacket(const Vec3x8& origins_m, const Vec3x8& directions, uint32_t active) {
  return {origins_m.x.Values(),
          origins_m.y.Values(),
          origins_m.z.Values(),
          directions.x.Values(),
          directions.y.Values(),
          directions.z.Values(),
          active};
}

/// Where one ray of a packet meets the scene, in the ray tracer's float arithmetic.
struct PacketHit {
  uint32_t mesh_idx = 0;
  uint32_t triangle_idx = 0;
  float distance_m = 0.0F;
  /// Barycentric weights of the triangle's second and third vertex.
  float u = 0.0F;
  float v = 0.0F;
};

/// The nearest hits of a packet. Bit i of `hit` says whether ray i met anything.
struct HitPacket {
  alignas(32) std::array<uint32_t, kPacketSize> mesh_idx;
  alignas(32) std::array<uint32_t, kPacketSize> triangle_idx;
  alignas(32) std::array<float, kPacketSize> distance_m;
  alignas(32) std::array<float, kPacketSize> u;
  alignas(32) std::array<float, kPacketSize> v;
  uint32_t hit = 0;

  bool IsHit(int i) const { return (hit >> i & 1U) != 0; }
  PacketHit Of(int i) const {
    const auto lane = static_cast<size_t>(i);
    return {mesh_idx[lane], triangle_idx[lane], distance_m[lane], u[lane], v[lane]};
  }
};

/// Whether the rays of a packet go nearly the same way, which decides how they are traced.
enum class Coherence { kCoherent, kIncoherent };

}  // namespace pfseq
