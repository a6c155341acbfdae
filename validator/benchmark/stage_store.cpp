// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/stage_store.h"

#include "renderer/core/bytes.h"
#include "renderer/core/file.h"

#include <array>
#include <mutex>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// Changes whenever a stage of the same inputs would come out differently.
constexpr const char* kVersion = "pfseq stage 1 " PFSEQ_VERSION;
constexpr size_t kHashDigits = 64;

/// A key point as stored.
struct StoredPoint {
  float x, y, size, angle, response;
  int32_t octave, class_id;
  uint32_t zero;
  uint64_t members;
};

}  // namespace

std::string StageStore::KeyOf(const std::vector<std::string>& inputs) {
  std::string text = kVersion;
  for (const std::string& input : inputs) {
    text += fmt::format("\n{} {}", input.size(), input);
  }
  return Sha256Hex(text);
}

std::optional<std::string> StageStore::Load(const std::string& key, const char* kind) const {
  const std::filesystem::path path = folder_ / (key + kind);
  if (folder_.empty() || !std::filesystem::exists(path)) {
    return std::nullopt;
  }
  std::string bytes = ReadFile(path);
  if (bytes.size() < kHashDigits ||
      Sha256Hex(std::string_view(bytes).substr(kHashDigits)) != bytes.substr(0, kHashDigits)) {
    return std::nullopt;
  }
  return bytes.substr(kHashDigits);
}

void StageStore::Save(const std::string& key, const char* kind, const std::string& bytes) const {
  if (!folder_.empty()) {
    // Two threads of a program would use the same temporary name.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    WriteFileAtomically(folder_ / (key + kind), Sha256Hex(bytes) + bytes);
  }
}

std::optional<FamilyKeyPoints> StageStore::LoadKeyPoints(const std::string& key) const {
  const std::optional<std::string> bytes = Load(key, ".points");
  if (!bytes) {
    return std::nullopt;
  }
  FamilyKeyPoints family;
  ByteReader reader(*bytes);
  StoredPoint stored;
  while (reader.Take(stored)) {
    family.points.emplace_back(stored.x,
                               stored.y,
                               stored.size,
                               stored.angle,
                               stored.response,
                               stored.octave,
                               stored.class_id);
    family.members.push_back(stored.members);
  }
  return family;
}

void StageStore::SaveKeyPoints(const std::string& key, const FamilyKeyPoints& family) const {
  std::string bytes;
  for (size_t i = 0; i < family.points.size(); ++i) {
    const cv::KeyPoint& point = family.points[i];
    AppendBytes(StoredPoint{point.pt.x,
                            point.pt.y,
                            point.size,
                            point.angle,
                            point.response,
                            point.octave,
                            point.class_id,
                            0,
                            family.members[i]},
                bytes);
  }
  Save(key, ".points", bytes);
}

std::optional<MatchLists> StageStore::LoadMatches(const std::string& key) const {
  const std::optional<std::string> bytes = Load(key, ".matches");
  if (!bytes) {
    return std::nullopt;
  }
  MatchLists lists;
  ByteReader reader(*bytes);
  uint64_t size = 0;
  while (reader.Take(size)) {
    std::vector<std::pair<int, int>>& list = lists.emplace_back();
    std::array<int32_t, 2> match;
    for (uint64_t i = 0; i < size && reader.Take(match); ++i) {
      list.emplace_back(match[0], match[1]);
    }
  }
  return lists;
}

void StageStore::SaveMatches(const std::string& key, const MatchLists& lists) const {
  std::string bytes;
  for (const auto& list : lists) {
    AppendBytes(static_cast<uint64_t>(list.size()), bytes);
    for (const auto& [first, second] : list) {
      AppendBytes(std::array<int32_t, 2>{first, second}, bytes);
    }
  }
  Save(key, ".matches", bytes);
}

}  // namespace pfseq
