// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_spec.h"

#include "renderer/core/error.h"
#include "renderer/sequence/yaml_type.h"
#include "validator/benchmark/pairs.h"
#include "validator/study/study_factors.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr const char* kOneAtATime = "one at a time";
constexpr const char* kAllCombinations = "all combinations";

std::string Choice(const YamlValue& root, const std::string& name, std::vector<std::string> words) {
  std::string word = words.front();
  if (const YamlValue* value = root.Find(name)) {
    YamlChoice(std::move(words))->Read(*value, name, word);
  }
  return word;
}

std::vector<std::string> Words(const YamlValue& root, const std::string& name) {
  std::vector<std::string> words;
  if (const YamlValue* list = root.Find(name)) {
    for (const YamlValue& item : YamlItems(*list, name)) {
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

std::vector<std::array<std::string, 2>> ReadCompare(const YamlValue* list, const Grid& grid) {
  std::vector<std::array<std::string, 2>> pairs;
  if (list == nullptr) {
    return pairs;
  }
  std::set<std::string> known;
  for (const std::vector<std::string>& names : {grid.DetectorNames(), grid.TripletNames()}) {
    known.insert(names.begin(), names.end());
  }
  for (const YamlValue& item : YamlItems(*list, "compare")) {
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
      FailExpected(*value, "tolerance_m", fmt::format("one of {}", fmt::join(kTolerancesM, ", ")));
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
  study.name = YamlWord(root, "", "name", path.stem().string());
  YamlWord(root, "", "base");
  study.base = Absolute(*root.Find("base"));
  study.changes = ReadChanges(root.Find("set"), "set");
  study.factors = ReadFactors(root);
  const std::string design = Choice(root, "design", {kOneAtATime, kAllCombinations});
  study.design = design == kOneAtATime ? StudyDesign::kOneAtATime : StudyDesign::kAllCombinations;
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
