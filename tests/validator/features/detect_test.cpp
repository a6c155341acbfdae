// SPDX-License-Identifier: Apache-2.0
#include "validator/features/detect.h"

#include "tests/validator/features/test_images.h"
#include "validator/features/describe.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/features2d.hpp>

namespace pfseq {
namespace {

Setting DetectorOf(const std::string& name) { return ParseName(name).detector.setting; }

KeyPoints Own(cv::Ptr<cv::Feature2D> detector, const cv::Mat& image) {
  KeyPoints points;
  detector->detect(image, points);
  return points;
}

void ExpectSamePoints(const KeyPoints& a, const KeyPoints& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].pt, b[i].pt) << i;
    ASSERT_EQ(a[i].size, b[i].size) << i;
    ASSERT_EQ(a[i].angle, b[i].angle) << i;
    ASSERT_EQ(a[i].response, b[i].response) << i;
    ASSERT_EQ(a[i].octave, b[i].octave) << i;
  }
}

TEST(Detect, IsWhatOpenCvsOwnCallsGive) {
  const cv::Mat image = BlobImage(640, 520);  // floor(log2(520)) = 9 octaves.
  ExpectSamePoints(Detect(image, DetectorOf("SIFT nopol 0.04 5.0 1.6")),
                   Own(cv::SIFT::create(0, 3, 0.04, 5.0, 1.6), image));
  ExpectSamePoints(Detect(image, DetectorOf("ORB nopol 1000")),
                   Own(cv::ORB::create(1000, std::exp2(1.0F / 3.0F), 27, 31), image));
  ExpectSamePoints(Detect(image, DetectorOf("BRISK nopol 30 2.0 octaves=3")),
                   Own(cv::BRISK::create(30, 3, 2.0F), image));
}

TEST(Detect, DescriptorsOfOwnPointsAreWhatOpenCvsOwnCallsGive) {
  const cv::Mat image = BlobImage(400, 400);
  const auto expect_same = [&](const std::string& name, const cv::Ptr<cv::Feature2D>& own) {
    const ParsedName parsed = ParseName(name);
    KeyPoints points;
    cv::Mat rows;
    own->detectAndCompute(image, cv::noArray(), points, rows);
    const KeyPoints ours = Detect(image, parsed.detector.setting);
    const Descriptors descriptors =
        Describe(image, ours, parsed.detector.setting, *parsed.descriptor);
    ASSERT_EQ(descriptors.rows.rows, rows.rows) << name;
    ASSERT_GT(rows.rows, 100) << name;
    for (int row = 0; row < rows.rows; ++row) {
      ASSERT_EQ(cv::norm(rows.row(row), descriptors.rows.row(row), cv::NORM_INF), 0.0) << name;
      ASSERT_EQ(points[row].pt, ours[descriptors.key_point_idx[row]].pt) << name;
    }
  };
  expect_same("SIFT nopol 0.02 20.0 1.0 SIFT BruteForce",
              cv::SIFT::create(0, 3, 0.02, 20.0, 1.0, CV_8U));
  expect_same("BRISK nopol 30 1.0 octaves=3 BRISK 1.0 BruteForce", cv::BRISK::create(30, 3, 1.0F));
  expect_same("ORB nopol 500 scaleFactor=1.2 nlevels=8 ORB 3 BruteForce",
              cv::ORB::create(500, 1.2F, 8, 31, 0, 3));
}

TEST(DetectFamily, HasEachMembersPointsInOrder) {
  const cv::Mat image = BlobImage(500, 420);
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"SIFT nopol 0.02 5.0 1.6",
                                 "SIFT nopol 0.02 20.0 1.6",
                                 "SIFT nopol 0.04 10.0 1.6",
                                 "SIFT nopol 0.08 20.0 1.6",
                                 "SIFT nopol 0.08 5.0 1.6"},
        std::vector<std::string>{
            "CenSurE nopol 8 10 3", "CenSurE nopol 16 20 7", "CenSurE nopol 32 10 5"}}) {
    std::vector<Setting> members;
    for (const std::string& name : names) {
      members.push_back(DetectorOf(name));
    }
    const FamilyKeyPoints family = DetectFamily(image, members);
    for (size_t m = 0; m < members.size(); ++m) {
      KeyPoints of_member;
      for (size_t i = 0; i < family.points.size(); ++i) {
        if (((family.members[i] >> m) & 1U) != 0) {
          of_member.push_back(family.points[i]);
        }
      }
      SCOPED_TRACE(names[m]);
      EXPECT_GT(of_member.size(), 20U);
      ExpectSamePoints(of_member, Detect(image, members[m]));
    }
  }
}

TEST(Describe, DescriptorsOfASubsetAreThoseOfTheWhole) {
  const cv::Mat image = BlobImage(400, 400);
  const Setting detector = DetectorOf("CenSurE nopol 16 20 3");
  const KeyPoints points = Detect(image, detector);
  KeyPoints odd;
  for (size_t i = 1; i < points.size(); i += 2) {
    odd.push_back(points[i]);
  }
  for (const char* name : {"SIFT", "ORB 2", "ORB 4", "BRISK 1.0", "FREAK 22.0", "BRIEF 32"}) {
    const Setting descriptor =
        *ParseName(std::string("FAST nopol 20 ") + name + " BruteForce").descriptor;
    const Descriptors whole = Describe(image, points, detector, descriptor);
    const Descriptors part = Describe(image, odd, detector, descriptor);
    ASSERT_GT(part.rows.rows, 20) << name;
    for (int row = 0; row < part.rows.rows; ++row) {
      const auto found = std::find(
          whole.key_point_idx.begin(), whole.key_point_idx.end(), 2 * part.key_point_idx[row] + 1);
      ASSERT_NE(found, whole.key_point_idx.end()) << name;
      const int at = static_cast<int>(found - whole.key_point_idx.begin());
      ASSERT_EQ(cv::norm(part.rows.row(row), whole.rows.row(at), cv::NORM_INF), 0.0) << name;
    }
  }
}

/// All detectors and descriptors on one image; nothing may crash, and indices must fit.
void ExpectNoTrouble(const cv::Mat& image, const std::string& what) {
  for (const Algorithm& algorithm : KnownDetectors()) {
    const Setting detector(algorithm);
    KeyPoints points = Detect(image, detector);
    for (const cv::KeyPoint& point : points) {
      ASSERT_TRUE(point.pt.x >= 0.0F && point.pt.x < static_cast<float>(image.cols) &&
                  point.pt.y >= 0.0F && point.pt.y < static_cast<float>(image.rows))
          << what << " " << algorithm.name;
    }
    points.resize(std::min<size_t>(points.size(), 300));
    for (const Algorithm& described : KnownDescriptors()) {
      const bool is_own = algorithm.name.find("KAZE") != std::string::npos;
      if (described.name.find("KAZE") != std::string::npos &&
          (!is_own || described.name != algorithm.name)) {
        continue;
      }
      const Descriptors descriptors = Describe(image, points, detector, Setting(described));
      ASSERT_EQ(descriptors.rows.rows, static_cast<int>(descriptors.key_point_idx.size()));
      ASSERT_LE(descriptors.rows.rows, static_cast<int>(points.size()))
          << what << " " << algorithm.name << " " << described.name;
    }
  }
}

TEST(Detect, DegenerateImagesAreNoTrouble) {
  ExpectNoTrouble(cv::Mat::zeros(200, 200, CV_8U), "black");
  ExpectNoTrouble(cv::Mat(200, 200, CV_8U, cv::Scalar(255)), "white");
  ExpectNoTrouble(NoiseImage(200, 200), "noise");
  ExpectNoTrouble(cv::Mat::zeros(1, 1, CV_8U), "1 x 1");
  ExpectNoTrouble(BlobImage(17, 16), "17 x 16");
  ExpectNoTrouble(BlobImage(40, 500), "40 x 500");
}

TEST(Describe, OnePointIsNoTrouble) {
  const cv::Mat image = BlobImage(200, 200);
  for (const Algorithm& descriptor : KnownDescriptors()) {
    if (descriptor.name.find("KAZE") == std::string::npos) {
      for (const float size : {0.1F, 8.0F, 5000.0F}) {
        const KeyPoints one = {cv::KeyPoint(100.0F, 100.0F, size)};
        const Descriptors described =
            Describe(image, one, DetectorOf("FAST nopol 20"), Setting(descriptor));
        EXPECT_LE(described.rows.rows, 1) << descriptor.name << " " << size;
      }
    }
  }
}

TEST(Detect, EveryDetectorFindsPointsInAPicture) {
  const cv::Mat image = BlobImage(300, 300);
  for (const Algorithm& algorithm : KnownDetectors()) {
    const KeyPoints points = Detect(image, Setting(algorithm));
    EXPECT_GT(points.size(), 20U) << algorithm.name;
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const cv::KeyPoint& p) {
      return p.response != 0.0F;
    })) << algorithm.name;
  }
}

}  // namespace
}  // namespace pfseq
