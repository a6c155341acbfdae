// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sampler.h"

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

}  // namespace

SobolPoint Sobol2D(uint32_t index) {
  return {ReverseBits(index), ReverseBits(ReversedPascal(index))};
}

uint32_t NestedUniformScramble(uint32_t bits, uint32_t seed) {
  return ReverseBits(ScrambleReversed(ReverseBits(bits), seed));
}

double PixelSampler::Get1D() { return Get2D().x(); }

Vec2d PixelSampler::Get2D() {
  const uint64_t hash = HashKey({key_, draw_idx_++});
  const uint64_t more_hash = MixBits(hash + 0x9e3779b97f4a7c15ULL);
  const uint32_t index = NestedUniformScramble(sample_idx_, static_cast<uint32_t>(hash));
  // As Sobol2D and two scramblings, less the reversals that cancel.
  const uint32_t x = ReverseBits(ScrambleReversed(index, static_cast<uint32_t>(hash >> 32)));
  const uint32_t y =
      ReverseBits(ScrambleReversed(ReversedPascal(index), static_cast<uint32_t>(more_hash)));
  return {x * 0x1.0p-32, y * 0x1.0p-32};
}

}  // namespace pfseq
