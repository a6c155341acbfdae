// SPDX-License-Identifier: Apache-2.0
// Images to and from files, through OpenImageIO.
#pragma once

#include "renderer/core/image.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

using Bytes = std::vector<std::byte>;

/// Small files, or soon done: some tenth more bytes.
enum class PngEffort { kSmall, kFast };

/// PNG of an 8-bit image of 1, 3 or 4 channels.
Bytes EncodePng(const Image<uint8_t>& image, PngEffort effort = PngEffort::kSmall);

/// PNG of 16 bits a channel.
Bytes EncodePng16(const Image<uint16_t>& image);

/// JPEG of an 8-bit image of 1 or 3 channels; quality from 1 to 100.
Bytes EncodeJpeg(const Image<uint8_t>& image, int quality);

/// OpenEXR, float32, single-part scanlines, ZIP; one channel is named Y, two X, Y, three R, G, B.
Bytes EncodeExrFloat(const Image<float>& image);

/// The same with half-float values; finite values are clamped to the range of half.
Bytes EncodeExrHalf(const Image<float>& image);

/// Any 8-bit image file, with the channels it has. InputError that names `path` and the fault when
/// it is missing, truncated, or not of 8 bits a channel.
Image<uint8_t> ReadImage8(const std::filesystem::path& path);

/// The same of 8 or 16 bits a channel, reduced to 8.
Image<uint8_t> ReadPicture8(const std::filesystem::path& path);

/// An OpenEXR file of float or half values. InputError as above.
Image<float> ReadExr(const std::filesystem::path& path);

/// An OpenEXR or Radiance HDR file as 3 channels; a single one counts for all three. InputError as
/// above.
Image<float> ReadHdrRgb(const std::filesystem::path& path);

/// Whether a file's bytes are those of an OpenEXR file.
bool IsExr(std::string_view bytes);

/// An 8-bit image in memory (PNG, JPEG, ...) as 4 channels; 16-bit sources are reduced. InputError
/// with `origin`.
Image<uint8_t> DecodeImage8Rgba(std::span<const std::byte> bytes, const std::string& origin);

}  // namespace pfseq
