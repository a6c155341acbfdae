// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_factors.h"

#include "renderer/core/parse_number.h"
#include "renderer/sequence/yaml_type.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr size_t kMaxLevels = 1000;

/// A value as people call it: a file by its name alone.
std::string LabelOf(const YamlValue& value) {
  if (value.kind == YamlValue::Kind::kScalar) {
    const std::filesystem::path path = value.text;
    return path.extension() == ".yaml" ? path.stem().string() : value.text;
  }
  std::string text = InlineYamlText(value);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

StudyLevel LevelOf(const std::string& label, std::vector<SpecChange> changes) {
  return {label, std::move(changes), ParseNumber<double>(label)};
}

std::vector<StudyLevel> ReadLevels(const YamlValue& factor, const std::string& key) {
  const YamlValue* values = factor.Find("values");
  const YamlValue* levels = factor.Find("levels");
  if ((values == nullptr) == (levels == nullptr) ||
      (values == nullptr) != (factor.Find("key") == nullptr)) {
    FailAtYaml(factor, key, "expected either key and values, or levels");
  }
  std::vector<StudyLevel> result;
  if (values != nullptr) {
    const std::string changed = YamlWord(factor, key, "key");
    for (const YamlValue& value : YamlItems(*values, key + ".values")) {
      result.push_back(LevelOf(LabelOf(value), {{changed, value}}));
    }
  } else {
    const std::string levels_key = key + ".levels";
    for (const YamlValue& level : YamlItems(*levels, levels_key)) {
      CheckIsMapping(level, levels_key);
      CheckKnownKeys(level, levels_key, {"label", "set"});
      result.push_back(LevelOf(YamlWord(level, levels_key, "label"),
                               ReadChanges(level.Find("set"), levels_key + ".set")));
    }
  }
  if (result.size() < 2 || result.size() > kMaxLevels) {
    FailAtYaml(values != nullptr ? *values : *levels,
               key + (values != nullptr ? ".values" : ".levels"),
               fmt::format("expected 2 to {}, got {}", kMaxLevels, result.size()));
  }
  std::set<std::string> labels;
  for (const StudyLevel& level : result) {
    if (!labels.insert(level.label).second) {
      FailAtYaml(factor, key, fmt::format("label '{}' given twice", level.label));
    }
  }
  return result;
}

StudyFactor ReadFactor(const YamlEntry& entry, const YamlValue& factors) {
  const std::string key = JoinYamlKey("factors", entry.key);
  CheckName(entry, key, factors);
  CheckIsMapping(entry.value, key);
  CheckKnownKeys(entry.value, key, {"title", "key", "values", "levels", "base"});
  StudyFactor factor;
  factor.name = entry.key;
  factor.title = YamlWord(entry.value, key, "title", YamlWord(entry.value, key, "key", entry.key));
  factor.levels = ReadLevels(entry.value, key);
  if (const YamlValue* base = entry.value.Find("base")) {
    std::vector<std::string> labels;
    for (const StudyLevel& level : factor.levels) {
      labels.push_back(level.label);
    }
    const auto found = std::find(labels.begin(), labels.end(), LabelOf(*base));
    if (found == labels.end()) {
      FailExpected(*base, key + ".base", fmt::format("one of {}", fmt::join(labels, ", ")));
    }
    factor.base_idx = static_cast<size_t>(found - labels.begin());
  }
  return factor;
}

}  // namespace

bool StudyFactor::IsNumeric() const {
  return std::all_of(
      levels.begin(), levels.end(), [](const StudyLevel& level) { return level.number; });
}

std::string YamlWord(const YamlValue& mapping,
                     const std::string& key,
                     const std::string& name,
                     const std::optional<std::string>& otherwise) {
  const YamlValue* value = mapping.Find(name);
  if (value == nullptr && otherwise) {
    return *otherwise;
  }
  std::string text;
  YamlLine()->Read(value != nullptr ? *value : mapping, JoinYamlKey(key, name), text);
  return text;
}

std::vector<YamlValue> YamlItems(const YamlValue& value, const std::string& key) {
  if (value.kind == YamlValue::Kind::kScalar) {
    return {value};
  }
  if (value.kind != YamlValue::Kind::kList || value.items.empty()) {
    FailExpected(value, key, "a list of values");
  }
  return value.items;
}

std::vector<SpecChange> ReadChanges(const YamlValue* mapping, const std::string& key) {
  std::vector<SpecChange> changes;
  if (mapping != nullptr) {
    CheckIsMapping(*mapping, key);
    for (const YamlEntry& entry : mapping->entries) {
      changes.push_back({entry.key, entry.value});
    }
  }
  return changes;
}

std::vector<StudyFactor> ReadFactors(const YamlValue& root) {
  const YamlValue* factors = root.Find("factors");
  if (factors == nullptr || factors->kind != YamlValue::Kind::kMapping ||
      factors->entries.empty()) {
    FailExpected(factors != nullptr ? *factors : root, "factors", "at least one factor by name");
  }
  std::vector<StudyFactor> result;
  std::map<std::string, std::string> factor_of_key;
  for (const YamlEntry& entry : factors->entries) {
    result.push_back(ReadFactor(entry, *factors));
    for (const StudyLevel& level : result.back().levels) {
      for (const SpecChange& change : level.changes) {
        const auto known = factor_of_key.emplace(change.key, entry.key).first;
        if (known->second != entry.key) {
          FailAtYaml(change.value,
                     JoinYamlKey("factors", entry.key),
                     fmt::format("sets {}, as factor {} does", change.key, known->second));
        }
      }
    }
  }
  return result;
}

std::vector<StudyLevel> ReadRepetitions(const YamlValue* mapping) {
  if (mapping == nullptr) {
    return {{"1", {}, 1.0}};
  }
  CheckIsMapping(*mapping, "repetitions");
  std::vector<StudyLevel> repetitions;
  for (const YamlEntry& entry : mapping->entries) {
    const std::string key = "repetitions." + entry.key;
    const std::vector<YamlValue> values = YamlItems(entry.value, key);
    const bool is_first = &entry == &mapping->entries.front();
    if (!is_first && values.size() != repetitions.size()) {
      FailAtYaml(
          entry.value,
          key,
          fmt::format("expected {} values as above, got {}", repetitions.size(), values.size()));
    }
    repetitions.resize(values.size());
    for (size_t i = 0; i < values.size(); ++i) {
      repetitions[i].label = fmt::format("{}", i + 1);
      repetitions[i].changes.push_back({entry.key, values[i]});
    }
  }
  if (repetitions.empty()) {
    FailExpected(*mapping, "repetitions", "KEY: [VALUE, ...]");
  }
  return repetitions;
}

}  // namespace pfseq
