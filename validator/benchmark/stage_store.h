// SPDX-License-Identifier: Apache-2.0
// Results of stages on disk, under a hash of all that they depend on.
#pragma once

#include "validator/features/detect.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfseq {

/// Attempted matches by index of key points, for each of a unit's settings in order.
using MatchLists = std::vector<std::vector<std::pair<int, int>>>;

/// A folder of stages, or nowhere. Safe for many threads and programs at once: files are written
/// under a temporary name and renamed. A damaged file counts as missing.
class StageStore {
 public:
  /// Empty: keeps nothing.
  explicit StageStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The hash of what a stage depends on.
  static std::string KeyOf(const std::vector<std::string>& inputs);

  std::optional<FamilyKeyPoints> LoadKeyPoints(const std::string& key) const;
  void SaveKeyPoints(const std::string& key, const FamilyKeyPoints& points) const;
  std::optional<MatchLists> LoadMatches(const std::string& key) const;
  void SaveMatches(const std::string& key, const MatchLists& lists) const;

 private:
  std::optional<std::string> Load(const std::string& key, const char* kind) const;
  void Save(const std::string& key, const char* kind, const std::string& bytes) const;

  std::filesystem::path folder_;
};

}  // namespace pfseq
