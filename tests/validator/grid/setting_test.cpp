// SPDX-License-Identifier: Apache-2.0
#include "validator/grid/setting.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

TEST(Setting, NamesAreThoseOfTheReport) {
  const ParsedName parsed = ParseName("SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce");
  EXPECT_EQ(parsed.detector.setting.Number("contrastThreshold"), 0.04);
  EXPECT_EQ(parsed.detector.setting.Number("edgeThreshold"), 5.0);
  EXPECT_EQ(parsed.detector.setting.Number("sigma"), 1.6);
  EXPECT_FALSE(parsed.detector.is_polar);
  EXPECT_EQ(parsed.descriptor->Number("patternScale"), 44.0);
  EXPECT_EQ(parsed.detector.Name(), "SIFT nopol 0.04 5.0 1.6");
  EXPECT_EQ(DescriptorName(*parsed.descriptor), "FREAK 44.0");
  EXPECT_EQ(MatcherName(*parsed.matcher), "BruteForce");
}

TEST(Setting, ANameReadsBackWithAllItsValues) {
  for (const char* name : {"CenSurE pol 16 10 7 responseThreshold=20 lineThresholdBinarized=9",
                           "ORB nopol 500 scaleFactor=1.2 nlevels=8",
                           "BRISK pol 10 2.0 octaves=3",
                           "FAST nopol 20",
                           "MSER nopol 5"}) {
    EXPECT_EQ(ParseName(name).detector.Name(), name);
  }
  const ParsedName ratio = ParseName("ORB pol 500 SIFT sizeScale=0.226 RatioTest ratio=0.7");
  EXPECT_EQ(DescriptorName(*ratio.descriptor), "SIFT sizeScale=0.226");
  EXPECT_EQ(MatcherName(*ratio.matcher), "RatioTest ratio=0.7");
}

TEST(Setting, AutoIsTheReportsRule) {
  EXPECT_FALSE(ParseName("ORB nopol 500").detector.setting.Value("nlevels"));
  EXPECT_FALSE(ParseName("CenSurE nopol 16 10 7").detector.setting.Value("lineThresholdBinarized"));
}

TEST(Setting, ToldIsTheWordThatDoesNotFit) {
  const auto refusal = [](const char* name) {
    return MessageOf<InputError>([&] { ParseName(name); });
  };
  EXPECT_THAT(refusal("SIFT 0.04 5.0 1.6"), HasSubstr("expected pol or nopol, got '0.04'"));
  EXPECT_THAT(refusal("SIFT nopol 0.04 5.0"), HasSubstr("sigma"));
  EXPECT_THAT(refusal("SIFT nopol 0.04 -5 1.6"), HasSubstr("edgeThreshold"));
  EXPECT_THAT(refusal("ORB nopol 2.5"), HasSubstr("a whole number"));
  EXPECT_THAT(refusal("ORB nopol 500 nlevel=3"), HasSubstr("a parameter of ORB"));
  EXPECT_THAT(refusal("Sift nopol"), HasSubstr("got 'Sift'"));
  EXPECT_THAT(refusal("ORB nopol 500 ORB 2"), HasSubstr("matcher"));
  EXPECT_THAT(refusal("ORB nopol 500 ORB 2 FLANN"), HasSubstr("Euclidean"));
  EXPECT_THAT(refusal("ORB nopol 500 ORB 2 BruteForce 7"), HasSubstr("no more"));
}

TEST(Setting, DistancesFitTheDescriptor) {
  const auto norm = [](const char* name) { return NormOf(*ParseName(name).descriptor); };
  EXPECT_EQ(norm("ORB nopol 500 ORB 2 BruteForce"), Norm::kHamming);
  EXPECT_EQ(norm("ORB nopol 500 ORB 3 BruteForce"), Norm::kHamming2);
  EXPECT_EQ(norm("ORB nopol 500 ORB 4 BruteForce"), Norm::kHamming2);
  EXPECT_EQ(norm("ORB nopol 500 SIFT FLANN"), Norm::kL2);
  EXPECT_EQ(norm("ORB nopol 500 FREAK 22.0 BruteForce"), Norm::kHamming);
}

}  // namespace
}  // namespace pfseq
