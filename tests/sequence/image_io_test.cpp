// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/image_io.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

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

/// A Radiance HDR file without run lengths, as Ward 1991, "Real Pixels" (Graphics Gems II), has it:
/// each pixel three mantissas and an exponent, 256 times too great and biased by 128.
std::string HdrText() {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) {
    text += {static_cast<char>(128 + i), '\x40', '\x10', static_cast<char>(128 + 3)};
  }
  return text;
}

TEST(ReadHdrRgb, ReadsRadianceHdrFiles) {
  const TempFolder folder;
  WriteFileAtomically(folder / "map.hdr", HdrText());
  const Image<float> image = ReadHdrRgb(folder / "map.hdr");
  ASSERT_EQ(image.WidthPx(), 4);
  ASSERT_EQ(image.HeightPx(), 2);
  ASSERT_EQ(image.NumChannels(), 3);
  // (mantissa + 0.5) / 256 * 2^3, or without the half, as some decoders have it.
  EXPECT_NEAR(image.At(1, 1, 0), 133.0F / 32.0F, 0.02F);
  EXPECT_NEAR(image.At(1, 1, 1), 2.0F, 0.02F);
  EXPECT_NEAR(image.At(1, 1, 2), 0.5F, 0.02F);
}

TEST(ReadHdrRgb, TakesTheFirstThreeChannelsOrOneForAll) {
  const TempFolder folder;
  Image<float> rgba(4, 2, 4);
  for (size_t i = 0; i < rgba.Values().size(); ++i) {
    rgba.Values()[i] = static_cast<float>(i);
  }
  WriteFileAtomically(folder / "map.exr", EncodeExrFloat(rgba));
  EXPECT_EQ(ReadHdrRgb(folder / "map.exr").At(1, 0, 2), 6.0F);
  WriteFileAtomically(folder / "map.exr", EncodeExrFloat(Image<float>(4, 2, 1, 7.0F)));
  EXPECT_EQ(ReadHdrRgb(folder / "map.exr"), Image<float>(4, 2, 3, 7.0F));
}

TEST(ReadHdrRgb, NamesMissingForeignAndTruncatedFiles) {
  const TempFolder folder;
  const auto error = [&](const char* name) {
    return MessageOf<InputError>([&] { ReadHdrRgb(folder / name); });
  };
  EXPECT_THAT(error("none.exr"), AllOf(HasSubstr("none.exr"), HasSubstr("no such file")));
  WriteFileAtomically(folder / "map.png", EncodePng(Pattern8(3)));
  EXPECT_THAT(error("map.png"), HasSubstr("expected an OpenEXR or Radiance HDR file, got png"));
  const Bytes exr = EncodeExrFloat(PatternFloat());
  for (const double share : {0.0, 0.1, 0.5, 0.9}) {
    const auto cut = [&](std::string_view bytes) {
      return bytes.substr(0, static_cast<size_t>(share * static_cast<double>(bytes.size())));
    };
    const std::string hdr = HdrText();
    WriteFileAtomically(folder / "cut.exr", cut(Text(exr)));
    WriteFileAtomically(folder / "cut.hdr", cut(hdr));
    EXPECT_THAT(error("cut.exr"), HasSubstr("cut.exr")) << share;
    EXPECT_THAT(error("cut.hdr"), HasSubstr("cut.hdr")) << share;
  }
}

TEST(IsExr, TellsByTheFirstBytes) {
  EXPECT_TRUE(IsExr(Text(EncodeExrFloat(PatternFloat()))));
  EXPECT_FALSE(IsExr(HdrText()));
  EXPECT_FALSE(IsExr(""));
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
