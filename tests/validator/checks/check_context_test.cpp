// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_context.h"

#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"

#include <gtest/gtest.h>

namespace pfseq {
namespace {

int AutomaticStridePx(int size_px) {
  TempFolder folder;
  TestSequence sequence = TestSequence::Yard(size_px);
  sequence.frames = {};
  sequence.Write(folder.Path());
  const SequenceReader reader(folder.Path());
  return CheckContext{reader, nullptr, {}, {}}.StridePx();
}

TEST(CheckContext, SmallImagesAreComparedPixelByPixel) {
  EXPECT_EQ(AutomaticStridePx(48), 1);
  EXPECT_EQ(AutomaticStridePx(300), 1);
  EXPECT_EQ(AutomaticStridePx(1200), 4);
}

}  // namespace
}  // namespace pfseq
