// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "validator/benchmark/imported_features.h"
#include "validator/benchmark/unit.h"
#include "validator/matching/match.h"

#include <numeric>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// The features of a view that lie within the lens's field, and where the file has them.
struct ImportedView {
  JudgedView judged;
  Descriptors descriptors;
  std::vector<int> row_of_file;
  /// Of each row of the file its key point; -1 beyond the field.
  std::vector<int> point_of_row;
};

ImportedView LoadView(const BenchmarkContext& context,
                      const ImportedSetting& setting,
                      const std::string& lens_name,
                      const ViewName& view) {
  const Lens& lens = context.Source().LensOf(lens_name);
  const ImportedFeatures features =
      ReadImportedFeatures(setting, lens_name, view, context.Variant());
  const std::shared_ptr<const LoadedImage> image = context.ImageOf(lens_name, view);
  ImportedView imported;
  imported.judged.width_px = image->width_px;
  imported.judged.height_px = image->height_px;
  for (size_t i = 0; i < features.pixels_px.size(); ++i) {
    if (!lens.Unproject(features.pixels_px[i])) {
      imported.point_of_row.push_back(-1);
      continue;
    }
    imported.point_of_row.push_back(static_cast<int>(imported.row_of_file.size()));
    imported.row_of_file.push_back(static_cast<int>(i));
    imported.judged.pixels_px.push_back(features.pixels_px[i]);
    imported.judged.sizes_px.push_back(features.sizes_px[i]);
    imported.judged.responses.push_back(features.scores[i]);
  }
  PlaceInDisc(lens, imported.judged);
  imported.descriptors.norm = features.descriptors.norm;
  if (!features.descriptors.rows.empty()) {
    for (size_t i = 0; i < imported.row_of_file.size(); ++i) {
      imported.descriptors.rows.push_back(features.descriptors.rows.row(imported.row_of_file[i]));
      imported.descriptors.key_point_idx.push_back(static_cast<int>(i));
    }
  }
  return imported;
}

/// "128 floats".
std::string KindText(const cv::Mat& rows) {
  return fmt::format("{} {}", rows.cols, rows.type() == CV_8U ? "bytes" : "floats");
}

std::vector<int> AllRows(const Descriptors& descriptors) {
  std::vector<int> rows(descriptors.key_point_idx.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

std::vector<std::pair<int, int>> Match(const ImportedView& first,
                                       const ImportedView& second,
                                       const Setting& matcher) {
  std::vector<RowMatch> matches;
  if (matcher.Is("FLANN")) {
    matches = FlannMatches(
        first.descriptors,
        AllRows(first.descriptors),
        second.descriptors,
        AllRows(second.descriptors),
        {matcher.Integer("trees"), matcher.Integer("checks"), matcher.Number("ratio")});
  } else {
    const ClassedDescriptors classed_first = ClassedDescriptors::Whole(first.descriptors);
    const ClassedDescriptors classed_second = ClassedDescriptors::Whole(second.descriptors);
    const NearestTables tables = FindNearest(classed_first, classed_second, 1);
    const SubsetNeighbours all = {&tables, &classed_first, &classed_second, {true}, {true}};
    matches = matcher.Is("RatioTest") ? RatioMatches(all, matcher.Number("ratio"))
                                      : CrossCheckedMatches(all);
  }
  std::vector<std::pair<int, int>> pairs;
  for (const RowMatch& match : matches) {
    pairs.emplace_back(match.first, match.second);
  }
  return pairs;
}

std::vector<std::pair<int, int>> MatchesOfFile(const ImportedSetting& setting,
                                               const PairOfViews& pair,
                                               const ImportedView& first,
                                               const ImportedView& second) {
  std::vector<std::pair<int, int>> matches;
  for (const auto& [a, b] : ReadImportedMatches(setting, pair.lens, pair.first, pair.second)) {
    if (static_cast<size_t>(a) >= first.point_of_row.size() ||
        static_cast<size_t>(b) >= second.point_of_row.size()) {
      throw InputError("{}: matches: ({}, {}): the views have {} and {} key points",
                       setting.matches,
                       a,
                       b,
                       first.point_of_row.size(),
                       second.point_of_row.size());
    }
    if (first.point_of_row[a] >= 0 && second.point_of_row[b] >= 0) {
      matches.emplace_back(first.point_of_row[a], second.point_of_row[b]);
    }
  }
  return matches;
}

}  // namespace

UnitResult RunImportedUnit(const BenchmarkContext& context,
                           const PairOfViews& pair,
                           size_t pair_idx,
                           const ImportedSetting& setting) {
  const ImportedView first = LoadView(context, setting, pair.lens, pair.first);
  const ImportedView second = LoadView(context, setting, pair.lens, pair.second);
  const bool has_rows = !first.descriptors.rows.empty() && !second.descriptors.rows.empty();
  if (has_rows && (first.descriptors.rows.cols != second.descriptors.rows.cols ||
                   first.descriptors.rows.type() != second.descriptors.rows.type())) {
    throw InputError("{}: expected descriptors of one kind, got {} and {}",
                     setting.files,
                     KindText(first.descriptors.rows),
                     KindText(second.descriptors.rows));
  }
  JudgedPair judged{first.judged,
                    second.judged,
                    {context.Lift(pair.lens, pair.first, first.judged.pixels_px),
                     context.Lift(pair.lens, pair.second, second.judged.pixels_px),
                     context.Source().WorldFromCamera(pair.first).translation_m,
                     context.Source().WorldFromCamera(pair.second).translation_m}};
  DetectionJudgement detections = JudgeDetections(judged, context.Judging(), context.Draws());
  detections.result.setup = setting.name;
  detections.result.pair_idx = pair_idx;
  UnitResult result;
  result.of_members.push_back({detections.result});
  const auto add = [&](const std::string& name, const std::vector<std::pair<int, int>>& matches) {
    SettingResult triplet =
        JudgeMatches(judged, matches, detections, context.Judging(), context.Draws());
    triplet.setup = fmt::format("{} {}", setting.name, name);
    triplet.pair_idx = pair_idx;
    result.of_members.front().push_back(std::move(triplet));
  };
  for (const Setting& matcher : context.OwnGrid().imported_matchers) {
    if (!matcher.Is("FLANN") || setting.norm == Norm::kL2) {
      add(MatcherName(matcher), Match(first, second, matcher));
    }
  }
  if (!setting.matches.empty()) {
    add("Imported", MatchesOfFile(setting, pair, first, second));
  }
  return result;
}

}  // namespace pfseq
