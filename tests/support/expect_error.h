// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {

/// The text of the exception of type Error that `action` throws; a test failure and "" when it
/// throws none.
template <typename Error, typename Action>
std::string MessageOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << "expected one line: " << text;
    return text;
  }
  ADD_FAILURE() << "expected an exception";
  return "";
}

}  // namespace pfseq
