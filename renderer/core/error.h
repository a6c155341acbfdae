// SPDX-License-Identifier: Apache-2.0
// What can go wrong outside the program, in two kinds (a broken invariant is PFSEQ_CHECK's
// business).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace pfseq {

/// Bad input: a file, flag or value that the user can mend. The program ends with exit status 2.
/// The text is one line: what, where, what was expected.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& text) : std::runtime_error(text) {}

  template <typename... Args>
  explicit InputError(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// The world failed: disk, codec, library. The program ends with exit status 1.
/// The text is one line with the path and the system's reason.
class SystemError : public std::runtime_error {
 public:
  explicit SystemError(const std::string& text) : std::runtime_error(text) {}

  template <typename... Args>
  explicit SystemError(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

}  // namespace pfseq
