// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade_photos.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr const char* kHead = "source: a box\ncredit: N. N.\nlicence: CC0\nfacades:\n  front:\n";

/// A folder with a photograph of 40 x 20 px, white with a black window, and a description of it.
class FacadePhotosTest : public testing::Test {
 protected:
  FacadePhotosTest() {
    Image<uint8_t> image(40, 20, 3, uint8_t{250});
    for (int y = 4; y < 12; ++y) {
      for (int x = 8; x < 16; ++x) {
        for (int channel = 0; channel < 3; ++channel) {
          image.At(x, y, channel) = 0;
        }
      }
    }
    WriteFileAtomically(folder_.Path() / "front.png", EncodePng(image));
  }

  std::filesystem::path Write(const std::string& facade) {
    const std::filesystem::path path = folder_.Path() / "facades.yaml";
    WriteFileAtomically(path, std::string_view(kHead + facade));
    return path;
  }

  TempFolder folder_;
};

constexpr const char* kGood =
    "    file: front.png\n    width_m: 20\n    height_m: 10\n    floors: 3\n    recess_m: 0.2\n"
    "    windows_px:\n      a: [8, 4, 8, 8, 16, 2, 0, 1]\n";

TEST_F(FacadePhotosTest, MeasuresWindowsInMetresFromTheLowerLeft) {
  const FacadePhotos photos = ReadFacadePhotos(Write(kGood));
  ASSERT_EQ(photos.photos.size(), 1U);
  const FacadePhoto& photo = *photos.photos[0];
  ASSERT_EQ(photo.windows.size(), 2U);
  EXPECT_TRUE(photo.windows[0].low_m.isApprox(Vec2d(4, 4)));
  EXPECT_TRUE(photo.windows[0].high_m.isApprox(Vec2d(8, 8)));
  EXPECT_TRUE(photo.windows[1].low_m.isApprox(Vec2d(12, 4)));
  EXPECT_THAT(photos.credits, testing::HasSubstr("CC0"));
  EXPECT_THAT(photos.credits, testing::HasSubstr("N. N."));
}

TEST_F(FacadePhotosTest, CropsThePhotographAndItsWindows) {
  const FacadePhotos photos =
      ReadFacadePhotos(Write(std::string(kGood) + "    crop_px: [4, 0, 24, 16]\n"));
  const FacadePhoto& photo = *photos.photos[0];
  EXPECT_EQ(photo.image->WidthPx(), 20);
  EXPECT_EQ(photo.image->HeightPx(), 16);
  EXPECT_EQ(photo.image->At(4, 4, 1), 0);
  EXPECT_EQ(photo.image->At(3, 4, 1), 250);
  EXPECT_TRUE(photo.windows[0].low_m.isApprox(Vec2d(4, 2.5)));
}

TEST_F(FacadePhotosTest, TellsFaultsInOneLine) {
  const auto message = [&](const std::string& facade) {
    return MessageOf<InputError>([&] { ReadFacadePhotos(Write(facade)); });
  };
  EXPECT_THAT(message("    file: none.png\n    width_m: 1\n    height_m: 1\n    floors: 1\n"),
              testing::HasSubstr("none.png"));
  EXPECT_THAT(message("    file: front.png\n    width_m: 1\n    floors: 1\n"),
              testing::HasSubstr("expected the key height_m"));
  EXPECT_THAT(message("    file: front.png\n    width_m: -1\n    height_m: 1\n    floors: 1\n"),
              testing::HasSubstr("width_m: expected"));
  EXPECT_THAT(message(std::string(kGood) + "    crop_px: [0, 0, 50, 20]\n"),
              testing::HasSubstr("crop_px: expected left < right <= 40"));
  EXPECT_THAT(message(std::string(kGood) + "      b: [1, 2, 3]\n"),
              testing::HasSubstr("a list of 4 or 8 numbers"));
  EXPECT_THAT(message(std::string(kGood) + "    flors: 2\n"), testing::HasSubstr("floors"));
}

TEST_F(FacadePhotosTest, MapsAreCroppedAlikeAndOfTheSameSize) {
  WriteFileAtomically(folder_.Path() / "normal.png", EncodePng(Image<uint8_t>(40, 20, 3, 128)));
  WriteFileAtomically(folder_.Path() / "small.png", EncodePng(Image<uint8_t>(20, 10, 3, 128)));
  const std::string good = std::string(kGood) + "    crop_px: [4, 0, 24, 16]\n";
  const FacadePhotos photos =
      ReadFacadePhotos(Write(good + "    normal: normal.png\n    roughness: front.png\n"));
  EXPECT_EQ(photos.photos[0]->normal->WidthPx(), 20);
  EXPECT_EQ(*photos.photos[0]->roughness, *photos.photos[0]->image);
  EXPECT_THAT(
      MessageOf<InputError>([&] { ReadFacadePhotos(Write(good + "    normal: small.png\n")); }),
      testing::HasSubstr("normal: expected the photograph's size, 40 x 20 px, got 20 x 10"));
}

TEST_F(FacadePhotosTest, ChoosesOnesOfAboutTheHeightWanted) {
  const FacadePhotos photos = ReadFacadePhotos(Write(kGood));
  EXPECT_EQ(ChoosePhoto(photos, 11.0, 1), photos.photos[0]);
  EXPECT_EQ(ChoosePhoto(photos, 20.0, 1), nullptr);
  EXPECT_EQ(ChoosePhoto(photos, 6.0, 1), nullptr);
}

}  // namespace
}  // namespace pfseq
