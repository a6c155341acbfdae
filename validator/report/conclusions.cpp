// SPDX-License-Identifier: Apache-2.0
#include "validator/report/conclusions.h"

#include "validator/report/ranking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

using Accepts = std::function<bool(const ReportSetting&)>;

/// The report says "approximately": two figures within this are the same.
constexpr double kAboutTheSame = 0.05;
const Measure kScore = {"", "matching_score", "correct_matches", false, false};

Accepts Detector(const std::string& name) {
  return [name](const ReportSetting& setting) { return setting.detector == name; };
}
Accepts Matcher(const std::string& name) {
  return [name](const ReportSetting& setting) { return setting.matcher == name; };
}
bool IsBlob(const ReportSetting& setting) {
  return setting.detector == "SIFT" || setting.detector == "CenSurE";
}
bool IsCorner(const ReportSetting& setting) {
  return setting.detector == "ORB" || setting.detector == "BRISK";
}

Judgement Of(size_t num_held, size_t num_judged) {
  if (num_judged == 0) {
    return Judgement::kUnknown;
  }
  return num_held == num_judged ? Judgement::kHolds
         : num_held == 0        ? Judgement::kFails
                                : Judgement::kPartly;
}

class Judge2014 {
 public:
  Judge2014(const ResultSet& results, const Reference2014& reference)
      : results_(results),
        reference_(reference),
        tolerance_(results.ToleranceIdx(kVerdictToleranceM)) {}

  std::vector<Conclusion> All() const {
    return {SiftIsBest(),
            CensureFailsAtTheCorner(),
            PolarGainsNothing(),
            BlobsBeatCorners(),
            BruteForceIsBest(),
            FreakUnderBlur(),
            ExpectedGeneral(),
            ExpectedEasy()};
  }

 private:
  std::optional<size_t> CaseOf(const std::string& pair) const {
    for (size_t i = 0; i < results_.cases.size(); ++i) {
      if (results_.cases[i].pair == pair && tolerance_) {
        return i;
      }
    }
    return std::nullopt;
  }

  std::vector<Ranked> Best(const std::string& pair, const Accepts& accepts) const {
    const std::optional<size_t> case_idx = CaseOf(pair);
    return case_idx ? Rank(results_.triplets, kScore, {*case_idx}, *tolerance_, accepts)
                    : std::vector<Ranked>();
  }

  bool HasAny(const Accepts& accepts) const {
    return std::any_of(
        results_.triplets.settings.begin(), results_.triplets.settings.end(), accepts);
  }

  std::string Text(const Ranked& ranked) const {
    return fmt::format(
        "{} {:.3f}", results_.triplets.settings[ranked.setting_idx].name, ranked.value);
  }

  std::optional<double> Score(const std::string& setup, const std::string& pair) const {
    const std::optional<size_t> case_idx = CaseOf(pair);
    const std::optional<size_t> setting = results_.triplets.Find(setup);
    if (!case_idx || !setting) {
      return std::nullopt;
    }
    const double value =
        results_.triplets.Value("matching_score", *setting, *case_idx, *tolerance_);
    return std::isnan(value) ? std::nullopt : std::optional(value);
  }

  std::string TheirScores(const std::vector<std::string>& setups,
                          const std::vector<std::string>& pairs) const {
    std::vector<std::string> texts;
    for (const std::string& setup : setups) {
      std::vector<std::string> values;
      for (const std::string& pair : pairs) {
        const auto value = reference_.Find({"matching_score", pair, setup}, kVerdictToleranceM);
        values.push_back(
            fmt::format("{} on pair {}", value ? fmt::format("{:.2f}", *value) : "none", pair));
      }
      texts.push_back(fmt::format("{}: {}", setup, fmt::join(values, ", ")));
    }
    return fmt::format("{}", fmt::join(texts, "\n"));
  }

  /// On each pair: is the best of one kind ahead of the best of the other?
  Conclusion Ahead(std::string claim,
                   std::string theirs,
                   const Accepts& better,
                   const Accepts& worse,
                   const std::vector<std::string>& pairs,
                   const char* lacking) const {
    Conclusion conclusion{std::move(claim), std::move(theirs), "", Judgement::kUnknown};
    size_t num_held = 0;
    std::vector<std::string> texts;
    for (const std::string& pair : pairs) {
      const std::vector<Ranked> a = Best(pair, better), b = Best(pair, worse);
      if (!CaseOf(pair) || !HasAny(better) || !HasAny(worse) || (a.empty() && b.empty())) {
        continue;
      }
      num_held += b.empty() || (!a.empty() && a[0].value >= b[0].value) ? 1 : 0;
      texts.push_back(fmt::format("pair {}: {} against {}",
                                  pair,
                                  a.empty() ? "none with enough matches" : Text(a[0]),
                                  b.empty() ? "none with enough matches" : Text(b[0])));
    }
    conclusion.judgement = Of(num_held, texts.size());
    conclusion.ours = texts.empty() ? lacking : fmt::format("{}", fmt::join(texts, "\n"));
    return conclusion;
  }

  Conclusion SiftIsBest() const {
    return Ahead(
        "SIFT is the best detector over all",
        "all of its best setups by matching score detect with SIFT",
        Detector("SIFT"),
        [](const ReportSetting& setting) { return setting.detector != "SIFT"; },
        {"0", "40", "24"},
        "needs SIFT and another detector on pair 0, 40 or 24");
  }

  Conclusion CensureFailsAtTheCorner() const {
    Conclusion conclusion{"CenSurE is out on the corner pair (24)",
                          "too few correct matches on pair 24 to be of use",
                          "needs CenSurE on pair 24",
                          Judgement::kUnknown};
    const std::optional<size_t> corner = CaseOf("24");
    double most = -1.0;
    size_t which = 0;
    for (size_t i = 0; corner && i < results_.triplets.settings.size(); ++i) {
      const double count = results_.triplets.Value("correct_matches", i, *corner, *tolerance_);
      if (results_.triplets.settings[i].detector == "CenSurE" && count > most) {
        most = count;
        which = i;
      }
    }
    if (most >= 0.0) {
      conclusion.judgement = most < kEnoughMatches ? Judgement::kHolds : Judgement::kFails;
      conclusion.ours = fmt::format(
          "at most {:.0f} correct matches ({})", most, results_.triplets.settings[which].name);
    }
    return conclusion;
  }

  Conclusion PolarGainsNothing() const {
    return Ahead(
        "Polar rectification gains nothing but on the corner pair",
        "best setups without it on pairs 0 and 40; on pair 24 one with it is on top",
        [](const ReportSetting& setting) { return !setting.is_polar; },
        [](const ReportSetting& setting) { return setting.is_polar; },
        {"0", "40"},
        "needs settings with and without polar rectification on pair 0 or 40");
  }

  Conclusion BlobsBeatCorners() const {
    return Ahead("Corners (ORB, BRISK) are behind blobs (SIFT, CenSurE)",
                 "no setup with a corner detector is among the best",
                 IsBlob,
                 IsCorner,
                 {"0", "40", "24"},
                 "needs blob and corner detectors on pair 0, 40 or 24");
  }

  Conclusion BruteForceIsBest() const {
    return Ahead(
        "Brute force is ahead of ratio test and FLANN",
        "with SIFT points all of the best setups match by brute force",
        Matcher("BruteForce"),
        [](const ReportSetting& setting) {
          return setting.matcher == "RatioTest" || setting.matcher == "FLANN";
        },
        {"0", "40", "24"},
        "needs brute force and another matcher on pair 0, 40 or 24");
  }

  bool IsBlurred(size_t case_idx) const {
    return results_.sources[results_.cases[case_idx].source_idx].variant == "realistic";
  }

  Conclusion FreakUnderBlur() const {
    const std::string freak = "SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce";
    const std::string sift = "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce";
    Conclusion conclusion{"FREAK's descriptor is ahead of SIFT's under strong blur",
                          TheirScores({freak, sift}, {"24"}),
                          "needs both descriptors on pair 24",
                          Judgement::kUnknown};
    const std::optional<double> a = Score(freak, "24"), b = Score(sift, "24");
    if (a && b) {
      const std::string values = fmt::format("FREAK {:.3f}, SIFT {:.3f}", *a, *b);
      const bool is_blurred = IsBlurred(*CaseOf("24"));
      conclusion.ours =
          is_blurred
              ? values
              : values + ", but these images are clean: there is no blur to be robust against";
      conclusion.judgement = !is_blurred ? Judgement::kUnknown
                             : *a > *b   ? Judgement::kHolds
                                         : Judgement::kFails;
    }
    return conclusion;
  }

  /// Is a setup's score about what the report expects on each of the pairs?
  Conclusion Expected(std::string claim,
                      const std::string& setup,
                      const std::vector<std::pair<std::string, double>>& expected) const {
    std::vector<std::string> pairs, texts;
    size_t num_held = 0;
    for (const auto& [pair, value] : expected) {
      pairs.push_back(pair);
      if (const std::optional<double> ours = Score(setup, pair)) {
        texts.push_back(fmt::format("{:.3f} on pair {}", *ours, pair));
        num_held += std::abs(*ours - value) <= kAboutTheSame ? 1 : 0;
      }
    }
    return {std::move(claim),
            TheirScores({setup}, pairs),
            texts.empty() ? "needs " + setup : fmt::format("{}", fmt::join(texts, ", ")),
            Of(num_held, texts.size())};
  }

  Conclusion ExpectedGeneral() const {
    return Expected(
        "SIFT 0.02 20 1.6 with brute force: 35 % on easy to 15 % on hard scenes within 4 cm",
        "SIFT nopol 0.02 20.0 1.6 SIFT BruteForce",
        {{"0", 0.35}, {"40", 0.35}, {"24", 0.15}});
  }
  Conclusion ExpectedEasy() const {
    return Expected("SIFT 0.04 5 1.6 with brute force: 50 % on easy scenes within 4 cm",
                    "SIFT nopol 0.04 5.0 1.6 SIFT BruteForce",
                    {{"0", 0.50}, {"40", 0.50}});
  }

  const ResultSet& results_;
  const Reference2014& reference_;
  std::optional<size_t> tolerance_;
};

}  // namespace

std::string JudgementText(Judgement judgement) {
  switch (judgement) {
    case Judgement::kHolds:
      return "holds";
    case Judgement::kPartly:
      return "holds in part";
    case Judgement::kFails:
      return "does not hold";
    case Judgement::kUnknown:
      break;
  }
  return "cannot be said";
}

std::vector<Conclusion> JudgeConclusions(const ResultSet& results, const Reference2014& reference) {
  return Judge2014(results, reference).All();
}

}  // namespace pfseq
