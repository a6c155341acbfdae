// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/simd.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr std::array<float, kSimdWidth> kRising = {
    -3.0F, -2.0F, -1.0F, 0.0F, 1.0F, 2.0F, 3.0F, 4.0F};

TEST(Simd, SineAndCosineOfAllPartsOfATurn) {
  constexpr int kNumSteps = 1000;
  for (int i = 0; i <= kNumSteps; ++i) {
    const float turn = static_cast<float>(i) / kNumSteps;
    Float8 sine;
    Float8 cosine;
    SinCosOfTurn(turn, sine, cosine);
    const double angle_rad = 2.0 * std::numbers::pi * turn;
    EXPECT_NEAR(sine.Values()[0], std::sin(angle_rad), 4e-7) << turn;
    EXPECT_NEAR(cosine.Values()[7], std::cos(angle_rad), 4e-7) << turn;
  }
}

TEST(Simd, MaskChoosesByLane) {
  const Mask8 mask = Mask8::FromBits(0b10100110);
  EXPECT_EQ(mask.Bits(), 0b10100110U);
  const std::array<float, kSimdWidth> chosen = Select(mask, Float8(kRising), 9.0F).Values();
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    EXPECT_EQ(chosen[lane], (0b10100110U >> lane & 1U) != 0 ? kRising[lane] : 9.0F);
  }
  EXPECT_EQ((Float8(kRising) < 0.0F).Bits(), 0b00000111U);
  EXPECT_EQ((Float8(kRising) > 0.0F).Bits(), 0b11110000U);
}

TEST(Simd, CopySignKeepsTheSize) {
  const std::array<float, kSimdWidth> values = CopySign(-2.5F, Float8(kRising)).Values();
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    EXPECT_EQ(values[lane], std::copysign(2.5F, kRising[lane]));
  }
}

TEST(Simd, ColoursAreTransposedAndBack) {
  std::array<Rgb, kSimdWidth> colors;
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    const auto start = static_cast<float>(3 * lane);
    colors[lane] = Rgb(start, start + 1.0F, start + 2.0F);
  }
  const Rgb8 channels = Transposed(colors);
  EXPECT_EQ(channels.r.Values()[2], 6.0F);
  EXPECT_EQ(channels.b.Values()[7], 23.0F);
  const std::array<Rgb, kSimdWidth> back = Transposed(channels);
  for (size_t lane = 0; lane < kSimdWidth; ++lane) {
    EXPECT_TRUE((back[lane] == colors[lane]).all()) << lane;
  }
}

}  // namespace
}  // namespace pfseq
