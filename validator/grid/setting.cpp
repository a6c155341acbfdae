// SPDX-License-Identifier: Apache-2.0
#include "validator/grid/setting.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr const char* kPolar = "pol";
constexpr const char* kNotPolar = "nopol";

/// The words of a name, taken from the left.
class Words {
 public:
  explicit Words(const std::string& text) : text_(text) {
    std::string word;
    for (const char c : text + " ") {
      if (c != ' ') {
        word += c;
      } else if (!word.empty()) {
        words_.push_back(word);
        word.clear();
      }
    }
  }

  bool IsAtEnd() const { return next_ == words_.size(); }
  std::string Peek() const { return IsAtEnd() ? "" : words_[next_]; }
  std::string Take(const std::string& expected) {
    if (IsAtEnd()) {
      Fail(expected);
    }
    return words_[next_++];
  }

  [[noreturn]] void Fail(const std::string& expected) const {
    throw InputError("setting '{}': expected {}, got {}",
                     text_,
                     expected,
                     IsAtEnd() ? "nothing" : "'" + words_[next_] + "'");
  }

  /// The values of a setting: positional ones, then key=value.
  Setting TakeSetting(const Algorithm& algorithm) {
    Setting setting(algorithm);
    for (const Parameter& parameter : algorithm.parameters) {
      if (parameter.is_positional) {
        const auto value = ParseValue(parameter, Peek());
        if (!value) {
          Fail(fmt::format("{} ({})", parameter.name, ExpectedText(parameter)));
        }
        setting.Set(parameter.name, *value);
        ++next_;
      }
    }
    while (Peek().find('=') != std::string::npos) {
      const std::string word = Peek();
      const size_t split = word.find('=');
      const auto known = std::find_if(
          algorithm.parameters.begin(), algorithm.parameters.end(), [&](const Parameter& p) {
            return p.name == word.substr(0, split);
          });
      if (known == algorithm.parameters.end()) {
        Fail(fmt::format("a parameter of {}", algorithm.name));
      }
      const auto value = ParseValue(*known, word.substr(split + 1));
      if (!value) {
        Fail(fmt::format("{} ({})", known->name, ExpectedText(*known)));
      }
      setting.Set(known->name, *value);
      ++next_;
    }
    return setting;
  }

 private:
  std::string text_;
  std::vector<std::string> words_;
  size_t next_ = 0;
};

std::string WithValues(const std::string& text, const Setting& setting) {
  const std::string values = setting.ValuesText();
  return values.empty() ? text : text + " " + values;
}

}  // namespace

Setting::Setting(const Algorithm& algorithm) : algorithm_(&algorithm) {
  for (const Parameter& parameter : algorithm.parameters) {
    values_.push_back(parameter.default_value);
  }
}

size_t Setting::IndexOf(std::string_view parameter) const {
  for (size_t i = 0; i < values_.size(); ++i) {
    if (algorithm_->parameters[i].name == parameter) {
      return i;
    }
  }
  PFSEQ_CHECK(false, "{} has no parameter {}", algorithm_->name, parameter);
}

std::optional<double> Setting::Value(std::string_view parameter) const {
  return values_[IndexOf(parameter)];
}

double Setting::Number(std::string_view parameter) const {
  const std::optional<double> value = Value(parameter);
  PFSEQ_CHECK(value.has_value(), "{} of {}", parameter, algorithm_->name);
  return *value;
}

int Setting::Integer(std::string_view parameter) const {
  return static_cast<int>(std::lround(Number(parameter)));
}

void Setting::Set(std::string_view parameter, std::optional<double> value) {
  values_[IndexOf(parameter)] = value;
}

std::string Setting::ValuesText() const {
  std::vector<std::string> words;
  for (size_t i = 0; i < values_.size(); ++i) {
    const Parameter& parameter = algorithm_->parameters[i];
    if (parameter.is_positional) {
      words.push_back(NumberText(*values_[i], parameter.is_integer));
    }
  }
  for (size_t i = 0; i < values_.size(); ++i) {
    const Parameter& parameter = algorithm_->parameters[i];
    if (!parameter.is_positional && values_[i] != parameter.default_value) {
      words.push_back(parameter.name + "=" +
                      (values_[i] ? NumberText(*values_[i], parameter.is_integer) : "auto"));
    }
  }
  return fmt::format("{}", fmt::join(words, " "));
}

std::string DetectorSetting::Name() const {
  return WithValues(setting.Kind().name + " " + (is_polar ? kPolar : kNotPolar), setting);
}

std::string DescriptorName(const Setting& descriptor) {
  return WithValues(descriptor.Kind().name, descriptor);
}

std::string MatcherName(const Setting& matcher) { return WithValues(matcher.Kind().name, matcher); }

std::string NumberText(double value, bool is_integer) {
  if (is_integer) {
    return fmt::format("{:.0f}", value);
  }
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) {
    text += ".0";
  }
  return text;
}

std::optional<std::optional<double>> ParseValue(const Parameter& parameter, std::string_view text) {
  if (text == "auto" && parameter.may_be_auto) {
    return std::optional<double>();
  }
  const std::optional<double> value = ParseNumber<double>(text);
  if (!value || *value < parameter.least || *value > parameter.most ||
      (parameter.is_integer && *value != std::floor(*value))) {
    return std::nullopt;
  }
  return value;
}

std::string ExpectedText(const Parameter& parameter) {
  return fmt::format("a {} from {} to {}{}",
                     parameter.is_integer ? "whole number" : "number",
                     parameter.least,
                     parameter.most,
                     parameter.may_be_auto ? ", or auto" : "");
}

const Algorithm& FindAlgorithm(const std::vector<Algorithm>& algorithms,
                               std::string_view name,
                               std::string_view kind) {
  std::vector<std::string> known;
  for (const Algorithm& algorithm : algorithms) {
    if (algorithm.name == name) {
      return algorithm;
    }
    known.push_back(algorithm.name);
  }
  throw InputError("{}: expected one of {}, got '{}'", kind, fmt::join(known, ", "), name);
}

ParsedName ParseName(const std::string& name) {
  Words words(name);
  const auto algorithm = [&](const std::vector<Algorithm>& known, const char* kind) -> const auto& {
    const std::string word = words.Take(kind);
    return FindAlgorithm(known, word, fmt::format("setting '{}': {}", name, kind));
  };
  const Algorithm& detector = algorithm(KnownDetectors(), "detector");
  const std::string polar = words.Peek();
  if (polar != kPolar && polar != kNotPolar) {
    words.Fail("pol or nopol");
  }
  words.Take("pol or nopol");
  ParsedName parsed{{words.TakeSetting(detector), polar == kPolar}, {}, {}};
  if (!words.IsAtEnd()) {
    parsed.descriptor = words.TakeSetting(algorithm(KnownDescriptors(), "descriptor"));
    parsed.matcher = words.TakeSetting(algorithm(KnownMatchers(), "matcher"));
    if (!words.IsAtEnd()) {
      words.Fail("no more");
    }
    if (!CanMatch(*parsed.matcher, *parsed.descriptor)) {
      throw InputError(
          "setting '{}': expected a matcher for {}, got {}, which is for Euclidean "
          "distances only",
          name,
          parsed.descriptor->Kind().name,
          parsed.matcher->Kind().name);
    }
  }
  return parsed;
}

}  // namespace pfseq
