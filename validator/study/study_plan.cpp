// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_plan.h"

#include "renderer/core/error.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr size_t kMaxVariants = 100000;

/// Letters, digits and what is harmless in the names of folders.
std::string FolderName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    name += is_plain ? c : '-';
  }
  return name;
}

/// The levels of one repetition's variants.
std::vector<std::vector<size_t>> Combinations(const StudySpec& study) {
  std::vector<size_t> base;
  for (const StudyFactor& factor : study.factors) {
    base.push_back(factor.base_idx);
  }
  std::vector<std::vector<size_t>> combinations;
  if (study.design == StudyDesign::kOneAtATime) {
    combinations.push_back(base);
    for (size_t f = 0; f < study.factors.size(); ++f) {
      for (size_t level = 0; level < study.factors[f].levels.size(); ++level) {
        if (level != study.factors[f].base_idx) {
          combinations.push_back(base);
          combinations.back()[f] = level;
        }
      }
    }
    return combinations;
  }
  combinations.emplace_back();
  for (const StudyFactor& factor : study.factors) {
    std::vector<std::vector<size_t>> longer;
    for (const std::vector<size_t>& start : combinations) {
      for (size_t level = 0; level < factor.levels.size(); ++level) {
        longer.push_back(start);
        longer.back().push_back(level);
      }
    }
    combinations = std::move(longer);
    if (combinations.size() > kMaxVariants) {
      throw InputError("factors: expected at most {} combinations", kMaxVariants);
    }
  }
  return combinations;
}

std::string NameOf(const StudySpec& study, const std::vector<size_t>& levels, size_t repetition) {
  std::string name;
  for (size_t f = 0; f < levels.size(); ++f) {
    if (study.design == StudyDesign::kAllCombinations || levels[f] != study.factors[f].base_idx) {
      name +=
          (name.empty() ? "" : "__") +
          fmt::format(
              "{}_{}", study.factors[f].name, FolderName(study.factors[f].levels[levels[f]].label));
    }
  }
  if (name.empty()) {
    name = "base";
  }
  return study.repetitions.size() > 1 ? fmt::format("{}__{}", name, repetition + 1) : name;
}

void CheckSelection(const StudySpec& study, const SequenceSpec& spec, const std::string& name) {
  const auto check = [&](const std::string& what, const auto& wanted, const auto& known) {
    std::vector<std::string> names;
    for (const auto& one : known) {
      names.push_back(one.name);
    }
    for (const std::string& one : wanted) {
      if (!one.empty() && std::find(names.begin(), names.end(), one) == names.end()) {
        throw InputError(
            "{}: variant {} has no {}, only {}", what, name, one, fmt::join(names, ", "));
      }
    }
  };
  check("lenses", study.lenses, spec.lenses);
  check("cameras", study.cameras, spec.cameras);
}

}  // namespace

std::vector<StudyVariant> PlanVariants(const StudySpec& study) {
  std::vector<StudyVariant> variants;
  std::set<std::string> names;
  for (size_t repetition = 0; repetition < study.repetitions.size(); ++repetition) {
    for (const std::vector<size_t>& levels : Combinations(study)) {
      std::vector<SpecChange> changes = study.changes;
      const auto add = [&](const StudyLevel& level) {
        changes.insert(changes.end(), level.changes.begin(), level.changes.end());
      };
      for (size_t f = 0; f < levels.size(); ++f) {
        add(study.factors[f].levels[levels[f]]);
      }
      add(study.repetitions[repetition]);
      std::string name = NameOf(study, levels, repetition);
      while (!names.insert(name).second) {
        name += "_";  // Labels that differ only in what folders' names leave out.
      }
      variants.push_back({name, levels, repetition, ReadChangedSequenceSpec(study.base, changes)});
      CheckSelection(study, variants.back().spec, name);
    }
  }
  return variants;
}

std::string PlanSummary(const StudySpec& study, size_t num_variants) {
  std::vector<std::string> factors;
  for (const StudyFactor& factor : study.factors) {
    factors.push_back(fmt::format("{} {} levels", factor.name, factor.levels.size()));
  }
  return fmt::format("{} ({}){}, {} repetition{}: {} variants",
                     factors.size() == 1 ? "1 factor" : fmt::format("{} factors", factors.size()),
                     fmt::join(factors, ", "),
                     factors.size() == 1                        ? ""
                     : study.design == StudyDesign::kOneAtATime ? ", one at a time"
                                                                : ", all combinations",
                     study.repetitions.size(),
                     study.repetitions.size() == 1 ? "" : "s",
                     num_variants);
}

}  // namespace pfseq
