// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/trace/light_gatherer.h"
#include "renderer/trace/vector_irradiance.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace pfseq {

/// One place's stored light in 24 bytes: three times red, green, blue in half precision, of x, y
/// and z of the vector; the fourth of the first three is the state, that of the second 1 if the
/// record is buried in a body, that of the third 1 if its regular place is. Any number of threads
/// may ask for the state and publish.
class LightRecord {
 public:
  enum class State : uint16_t { kEmpty = 0, kWanted = 1, kReady = 2 };

  LightRecord() = default;
  /// Ready.
  LightRecord(const GatheredLight& gathered, bool is_beside_body);

  State GetState() const {
    return State{std::atomic_ref<uint16_t>(const_cast<uint16_t&>(halves_[kStateIdx]))
                     .load(std::memory_order_acquire)};
  }
  bool IsReady() const { return GetState() == State::kReady; }
  bool IsBuried() const { return halves_[kBuriedIdx] != 0; }
  /// A body runs into the face hereabouts.
  bool IsBesideBody() const { return halves_[kBesideBodyIdx] != 0; }

  /// Makes an empty record a wanted one; false if it was not empty.
  bool MarkWanted();

  /// Takes over a ready one; false if this was ready before. Who sees the state sees the rest.
  bool Publish(const LightRecord& computed);

  void AddTo(float weight, VectorIrradiance& light) const;

 private:
  static constexpr size_t kStateIdx = 3;
  static constexpr size_t kBuriedIdx = 7;
  static constexpr size_t kBesideBodyIdx = 11;

  std::array<uint16_t, 12> halves_{};
};

}  // namespace pfseq
