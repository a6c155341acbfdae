// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/nearest_kernel.h"

#include <immintrin.h>

namespace pfseq {
namespace {

constexpr int kLanes = 8;
constexpr int kQueries = 4;
constexpr int kGroups = 2;  // With four queries they fill the sixteen registers.

using Ints = __m256i;

inline Ints Load(const void* from) { return _mm256_loadu_si256(static_cast<const __m256i*>(from)); }
inline void Store(int32_t* to, Ints value) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), value);
}
inline Ints Set1(int32_t value) { return _mm256_set1_epi32(value); }
inline Ints LaneIdx() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
inline Ints Add(Ints a, Ints b) { return _mm256_add_epi32(a, b); }
inline Ints Min(Ints a, Ints b) { return _mm256_min_epi32(a, b); }
inline Ints Max(Ints a, Ints b) { return _mm256_max_epi32(a, b); }
inline Ints ChooseIfGreater(Ints a, Ints b, Ints if_greater, Ints otherwise) {
  return _mm256_blendv_epi8(otherwise, if_greater, _mm256_cmpgt_epi32(a, b));
}

/// |a - b|^2 = |a|^2 + |b|^2 - 2 a.b
struct BytesMetric {
  using Sum = __m256i;
  static Sum Zero() { return _mm256_setzero_si256(); }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return _mm256_add_epi32(sum, _mm256_madd_epi16(a, b));
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    return _mm256_sub_epi32(_mm256_add_epi32(a_norm, b_norm), _mm256_slli_epi32(sum, 1));
  }
};

struct FloatsMetric {
  using Sum = __m256;
  static Sum Zero() { return _mm256_setzero_ps(); }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return _mm256_fmadd_ps(_mm256_castsi256_ps(a), _mm256_castsi256_ps(b), sum);
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    const __m256 norms = _mm256_add_ps(_mm256_castsi256_ps(a_norm), _mm256_castsi256_ps(b_norm));
    const __m256 distance = _mm256_fnmadd_ps(_mm256_set1_ps(2.0F), sum, norms);
    return _mm256_castps_si256(_mm256_max_ps(distance, _mm256_setzero_ps()));
  }
};

/// Bits set in each byte, by looking up its two halves (Mula, Kurz, Lemire 2018, "Faster population
/// counts using AVX2 instructions").
inline __m256i BitsPerByte(__m256i bits) {
  const __m256i table = _mm256_setr_epi8(0,
                                         1,
                                         1,
                                         2,
                                         1,
                                         2,
                                         2,
                                         3,
                                         1,
                                         2,
                                         2,
                                         3,
                                         2,
                                         3,
                                         3,
                                         4,  //
                                         0,
                                         1,
                                         1,
                                         2,
                                         1,
                                         2,
                                         2,
                                         3,
                                         1,
                                         2,
                                         2,
                                         3,
                                         2,
                                         3,
                                         3,
                                         4);
  const __m256i low = _mm256_set1_epi8(0x0f);
  return _mm256_add_epi8(
      _mm256_shuffle_epi8(table, _mm256_and_si256(bits, low)),
      _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(bits, 4), low)));
}

/// Sums bytes, so 31 words (992 bits) at most: the caller splits nothing, it refuses longer rows.
struct HammingMetric {
  using Sum = __m256i;
  static Sum Zero() { return _mm256_setzero_si256(); }
  static Sum Step(Sum sum, Ints a, Ints b) {
    return _mm256_add_epi8(sum, BitsPerByte(_mm256_xor_si256(a, b)));
  }
  static Ints Distance(Sum sum, Ints a_norm, Ints b_norm) {
    const __m256i words =
        _mm256_madd_epi16(_mm256_maddubs_epi16(sum, _mm256_set1_epi8(1)), _mm256_set1_epi16(1));
    return _mm256_add_epi32(words, _mm256_add_epi32(a_norm, b_norm));
  }
};

struct Hamming2Metric : HammingMetric {
  static Sum Step(Sum sum, Ints a, Ints b) {
    const __m256i bits = _mm256_xor_si256(a, b);
    const __m256i symbols =
        _mm256_and_si256(_mm256_or_si256(bits, _mm256_srli_epi16(bits, 1)), _mm256_set1_epi8(0x55));
    return _mm256_add_epi8(sum, BitsPerByte(symbols));
  }
};

#include "validator/matching/nearest_kernel.inl"

}  // namespace

const Kernel kAvx2Kernel = {"AVX2", kLanes, kQueries, kGroups, false, Compare};

}  // namespace pfseq
