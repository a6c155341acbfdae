// SPDX-License-Identifier: Apache-2.0
// Random numbers without state: each number is a hash of what it is for, so results do not depend
// on the number of threads or the order of work.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace pfseq {

/// Mixes 64 bits so that each input bit flips each output bit with probability near one half.
/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators"), constants of Stafford's variant 13.
constexpr uint64_t MixBits(uint64_t bits) {
  bits ^= bits >> 30;
  bits *= 0xbf58476d1ce4e5b9ULL;
  bits ^= bits >> 27;
  bits *= 0x94d049bb133111ebULL;
  bits ^= bits >> 31;
  return bits;
}

/// Hash of a tuple of integers; the order matters.
constexpr uint64_t HashKey(std::initializer_list<uint64_t> key) {
  uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const uint64_t part : key) {
    hash = MixBits(hash + 0x9e3779b97f4a7c15ULL + part);
  }
  return hash;
}

/// Uniform in [0, 1), 53 bits, from a hash.
constexpr double UniformFromHash(uint64_t hash) {
  return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

/// A stream of numbers keyed by a hash: the n-th call gives MixBits of key and n. For generators of
/// content (streets, facades, textures), where a sequence of draws is wanted.
class RandomStream {
 public:
  explicit constexpr RandomStream(uint64_t key) : key_(key) {}
  constexpr RandomStream(std::initializer_list<uint64_t> key) : key_(HashKey(key)) {}

  constexpr uint64_t Bits() { return HashKey({key_, counter_++}); }

  /// Uniform in [0, 1).
  constexpr double Uniform() { return UniformFromHash(Bits()); }

  /// Uniform in [low, high).
  constexpr double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  /// Uniform integer in [low, high], both included.
  constexpr int Integer(int low, int high) {
    return low + static_cast<int>(Uniform() * (static_cast<double>(high) - low + 1.0));
  }

  /// True with the given probability.
  constexpr bool Chance(double probability) { return Uniform() < probability; }

 private:
  uint64_t key_;
  uint64_t counter_ = 0;
};

}  // namespace pfseq
