// SPDX-License-Identifier: Apache-2.0
// The verdict of a study in words.
#include "renderer/core/error.h"
#include "validator/study/study_analysis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

/// More levels than these without a difference are not listed.
constexpr size_t kMaxListed = 4;

/// With a sign that is no hyphen.
std::string SignedText(double points) {
  const std::string text = fmt::format("{:.1f}", std::abs(points));
  return (points < 0.0 ? "\u2212" : "+") + text;
}

/// A difference of shares in points of a hundred with its interval: "-3.1 [-4.0 to -2.2]".
std::string PointsText(const Interval& interval) {
  std::string text = SignedText(100.0 * interval.mean);
  if (!std::isnan(interval.low)) {
    text += fmt::format(
        " [{} to {}]", SignedText(100.0 * interval.low), SignedText(100.0 * interval.high));
  }
  return text;
}

std::string LevelsText(const StudyFactor& factor, const std::vector<size_t>& levels) {
  std::vector<std::string> labels;
  for (const size_t level : levels) {
    labels.push_back(factor.levels[level].label);
  }
  return fmt::format("{}", fmt::join(labels, ", "));
}

/// Where the line between two levels' differences passes 0.
double CrossingAt(const StudyFactor& factor,
                  const std::vector<Interval>& differences,
                  size_t before,
                  size_t after) {
  const double from = *factor.levels[before].number;
  const double to = *factor.levels[after].number;
  const double share =
      differences[before].mean / (differences[before].mean - differences[after].mean);
  return from + share * (to - from);
}

/// Levels by their numbers where they have some, else as they come.
std::vector<size_t> OrderOfLevels(const StudyFactor& factor) {
  std::vector<size_t> order(factor.levels.size());
  for (size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  if (factor.IsNumeric()) {
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return *factor.levels[a].number < *factor.levels[b].number;
    });
  }
  return order;
}

/// Where the means change sides, of numbers alone: words have no order.
std::string CrossingText(const StudyFactor& factor, const std::vector<Interval>& differences) {
  if (!factor.IsNumeric()) {
    return "";
  }
  std::vector<std::string> places;
  std::optional<size_t> last;
  for (const size_t level : OrderOfLevels(factor)) {
    const double mean = differences[level].mean;
    if (std::isnan(mean) || mean == 0.0) {
      continue;
    }
    if (last && std::signbit(differences[*last].mean) != std::signbit(mean)) {
      places.push_back(fmt::format("{:.2g}", CrossingAt(factor, differences, *last, level)));
    }
    last = level;
  }
  return places.empty() ? ""
                        : fmt::format(" The means cross at about {}.", fmt::join(places, ", "));
}

}  // namespace

ShortNames ShortNamesOf(const std::string& a, const std::string& b) {
  try {
    const ParsedName of_a = ParseName(a);
    const ParsedName of_b = ParseName(b);
    if (of_a.detector == of_b.detector && of_a.matcher && of_b.matcher) {
      ShortNames names = {DescriptorName(*of_a.descriptor), DescriptorName(*of_b.descriptor), ""};
      names.shared = of_a.detector.Name() + " points";
      if (of_a.matcher == of_b.matcher) {
        names.shared += ", " + MatcherName(*of_a.matcher);
      } else {
        names.a += " " + MatcherName(*of_a.matcher);
        names.b += " " + MatcherName(*of_b.matcher);
      }
      return names;
    }
  } catch (const InputError&) {
    // Features made elsewhere.
  }
  return {a, b, ""};
}

std::string EffectText(const StudyFactor& factor, const Effect& effect, const std::string& metric) {
  std::vector<size_t> order = OrderOfLevels(factor);
  const auto greatest = std::max_element(order.begin(), order.end(), [&](size_t a, size_t b) {
    const double of_a = std::abs(effect.changes[a].mean);
    const double of_b = std::abs(effect.changes[b].mean);
    return (std::isnan(of_a) ? -1.0 : of_a) < (std::isnan(of_b) ? -1.0 : of_b);
  });
  if (std::isnan(effect.changes[*greatest].mean)) {
    return fmt::format("{}: no {} to compare.", factor.title, metric);
  }
  const Interval& change = effect.changes[*greatest];
  std::string text = fmt::format("{}: the {} changes most from {} to {}, by {} points of 100",
                                 factor.title,
                                 metric,
                                 factor.levels[factor.base_idx].label,
                                 factor.levels[*greatest].label,
                                 PointsText(change));
  if (!change.IsAbove0() && !change.IsBelow0()) {
    text += ", which cannot be told from none";
  }
  if (!std::isnan(effect.shares.levels)) {
    text += fmt::format("; its levels explain {:.0f} % of the variance, places and scenes {:.0f} %",
                        100.0 * effect.shares.levels,
                        100.0 * effect.shares.samples);
  }
  return text + ".";
}

std::string ComparisonText(const StudyFactor& factor,
                           const ShortNames& names,
                           const std::vector<Interval>& differences) {
  std::vector<size_t> ahead, behind, open;
  for (const size_t level : OrderOfLevels(factor)) {
    (differences[level].IsAbove0()   ? ahead
     : differences[level].IsBelow0() ? behind
                                     : open)
        .push_back(level);
  }
  const std::string on = names.shared.empty() ? "" : fmt::format(" ({})", names.shared);
  const auto by = [&](const std::vector<size_t>& levels) {
    return fmt::format(
        "{} at {}", PointsText(differences[levels.back()]), factor.levels[levels.back()].label);
  };
  const auto at = [&](const std::vector<size_t>& levels) {
    return levels.size() == 1
               ? fmt::format(
                     "{} ({})", factor.levels[levels[0]].label, PointsText(differences[levels[0]]))
               : fmt::format("{} ({})", LevelsText(factor, levels), by(levels));
  };
  const std::string crossing = CrossingText(factor, differences);
  if (!ahead.empty() && !behind.empty()) {
    if (!factor.IsNumeric()) {
      return fmt::format("{} against {}{}: ahead at {}, behind at {}.",
                         names.a,
                         names.b,
                         on,
                         at(ahead),
                         at(behind));
    }
    const bool rises = *factor.levels[behind.back()].number < *factor.levels[ahead.back()].number;
    return fmt::format("{} {} {}{}: {} at {}, {} at {}.{}",
                       names.a,
                       rises ? "overtakes" : "falls behind",
                       names.b,
                       on,
                       rises ? "behind" : "ahead",
                       at(rises ? behind : ahead),
                       rises ? "ahead" : "behind",
                       at(rises ? ahead : behind),
                       crossing);
  }
  if (ahead.empty() && behind.empty()) {
    return fmt::format(
        "{} and {}{}: no difference can be told at any level.{}", names.a, names.b, on, crossing);
  }
  const bool is_ahead = !ahead.empty();
  const std::vector<size_t>& sure = is_ahead ? ahead : behind;
  return fmt::format(
      "{} is {} {}{} at {}.{}",
      names.a,
      is_ahead ? "ahead of" : "behind",
      names.b,
      on,
      open.empty()
          ? fmt::format("every level ({}, {})", by({sure.front()}), by(sure))
          : fmt::format("{}; {} no difference can be told",
                        at(sure),
                        open.size() > kMaxListed ? "elsewhere" : "at " + LevelsText(factor, open)),
      crossing);
}

}  // namespace pfseq
