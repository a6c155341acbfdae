// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/image_io.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string_view Text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Image<uint8_t> Pattern8(int num_channels) {
  Image<uint8_t> image(37, 23, num_channels);
  for (size_t i = 0; i < image.Values().size(); ++i) {
    image.Values()[i] = static_cast<uint8_t>(i * 7 % 256);
  }
  return image;
}

Image<float> PatternFloat() {
  Image<float> image(37, 23, 1);
  for (size_t i = 0; i < image.Values().size(); ++i) {
    image.Values()[i] = 1.0F / (1.0F + static_cast<float>(i));
  }
  image.At(3, 5) = std::numeric_limits<float>::infinity();
  image.At(4, 5) = 0.0F;
  return image;
}

TEST(ImageIo, PngReadsBackUnchangedForOneThreeAndFourChannels) {
  const TempFolder folder;
  for (const int num_channels : {1, 3, 4}) {
    WriteFileAtomically(folder / "image.png", EncodePng(Pattern8(num_channels)));
    EXPECT_EQ(ReadImage8(folder / "image.png"), Pattern8(num_channels)) << num_channels;
  }
}

TEST(ImageIo, FloatExrReadsBackBitForBitWithInfinity) {
  const TempFolder folder;
  WriteFileAtomically(folder / "image.exr", EncodeExrFloat(PatternFloat()));
  EXPECT_EQ(ReadExr(folder / "image.exr"), PatternFloat());
}

TEST(ImageIo, DistanceExrHasOneChannelNamedY) {
  // In an OpenEXR header the channel list stores the name as a zero-terminated string behind
  // "chlist".
  const Bytes bytes = EncodeExrFloat(PatternFloat());
  const size_t list = Text(bytes).find("chlist");
  ASSERT_NE(list, std::string_view::npos);
  EXPECT_EQ(Text(bytes).substr(list + 7 + 4, 2), std::string_view("Y\0", 2));
}

TEST(ImageIo, HalfExrIsRoundedAndNeverInfinite) {
  const TempFolder folder;
  Image<float> image(2, 1, 3, 0.1F);
  image.At(1, 0, 2) = 1e9F;
  WriteFileAtomically(folder / "image.exr", EncodeExrHalf(image));
  const Image<float> read = ReadExr(folder / "image.exr");
  EXPECT_NEAR(read.At(0, 0, 0), 0.1F, 0.1F / 1024);
  EXPECT_EQ(read.At(1, 0, 2), 65504.0F);
}

TEST(ImageIo, EncodingIsRepeatable) {
  EXPECT_EQ(EncodePng(Pattern8(3)), EncodePng(Pattern8(3)));
  EXPECT_EQ(EncodeExrFloat(PatternFloat()), EncodeExrFloat(PatternFloat()));
}

TEST(ImageIo, TruncatedFilesAreNamed) {
  const TempFolder folder;
  const Bytes png = EncodePng(Pattern8(3));
  const Bytes exr = EncodeExrFloat(PatternFloat());
  for (const double share : {0.0, 0.1, 0.5, 0.9}) {
    const auto cut = [&](const Bytes& bytes) {
      return Text(bytes).substr(0, static_cast<size_t>(share * static_cast<double>(bytes.size())));
    };
    WriteFileAtomically(folder / "cut.png", cut(png));
    WriteFileAtomically(folder / "cut.exr", cut(exr));
    EXPECT_THAT(MessageOf<InputError>([&] { ReadImage8(folder / "cut.png"); }),
                HasSubstr("cut.png"))
        << share;
    EXPECT_THAT(MessageOf<InputError>([&] { ReadExr(folder / "cut.exr"); }), HasSubstr("cut.exr"))
        << share;
  }
}

TEST(ImageIo, MissingAndForeignFilesAreNamed) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf<InputError>([&] { ReadImage8(folder / "none.png"); }),
              AllOf(HasSubstr("none.png"), HasSubstr("no such file")));
  WriteFileAtomically(folder / "text.png", "hello");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadImage8(folder / "text.png"); }),
              HasSubstr("text.png"));
  WriteFileAtomically(folder / "image.png", EncodePng(Pattern8(3)));
  EXPECT_THAT(MessageOf<InputError>([&] { ReadExr(folder / "image.png"); }),
              HasSubstr("expected an OpenEXR file"));
}

TEST(DecodeImage8Rgba, FillsMissingChannels) {
  for (const int num_channels : {1, 3, 4}) {
    const Image<uint8_t> source = Pattern8(num_channels);
    const Image<uint8_t> rgba = DecodeImage8Rgba(EncodePng(source), "test");
    ASSERT_EQ(rgba.NumChannels(), 4);
    EXPECT_EQ(rgba.At(5, 6, 0), source.At(5, 6, 0));
    EXPECT_EQ(rgba.At(5, 6, 2), source.At(5, 6, num_channels == 1 ? 0 : 2));
    EXPECT_EQ(rgba.At(5, 6, 3), num_channels == 4 ? source.At(5, 6, 3) : 255);
  }
}

TEST(DecodeImage8Rgba, RefusesOtherBytes) {
  const Bytes bytes(100, std::byte{7});
  EXPECT_THAT(MessageOf<InputError>([&] { DecodeImage8Rgba(bytes, "texture 3"); }),
              HasSubstr("texture 3"));
  Bytes png = EncodePng(Pattern8(3));
  png.resize(png.size() / 2);
  EXPECT_THAT(MessageOf<InputError>([&] { DecodeImage8Rgba(png, "texture 3"); }),
              HasSubstr("texture 3"));
}

}  // namespace
}  // namespace pfseq
