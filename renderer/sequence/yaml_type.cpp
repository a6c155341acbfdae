// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/yaml_type.h"

#include "renderer/core/parse_number.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

class NumberType : public YamlType<double> {
 public:
  explicit NumberType(const YamlRange& range) : range_(range) {}

  void Read(const YamlValue& yaml, const std::string& key, double& value) const override {
    std::optional<double> number;
    if (yaml.kind == YamlValue::Kind::kScalar && !yaml.is_quoted) {
      number = ParseNumber<double>(yaml.text);
    }
    if (!number || *number < range_.least ||
        (range_.is_least_excluded && *number == range_.least) || *number > range_.most) {
      FailExpected(yaml, key, Expected());
    }
    value = *number;
  }

  YamlValue Write(const double& value) const override {
    return YamlValue::Scalar(fmt::format("{}", value));
  }

  std::string Expected() const override {
    const bool has_least = std::isfinite(range_.least);
    const bool has_most = std::isfinite(range_.most);
    if (has_least && has_most && !range_.is_least_excluded) {
      return fmt::format("a number from {} to {}", range_.least, range_.most);
    }
    std::string text = "a number";
    if (has_least) {
      text += fmt::format(" {} {}", range_.is_least_excluded ? ">" : ">=", range_.least);
    }
    if (has_most) {
      text += fmt::format("{} <= {}", has_least ? " and" : "", range_.most);
    }
    return text;
  }

 private:
  YamlRange range_;
};

template <typename T>
class IntegerType : public YamlType<T> {
 public:
  IntegerType(T least, T most) : least_(least), most_(most) {}

  void Read(const YamlValue& yaml, const std::string& key, T& value) const override {
    std::optional<T> number;
    if (yaml.kind == YamlValue::Kind::kScalar && !yaml.is_quoted) {
      number = ParseNumber<T>(yaml.text);
    }
    if (!number || *number < least_ || *number > most_) {
      FailExpected(yaml, key, Expected());
    }
    value = *number;
  }

  YamlValue Write(const T& value) const override {
    return YamlValue::Scalar(fmt::format("{}", value));
  }

  std::string Expected() const override {
    return fmt::format("a whole number from {} to {}", least_, most_);
  }

 private:
  T least_;
  T most_;
};

bool IsOneLine(const std::string& text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
}

class LineType : public YamlType<std::string> {
 public:
  void Read(const YamlValue& yaml, const std::string& key, std::string& value) const override {
    if (yaml.kind != YamlValue::Kind::kScalar || !IsOneLine(yaml.text)) {
      FailExpected(yaml, key, Expected());
    }
    value = yaml.text;
  }

  YamlValue Write(const std::string& value) const override { return YamlValue::Scalar(value); }

  std::string Expected() const override { return "a line of text"; }
};

class ChoiceType : public YamlType<std::string> {
 public:
  explicit ChoiceType(std::vector<std::string> words) : words_(std::move(words)) {}

  void Read(const YamlValue& yaml, const std::string& key, std::string& value) const override {
    if (yaml.kind != YamlValue::Kind::kScalar ||
        std::find(words_.begin(), words_.end(), yaml.text) == words_.end()) {
      FailExpected(yaml, key, Expected());
    }
    value = yaml.text;
  }

  YamlValue Write(const std::string& value) const override { return YamlValue::Scalar(value); }

  std::string Expected() const override {
    return fmt::format("one of {}", fmt::join(words_, ", "));
  }

 private:
  std::vector<std::string> words_;
};

/// An absent path is an empty string.
class PathType : public YamlType<std::string> {
 public:
  void Read(const YamlValue& yaml, const std::string& key, std::string& value) const override {
    if (yaml.kind != YamlValue::Kind::kScalar || !IsOneLine(yaml.text)) {
      FailExpected(yaml, key, Expected());
    }
    value = std::filesystem::absolute(yaml.origin.folder / yaml.text).lexically_normal().string();
  }

  YamlValue Write(const std::string& value) const override {
    return value.empty() ? YamlValue{} : YamlValue::Scalar(value);
  }

  std::string Expected() const override { return "the path of a file"; }
};

/// The least number of letters to insert, remove or replace to make one word of the other
/// (Levenshtein 1966).
size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

/// "did you mean X?" when a known word is near, else all that are known.
std::string Suggestion(const std::string& word, const std::vector<std::string>& known) {
  if (word.size() <= 64) {
    const auto nearest = std::min_element(
        known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
          return EditDistance(word, a) < EditDistance(word, b);
        });
    if (nearest != known.end() &&
        EditDistance(word, *nearest) <= std::max<size_t>(2, nearest->size() / 3)) {
      return fmt::format("did you mean {}?", *nearest);
    }
  }
  return fmt::format("known here: {}", fmt::join(known, ", "));
}

}  // namespace

YamlTypePtr<double> YamlNumber(const YamlRange& range) {
  return std::make_shared<NumberType>(range);
}

template <typename T>
YamlTypePtr<T> YamlInteger(T least, T most) {
  return std::make_shared<IntegerType<T>>(least, most);
}
template YamlTypePtr<int> YamlInteger(int, int);
template YamlTypePtr<uint64_t> YamlInteger(uint64_t, uint64_t);

YamlTypePtr<std::string> YamlChoice(std::vector<std::string> words) {
  return std::make_shared<ChoiceType>(std::move(words));
}

YamlTypePtr<std::string> YamlLine() { return std::make_shared<LineType>(); }

YamlTypePtr<std::string> YamlPath() { return std::make_shared<PathType>(); }

std::string JoinYamlKey(const std::string& parent, const std::string& child) {
  return parent.empty() ? child : parent + '.' + child;
}

std::string InlineYamlText(const YamlValue& value) {
  if (value.kind == YamlValue::Kind::kNothing) {
    return "absent";
  }
  std::string text = YamlText(value);
  text.pop_back();
  return text;
}

void FailExpected(const YamlValue& yaml, const std::string& key, const std::string& expected) {
  FailAtYaml(yaml, key, fmt::format("expected {}, got {}", expected, DescribeYaml(yaml)));
}

void CheckIsMapping(const YamlValue& yaml, const std::string& key) {
  if (yaml.kind != YamlValue::Kind::kMapping && yaml.kind != YamlValue::Kind::kNothing) {
    FailExpected(yaml, key, "a mapping");
  }
}

void CheckKnownKeys(const YamlValue& yaml,
                    const std::string& key,
                    const std::vector<std::string>& known) {
  for (const YamlEntry& entry : yaml.entries) {
    if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
      FailAtYaml(
          entry.value, JoinYamlKey(key, entry.key), "unknown key; " + Suggestion(entry.key, known));
    }
  }
}

void CheckName(const YamlEntry& entry, const std::string& key, const YamlValue& mapping) {
  if (entry.value.origin.is_implied) {
    std::vector<std::string> known;
    for (const YamlEntry& other : mapping.entries) {
      if (!other.value.origin.is_implied) {
        known.push_back(other.key);
      }
    }
    FailAtYaml(entry.value, key, "there is none of this name; " + Suggestion(entry.key, known));
  }
  if (entry.key.empty() || entry.key.size() > 64 ||
      entry.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos) {
    FailAtYaml(entry.value, key, "expected a name of up to 64 of a-z, 0-9 and _");
  }
}

bool HasOverride(const YamlValue* yaml) {
  return yaml != nullptr &&
         ((yaml->origin.IsOverride() && !yaml->origin.is_implied) ||
          std::any_of(yaml->items.begin(),
                      yaml->items.end(),
                      [](const YamlValue& item) { return HasOverride(&item); }) ||
          std::any_of(yaml->entries.begin(), yaml->entries.end(), [](const YamlEntry& entry) {
            return HasOverride(&entry.value);
          }));
}

YamlValue ResolveExclusive(YamlValue yaml,
                           const std::string& key,
                           const std::vector<std::string>& keys) {
  const auto is_alternative = [&](const YamlEntry& entry) {
    return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
  };
  const bool has_override =
      std::any_of(yaml.entries.begin(), yaml.entries.end(), [&](const YamlEntry& entry) {
        return is_alternative(entry) && entry.value.origin.IsOverride();
      });
  if (has_override) {
    std::erase_if(yaml.entries, [&](const YamlEntry& entry) {
      return is_alternative(entry) && !entry.value.origin.IsOverride();
    });
  }
  const YamlEntry* first = nullptr;
  for (const YamlEntry& entry : yaml.entries) {
    if (!is_alternative(entry)) {
      continue;
    }
    if (first != nullptr) {
      FailAtYaml(entry.value,
                 JoinYamlKey(key, entry.key),
                 fmt::format("expected either this or {}, got both", first->key));
    }
    first = &entry;
  }
  return yaml;
}

}  // namespace pfseq
