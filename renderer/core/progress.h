// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace pfseq {

/// A progress line with the time left on standard error: redrawn in place on a terminal, one line
/// every ten seconds elsewhere. Thread-safe; workers only call Advance.
class Progress {
 public:
  /// `total` counts any unit of work; `quiet` prints nothing at all.
  Progress(std::string title, uint64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Advance(uint64_t amount = 1);

  /// A word on what is being done now, shown behind the bar.
  void SetDetail(const std::string& detail);

  /// Prints the closing line (title, time taken); called by the destructor if it was not before.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  void Draw(Clock::time_point now);

  const std::string title_;
  const uint64_t total_;
  const bool quiet_;
  const bool is_terminal_;
  const Clock::time_point start_;
  std::atomic<uint64_t> done_{0};
  std::atomic<int64_t> next_draw_ns_{0};
  std::mutex mutex_;
  std::string detail_;
  bool finished_ = false;
};

/// "12 s", "3 min 05 s", "2 h 07 min".
std::string DurationText(double duration_s);

}  // namespace pfseq
