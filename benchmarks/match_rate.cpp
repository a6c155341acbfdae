// SPDX-License-Identifier: Apache-2.0
// Exact nearest neighbours, both ways, against OpenCV's brute force: comparisons per CPU second,
// and the share of what the processor's instructions could do at best (the products or bit counts
// alone, in registers). Usage: match_rate [ROWS]
#include "renderer/core/random.h"
#include "validator/matching/nearest.h"

#include <cstdlib>
#include <ctime>
#include <string>

#include <fmt/format.h>
#include <immintrin.h>
#include <opencv2/features2d.hpp>

namespace {

using namespace pfseq;

constexpr int kOpenCvRows = 4000;  // Its time per comparison does not depend on the number.

double CpuS() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Descriptors RandomRows(int count, int columns, Norm norm, uint64_t seed) {
  Descriptors descriptors;
  descriptors.norm = norm;
  descriptors.rows = cv::Mat(count, columns, CV_8U);
  RandomStream random{seed};
  for (int row = 0; row < count; ++row) {
    for (int i = 0; i < columns; ++i) {
      descriptors.rows.at<uint8_t>(row, i) = static_cast<uint8_t>(random.Bits());
    }
  }
  return descriptors;
}

constexpr int kChains = 12;  // Independent sums, enough to hide each instruction's latency.
constexpr int kRounds = 20'000'000;

/// 512-bit vectors of work per second.
__attribute__((target("avx512f,avx512vnni,avx512vpopcntdq"))) double Avx512VectorsPerS(
    bool is_bits) {
  __m512i sums[kChains];
  for (__m512i& sum : sums) {
    sum = _mm512_set1_epi32(1);
  }
  __m512i operand = _mm512_set1_epi32(0x01020304);
  const double start_s = CpuS();
  for (int round = 0; round < kRounds; ++round) {
    __asm__ volatile("" : "+v"(operand));
#pragma GCC unroll 12
    for (__m512i& sum : sums) {
      sum = is_bits ? _mm512_add_epi32(sum, _mm512_popcnt_epi32(_mm512_xor_si512(sum, operand)))
                    : _mm512_dpbusd_epi32(sum, operand, operand);
    }
  }
  const double seconds = CpuS() - start_s;
  for (__m512i& sum : sums) {
    __asm__ volatile("" : "+v"(sum));
  }
  return static_cast<double>(kRounds) * kChains / seconds;
}

/// 256-bit vectors of work per second: pairwise 16-bit products, added up.
__attribute__((target("avx2"))) double Avx2ProductsPerS() {
  __m256i sums[kChains];
  for (__m256i& sum : sums) {
    sum = _mm256_set1_epi32(1);
  }
  __m256i operand = _mm256_set1_epi32(0x00010002);
  const double start_s = CpuS();
  for (int round = 0; round < kRounds; ++round) {
    __asm__ volatile("" : "+x"(operand));
#pragma GCC unroll 12
    for (__m256i& sum : sums) {
      sum = _mm256_add_epi32(sum, _mm256_madd_epi16(operand, operand));
      __asm__ volatile("" : "+x"(operand));
    }
  }
  const double seconds = CpuS() - start_s;
  for (__m256i& sum : sums) {
    __asm__ volatile("" : "+x"(sum));
  }
  return static_cast<double>(kRounds) * kChains / seconds;
}

double OpenCvPerS(const Descriptors& first, const Descriptors& second, int norm) {
  cv::setNumThreads(1);
  cv::Mat a = first.rows.rowRange(0, std::min(kOpenCvRows, first.rows.rows));
  cv::Mat b = second.rows.rowRange(0, std::min(kOpenCvRows, second.rows.rows));
  if (norm == cv::NORM_L2) {
    a.convertTo(a, CV_32F);
    b.convertTo(b, CV_32F);
  }
  std::vector<cv::DMatch> matches;
  const double start_s = CpuS();
  cv::BFMatcher(norm, true).match(a, b, matches);
  return static_cast<double>(a.rows) * b.rows / (CpuS() - start_s);
}

}  // namespace

int main(int argc, char** argv) {
  const int rows = argc > 1 ? std::max(2, std::atoi(argv[1])) : 20000;
  struct Case {
    const char* name;
    int columns;
    Norm norm;
    int cv_norm;
  };
  const bool has_avx512 = &BestKernel() == &kAvx512Kernel;
  const double products_512 = has_avx512 ? Avx512VectorsPerS(false) : 0.0;
  const double bits_512 = has_avx512 ? Avx512VectorsPerS(true) : 0.0;
  const double products_256 = Avx2ProductsPerS();
  fmt::print(
      "{} x {} rows, one thread; G comparisons per CPU second (both ways, best two)\n", rows, rows);
  fmt::print("{:<22}{:>10}{:>10}{:>10}{:>16}{:>18}\n",
             "",
             "OpenCV",
             "AVX2",
             "AVX-512",
             "of OpenCV (best)",
             "of limit (best)");
  for (const Case& c : {Case{"SIFT, 128 bytes", 128, Norm::kL2, cv::NORM_L2},
                        Case{"ORB, 256 bits", 32, Norm::kHamming, cv::NORM_HAMMING},
                        Case{"ORB WTA_K 3 and 4", 32, Norm::kHamming2, cv::NORM_HAMMING2},
                        Case{"BRISK, FREAK, 512 bits", 64, Norm::kHamming, cv::NORM_HAMMING}}) {
    const Descriptors first = RandomRows(rows, c.columns, c.norm, 1);
    const Descriptors second = RandomRows(rows, c.columns, c.norm, 2);
    const double opencv = OpenCvPerS(first, second, c.cv_norm);
    const auto rate = [&](const Kernel& kernel) {
      const double start_s = CpuS();
      FindNearest(ClassedDescriptors::Whole(first), ClassedDescriptors::Whole(second), 1, kernel);
      return static_cast<double>(rows) * rows / (CpuS() - start_s);
    };
    const double avx2 = rate(kAvx2Kernel);
    const double avx512 = has_avx512 ? rate(kAvx512Kernel) : 0.0;
    const double best = has_avx512 ? avx512 : avx2;
    // Vectors of work a comparison needs; the AVX2 bit count has no single instruction to compare.
    double limit = 0.0;
    if (has_avx512) {
      limit = (c.norm == Norm::kL2 ? products_512 : bits_512) / (c.columns / 64.0);
    } else if (c.norm == Norm::kL2) {
      limit = products_256 / (c.columns / 16.0);
    }
    fmt::print("{:<22}{:>10.4f}{:>10.3f}{:>10.3f}{:>15.0f}x{:>17}\n",
               c.name,
               opencv / 1e9,
               avx2 / 1e9,
               avx512 / 1e9,
               best / opencv,
               limit > 0.0 ? fmt::format("{:.0f} %", 100.0 * best / limit) : "-");
  }
  return 0;
}
