// SPDX-License-Identifier: Apache-2.0
// The parts of a study's file: factors with their levels, repetitions, and what they are made of.
// All throw InputError "FILE:LINE: KEY: expected ..., got ...".
#pragma once

#include "validator/study/study_spec.h"

#include <optional>
#include <string>
#include <vector>

namespace pfseq {

/// The text of mapping[name], a scalar of one line; `otherwise` where it is not there. `key` is the
/// mapping's own.
std::string YamlWord(const YamlValue& mapping,
                     const std::string& key,
                     const std::string& name,
                     const std::optional<std::string>& otherwise = std::nullopt);

/// The items of a list that is not empty; a scalar stands for a list of one.
std::vector<YamlValue> YamlItems(const YamlValue& value, const std::string& key);

/// KEY: VALUE of a mapping; none for null.
std::vector<SpecChange> ReadChanges(const YamlValue* mapping, const std::string& key);

/// Of the study's mapping: at least one. No two factors set the same key.
std::vector<StudyFactor> ReadFactors(const YamlValue& root);

/// A single one that changes nothing for null.
std::vector<StudyLevel> ReadRepetitions(const YamlValue* mapping);

}  // namespace pfseq
