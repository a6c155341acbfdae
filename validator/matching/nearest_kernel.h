// SPDX-License-Identifier: Apache-2.0
// The inner loops of exact nearest neighbours, in plain pointers: compiled once for each
// instruction set, chosen at run time. No standard templates here, lest the linker takes their copy
// of a newer instruction set for the whole program.
//
// Distances are int32 keys that order as the distances do: squared Euclidean distances of bytes,
// numbers of differing bits or symbols, or the bits of a non-negative float.
#pragma once

#include <cstdint>

namespace pfseq {

enum class KernelMetric {
  kBytes,     ///< squared Euclidean: 4 bytes a word (second set minus 128), or 2 16-bit values
  kFloats,    ///< squared Euclidean: one float a word
  kHamming,   ///< 32 bits a word
  kHamming2,  ///< 16 symbols of two bits a word
};

/// Padding rows are this far from everything.
inline constexpr int32_t kFarInteger = 1 << 29;
inline constexpr float kFarFloat = 1e30F;

/// Two sets in the kernel's layout. A row is `num_words` words of 32 bits.
struct KernelSets {
  /// [row][word], rows padded to a multiple of KernelSize::num_queries.
  const uint32_t* first = nullptr;
  /// Added to the distance (squared norms; floats as bits).
  const int32_t* first_norm = nullptr;
  /// [group][word][lane], groups padded to a multiple of KernelSize::num_groups.
  const uint32_t* second = nullptr;
  const int32_t* second_norm = nullptr;
  int num_words = 0;
};

/// Rows [begin_row, end_row) of the first set against groups [begin_group, end_group) of the
/// second.
struct KernelTile {
  int begin_row = 0;
  int end_row = 0;
  int begin_group = 0;
  int end_group = 0;
};

/// Best so far; all arrays are read and written.
struct KernelBest {
  /// [row - begin_row][lane]: least and second least distance, and whose the least is.
  int32_t* first_distance = nullptr;
  int32_t* first_second = nullptr;
  int32_t* first_idx = nullptr;
  /// [row of the second set]
  int32_t* second_distance = nullptr;
  int32_t* second_idx = nullptr;
};

struct Kernel {
  const char* name;
  int num_lanes;
  int num_queries;
  int num_groups;
  /// Whether kBytes takes 4 bytes a word (else two 16-bit values).
  bool packs_bytes;
  void (*compare)(KernelMetric, const KernelSets&, const KernelTile&, const KernelBest&);
};

/// Plain C++, for any processor.
extern const Kernel kPlainKernel;
extern const Kernel kAvx2Kernel;
/// AVX-512 with VNNI and VPOPCNTDQ.
extern const Kernel kAvx512Kernel;

}  // namespace pfseq
