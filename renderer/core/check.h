// SPDX-License-Identifier: Apache-2.0
// Invariants. PFSEQ_CHECK is always on and aborts with values; PFSEQ_DCHECK is for inner loops of
// debug builds.
#pragma once

#include <string>

#include <fmt/format.h>

namespace pfseq {

/// Prints the broken invariant and the thread's context (see FailureContext) to standard error,
/// then aborts.
[[noreturn]] void FailCheck(const char* expression,
                            const char* file,
                            int line,
                            const std::string& text);

/// While alive, a broken invariant in this thread also prints `text` (for example the command that
/// repeats the failing pixel). Contexts nest. The pointed-to object must outlive the context.
class FailureContext {
 public:
  /// Something that can tell, in a crash, what the thread was doing.
  struct Source {
    virtual ~Source() = default;
    virtual std::string Describe() const = 0;
  };

  explicit FailureContext(const Source* source);
  ~FailureContext();
  FailureContext(const FailureContext&) = delete;
  FailureContext& operator=(const FailureContext&) = delete;

 private:
  const Source* previous_;
};

}  // namespace pfseq

#define PFSEQ_CHECK(expression, ...)                                                      \
  do {                                                                                    \
    if (!(expression)) [[unlikely]] {                                                     \
      ::pfseq::FailCheck(#expression, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__)); \
    }                                                                                     \
  } while (false)

#ifdef NDEBUG
#define PFSEQ_DCHECK(expression, ...) \
  do {                                \
  } while (false)
#else
#define PFSEQ_DCHECK(expression, ...) PFSEQ_CHECK(expression, __VA_ARGS__)
#endif
