// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/nearest_kernel.h"

#include <cmath>
#include <cstring>

namespace pfseq {
namespace {

constexpr int kLanes = 1;
constexpr int kQueries = 1;
constexpr int kGroups = 1;

using Ints = int32_t;

inline Ints Load(const void* from) {
  int32_t value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
inline void Store(int32_t* to, Ints value) { *to = value; }
inline Ints Set1(int32_t value) { return value; }
inline Ints LaneIdx() { return 0; }
inline Ints Add(Ints a, Ints b) { return a + b; }
inline Ints Min(Ints a, Ints b) { return a < b ? a : b; }
inline Ints Max(Ints a, Ints b) { return a > b ? a : b; }
inline Ints ChooseIfGreater(Ints a, Ints b, Ints if_greater, Ints otherwise) {
  return a > b ? if_greater : otherwise;
}
inline float AsFloat(Ints bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

struct BytesMetric {
  using Sum = int32_t;
  static Sum Zero() { return 0; }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return sum + static_cast<int16_t>(a) * static_cast<int16_t>(b) + (a >> 16) * (b >> 16);
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) { return a_norm + b_norm - 2 * sum; }
};

/// Fused products like the other kernels', for the same bits.
struct FloatsMetric {
  using Sum = float;
  static Sum Zero() { return 0.0F; }
  static Sum Step(Sum sum, Ints a, Ints b) { return std::fma(AsFloat(a), AsFloat(b), sum); }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    const float distance = std::fma(-2.0F, sum, AsFloat(a_norm) + AsFloat(b_norm));
    return Load(distance > 0.0F ? &distance : &kNone);
  }
  static constexpr float kNone = 0.0F;
};

struct HammingMetric {
  using Sum = int32_t;
  static Sum Zero() { return 0; }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return sum + __builtin_popcount(static_cast<uint32_t>(a ^ b));
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) { return sum + a_norm + b_norm; }
};

struct Hamming2Metric : HammingMetric {
  static Sum Step(Sum sum, Ints a, Ints b) {
    const auto bits = static_cast<uint32_t>(a ^ b);
    return sum + __builtin_popcount((bits | (bits >> 1)) & 0x55555555U);
  }
};

#include "validator/matching/nearest_kernel.inl"

}  // namespace

const Kernel kPlainKernel = {"plain", kLanes, kQueries, kGroups, false, Compare};

}  // namespace pfseq
