// SPDX-License-Identifier: Apache-2.0
// Eight numbers at a time in an AVX register, and vectors and colours of them. Only operations that
// IEEE 754 defines to the last bit, so that every processor gives the same.
#pragma once

#include "renderer/core/vector.h"

#include <array>
#include <cstdint>

#include <immintrin.h>

namespace pfseq {

inline constexpr int kSimdWidth = 8;

/// Yes or no for each lane.
class Mask8 {
 public:
  Mask8() : bits_(_mm256_setzero_ps()) {}
  explicit Mask8(__m256 bits) : bits_(bits) {}
  /// Bit i of `bits` is lane i.
  static Mask8 FromBits(uint32_t bits) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i chosen = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane);
    return Mask8(_mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, lane)));
  }
  uint32_t Bits() const { return static_cast<uint32_t>(_mm256_movemask_ps(bits_)); }
  __m256 Register() const { return bits_; }

  friend Mask8 operator&(Mask8 a, Mask8 b) { return Mask8(_mm256_and_ps(a.bits_, b.bits_)); }
  friend Mask8 operator|(Mask8 a, Mask8 b) { return Mask8(_mm256_or_ps(a.bits_, b.bits_)); }

 private:
  __m256 bits_;
};

/// Eight floats.
class Float8 {
 public:
  Float8() : value_(_mm256_setzero_ps()) {}
  // A number stands for eight of it, as in formulas.
  Float8(float value) : value_(_mm256_set1_ps(value)) {}  // NOLINT(google-explicit-constructor)
  explicit Float8(__m256 value) : value_(value) {}
  explicit Float8(const std::array<float, kSimdWidth>& values)
      : value_(_mm256_loadu_ps(values.data())) {}

  std::array<float, kSimdWidth> Values() const {
    std::array<float, kSimdWidth> values;
    _mm256_storeu_ps(values.data(), value_);
    return values;
  }
  __m256 Register() const { return value_; }

  friend Float8 operator+(Float8 a, Float8 b) { return Float8(_mm256_add_ps(a.value_, b.value_)); }
  friend Float8 operator-(Float8 a, Float8 b) { return Float8(_mm256_sub_ps(a.value_, b.value_)); }
  friend Float8 operator*(Float8 a, Float8 b) { return Float8(_mm256_mul_ps(a.value_, b.value_)); }
  friend Float8 operator/(Float8 a, Float8 b) { return Float8(_mm256_div_ps(a.value_, b.value_)); }
  friend Float8 operator-(Float8 a) {
    return Float8(_mm256_xor_ps(a.value_, _mm256_set1_ps(-0.0F)));
  }
  friend Mask8 operator<(Float8 a, Float8 b) {
    return Mask8(_mm256_cmp_ps(a.value_, b.value_, _CMP_LT_OQ));
  }
  friend Mask8 operator>(Float8 a, Float8 b) { return b < a; }

 private:
  __m256 value_;
};

/// As std::max and std::min: `b` where one is not a number.
inline Float8 Max(Float8 a, Float8 b) { return Float8(_mm256_max_ps(a.Register(), b.Register())); }
inline Float8 Min(Float8 a, Float8 b) { return Float8(_mm256_min_ps(a.Register(), b.Register())); }
inline Float8 Sqrt(Float8 a) { return Float8(_mm256_sqrt_ps(a.Register())); }
/// `yes` where the mask is set, else `no`.
inline Float8 Select(Mask8 mask, Float8 yes, Float8 no) {
  return Float8(_mm256_blendv_ps(no.Register(), yes.Register(), mask.Register()));
}
/// The size of `a` with the sign of `b`.
inline Float8 CopySign(Float8 a, Float8 b) {
  const __m256 sign = _mm256_set1_ps(-0.0F);
  return Float8(
      _mm256_or_ps(_mm256_andnot_ps(sign, a.Register()), _mm256_and_ps(sign, b.Register())));
}

/// Sine and cosine of 2 pi t for t in [0, 1], to 2e-7: the Taylor series within an eighth of a turn
/// about the nearest quarter.
inline void SinCosOfTurn(Float8 t, Float8& sine, Float8& cosine) {
  const __m256i quarter = _mm256_cvtps_epi32(_mm256_mul_ps(t.Register(), _mm256_set1_ps(4.0F)));
  constexpr float kTurn = 6.28318530717958647692F;
  const Float8 angle = (t - Float8(_mm256_cvtepi32_ps(quarter)) * 0.25F) * kTurn;
  const Float8 squared = angle * angle;
  const Float8 s =
      angle *
      ((((squared * (1.0F / 362880.0F) - 1.0F / 5040.0F) * squared + 1.0F / 120.0F) * squared -
        1.0F / 6.0F) *
           squared +
       1.0F);
  const Float8 c =
      (((squared * (1.0F / 40320.0F) - 1.0F / 720.0F) * squared + 1.0F / 24.0F) * squared - 0.5F) *
          squared +
      1.0F;
  const auto bit = [&](int value) {
    const __m256i chosen = _mm256_set1_epi32(value);
    return Mask8(
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_and_si256(quarter, chosen), chosen)));
  };
  const Mask8 is_odd = bit(1);
  const Mask8 is_second_half = bit(2);
  const Float8 sine_size = Select(is_odd, c, s);
  const Float8 cosine_size = Select(is_odd, -s, c);
  sine = Select(is_second_half, -sine_size, sine_size);
  cosine = Select(is_second_half, -cosine_size, cosine_size);
}

/// Eight vectors, component by component.
struct Vec3x8 {
  Float8 x;
  Float8 y;
  Float8 z;

  friend Vec3x8 operator+(const Vec3x8& a, const Vec3x8& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vec3x8 operator-(const Vec3x8& a, const Vec3x8& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vec3x8 operator*(Float8 scale, const Vec3x8& a) {
    return {scale * a.x, scale * a.y, scale * a.z};
  }
};

inline Float8 Dot(const Vec3x8& a, const Vec3x8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x8 Normalized(const Vec3x8& a) { return (1.0F / Sqrt(Dot(a, a))) * a; }

/// Eight colours, channel by channel.
struct Rgb8 {
  Float8 r;
  Float8 g;
  Float8 b;

  friend Rgb8 operator+(const Rgb8& a, const Rgb8& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
  friend Rgb8 operator-(const Rgb8& a, const Rgb8& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
  friend Rgb8 operator*(const Rgb8& a, const Rgb8& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
  friend Rgb8 operator*(Float8 scale, const Rgb8& a) {
    return {scale * a.r, scale * a.g, scale * a.b};
  }
};

inline Rgb8 Max(const Rgb8& a, const Rgb8& b) {
  return {Max(a.r, b.r), Max(a.g, b.g), Max(a.b, b.b)};
}
inline Rgb8 Select(Mask8 mask, const Rgb8& yes, const Rgb8& no) {
  return {Select(mask, yes.r, no.r), Select(mask, yes.g, no.g), Select(mask, yes.b, no.b)};
}
inline Rgb8 Broadcast(const Rgb& color) { return {color[0], color[1], color[2]}; }
/// Eight colours one after the other as channels, and back.
inline Rgb8 Transposed(const std::array<Rgb, kSimdWidth>& colors) {
  std::array<std::array<float, kSimdWidth>, 3> channels;
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    for (size_t channel = 0; channel < 3; ++channel) {
      channels[channel][lane] = colors[lane][static_cast<Eigen::Index>(channel)];
    }
  }
  return {Float8(channels[0]), Float8(channels[1]), Float8(channels[2])};
}
inline std::array<Rgb, kSimdWidth> Transposed(const Rgb8& colors) {
  const std::array<float, kSimdWidth> r = colors.r.Values();
  const std::array<float, kSimdWidth> g = colors.g.Values();
  const std::array<float, kSimdWidth> b = colors.b.Values();
  std::array<Rgb, kSimdWidth> each;
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    each[lane] = Rgb(r[lane], g[lane], b[lane]);
  }
  return each;
}

inline Vec3x8 Broadcast(const Vec3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// As Luminance of one colour.
inline Float8 Luminance(const Rgb8& color) {
  return 0.2126F * color.r + 0.7152F * color.g + 0.0722F * color.b;
}

}  // namespace pfseq
