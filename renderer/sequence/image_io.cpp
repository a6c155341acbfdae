// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/image_io.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace pfseq {
namespace {

/// Of zlib, from 1 (fast) to 9 (small).
constexpr int kSmallPngLevel = 6;

constexpr float kMaxHalf = 65504.0F;
constexpr int kMaxImagePx = 65536;

/// OpenImageIO's own threads are turned off: the program runs its own, and the bytes must not
/// depend on them.
void UseOneThread() {
  static const bool done = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
  (void)done;
}

/// One line of OpenImageIO's message.
std::string FirstLine(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "unknown fault" : line;
}

Bytes Encode(const char* format,
             const OIIO::ImageSpec& spec,
             OIIO::TypeDesc type,
             const void* values) {
  UseOneThread();
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::string name = std::string("image.") + format;
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name, &memory);
  if (output == nullptr) {
    throw SystemError("cannot encode {}: {}", format, FirstLine(OIIO::geterror()));
  }
  const bool ok = output->open(name, spec) && output->write_image(type, values) && output->close();
  if (!ok) {
    throw SystemError("cannot encode {}: {}", format, FirstLine(output->geterror()));
  }
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

OIIO::ImageSpec ExrSpec(const Image<float>& image, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(image.WidthPx(), image.HeightPx(), image.NumChannels(), type);
  if (image.NumChannels() == 1) {
    spec.channelnames = {"Y"};
  } else if (image.NumChannels() == 2) {
    spec.channelnames = {"X", "Y"};
  }
  spec.attribute("compression", "zip");
  // Without this the time of writing would become part of the file.
  spec.attribute("DateTime", "");
  return spec;
}

/// An opened image and what its header says.
struct OpenedImage {
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

/// `origin` names the image in messages.
OpenedImage Open(const std::string& origin,
                 const std::string& name,
                 OIIO::Filesystem::IOProxy* memory) {
  UseOneThread();
  OpenedImage opened;
  OIIO::ImageSpec config;
  // Keep the alpha channel and the colours beside it as they are in the file.
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (memory != nullptr) {
    // OpenImageIO 2.4 forgets its argument `memory` when it is also given a configuration.
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &memory);
  }
  opened.input = OIIO::ImageInput::open(name, &config, memory);
  if (opened.input == nullptr) {
    throw InputError("{}: cannot read the image: {}", origin, FirstLine(OIIO::geterror()));
  }
  opened.spec = opened.input->spec();
  const OIIO::ImageSpec& spec = opened.spec;
  if (spec.width < 1 || spec.height < 1 || spec.width > kMaxImagePx || spec.height > kMaxImagePx ||
      spec.nchannels < 1 || spec.nchannels > 64 || spec.depth > 1) {
    throw InputError("{}: expected an image of at most {} px a side, got {} x {} x {}",
                     origin,
                     kMaxImagePx,
                     spec.width,
                     spec.height,
                     spec.nchannels);
  }
  return opened;
}

template <typename T>
Image<T> ReadPixels(const std::string& origin, OpenedImage& opened, OIIO::TypeDesc type) {
  Image<T> image(opened.spec.width, opened.spec.height, opened.spec.nchannels);
  if (!opened.input->read_image(0, 0, 0, opened.spec.nchannels, type, image.Values().data())) {
    throw InputError(
        "{}: damaged or truncated image: {}", origin, FirstLine(opened.input->geterror()));
  }
  return image;
}

/// PNG files end with an empty chunk named IEND (PNG specification, section 11.2.5). The decoder
/// does not mind when it is missing, but then bytes were lost.
bool EndsLikePng(const std::filesystem::path& path) {
  constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  std::ifstream stream(path, std::ios::binary);
  std::string end(kEnd.size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return stream.good() && end == kEnd;
}

Image<uint8_t> ToRgba(const Image<uint8_t>& image) {
  Image<uint8_t> rgba(image.WidthPx(), image.HeightPx(), 4, 255);
  const int num_channels = image.NumChannels();
  const bool is_grey = num_channels <= 2;
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        rgba.At(x, y, channel) = image.At(x, y, is_grey ? 0 : channel);
      }
      if (num_channels == 2 || num_channels >= 4) {
        rgba.At(x, y, 3) = image.At(x, y, num_channels == 2 ? 1 : 3);
      }
    }
  }
  return rgba;
}

}  // namespace

Bytes EncodePng(const Image<uint8_t>& image, PngEffort effort) {
  OIIO::ImageSpec spec(
      image.WidthPx(), image.HeightPx(), image.NumChannels(), OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("png:compressionLevel", effort == PngEffort::kFast ? 1 : kSmallPngLevel);
  if (effort == PngEffort::kFast) {
    // libpng's PNG_FILTER_SUB; by default it tries all filters for each row.
    spec.attribute("png:filter", 0x10);
  }
  return Encode("png", spec, OIIO::TypeDesc::UINT8, image.Values().data());
}

Bytes EncodePng16(const Image<uint16_t>& image) {
  OIIO::ImageSpec spec(
      image.WidthPx(), image.HeightPx(), image.NumChannels(), OIIO::TypeDesc::UINT16);
  spec.attribute("png:compressionLevel", kSmallPngLevel);
  return Encode("png", spec, OIIO::TypeDesc::UINT16, image.Values().data());
}

Bytes EncodeJpeg(const Image<uint8_t>& image, int quality) {
  OIIO::ImageSpec spec(
      image.WidthPx(), image.HeightPx(), image.NumChannels(), OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", fmt::format("jpeg:{}", quality));
  return Encode("jpg", spec, OIIO::TypeDesc::UINT8, image.Values().data());
}

Bytes EncodeExrFloat(const Image<float>& image) {
  return Encode(
      "exr", ExrSpec(image, OIIO::TypeDesc::FLOAT), OIIO::TypeDesc::FLOAT, image.Values().data());
}

Bytes EncodeExrHalf(const Image<float>& image) {
  Image<float> clamped = image;
  for (float& value : clamped.Values()) {
    value = std::clamp(value, -kMaxHalf, kMaxHalf);
  }
  return Encode(
      "exr", ExrSpec(image, OIIO::TypeDesc::HALF), OIIO::TypeDesc::FLOAT, clamped.Values().data());
}

namespace {

/// A file of integers as 8 bits a channel; of 16 bits only if told.
Image<uint8_t> ReadAs8(const std::filesystem::path& path, bool takes_16_bits) {
  if (!std::filesystem::exists(path)) {
    throw InputError("{}: no such file", path.string());
  }
  if (path.extension() == ".png" && !EndsLikePng(path)) {
    throw InputError("{}: damaged or truncated image: the PNG's end is missing", path.string());
  }
  OpenedImage opened = Open(path.string(), path.string(), nullptr);
  const bool is_readable = opened.spec.format == OIIO::TypeDesc::UINT8 ||
                           (takes_16_bits && opened.spec.format == OIIO::TypeDesc::UINT16);
  if (!is_readable) {
    throw InputError("{}: expected 8 {}bits a channel, got {}",
                     path.string(),
                     takes_16_bits ? "or 16 " : "",
                     opened.spec.format.c_str());
  }
  return ReadPixels<uint8_t>(path.string(), opened, OIIO::TypeDesc::UINT8);
}

}  // namespace

Image<uint8_t> ReadImage8(const std::filesystem::path& path) { return ReadAs8(path, false); }

Image<uint8_t> ReadPicture8(const std::filesystem::path& path) { return ReadAs8(path, true); }

Image<float> ReadExr(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError("{}: no such file", path.string());
  }
  OpenedImage opened = Open(path.string(), path.string(), nullptr);
  const bool is_float =
      opened.spec.format == OIIO::TypeDesc::FLOAT || opened.spec.format == OIIO::TypeDesc::HALF;
  if (std::string(opened.input->format_name()) != "openexr" || !is_float) {
    throw InputError("{}: expected an OpenEXR file of float or half values", path.string());
  }
  return ReadPixels<float>(path.string(), opened, OIIO::TypeDesc::FLOAT);
}

Image<float> ReadHdrRgb(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError("{}: no such file", path.string());
  }
  OpenedImage opened = Open(path.string(), path.string(), nullptr);
  const std::string format = opened.input->format_name();
  if (format != "openexr" && format != "hdr") {
    throw InputError("{}: expected an OpenEXR or Radiance HDR file, got {}", path.string(), format);
  }
  const Image<float> image = ReadPixels<float>(path.string(), opened, OIIO::TypeDesc::FLOAT);
  const int num_channels = image.NumChannels();
  Image<float> rgb(image.WidthPx(), image.HeightPx(), 3);
  for (size_t i = 0; i < image.NumPixels(); ++i) {
    for (size_t channel = 0; channel < 3; ++channel) {
      rgb.Values()[3 * i + channel] =
          image.Values()[i * num_channels + (num_channels < 3 ? 0 : channel)];
    }
  }
  return rgb;
}

bool IsExr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

Image<uint8_t> DecodeImage8Rgba(std::span<const std::byte> bytes, const std::string& origin) {
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
  const auto starts_with = [&](std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  };
  // OpenImageIO chooses the format of a memory image by the name.
  const char* name = starts_with("\x89PNG")    ? "image.png"
                     : starts_with("\xff\xd8") ? "image.jpg"
                                               : nullptr;
  if (name == nullptr) {
    throw InputError("{}: expected a PNG or JPEG image", origin);
  }
  OpenedImage opened = Open(origin, name, &memory);
  return ToRgba(ReadPixels<uint8_t>(origin, opened, OIIO::TypeDesc::UINT8));
}

}  // namespace pfseq
