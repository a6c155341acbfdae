// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/image_check.h"

#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/checks/view_fixture.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr const char* kCleanFile = "equisolid/front/clean/000001.png";
constexpr const char* kDistanceFile = "equisolid/rear/distance/000003.exr";
constexpr const char* kSkyFile = "equisolid/rear/sky/000003.png";

class ImageCheck : public ViewFixture {
 protected:
  std::filesystem::path Distance() const { return folder_ / kDistanceFile; }
  std::filesystem::path Sky() const { return folder_ / kSkyFile; }

  /// The first pixel for which `holds(distance, sky)`.
  template <typename Predicate>
  std::pair<int, int> Find(const Predicate& holds) const {
    const Image<float> distance_m = ReadExr(Distance());
    const Image<uint8_t> sky = ReadImage8(Sky());
    for (int y = 0; y < kSizePx; ++y) {
      for (int x = 0; x < kSizePx; ++x) {
        if (holds(distance_m.At(x, y), sky.At(x, y))) {
          return {x, y};
        }
      }
    }
    ADD_FAILURE() << "no such pixel";
    return {0, 0};
  }
};

TEST_F(ImageCheck, SoundImagesHaveNoFindings) {
  const CheckReport report = Check(CheckImages, 2);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_images, 24U);
}

TEST_F(ImageCheck, NamesTruncatedFiles) {
  for (const char* name : {kCleanFile, kDistanceFile}) {
    std::filesystem::resize_file(folder_ / name, std::filesystem::file_size(folder_ / name) / 2);
  }
  EXPECT_THAT(Check(CheckImages).findings,
              UnorderedElementsAre(IsFault(kCleanFile, ""), IsFault(kDistanceFile, "")));
}

TEST_F(ImageCheck, NamesImagesOfAnotherSizeOrKind) {
  WriteFileAtomically(folder_ / kCleanFile,
                      std::span<const std::byte>(EncodePng(Image<uint8_t>(40, 48, 3))));
  WriteFileAtomically(Distance(),
                      std::span<const std::byte>(EncodeExrHalf(Image<float>(48, 48, 1, 3.0F))));
  WriteFileAtomically(Sky(), std::span<const std::byte>(EncodePng(Image<uint8_t>(48, 48, 3))));
  EXPECT_THAT(Check(CheckImages).findings,
              UnorderedElementsAre(IsFault(kCleanFile, "40 x 48 px, 48 x 48 in rig.yaml"),
                                   IsFault(kDistanceFile, "got 1 of half"),
                                   IsFault(kSkyFile, "got 3 of uint8")));
}

TEST_F(ImageCheck, ChecksRadianceWhereItIsWritten) {
  const std::string file = "equisolid/front/linear/000001.exr";
  Image<float> radiance(48, 48, 3, 0.5F);
  WriteFileAtomically(folder_ / file, std::span<const std::byte>(EncodeExrHalf(radiance)));
  EXPECT_THAT(Check(CheckImages).findings, IsEmpty());
  radiance.At(3, 4, 1) = -0.25F;
  WriteFileAtomically(folder_ / file, std::span<const std::byte>(EncodeExrHalf(radiance)));
  EXPECT_THAT(Check(CheckImages).findings, ElementsAre(IsFault(file, "first (3, 4)")));
}

TEST_F(ImageCheck, NamesTheKindAndPlaceOfWrongDistances) {
  EditDistance(Distance(), [](Image<float>& distance_m) {
    distance_m.At(10, 20) = std::nanf("");
    distance_m.At(24, 30) = -1.0F;
    distance_m.At(24, 31) = 0.0F;
    distance_m.At(0, 0) = 2.0F;
    distance_m.At(12, 24) = 501.0F;
  });
  std::filesystem::remove(Sky());
  EXPECT_THAT(Check(CheckImages).findings,
              UnorderedElementsAre(
                  IsFault(kDistanceFile, "1 pixel not a number, first (10, 20)"),
                  IsFault(kDistanceFile, "2 pixels inside the image circle not positive"),
                  IsFault(kDistanceFile, "1 pixel outside the image circle not 0, first (0, 0)"),
                  IsFault(kDistanceFile, "1 pixel finite beyond the maximum of 500 m")));
}

TEST_F(ImageCheck, SkyIsBlackOrWhiteAndBlackOutside) {
  EditSky(Sky(), [](Image<uint8_t>& sky) {
    sky.At(24, 24) = 128;
    sky.At(0, 47) = 255;
  });
  EXPECT_THAT(Check(CheckImages).findings,
              testing::IsSupersetOf({IsFault(kSkyFile, "neither 0 nor 255, first (24, 24)"),
                                     IsFault(kSkyFile, "outside the image circle not 0")}));
}

TEST_F(ImageCheck, SkyHasInfiniteDistance) {
  const auto [x, y] = Find([](float d, uint8_t) { return d > 0.0F && std::isfinite(d); });
  EditSky(Sky(), [x = x, y = y](Image<uint8_t>& sky) { sky.At(x, y) = 255; });
  EXPECT_THAT(Check(CheckImages).findings, ElementsAre(IsFault(kSkyFile, "sky, but at finite")));
}

TEST_F(ImageCheck, InfiniteDistanceIsSkyUnlessTheSceneIsFurtherAway) {
  // The far wall: 0 in the mask, infinite in the map, and right so.
  Find([](float d, uint8_t s) { return d == kInfinity && s == 0; });
  const auto [x, y] = Find([](float, uint8_t s) { return s == 255; });
  EditSky(Sky(), [x = x, y = y](Image<uint8_t>& sky) { sky.At(x, y) = 0; });
  EXPECT_THAT(Check(CheckImages).findings, ElementsAre(IsFault(kSkyFile, "nothing beyond 500 m")));
}

}  // namespace
}  // namespace pfseq
