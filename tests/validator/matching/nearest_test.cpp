// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/nearest.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Few different values, so that equal distances are common.
Descriptors RandomRows(int num_rows, int num_columns, Norm norm, bool is_float, uint64_t seed) {
  Descriptors descriptors;
  descriptors.norm = norm;
  descriptors.rows = cv::Mat(num_rows, num_columns, is_float ? CV_32F : CV_8U);
  RandomStream random{seed};
  for (int row = 0; row < num_rows; ++row) {
    descriptors.key_point_idx.push_back(row);
    for (int i = 0; i < num_columns; ++i) {
      if (is_float) {
        // Exact in single precision, whatever the order of sums.
        descriptors.rows.at<float>(row, i) = static_cast<float>(random.Integer(-8, 8)) / 4.0F;
      } else {
        descriptors.rows.at<uint8_t>(row, i) =
            static_cast<uint8_t>(random.Chance(0.5) ? random.Integer(0, 255) : 255);
      }
    }
  }
  return descriptors;
}

double PlainDistance(const Descriptors& a, int i, const Descriptors& b, int j) {
  double sum = 0.0;
  for (int k = 0; k < a.rows.cols; ++k) {
    if (a.rows.type() == CV_32F) {
      sum += std::pow(a.rows.at<float>(i, k) - b.rows.at<float>(j, k), 2);
      continue;
    }
    const int x = a.rows.at<uint8_t>(i, k), y = b.rows.at<uint8_t>(j, k);
    if (a.norm == Norm::kL2) {
      sum += (x - y) * (x - y);
      continue;
    }
    const int step = a.norm == Norm::kHamming ? 1 : 2;
    const int mask = (1 << step) - 1;
    for (int bit = 0; bit < 8; bit += step) {
      sum += ((x >> bit) & mask) != ((y >> bit) & mask) ? 1 : 0;
    }
  }
  return a.norm == Norm::kL2 ? std::sqrt(sum) : sum;
}

struct Case {
  std::string name;
  int columns;
  Norm norm;
  bool is_float;
};

std::vector<const Kernel*> KernelsOfThisProcessor() {
  std::vector<const Kernel*> kernels = {&kPlainKernel};
  if (&BestKernel() != &kPlainKernel) {
    kernels.push_back(&kAvx2Kernel);
  }
  if (&BestKernel() == &kAvx512Kernel) {
    kernels.push_back(&kAvx512Kernel);
  }
  return kernels;
}

class NearestOf : public testing::TestWithParam<Case> {
 protected:
  Descriptors Rows(int count, uint64_t seed) const {
    const Case& c = GetParam();
    return RandomRows(count, c.columns, c.norm, c.is_float, seed);
  }
};

TEST_P(NearestOf, IsTheDefinitionWithEachKernelAndThreadCount) {
  const Descriptors first = Rows(137, 1);
  const Descriptors second = Rows(61, 2);
  for (const Kernel* kernel : KernelsOfThisProcessor()) {
    for (const int num_threads : {1, 3}) {
      SCOPED_TRACE(kernel->name);
      const NearestTables tables = FindNearest(ClassedDescriptors::Whole(first),
                                               ClassedDescriptors::Whole(second),
                                               num_threads,
                                               *kernel);
      for (int i = 0; i < first.rows.rows; ++i) {
        std::vector<std::pair<double, int>> all;
        for (int j = 0; j < second.rows.rows; ++j) {
          all.emplace_back(PlainDistance(first, i, second, j), j);
        }
        std::sort(all.begin(), all.end());
        const Nearest& nearest = tables.of_first[0][i];
        ASSERT_EQ(nearest.idx, all[0].second);
        ASSERT_DOUBLE_EQ(DistanceFromKey(first, nearest.key), all[0].first);
        ASSERT_DOUBLE_EQ(DistanceFromKey(first, nearest.second_key), all[1].first);
      }
      for (int j = 0; j < second.rows.rows; ++j) {
        std::vector<std::pair<double, int>> all;
        for (int i = 0; i < first.rows.rows; ++i) {
          all.emplace_back(PlainDistance(first, i, second, j), i);
        }
        ASSERT_EQ(tables.of_second[0][j].idx, std::min_element(all.begin(), all.end())->second);
      }
    }
  }
}

TEST_P(NearestOf, ClassesAreThatOfTheSubsetsAlone) {
  const Descriptors first = Rows(90, 3);
  const Descriptors second = Rows(70, 4);
  ClassedDescriptors classed_first{&first, {}, 3}, classed_second{&second, {}, 2};
  RandomStream random{5};
  for (int i = 0; i < first.rows.rows; ++i) {
    classed_first.row_class.push_back(random.Integer(0, 2));
  }
  for (int i = 0; i < second.rows.rows; ++i) {
    classed_second.row_class.push_back(random.Integer(0, 1));
  }
  for (const Kernel* kernel : KernelsOfThisProcessor()) {
    const NearestTables tables = FindNearest(classed_first, classed_second, 2, *kernel);
    for (int second_class = 0; second_class < 2; ++second_class) {
      for (int i = 0; i < first.rows.rows; ++i) {
        std::pair<double, int> best(1e30, -1);
        for (int j = 0; j < second.rows.rows; ++j) {
          if (classed_second.row_class[j] == second_class) {
            best = std::min(best, {PlainDistance(first, i, second, j), j});
          }
        }
        ASSERT_EQ(tables.of_first[second_class][i].idx, best.second);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         NearestOf,
                         testing::Values(Case{"Sift", 128, Norm::kL2, false},
                                         Case{"OddBytes", 61, Norm::kL2, false},
                                         Case{"Orb", 32, Norm::kHamming, false},
                                         Case{"Akaze", 61, Norm::kHamming, false},
                                         Case{"Brisk", 64, Norm::kHamming, false},
                                         Case{"OrbOfThree", 32, Norm::kHamming2, false},
                                         Case{"Kaze", 64, Norm::kL2, true}),
                         [](const auto& tested) { return tested.param.name; });

TEST(Nearest, ExtremeBytesDoNotOverflow) {
  Descriptors black = RandomRows(3, 2048, Norm::kL2, false, 1);
  Descriptors white = RandomRows(2, 2048, Norm::kL2, false, 1);
  black.rows.setTo(0);
  white.rows.setTo(255);
  for (const Kernel* kernel : KernelsOfThisProcessor()) {
    const NearestTables tables =
        FindNearest(ClassedDescriptors::Whole(black), ClassedDescriptors::Whole(white), 1, *kernel);
    EXPECT_EQ(tables.of_first[0][2].idx, 0) << kernel->name;
    EXPECT_EQ(tables.of_first[0][2].key, 2048 * 255 * 255) << kernel->name;
  }
}

TEST(Nearest, EmptySetsAndSinglesHaveNoNeighbourOrNoSecond) {
  const Descriptors none = RandomRows(0, 32, Norm::kHamming, false, 1);
  const Descriptors one = RandomRows(1, 32, Norm::kHamming, false, 1);
  const NearestTables nothing =
      FindNearest(ClassedDescriptors::Whole(one), ClassedDescriptors::Whole(none), 1);
  EXPECT_EQ(nothing.of_first[0][0].idx, -1);
  const NearestTables self =
      FindNearest(ClassedDescriptors::Whole(one), ClassedDescriptors::Whole(one), 1);
  EXPECT_EQ(self.of_first[0][0].idx, 0);
  EXPECT_EQ(self.of_first[0][0].key, 0);
  EXPECT_EQ(self.of_first[0][0].second_key, std::numeric_limits<int32_t>::max());
}

}  // namespace
}  // namespace pfseq
