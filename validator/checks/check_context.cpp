// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_context.h"

#include <algorithm>

namespace pfseq {

int CheckContext::StridePx() const {
  constexpr int kSamplesPerRow = 300;
  return options.stride_px > 0 ? options.stride_px : std::max(1, reader.WidthPx() / kSamplesPerRow);
}

}  // namespace pfseq
