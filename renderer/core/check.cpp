// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace pfseq {
namespace {

thread_local const FailureContext::Source* current_source = nullptr;

}  // namespace

void FailCheck(const char* expression, const char* file, int line, const std::string& text) {
  std::string message = fmt::format("{}:{}: broken invariant: {}", file, line, expression);
  if (!text.empty()) {
    message += ": " + text;
  }
  if (current_source != nullptr) {
    message += "\n" + current_source->Describe();
  }
  std::fputs((message + "\n").c_str(), stderr);
  std::abort();
}

FailureContext::FailureContext(const Source* source) : previous_(current_source) {
  current_source = source;
}

FailureContext::~FailureContext() { current_source = previous_; }

}  // namespace pfseq
