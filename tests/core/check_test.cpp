// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/check.h"

#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

class FixedSource : public FailureContext::Source {
 public:
  explicit FixedSource(std::string text) : text_(std::move(text)) {}
  std::string Describe() const override { return text_; }

 private:
  std::string text_;
};

TEST(PfseqCheckDeathTest, AbortsWithExpressionValuesAndInnermostContext) {
  EXPECT_DEATH(
      {
        const FixedSource outer("outer");
        const FixedSource inner("to repeat: this pixel");
        const FailureContext outer_scope(&outer);
        const FailureContext inner_scope(&inner);
        PFSEQ_CHECK(1 + 1 == 3, "value {}", 42);
      },
      "1 \\+ 1 == 3: value 42\nto repeat: this pixel");
}

TEST(PfseqCheckDeathTest, ContextEndsWithItsScope) {
  EXPECT_DEATH(
      {
        const FixedSource outer("outer");
        const FailureContext outer_scope(&outer);
        {
          const FixedSource inner("inner");
          const FailureContext inner_scope(&inner);
        }
        PFSEQ_CHECK(false);
      },
      "false\nouter");
}

}  // namespace
}  // namespace pfseq
