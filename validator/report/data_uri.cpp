// SPDX-License-Identifier: Apache-2.0
#include "validator/report/data_uri.h"

#include "renderer/core/error.h"
#include "renderer/sequence/image_io.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <openssl/evp.h>

namespace pfseq {
namespace {

constexpr int kJpegQuality = 80;

std::string Uri(const char* type, std::span<const std::byte> bytes) {
  return std::string("data:image/") + type + ";base64," + Base64(bytes);
}

}  // namespace

std::string Base64(std::span<const std::byte> bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<size_t>(length));
  return text;
}

std::string JpegUri(const Image<uint8_t>& image) {
  const cv::Mat pixels(image.HeightPx(),
                       image.WidthPx(),
                       CV_8UC(image.NumChannels()),
                       const_cast<uint8_t*>(image.Values().data()));
  cv::Mat bgr;
  cv::cvtColor(pixels,
               bgr,
               image.NumChannels() == 1   ? cv::COLOR_GRAY2BGR
               : image.NumChannels() == 3 ? cv::COLOR_RGB2BGR
                                          : cv::COLOR_RGBA2BGR);
  std::vector<uint8_t> bytes;
  if (!cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality})) {
    throw SystemError("OpenCV cannot write JPEG images");
  }
  return Uri("jpeg", std::as_bytes(std::span(bytes)));
}

std::string PngUri(const Image<uint8_t>& image) { return Uri("png", EncodePng(image)); }

}  // namespace pfseq
