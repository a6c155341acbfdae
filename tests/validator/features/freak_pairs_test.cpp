// SPDX-License-Identifier: Apache-2.0
// The table as it ships.
#include "renderer/core/file.h"
#include "validator/features/freak.h"
#include "validator/features/freak_training.h"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(FreakPairs, AreDifferentAndOfThePattern) {
  std::set<std::pair<int, int>> pairs;
  for (const FreakPair& pair : kFreakPairs) {
    EXPECT_LT(pair.first, kNumFreakFields);
    EXPECT_GE(pair.second, 0);
    EXPECT_LT(pair.second, pair.first);
    pairs.emplace(pair.first, pair.second);
  }
  EXPECT_EQ(pairs.size(), static_cast<size_t>(kNumFreakPairs));
}

TEST(FreakPairs, UseEveryField) {
  std::set<int> fields;
  for (const FreakPair& pair : kFreakPairs) {
    fields.insert(pair.first);
    fields.insert(pair.second);
  }
  EXPECT_EQ(fields.size(), static_cast<size_t>(kNumFreakFields));
}

TEST(FreakPairs, TheFileIsWhatTheTrainingWrites) {
  FreakTraining training;
  training.num_points = 12121;
  training.max_correlation = 0.62;
  for (const FreakPair& pair : kFreakPairs) {
    training.pairs.push_back({pair.first, pair.second});
  }
  const std::string text =
      FreakPairsSource(training,
                       "frames 8 and 30 of data/sequences/pfseq.yaml with scene.canyon.seed=7, "
                       "image.size_px=600\n// (see data/README.md)");
  EXPECT_EQ(text, ReadFile(std::string(PFSEQ_SOURCE_DIR) + "/validator/features/freak_pairs.cpp"));
}

}  // namespace
}  // namespace pfseq
