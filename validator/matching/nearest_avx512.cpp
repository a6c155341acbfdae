// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/nearest_kernel.h"

#include <immintrin.h>

namespace pfseq {
namespace {

constexpr int kLanes = 16;
constexpr int kQueries = 4;
constexpr int kGroups = 4;

using Ints = __m512i;

inline Ints Load(const void* from) { return _mm512_loadu_si512(from); }
inline void Store(int32_t* to, Ints value) { _mm512_storeu_si512(to, value); }
inline Ints Set1(int32_t value) { return _mm512_set1_epi32(value); }
inline Ints LaneIdx() {
  return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline Ints Add(Ints a, Ints b) { return _mm512_add_epi32(a, b); }
inline Ints Min(Ints a, Ints b) { return _mm512_min_epi32(a, b); }
inline Ints Max(Ints a, Ints b) { return _mm512_max_epi32(a, b); }
inline Ints ChooseIfGreater(Ints a, Ints b, Ints if_greater, Ints otherwise) {
  return _mm512_mask_mov_epi32(otherwise, _mm512_cmpgt_epi32_mask(a, b), if_greater);
}

/// Unsigned bytes of the first set times signed ones of the second, which is stored minus 128; the
/// first norm makes up for it: a.b = a.(b - 128) + 128 sum(a).
struct BytesMetric {
  using Sum = __m512i;
  static Sum Zero() { return _mm512_setzero_si512(); }
  static Sum Step(Sum sum, Ints a, Ints b) { return _mm512_dpbusd_epi32(sum, a, b); }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    return _mm512_sub_epi32(_mm512_add_epi32(a_norm, b_norm), _mm512_slli_epi32(sum, 1));
  }
};

struct FloatsMetric {
  using Sum = __m512;
  static Sum Zero() { return _mm512_setzero_ps(); }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return _mm512_fmadd_ps(_mm512_castsi512_ps(a), _mm512_castsi512_ps(b), sum);
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    const __m512 norms = _mm512_add_ps(_mm512_castsi512_ps(a_norm), _mm512_castsi512_ps(b_norm));
    const __m512 distance = _mm512_fnmadd_ps(_mm512_set1_ps(2.0F), sum, norms);
    return _mm512_castps_si512(_mm512_max_ps(distance, _mm512_setzero_ps()));
  }
};

struct HammingMetric {
  using Sum = __m512i;
  static Sum Zero() { return _mm512_setzero_si512(); }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return _mm512_add_epi32(sum, _mm512_popcnt_epi32(_mm512_xor_si512(a, b)));
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    return _mm512_add_epi32(sum, _mm512_add_epi32(a_norm, b_norm));
  }
};

struct Hamming2Metric : HammingMetric {
  static Sum Step(Sum sum, Ints a, Ints b) {
    const __m512i bits = _mm512_xor_si512(a, b);
    const __m512i symbols = _mm512_and_si512(_mm512_or_si512(bits, _mm512_srli_epi32(bits, 1)),
                                             _mm512_set1_epi32(0x55555555));
    return _mm512_add_epi32(sum, _mm512_popcnt_epi32(symbols));
  }
};

#include "validator/matching/nearest_kernel.inl"

}  // namespace

const Kernel kAvx512Kernel = {"AVX-512", kLanes, kQueries, kGroups, true, Compare};

}  // namespace pfseq
