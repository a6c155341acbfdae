// SPDX-License-Identifier: Apache-2.0
#include "validator/features/freak_training.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/validator/features/test_images.h"
#include "validator/features/freak.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

Image<uint8_t> PictureOf(const cv::Mat& grey) {
  Image<uint8_t> image(grey.cols, grey.rows, 1);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      image.At(x, y) = grey.at<uint8_t>(y, x);
    }
  }
  return image;
}

TEST(FreakTraining, ChoosesAsManyDifferentPairsAsThePatternHas) {
  const std::vector<Image<uint8_t>> images = {PictureOf(BlobImage(500, 500, 1)),
                                              PictureOf(BlobImage(500, 500, 2))};
  const FreakTraining training = ChooseFreakPairs(images);
  EXPECT_GE(training.num_points, 1000U);
  ASSERT_EQ(training.pairs.size(), static_cast<size_t>(kNumFreakPairs));
  EXPECT_GE(training.max_correlation, 0.2);
  EXPECT_LT(training.max_correlation, 1.0);
  EXPECT_EQ(std::set(training.pairs.begin(), training.pairs.end()).size(), training.pairs.size());
  for (const auto& [first, second] : training.pairs) {
    EXPECT_LT(first, kNumFreakFields);
    EXPECT_GE(second, 0);
    EXPECT_LT(second, first);
  }
  // The same images, the same table.
  EXPECT_EQ(ChooseFreakPairs(images).pairs, training.pairs);
}

TEST(FreakTraining, TooFewPointsAreRefused) {
  EXPECT_THAT(MessageOf<InputError>([] { ChooseFreakPairs({PictureOf(BlobImage(120, 120))}); }),
              HasSubstr("at least 1000"));
  EXPECT_THAT(MessageOf<InputError>([] { ChooseFreakPairs({}); }), HasSubstr("got 0"));
}

}  // namespace
}  // namespace pfseq
