// SPDX-License-Identifier: Apache-2.0
// Results by hand, so that tests know what is in them.
#pragma once

#include "renderer/core/file.h"

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pfseq {

/// A triplet's or detector's share and count on the pairs of a benchmark, at every tolerance alike
/// but for 1e-4 a tolerance.
struct FakeSetting {
  std::string name;
  std::vector<double> shares;
  std::vector<int> counts;
  bool is_triplet = true;
};

/// results.json as results_writer.cpp writes it, of pairs 0, 40 and 24 or the first of them.
inline void WriteFakeResults(const std::filesystem::path& folder,
                             const std::vector<FakeSetting>& settings,
                             const std::string& variant = "clean",
                             const std::function<void(nlohmann::json&)>& change = nullptr) {
  const std::vector<int> frames = {0, 40, 24};
  nlohmann::json json = {
      {"format", "pfseq benchmark 2"},
      {"program_version", "0"},
      {"opencv_version", "0"},
      {"sequence", "fake"},
      {"variant", variant},
      {"judge", "ray"},
      {"seed", 1},
      {"tolerances_m", {0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.15}},
      {"tolerances_deg", nlohmann::json::array()},
      {"pairs", nlohmann::json::array()},
      {"settings", nlohmann::json::array()}};
  for (size_t pair = 0; !settings.empty() && pair < settings[0].shares.size(); ++pair) {
    json["pairs"].push_back({{"lens", "equisolid"},
                             {"pair", std::to_string(frames[pair])},
                             {"first", {{"camera", "front"}, {"frame", frames[pair]}}},
                             {"second", {{"camera", "rear"}, {"frame", frames[pair]}}}});
    for (const FakeSetting& setting : settings) {
      std::vector<double> shares;
      for (int t = 0; t < 12; ++t) {
        shares.push_back(setting.shares[pair] + 1e-4 * (t - 4));  // As given at 4 cm.
      }
      const std::vector<int> counts(12, setting.counts[pair]);
      nlohmann::json one = {{"setup", setting.name}, {"pair", pair}, {"degenerate", false}};
      one[setting.is_triplet ? "matching_score" : "repeatability"] = shares;
      one[setting.is_triplet ? "correct_matches" : "matches"] = counts;
      if (setting.is_triplet) {
        one["attempted"] = {1000};
      }
      json["settings"].push_back(one);
    }
  }
  if (change) {
    change(json);
  }
  WriteFileAtomically(folder / "results.json", json.dump());
}

}  // namespace pfseq
