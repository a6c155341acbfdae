// SPDX-License-Identifier: Apache-2.0
// The table of algorithms.
#include "validator/grid/setting.h"

#include <set>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

Setting DescriptorOf(const char* name) {
  return Setting(FindAlgorithm(KnownDescriptors(), name, "descriptor"));
}

TEST(Algorithms, NamesAndParametersAreUniqueAndDefaultsLieWithinTheirBounds) {
  for (const auto* algorithms : {&KnownDetectors(), &KnownDescriptors(), &KnownMatchers()}) {
    std::set<std::string> names;
    for (const Algorithm& algorithm : *algorithms) {
      EXPECT_TRUE(names.insert(algorithm.name).second) << algorithm.name;
      std::set<std::string> parameters;
      for (const Parameter& parameter : algorithm.parameters) {
        const std::string where = algorithm.name + " " + parameter.name;
        EXPECT_TRUE(parameters.insert(parameter.name).second) << where;
        const std::optional<double> value = Setting(algorithm).Value(parameter.name);
        EXPECT_LT(parameter.least, parameter.most) << where;
        if (value.has_value()) {
          EXPECT_GE(*value, parameter.least) << where;
          EXPECT_LE(*value, parameter.most) << where;
        }
      }
    }
  }
}

TEST(Algorithms, TheReportsAreThere) {
  for (const char* name : {"SIFT", "CenSurE", "ORB", "BRISK"}) {
    EXPECT_EQ(FindAlgorithm(KnownDetectors(), name, "detector").name, name);
  }
  for (const char* name : {"SIFT", "ORB", "BRISK", "FREAK"}) {
    EXPECT_EQ(DescriptorOf(name).Kind().name, name);
  }
  for (const char* name : {"BruteForce", "RatioTest", "FLANN"}) {
    EXPECT_EQ(FindAlgorithm(KnownMatchers(), name, "matcher").name, name);
  }
}

TEST(Algorithms, BitsAreCountedAndVectorsMeasured) {
  EXPECT_EQ(NormOf(DescriptorOf("SIFT")), Norm::kL2);
  EXPECT_EQ(NormOf(DescriptorOf("KAZE")), Norm::kL2);
  for (const char* name : {"ORB", "BRISK", "FREAK", "BRIEF", "AKAZE"}) {
    EXPECT_EQ(NormOf(DescriptorOf(name)), Norm::kHamming) << name;
  }
  // Which of three or four points is brightest takes two bits.
  for (const double num_points : {3.0, 4.0}) {
    Setting orb = DescriptorOf("ORB");
    orb.Set("WTA_K", num_points);
    EXPECT_EQ(NormOf(orb), Norm::kHamming2);
  }
}

TEST(Algorithms, FlannNeedsVectors) {
  const Setting flann(FindAlgorithm(KnownMatchers(), "FLANN", "matcher"));
  const Setting brute_force(FindAlgorithm(KnownMatchers(), "BruteForce", "matcher"));
  EXPECT_TRUE(CanMatch(flann, DescriptorOf("SIFT")));
  EXPECT_FALSE(CanMatch(flann, DescriptorOf("ORB")));
  EXPECT_TRUE(CanMatch(brute_force, DescriptorOf("ORB")));
}

}  // namespace
}  // namespace pfseq
