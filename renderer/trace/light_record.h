// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/trace/light_gatherer.h"
#include "renderer/trace/vector_irradiance.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace pfseq {

/// One place's stored light in 24 bytes: three times red, green, blue in half precision, of x, y
/// and z of the vector; the fourth of the first three is the state, that of the second says by its
/// bits whether the record is buried in a body and whether its regular place is, that of the third
/// is the level. Any number of threads may ask for the state and publish.
class LightRecord {
 public:
  enum class State : uint16_t { kEmpty = 0, kWanted = 1, kReady = 2 };

  LightRecord() = default;
  /// Ready. The normal is that of the surface, on the record's side.
  LightRecord(const GatheredLight& gathered, const Vec3f& normal, bool is_beside_body);

  State GetState() const {
    return State{std::atomic_ref<uint16_t>(const_cast<uint16_t&>(halves_[kStateIdx]))
                     .load(std::memory_order_acquire)};
  }
  bool IsReady() const { return GetState() == State::kReady; }
  bool IsBuried() const { return (halves_[kFlagsIdx] & kBuried) != 0; }
  /// A body runs into the face hereabouts.
  bool IsBesideBody() const { return (halves_[kFlagsIdx] & kBesideBody) != 0; }
  /// How bright the irradiance is, so that equal differences are about equal ratios: kLevelsPerStop
  /// for a factor of two.
  int Level() const { return halves_[kLevelIdx]; }
  static constexpr int kLevelsPerStop = 1024;

  /// Makes an empty record a wanted one; false if it was not empty.
  bool MarkWanted();

  /// Takes over a ready one; false if this was ready before. Who sees the state sees the rest.
  bool Publish(const LightRecord& computed);

  void AddTo(float weight, VectorIrradiance& light) const;

 private:
  static constexpr size_t kStateIdx = 3;
  static constexpr size_t kFlagsIdx = 7;
  static constexpr uint16_t kBuried = 1;
  static constexpr uint16_t kBesideBody = 2;
  static constexpr size_t kLevelIdx = 11;

  std::array<uint16_t, 12> halves_{};
};

}  // namespace pfseq
