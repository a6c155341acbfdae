// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pfseq {

/// Base64 (RFC 4648) of bytes.
std::string Base64(std::span<const std::byte> bytes);

/// An 8-bit image (1, 3 or 4 channels) as the data: address of a JPEG file.
std::string JpegUri(const Image<uint8_t>& image);
/// The same as a PNG file, without loss.
std::string PngUri(const Image<uint8_t>& image);

}  // namespace pfseq
