// SPDX-License-Identifier: Apache-2.0
#include "validator/features/freak_training.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/validator/features/test_images.h"
#include "validator/features/detect.h"
#include "validator/features/freak.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

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

TEST(FreakTraining, BitsThatVaryMostComeFirst) {
  const cv::Mat grey = BlobImage(500, 500, 1);
  const FreakTraining training = ChooseFreakPairs({PictureOf(grey)});
  const FreakSampler sampler(grey, {});
  std::vector<double> ones(training.pairs.size(), 0.0);
  size_t num_points = 0;
  for (const char* name : {"SIFT nopol 0.04 10.0 1.6", "FAST nopol 20"}) {
    for (const cv::KeyPoint& point : Detect(grey, ParseName(name).detector.setting)) {
      if (sampler.Fits(point)) {
        const FreakSampler::Sample sample = sampler.At(point);
        for (size_t i = 0; i < ones.size(); ++i) {
          const auto [first, second] = training.pairs[i];
          ones[i] +=
              sample.fields[static_cast<size_t>(first)] > sample.fields[static_cast<size_t>(second)]
                  ? 1.0
                  : 0.0;
        }
        ++num_points;
      }
    }
  }
  ASSERT_EQ(num_points, training.num_points);
  const auto from_half = [&](double count) {
    return std::abs(count / static_cast<double>(num_points) - 0.5);
  };
  for (size_t i = 1; i < ones.size(); ++i) {
    EXPECT_LE(from_half(ones[i - 1]), from_half(ones[i]) + 1e-12) << i;
  }
  EXPECT_LT(from_half(ones[0]), 0.01);
}

TEST(FreakTraining, TooFewPointsAreRefused) {
  EXPECT_THAT(MessageOf<InputError>([] { ChooseFreakPairs({PictureOf(BlobImage(120, 120))}); }),
              HasSubstr("at least 1000"));
  EXPECT_THAT(MessageOf<InputError>([] { ChooseFreakPairs({}); }), HasSubstr("got 0"));
}

}  // namespace
}  // namespace pfseq
