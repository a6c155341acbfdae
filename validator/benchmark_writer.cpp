// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark_writer.h"

#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "validator/match_picture.h"

#include <span>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

std::string ResultsCsv(const BenchmarkResults& results) {
  std::string text = "lens,pair,metric,setup,tolerance_m,value\n";
  const std::string detector = results.DetectorName();
  const std::string triplet = results.TripletName();
  for (const PairResult& pair : results.pairs) {
    const FeatureMetrics& metrics = pair.metrics;
    const auto add = [&](const char* metric, const std::string& setup, const auto& value_text) {
      for (size_t i = 0; i < kTolerancesM.size(); ++i) {
        text += fmt::format("{},{},{},{},{:g},{}\n",
                            pair.lens,
                            pair.frame,
                            metric,
                            setup,
                            kTolerancesM[i],
                            value_text(i));
      }
    };
    const auto share = [](double value) { return fmt::format("{:.6f}", value); };
    add("correct_matches", triplet, [&](size_t i) {
      return fmt::format("{}", metrics.correct_matches[i]);
    });
    add("matches", detector, [&](size_t i) { return fmt::format("{}", metrics.matches[i]); });
    add("matching_score", triplet, [&](size_t i) { return share(metrics.MatchingScore(i)); });
    add("repeatability", detector, [&](size_t i) { return share(metrics.Repeatability(i)); });
  }
  return text;
}

std::string SummaryCsv(const BenchmarkResults& results) {
  std::string text = fmt::format("lens,pair,setup,detections_{},detections_{},attempted_matches\n",
                                 results.cameras[0],
                                 results.cameras[1]);
  for (const PairResult& pair : results.pairs) {
    text += fmt::format("{},{},{},{},{},{}\n",
                        pair.lens,
                        pair.frame,
                        results.TripletName(),
                        pair.metrics.num_first,
                        pair.metrics.num_second,
                        pair.attempted.size());
  }
  return text;
}

std::string TimesCsv(const BenchmarkResults& results) {
  std::string text = "lens,pair,detect_s,match_s,judge_s\n";
  for (const PairResult& pair : results.pairs) {
    text += fmt::format("{},{},{:.3f},{:.3f},{:.3f}\n",
                        pair.lens,
                        pair.frame,
                        pair.detect_s,
                        pair.match_s,
                        pair.judge_s);
  }
  return text;
}

std::string Description(const BenchmarkResults& results) {
  nlohmann::ordered_json json;
  json["format"] = "pfseq benchmark 1";
  json["program_version"] = PFSEQ_VERSION;
  json["sequence"] = results.sequence;
  json["images"] = "clean";
  json["cameras"] = results.cameras;
  json["lenses"] = results.lenses;
  json["frames"] = results.frames;
  json["detector"] = {{"name", "SIFT"},
                      {"octave_layers", results.sift.octave_layers},
                      {"contrast_threshold", results.sift.contrast_threshold},
                      {"edge_threshold", results.sift.edge_threshold},
                      {"sigma_px", results.sift.sigma_px}};
  json["descriptor"] = {{"name", "SIFT"}};
  json["matcher"] = {{"name", "BruteForce"}, {"norm", "L2"}, {"cross_check", true}};
  json["tolerances_m"] = kTolerancesM;
  return json.dump(2) + "\n";
}

}  // namespace

void WriteBenchmark(const BenchmarkResults& results,
                    const SequenceReader& reader,
                    const std::filesystem::path& folder) {
  for (const PairResult& pair : results.pairs) {
    const Image<uint8_t> picture =
        MatchPicture(reader.ReadClean(pair.lens, results.cameras[0], pair.frame),
                     reader.ReadClean(pair.lens, results.cameras[1], pair.frame),
                     pair.attempted,
                     fmt::format("{}, {}, pair {}", results.TripletName(), pair.lens, pair.frame));
    const Bytes png = EncodePng(picture);
    WriteFileAtomically(folder / fmt::format("matches_{}_{:06}.png", pair.lens, pair.frame),
                        std::span(png));
  }
  WriteFileAtomically(folder / "results.csv", ResultsCsv(results));
  WriteFileAtomically(folder / "summary.csv", SummaryCsv(results));
  WriteFileAtomically(folder / "times.csv", TimesCsv(results));
  WriteFileAtomically(folder / "benchmark.json", Description(results));
}

}  // namespace pfseq
