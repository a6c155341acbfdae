// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/check_report.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace pfseq {
namespace {

std::string PairTable(const std::vector<PairAgreement>& totals) {
  std::string text = fmt::format("{:<16}{:<18}{:>11}{:>10}{:>11}{:>11}{:>11}{:>10}{:>10}\n",
                                 "lens",
                                 "maps",
                                 "compared",
                                 "agree %",
                                 "median m",
                                 "99th % m",
                                 "no common",
                                 "occluded",
                                 "outside");
  for (const PairAgreement& pair : totals) {
    const size_t visible = pair.NumCompared() + pair.num_no_common;
    const auto percent = [](size_t part, size_t whole) {
      return whole == 0 ? std::string("-")
                        : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / whole);
    };
    text += fmt::format("{:<16}{:<18}{:>11}{:>10.4f}{:>11.1e}{:>11.1e}{:>11}{:>10}{:>10}\n",
                        pair.lens,
                        pair.from_camera + " > " + pair.to_camera,
                        pair.NumCompared(),
                        100.0 * pair.AgreeingShare(),
                        pair.median_gap_m,
                        pair.percentile_99_gap_m,
                        percent(pair.num_no_common, visible),
                        percent(pair.num_occluded, pair.num_sampled),
                        percent(pair.num_outside, pair.num_sampled));
  }
  return text;
}

}  // namespace

double PairAgreement::AgreeingShare() const {
  return NumCompared() == 0
             ? 1.0
             : static_cast<double>(num_agreeing) / static_cast<double>(NumCompared());
}

void CheckReport::AddFault(std::string file, std::string text) {
  findings.push_back({Severity::kFault, std::move(file), std::move(text)});
}

void CheckReport::AddNote(std::string file, std::string text) {
  findings.push_back({Severity::kNote, std::move(file), std::move(text)});
}

void CheckReport::Add(const std::vector<Finding>& more) {
  findings.insert(findings.end(), more.begin(), more.end());
}

size_t CheckReport::NumFaults() const {
  return static_cast<size_t>(
      std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
        return finding.severity == Severity::kFault;
      }));
}

std::string CheckReport::Text() const {
  std::string text;
  for (const Severity severity : {Severity::kFault, Severity::kNote}) {
    for (const Finding& finding : findings) {
      if (finding.severity == severity) {
        text += fmt::format("{}: {}: {}\n",
                            severity == Severity::kFault ? "fault" : "note",
                            finding.file,
                            finding.text);
      }
    }
  }
  text += fmt::format(
      "files hashed {}, images {}, poses {}\n", num_files_hashed, num_images, num_poses);
  text += fmt::format(
      "distance maps against scene.glb: {} maps, {} pixels, largest relative error {:.1e}\n",
      num_maps_recast,
      num_pixels_recast,
      max_relative_error);
  if (!pair_totals.empty()) {
    text += PairTable(pair_totals);
  }
  const size_t num_faults = NumFaults();
  text += num_faults == 0
              ? "sound: no fault found\n"
              : fmt::format("{} fault{} found\n", num_faults, num_faults == 1 ? "" : "s");
  return text;
}

std::string WithoutPath(const std::string& error_text, const std::filesystem::path& path) {
  const std::string prefix = path.string() + ":";
  if (!error_text.starts_with(prefix)) {
    return error_text;
  }
  const std::string rest = error_text.substr(prefix.size());
  return rest.starts_with(' ') ? rest.substr(1) : "line " + rest;
}

}  // namespace pfseq
