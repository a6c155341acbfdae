// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sampler.h"

#include <array>
#include <bit>

namespace pfseq {
namespace {

constexpr uint32_t ReverseBits(uint32_t bits) {
  bits = ((bits >> 1) & 0x55555555U) | ((bits & 0x55555555U) << 1);
  bits = ((bits >> 2) & 0x33333333U) | ((bits & 0x33333333U) << 2);
  bits = ((bits >> 4) & 0x0f0f0f0fU) | ((bits & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(bits);
}

/// Nested uniform scrambling of a fraction whose bits are in reverse order, so that each bit
/// depends on those below it: the permutation of Laine and Karras 2011, "Stratified sampling for
/// stochastic transparency", with the constants of Vegdahl 2021, "Building a better LK hash".
constexpr uint32_t ScrambleReversed(uint32_t bits, uint32_t seed) {
  bits ^= bits * 0x3d20adeaU;
  bits += seed;
  bits *= (seed >> 16) | 1U;
  bits ^= bits * 0x05526c56U;
  bits ^= bits * 0x53a22864U;
  return bits;
}

/// Dimension 1 of the Sobol sequence with its bits in reverse order. Bit j of the result is the sum
/// modulo 2 of binomial(k, j) times bit k of the index; binomial(k, j) is odd just where the bits
/// of j are among those of k (Lucas 1878), so the sum over all k is made in five steps, one for
/// each bit of k.
constexpr uint32_t ReversedPascal(uint32_t index) {
  index ^= (index & 0xaaaaaaaaU) >> 1;
  index ^= (index & 0xccccccccU) >> 2;
  index ^= (index & 0xf0f0f0f0U) >> 4;
  index ^= (index & 0xff00ff00U) >> 8;
  index ^= (index & 0xffff0000U) >> 16;
  return index;
}

/// Where the bits of an index stand in dimension 2, each with its bits in reverse order.
constexpr std::array<uint32_t, 32> kThirdDirections = [] {
  // m_k = 2 m_(k-1) xor 4 m_(k-2) xor m_(k-2), of which the k-th has k bits before the point.
  std::array<uint32_t, 32> numbers{1, 3};
  std::array<uint32_t, 32> directions{};
  for (size_t k = 0; k < numbers.size(); ++k) {
    if (k >= 2) {
      numbers[k] = 2 * numbers[k - 1] ^ 4 * numbers[k - 2] ^ numbers[k - 2];
    }
    directions[k] = ReverseBits(numbers[k] << (31 - k));
  }
  return directions;
}();

constexpr uint32_t ReversedThird(uint32_t index) {
  uint32_t result = 0;
  for (uint32_t bits = index; bits != 0; bits &= bits - 1) {
    result ^= kThirdDirections[static_cast<size_t>(std::countr_zero(bits))];
  }
  return result;
}

/// A draw's point of the Sobol sequence: that of a shuffled index, each dimension scrambled. As
/// Sobol2D and NestedUniformScramble, less the reversals that cancel.
class Scrambled {
 public:
  Scrambled(uint64_t key, uint64_t draw_idx, uint32_t sample_idx)
      : hash_(HashKey({key, draw_idx})),
        more_hash_(MixBits(hash_ + 0x9e3779b97f4a7c15ULL)),
        index_(NestedUniformScramble(sample_idx, static_cast<uint32_t>(hash_))) {}

  Vec2d FirstTwo() const {
    return {Fraction(index_, hash_ >> 32), Fraction(ReversedPascal(index_), more_hash_)};
  }
  double Third() const { return Fraction(ReversedThird(index_), more_hash_ >> 32); }

 private:
  static double Fraction(uint32_t reversed_bits, uint64_t seed) {
    return ReverseBits(ScrambleReversed(reversed_bits, static_cast<uint32_t>(seed))) * 0x1.0p-32;
  }

  uint64_t hash_;
  uint64_t more_hash_;
  uint32_t index_;
};

}  // namespace

SobolPoint Sobol2D(uint32_t index) {
  return {ReverseBits(index), ReverseBits(ReversedPascal(index))};
}

uint32_t SobolThird(uint32_t index) { return ReverseBits(ReversedThird(index)); }

uint32_t NestedUniformScramble(uint32_t bits, uint32_t seed) {
  return ReverseBits(ScrambleReversed(ReverseBits(bits), seed));
}

double PixelSampler::Get1D() { return Get2D().x(); }

Vec2d PixelSampler::Get2D() { return Scrambled(key_, draw_idx_++, sample_idx_).FirstTwo(); }

Vec3d PixelSampler::Get3D() {
  const Scrambled sample(key_, draw_idx_++, sample_idx_);
  const Vec2d first_two = sample.FirstTwo();
  return {first_two.x(), first_two.y(), sample.Third()};
}

}  // namespace pfseq
