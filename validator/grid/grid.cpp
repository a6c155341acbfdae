// SPDX-License-Identifier: Apache-2.0
#include "validator/grid/grid.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/yaml_schema.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr double kMaxSettings = 1e5;

/// A value, or the items of a list.
std::vector<YamlValue> Items(const YamlValue& yaml, const std::string& key) {
  if (yaml.kind == YamlValue::Kind::kScalar) {
    return {yaml};
  }
  if (yaml.kind != YamlValue::Kind::kList || yaml.items.empty()) {
    FailAtYaml(yaml, key, "expected a value or a list of values, got " + DescribeYaml(yaml));
  }
  return yaml.items;
}

/// The mappings of a list; none when the key is not there.
std::vector<YamlValue> Mappings(const YamlValue& root, const std::string& key) {
  const YamlValue* list = root.Find(key);
  if (list == nullptr) {
    return {};
  }
  if (list->kind != YamlValue::Kind::kList) {
    FailAtYaml(*list, key, "expected a list, got " + DescribeYaml(*list));
  }
  for (const YamlValue& item : list->items) {
    CheckIsMapping(item, key);
  }
  return list->items;
}

std::optional<double> ReadParameter(const YamlValue& yaml, const Parameter& parameter) {
  const auto value =
      yaml.kind == YamlValue::Kind::kScalar ? ParseValue(parameter, yaml.text) : std::nullopt;
  if (!value) {
    FailAtYaml(yaml,
               parameter.name,
               fmt::format("expected {}, got {}", ExpectedText(parameter), DescribeYaml(yaml)));
  }
  return *value;
}

std::vector<bool> ReadPolar(const YamlValue* yaml) {
  std::vector<bool> polar;
  if (yaml == nullptr) {
    return {false};
  }
  for (const YamlValue& item : Items(*yaml, "polar")) {
    if (item.text != "true" && item.text != "false") {
      FailAtYaml(item, "polar", "expected true or false, got " + DescribeYaml(item));
    }
    polar.push_back(item.text == "true");
  }
  return polar;
}

/// All combinations of the values that a mapping lists; the last key varies fastest.
std::vector<Setting> ExpandSettings(const YamlValue& yaml,
                                    const std::string& key,
                                    const std::vector<Algorithm>& algorithms,
                                    bool has_polar) {
  const YamlValue* name = yaml.Find("algorithm");
  if (name == nullptr || name->kind != YamlValue::Kind::kScalar) {
    FailAtYaml(yaml, key, "expected the key 'algorithm'");
  }
  const Algorithm& algorithm = FindAlgorithm(
      algorithms, name->text, fmt::format("{}: {}.algorithm", name->origin.where, key));
  std::vector<std::string> known = {"algorithm"};
  if (has_polar) {
    known.emplace_back("polar");
  }
  for (const Parameter& parameter : algorithm.parameters) {
    known.push_back(parameter.name);
  }
  CheckKnownKeys(yaml, key, known);

  std::vector<Setting> settings = {Setting(algorithm)};
  for (const Parameter& parameter : algorithm.parameters) {
    const YamlValue* values = yaml.Find(parameter.name);
    if (values == nullptr) {
      continue;
    }
    std::vector<Setting> expanded;
    for (const Setting& setting : settings) {
      for (const YamlValue& item : Items(*values, parameter.name)) {
        expanded.push_back(setting);
        expanded.back().Set(parameter.name, ReadParameter(item, parameter));
      }
    }
    settings = std::move(expanded);
    if (static_cast<double>(settings.size()) > kMaxSettings) {
      FailAtYaml(*values, key, fmt::format("expected at most {} settings", kMaxSettings));
    }
  }
  return settings;
}

/// What a combination leaves out.
bool Exists(const Setting& detector, const Setting& descriptor) {
  if (descriptor.Is("AKAZE") || descriptor.Is("KAZE")) {
    return detector.Is("AKAZE") || detector.Is("KAZE");
  }
  return !(detector.Is("BRISK") && descriptor.Is("BRISK")) ||
         detector.Number("patternScale") == descriptor.Number("patternScale");
}

/// A grid under construction; nothing twice.
class GridBuilder {
 public:
  GridDetector& Detector(const DetectorSetting& detector) {
    const auto [found, is_new] = by_name_.emplace(detector.Name(), grid_.detectors.size());
    if (is_new) {
      grid_.detectors.push_back({detector, false, {}});
    }
    return grid_.detectors[found->second];
  }

  void Triplet(const DetectorSetting& detector, const Setting& descriptor, const Setting& matcher) {
    std::vector<GridDetector::GridDescriptor>& all = Detector(detector).descriptors;
    auto found = std::find_if(
        all.begin(), all.end(), [&](const auto& known) { return known.descriptor == descriptor; });
    if (found == all.end()) {
      found = all.insert(all.end(), {descriptor, {}});
    }
    if (std::find(found->matchers.begin(), found->matchers.end(), matcher) ==
        found->matchers.end()) {
      found->matchers.push_back(matcher);
    }
  }

  void Name(const std::string& name) {
    const ParsedName parsed = ParseName(name);
    if (!parsed.descriptor) {
      Detector(parsed.detector).is_reported = true;
    } else if (!Exists(parsed.detector.setting, *parsed.descriptor) &&
               !parsed.descriptor->Is("BRISK")) {
      throw InputError("setting '{}': expected AKAZE or KAZE points for the descriptor {}, got {}",
                       name,
                       parsed.descriptor->Kind().name,
                       parsed.detector.setting.Kind().name);
    } else {
      Triplet(parsed.detector, *parsed.descriptor, *parsed.matcher);
    }
  }

  Grid Result() {
    const bool any = std::any_of(grid_.detectors.begin(),
                                 grid_.detectors.end(),
                                 [](const GridDetector& detector) { return detector.is_reported; });
    for (GridDetector& detector : grid_.detectors) {
      detector.is_reported |= !any;
    }
    return std::move(grid_);
  }

 private:
  Grid grid_;
  std::map<std::string, size_t> by_name_;
};

std::string TextOf(const YamlValue& yaml, const std::string& key, bool is_required) {
  const YamlValue* value = yaml.Find(key);
  if (value == nullptr && !is_required) {
    return "";
  }
  if (value == nullptr || value->kind != YamlValue::Kind::kScalar || value->text.empty()) {
    FailAtYaml(value != nullptr ? *value : yaml, key, "expected a text");
  }
  return value->text;
}

ImportedSetting ReadImported(const YamlValue& yaml) {
  CheckKnownKeys(yaml, "imported", {"name", "files", "norm", "origin", "matches"});
  ImportedSetting imported;
  imported.name = TextOf(yaml, "name", true);
  if (imported.name.find_first_of(" ,\"/{}") != std::string::npos) {
    FailAtYaml(yaml, "imported.name", "expected one word, got '" + imported.name + "'");
  }
  const auto path = [&](const std::string& text) {
    return text.empty()
               ? text
               : std::filesystem::absolute(yaml.origin.folder / text).lexically_normal().string();
  };
  imported.files = path(TextOf(yaml, "files", true));
  imported.matches = path(TextOf(yaml, "matches", false));
  const std::string norm = TextOf(yaml, "norm", false);
  if (!norm.empty() && norm != "L2" && norm != "Hamming") {
    FailAtYaml(*yaml.Find("norm"), "imported.norm", "expected L2 or Hamming, got '" + norm + "'");
  }
  imported.norm = norm == "Hamming" ? Norm::kHamming : Norm::kL2;
  const std::string origin = TextOf(yaml, "origin", false);
  if (!origin.empty() && origin != "corner" && origin != "centre") {
    FailAtYaml(*yaml.Find("origin"),
               "imported.origin",
               "expected corner or centre (of the first pixel), got '" + origin + "'");
  }
  imported.origin_is_pixel_centre = origin == "centre";
  return imported;
}

/// A list of numbers in a range.
std::vector<double> Numbers(const YamlValue& root,
                            const std::string& key,
                            const YamlTypePtr<double>& type) {
  std::vector<double> numbers;
  if (const YamlValue* yaml = root.Find(key)) {
    for (const YamlValue& item : Items(*yaml, key)) {
      type->Read(item, key, numbers.emplace_back());
    }
  }
  return numbers;
}

}  // namespace

std::string TripletName(const DetectorSetting& detector,
                        const Setting& descriptor,
                        const Setting& matcher) {
  return detector.Name() + " " + DescriptorName(descriptor) + " " + MatcherName(matcher);
}

std::vector<std::string> Grid::DetectorNames() const {
  std::vector<std::string> names;
  for (const GridDetector& detector : detectors) {
    if (detector.is_reported) {
      names.push_back(detector.detector.Name());
    }
  }
  for (const ImportedSetting& import : imported) {
    names.push_back(import.name);
  }
  return names;
}

std::vector<std::string> Grid::TripletNames() const {
  std::vector<std::string> names;
  for (const GridDetector& detector : detectors) {
    for (const auto& descriptor : detector.descriptors) {
      for (const Setting& matcher : descriptor.matchers) {
        names.push_back(TripletName(detector.detector, descriptor.descriptor, matcher));
      }
    }
  }
  for (const ImportedSetting& import : imported) {
    for (const Setting& matcher : imported_matchers) {
      if (!matcher.Is("FLANN") || import.norm == Norm::kL2) {
        names.push_back(fmt::format("{} {}", import.name, MatcherName(matcher)));
      }
    }
    if (!import.matches.empty()) {
      names.push_back(import.name + " Imported");
    }
  }
  return names;
}

Grid Grid::Read(const std::filesystem::path& path) {
  return FromYaml(ReadFile(path), path.string(), std::filesystem::absolute(path).parent_path());
}

Grid Grid::FromYaml(const std::string& text,
                    const std::string& origin,
                    const std::filesystem::path& folder) {
  return FromTree(ParseYaml(text, origin, folder));
}

Grid Grid::FromTree(const YamlValue& root) {
  CheckIsMapping(root, "");
  CheckKnownKeys(
      root,
      "",
      {"detectors", "descriptors", "matchers", "settings", "imported", "best", "angles_deg"});
  std::vector<Setting> descriptors, matchers;
  for (const YamlValue& yaml : Mappings(root, "descriptors")) {
    for (const Setting& setting : ExpandSettings(yaml, "descriptors", KnownDescriptors(), false)) {
      descriptors.push_back(setting);
    }
  }
  for (const YamlValue& yaml : Mappings(root, "matchers")) {
    for (const Setting& setting : ExpandSettings(yaml, "matchers", KnownMatchers(), false)) {
      matchers.push_back(setting);
    }
  }
  GridBuilder builder;
  for (const YamlValue& yaml : Mappings(root, "detectors")) {
    for (const bool is_polar : ReadPolar(yaml.Find("polar"))) {
      for (const Setting& setting : ExpandSettings(yaml, "detectors", KnownDetectors(), true)) {
        const DetectorSetting detector = {setting, is_polar};
        builder.Detector(detector).is_reported = true;
        for (const Setting& descriptor : descriptors) {
          for (const Setting& matcher : matchers) {
            if (Exists(setting, descriptor) && CanMatch(matcher, descriptor)) {
              builder.Triplet(detector, descriptor, matcher);
            }
          }
        }
      }
    }
  }
  if (const YamlValue* names = root.Find("settings")) {
    for (const YamlValue& item : Items(*names, "settings")) {
      try {
        builder.Name(item.text);
      } catch (const InputError& error) {
        throw InputError("{}: {}", item.origin.where, error.what());
      }
    }
  }
  Grid grid = builder.Result();
  for (const YamlValue& yaml : Mappings(root, "imported")) {
    grid.imported.push_back(ReadImported(yaml));
  }
  grid.imported_matchers = matchers;
  for (const double number : Numbers(root, "best", YamlNumber({1.0, 1e6}))) {
    grid.best.push_back(static_cast<int>(number));
  }
  grid.angles_deg = Numbers(root, "angles_deg", YamlNumber({0.0, 90.0, true}));
  std::sort(grid.angles_deg.begin(), grid.angles_deg.end());
  if (grid.detectors.empty() && grid.imported.empty()) {
    throw InputError("{}: expected detectors, settings or imported features, got none",
                     root.origin.where);
  }
  return grid;
}

Grid Grid::FromNames(const std::vector<std::string>& names) {
  GridBuilder builder;
  for (const std::string& name : names) {
    builder.Name(name);
  }
  return builder.Result();
}

std::string GridSummary(const Grid& grid) {
  std::map<std::string, int> detectors, descriptors, matchers;
  for (const GridDetector& detector : grid.detectors) {
    if (detector.is_reported) {
      ++detectors[fmt::format("{} {}",
                              detector.detector.setting.Kind().name,
                              detector.detector.is_polar ? "pol" : "nopol")];
    }
    for (const auto& descriptor : detector.descriptors) {
      for (const Setting& matcher : descriptor.matchers) {
        ++descriptors[descriptor.descriptor.Kind().name];
        ++matchers[matcher.Kind().name];
      }
    }
  }
  const auto line = [](const std::string& title, size_t total, const auto& counts) {
    std::vector<std::string> parts;
    for (const auto& [name, count] : counts) {
      parts.push_back(fmt::format("{} {}", name, count));
    }
    return fmt::format("{:<20}{:>6}   {}\n", title, total, fmt::join(parts, ", "));
  };
  const size_t num_triplets = grid.TripletNames().size();
  return line("detector settings", grid.DetectorNames().size(), detectors) +
         line("triplets", num_triplets, descriptors) + line("  by matcher", num_triplets, matchers);
}

}  // namespace pfseq
