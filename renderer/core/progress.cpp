// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace pfseq {
namespace {

constexpr int kBarWidth = 24;
constexpr int64_t kTerminalIntervalNs = 200'000'000;
constexpr int64_t kLogIntervalNs = 10'000'000'000;

}  // namespace

std::string DurationText(double duration_s) {
  const auto seconds = static_cast<int64_t>(std::llround(duration_s));
  if (seconds < 60) {
    return fmt::format("{} s", seconds);
  }
  if (seconds < 3600) {
    return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  }
  return fmt::format("{} h {:02} min", seconds / 3600, seconds % 3600 / 60);
}

Progress::Progress(std::string title, uint64_t total, bool quiet)
    : title_(std::move(title)),
      total_(std::max<uint64_t>(total, 1)),
      quiet_(quiet),
      is_terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_draw_ns_(is_terminal_ ? kTerminalIntervalNs : kLogIntervalNs) {}

Progress::~Progress() { Finish(); }

void Progress::Advance(uint64_t amount) {
  done_ += amount;
  const Clock::time_point now = Clock::now();
  const int64_t elapsed_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(now - start_).count();
  int64_t due_ns = next_draw_ns_.load();
  const int64_t interval_ns = is_terminal_ ? kTerminalIntervalNs : kLogIntervalNs;
  // One thread wins the exchange and draws; the others go on.
  if (!quiet_ && elapsed_ns >= due_ns &&
      next_draw_ns_.compare_exchange_strong(due_ns, elapsed_ns + interval_ns)) {
    Draw(now);
  }
}

void Progress::SetDetail(const std::string& detail) {
  const std::lock_guard lock(mutex_);
  detail_ = detail;
}

void Progress::Draw(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (finished_) {
    return;
  }
  const double share =
      std::min(1.0, static_cast<double>(done_.load()) / static_cast<double>(total_));
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      share > 0.0 ? DurationText(elapsed_s * (1.0 - share) / share) + " left" : "";
  if (is_terminal_) {
    const auto filled = static_cast<size_t>(std::lround(share * kBarWidth));
    fmt::print(stderr,
               "\r\033[K{} [{}{}] {:3.0f} %  {}  {}",
               title_,
               std::string(filled, '#'),
               std::string(kBarWidth - filled, '.'),
               100.0 * share,
               left,
               detail_);
  } else {
    fmt::print(stderr,
               "{}: {:.0f} %, {}{}{}\n",
               title_,
               100.0 * share,
               left,
               detail_.empty() ? "" : ", ",
               detail_);
  }
  std::fflush(stderr);
}

void Progress::Finish() {
  const std::lock_guard lock(mutex_);
  if (finished_) {
    return;
  }
  finished_ = true;
  if (quiet_) {
    return;
  }
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  const bool complete = done_.load() >= total_;
  fmt::print(stderr,
             "{}{}: {} in {}\n",
             is_terminal_ ? "\r\033[K" : "",
             title_,
             complete ? "done" : "stopped",
             DurationText(elapsed_s));
}

}  // namespace pfseq
