// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_record.h"

#include "renderer/trace/color.h"

#include <algorithm>
#include <cstring>

#include <immintrin.h>

namespace pfseq {
namespace {

Eigen::Array4f FloatsFromHalves(const uint16_t* halves) {
  const __m128i bits = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(halves));
  Eigen::Array4f values;
  _mm_storeu_ps(values.data(), _mm_cvtph_ps(bits));
  return values;
}

void HalvesFromFloats(const Eigen::Array4f& values, uint16_t* halves) {
  constexpr float kLargestHalf = 65504.0F;
  const Eigen::Array4f clamped = values.max(-kLargestHalf).min(kLargestHalf);
  const __m128i bits =
      _mm_cvtps_ph(_mm_loadu_ps(clamped.data()), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  std::memcpy(halves, &bits, 4 * sizeof(uint16_t));
}

}  // namespace

LightRecord::LightRecord(const GatheredLight& gathered,
                         const Vec3f& normal,
                         bool is_beside_body) {
  HalvesFromFloats(gathered.light.x, &halves_[0]);
  HalvesFromFloats(gathered.light.y, &halves_[4]);
  HalvesFromFloats(gathered.light.z, &halves_[8]);
  halves_[kStateIdx] = static_cast<uint16_t>(State::kReady);
  halves_[kFlagsIdx] = static_cast<uint16_t>((gathered.is_buried ? kBuried : 0) |
                                             (is_beside_body ? kBesideBody : 0));
  // The bits of a positive half count up as its logarithm does, but for the bend within a stop.
  const VectorIrradiance& light = gathered.light;
  const Eigen::Array4f irradiance = normal.x() * light.x + normal.y() * light.y + normal.z() * light.z;
  std::array<uint16_t, 4> level;
  HalvesFromFloats(
      Eigen::Array4f::Constant(std::max(0.0F, Luminance(Rgb(irradiance.head<3>())))), level.data());
  halves_[kLevelIdx] = level[0];
}

bool LightRecord::MarkWanted() {
  auto expected = static_cast<uint16_t>(State::kEmpty);
  return std::atomic_ref<uint16_t>(halves_[kStateIdx])
      .compare_exchange_strong(
          expected, static_cast<uint16_t>(State::kWanted), std::memory_order_relaxed);
}

bool LightRecord::Publish(const LightRecord& computed) {
  for (size_t i = 0; i < halves_.size(); ++i) {
    if (i != kStateIdx) {
      std::atomic_ref<uint16_t>(halves_[i]).store(computed.halves_[i], std::memory_order_relaxed);
    }
  }
  const uint16_t before =
      std::atomic_ref<uint16_t>(halves_[kStateIdx])
          .exchange(static_cast<uint16_t>(State::kReady), std::memory_order_acq_rel);
  return State{before} != State::kReady;
}

void LightRecord::AddTo(float weight, VectorIrradiance& light) const {
  light.x += weight * FloatsFromHalves(&halves_[0]);
  light.y += weight * FloatsFromHalves(&halves_[4]);
  light.z += weight * FloatsFromHalves(&halves_[8]);
}

}  // namespace pfseq
