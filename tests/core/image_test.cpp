// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/image.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Image, IsRowMajorWithInterleavedChannels) {
  Image<int> image(3, 2, 2);
  int value = 0;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      for (int channel = 0; channel < 2; ++channel) {
        image.At(x, y, channel) = value++;
      }
    }
  }
  for (int i = 0; i < value; ++i) {
    EXPECT_EQ(image.Values()[static_cast<size_t>(i)], i);
  }
  EXPECT_EQ(image.NumPixels(), 6U);
}

}  // namespace
}  // namespace pfseq
