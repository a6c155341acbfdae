// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/check.h"

#include <functional>
#include <string>

namespace pfseq {

/// Names the pixel that a thread is working on, should an invariant break there.
class PixelContext : public FailureContext::Source {
 public:
  explicit PixelContext(const std::function<std::string(int, int)>& describe)
      : describe_(describe) {}
  std::string Describe() const override { return describe_ ? describe_(x, y) : std::string(); }

  int x = 0;
  int y = 0;

 private:
  const std::function<std::string(int, int)>& describe_;
};

}  // namespace pfseq
