// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/stage_store.h"

#include "renderer/core/file.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class StageStoreTest : public testing::Test {
 protected:
  static FamilyKeyPoints Points() {
    FamilyKeyPoints family;
    family.points = {cv::KeyPoint(1.5F, -2.25F, 7.0F, 33.0F, 0.125F, 513, 4),
                     cv::KeyPoint(100.0F, 200.0F, 31.0F, -1.0F, 80.0F, 0, -1)};
    family.members = {1, uint64_t{1} << 63U | 5U};
    return family;
  }

  TempFolder folder_;
  StageStore store_{folder_.Path()};
  std::string key_ = StageStore::KeyOf({"image", "SIFT"});
};

TEST_F(StageStoreTest, KeyPointsComeBackWithAllTheirValues) {
  const FamilyKeyPoints saved = Points();
  store_.SaveKeyPoints(key_, saved);
  const std::optional<FamilyKeyPoints> loaded = store_.LoadKeyPoints(key_);
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->points.size(), saved.points.size());
  EXPECT_EQ(loaded->members, saved.members);
  for (size_t i = 0; i < saved.points.size(); ++i) {
    const cv::KeyPoint& a = loaded->points[i];
    const cv::KeyPoint& b = saved.points[i];
    EXPECT_EQ(a.pt, b.pt);
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.angle, b.angle);
    EXPECT_EQ(a.response, b.response);
    EXPECT_EQ(a.octave, b.octave);
    EXPECT_EQ(a.class_id, b.class_id);
  }
}

TEST_F(StageStoreTest, MatchesComeBackListByList) {
  const MatchLists saved = {{{1, 2}, {3, 4}}, {}, {{5, 60000}}};
  store_.SaveMatches(key_, saved);
  EXPECT_EQ(store_.LoadMatches(key_), saved);
  // Nothing found is a result too.
  store_.SaveMatches(key_, {});
  EXPECT_EQ(store_.LoadMatches(key_), MatchLists{});
}

TEST_F(StageStoreTest, WhatNobodySavedIsMissing) {
  store_.SaveMatches(key_, {{{1, 2}}});
  EXPECT_FALSE(store_.LoadKeyPoints(key_).has_value());
  EXPECT_FALSE(store_.LoadMatches(StageStore::KeyOf({"image", "ORB"})).has_value());
}

TEST_F(StageStoreTest, AnyDamageCountsAsMissing) {
  store_.SaveKeyPoints(key_, Points());
  const std::filesystem::path path = folder_.Path() / (key_ + ".points");
  const std::string bytes = ReadFile(path);
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  for (const std::string& damaged : {flipped,
                                     bytes.substr(0, bytes.size() - 1),
                                     bytes + "x",
                                     bytes.substr(0, 10),
                                     std::string()}) {
    WriteFileAtomically(path, damaged);
    EXPECT_FALSE(store_.LoadKeyPoints(key_).has_value()) << damaged.size();
  }
  WriteFileAtomically(path, bytes);
  EXPECT_TRUE(store_.LoadKeyPoints(key_).has_value());
}

TEST_F(StageStoreTest, TheKeyTellsInputsApart) {
  EXPECT_EQ(StageStore::KeyOf({"image", "SIFT"}), key_);
  EXPECT_NE(StageStore::KeyOf({"SIFT", "image"}), key_);
  EXPECT_NE(StageStore::KeyOf({"imageSIFT"}), key_);
  EXPECT_NE(StageStore::KeyOf({"image", "SIFT", ""}), key_);
  // A line feed within an input is no boundary between two.
  EXPECT_NE(StageStore::KeyOf({"a\n1 b"}), StageStore::KeyOf({"a", "b"}));
}

TEST(StageStore, WithoutAFolderKeepsNothing) {
  const StageStore nowhere{{}};
  const std::string key = StageStore::KeyOf({"image"});
  nowhere.SaveMatches(key, {{{1, 2}}});
  EXPECT_FALSE(nowhere.LoadMatches(key).has_value());
}

}  // namespace
}  // namespace pfseq
