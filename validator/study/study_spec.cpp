// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_spec.h"

#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"
#include "renderer/sequence/yaml_type.h"
#include "validator/benchmark/pairs.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr const char* kOneAtATime = "one at a time";
constexpr const char* kAllCombinations = "all combinations";
constexpr size_t kMaxLevels = 1000;

/// A scalar's text; the default where the key is not there.
std::string Text(const YamlValue& mapping,
                 const std::string& key,
                 const std::string& name,
                 const std::optional<std::string>& otherwise = std::nullopt) {
  const YamlValue* value = mapping.Find(name);
  if (value == nullptr && otherwise) {
    return *otherwise;
  }
  std::string text;
  YamlLine()->Read(value != nullptr ? *value : mapping, JoinYamlKey(key, name), text);
  return text;
}

std::string Choice(const YamlValue& root, const std::string& name, std::vector<std::string> words) {
  std::string word = words.front();
  if (const YamlValue* value = root.Find(name)) {
    YamlChoice(std::move(words))->Read(*value, name, word);
  }
  return word;
}

/// The items of a list that is not empty; a scalar stands for a list of one.
std::vector<YamlValue> Items(const YamlValue& value, const std::string& key) {
  if (value.kind == YamlValue::Kind::kScalar) {
    return {value};
  }
  if (value.kind != YamlValue::Kind::kList || value.items.empty()) {
    FailExpected(value, key, "a list of values");
  }
  return value.items;
}

std::vector<std::string> Words(const YamlValue& root, const std::string& name) {
  std::vector<std::string> words;
  if (const YamlValue* list = root.Find(name)) {
    for (const YamlValue& item : Items(*list, name)) {
      YamlLine()->Read(item, name, words.emplace_back());
    }
  }
  return words;
}

std::filesystem::path Absolute(const YamlValue& value) {
  return std::filesystem::absolute(value.origin.folder / value.text).lexically_normal();
}

/// Makes the paths of files that there are absolute: they start at the study's folder, wherever
/// the study is written again.
void MakePathsAbsolute(YamlValue& value) {
  const bool looks_like_file = value.kind == YamlValue::Kind::kScalar &&
                               value.text.find('.') != std::string::npos &&
                               value.text.find('\n') == std::string::npos;
  std::error_code error;
  if (looks_like_file && std::filesystem::is_regular_file(Absolute(value), error)) {
    value.text = Absolute(value).string();
  }
  for (YamlValue& item : value.items) {
    MakePathsAbsolute(item);
  }
  for (YamlEntry& entry : value.entries) {
    MakePathsAbsolute(entry.value);
  }
}

std::vector<SpecChange> Changes(const YamlValue* mapping, const std::string& key) {
  std::vector<SpecChange> changes;
  if (mapping != nullptr) {
    CheckIsMapping(*mapping, key);
    for (const YamlEntry& entry : mapping->entries) {
      changes.push_back({entry.key, entry.value});
    }
  }
  return changes;
}

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
  if ((values == nullptr) == (levels == nullptr)) {
    FailAtYaml(factor, key, "expected either key and values, or levels");
  }
  std::vector<StudyLevel> result;
  if (values != nullptr) {
    const std::string changed = Text(factor, key, "key");
    for (const YamlValue& value : Items(*values, key + ".values")) {
      result.push_back(LevelOf(LabelOf(value), {{changed, value}}));
    }
  } else {
    const std::string levels_key = key + ".levels";
    for (const YamlValue& level : Items(*levels, levels_key)) {
      CheckIsMapping(level, levels_key);
      CheckKnownKeys(level, levels_key, {"label", "set"});
      result.push_back(LevelOf(Text(level, levels_key, "label"),
                               Changes(level.Find("set"), levels_key + ".set")));
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
  factor.title = Text(entry.value, key, "title", Text(entry.value, key, "key", entry.key));
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
    const std::vector<YamlValue> values = Items(entry.value, key);
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

std::vector<std::array<std::string, 2>> ReadCompare(const YamlValue* list, const Grid& grid) {
  std::vector<std::array<std::string, 2>> pairs;
  if (list == nullptr) {
    return pairs;
  }
  std::set<std::string> known;
  for (const std::vector<std::string>& names : {grid.DetectorNames(), grid.TripletNames()}) {
    known.insert(names.begin(), names.end());
  }
  for (const YamlValue& item : Items(*list, "compare")) {
    std::array<std::string, 2> pair;
    YamlArray<2>(YamlLine())->Read(item, "compare", pair);
    for (const std::string& name : pair) {
      if (known.find(name) == known.end()) {
        FailAtYaml(item, "compare", fmt::format("the grid has no setting '{}'", name));
      }
    }
    pairs.push_back(pair);
  }
  return pairs;
}

double ReadTolerance(const YamlValue& root) {
  double tolerance_m = StudySpec().tolerance_m;
  if (const YamlValue* value = root.Find("tolerance_m")) {
    YamlNumber({})->Read(*value, "tolerance_m", tolerance_m);
    if (std::find(std::begin(kTolerancesM), std::end(kTolerancesM), tolerance_m) ==
        std::end(kTolerancesM)) {
      FailExpected(
          *value, "tolerance_m", fmt::format("one of {}", fmt::join(kTolerancesM, ", ")));
    }
  }
  return tolerance_m;
}

/// The tree of the grid, from its own file where the study names one.
YamlValue GridTree(const YamlValue& root) {
  const YamlValue* grid = root.Find("grid");
  if (grid == nullptr) {
    FailAtYaml(root, "grid", "expected a file (data/grids/*.yaml) or a grid's mapping");
  }
  YamlValue tree = grid->kind == YamlValue::Kind::kScalar ? ReadYaml(Absolute(*grid)) : *grid;
  for (YamlEntry& entry : tree.entries) {
    for (YamlValue& item : entry.value.items) {
      for (const char* path : {"files", "matches"}) {
        YamlValue* value = entry.key == "imported" ? item.Find(path) : nullptr;
        if (value != nullptr && !value->text.empty()) {
          value->text = Absolute(*value).string();
        }
      }
    }
  }
  return tree;
}

void Put(YamlValue& root, const std::string& key, YamlValue value) {
  if (YamlValue* old = root.Find(key)) {
    *old = std::move(value);
  } else {
    root.entries.push_back({key, std::move(value)});
  }
}

}  // namespace

bool StudyFactor::IsNumeric() const {
  return std::all_of(
      levels.begin(), levels.end(), [](const StudyLevel& level) { return level.number; });
}

StudySpec ReadStudy(const std::filesystem::path& path) {
  YamlValue root = ReadYaml(path);
  if (root.kind != YamlValue::Kind::kMapping) {
    FailAtYaml(root, "", "expected a study (KEY: VALUE), got " + DescribeYaml(root));
  }
  CheckKnownKeys(root,
                 "",
                 {"name",
                  "base",
                  "set",
                  "factors",
                  "design",
                  "repetitions",
                  "pairs",
                  "cameras",
                  "lenses",
                  "grid",
                  "images",
                  "judge",
                  "tolerance_m",
                  "compare"});
  StudySpec study;
  study.name = Text(root, "", "name", path.stem().string());
  Text(root, "", "base");
  study.base = Absolute(*root.Find("base"));
  study.changes = Changes(root.Find("set"), "set");
  study.factors = ReadFactors(root);
  const std::string design = Choice(root, "design", {kOneAtATime, kAllCombinations});
  study.design =
      design == kOneAtATime ? StudyDesign::kOneAtATime : StudyDesign::kAllCombinations;
  study.repetitions = ReadRepetitions(root.Find("repetitions"));
  if (root.Find("pairs") == nullptr) {
    FailAtYaml(root, "pairs", "expected frames such as [24, 40] (as --pairs of pfseq bench)");
  }
  study.pairs = fmt::format("{}", fmt::join(Words(root, "pairs"), ","));
  FramesOfPairs(study.pairs);
  study.lenses = Words(root, "lenses");
  if (const YamlValue* cameras = root.Find("cameras")) {
    YamlArray<2>(YamlLine())->Read(*cameras, "cameras", study.cameras);
  }
  const YamlValue grid = GridTree(root);
  study.grid = Grid::FromTree(grid);
  study.images = Choice(root, "images", {"realistic", "clean"});
  const std::string judge = Choice(root, "judge", {"ray", "map"});
  study.judge = judge == "map" ? Judge::kMap : Judge::kRay;
  study.tolerance_m = ReadTolerance(root);
  study.compare = ReadCompare(root.Find("compare"), study.grid);

  MakePathsAbsolute(root);
  Put(root, "name", YamlValue::Scalar(study.name));
  Put(root, "design", YamlValue::Scalar(design));
  Put(root, "images", YamlValue::Scalar(study.images));
  Put(root, "judge", YamlValue::Scalar(judge));
  Put(root, "tolerance_m", YamlValue::Scalar(fmt::format("{}", study.tolerance_m)));
  Put(root, "grid", grid);
  study.effective_yaml = YamlText(root);
  return study;
}

}  // namespace pfseq
