// SPDX-License-Identifier: Apache-2.0
// How C++ values are written in YAML: numbers in a range, words, paths, lists, optional and named
// values. Each type reads, writes and documents itself.
#pragma once

#include "renderer/sequence/named.h"
#include "renderer/sequence/yaml_value.h"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfseq {

/// The documentation of a key.
struct YamlKeyHelp {
  std::string key;
  std::string default_text;
  /// What a value must be: "a number > 0".
  std::string expected;
  std::string meaning;
};

/// How a T is written in YAML.
template <typename T>
class YamlType {
 public:
  virtual ~YamlType() = default;

  /// Reads into `value`. InputError with the place, the key and what was expected.
  virtual void Read(const YamlValue& yaml, const std::string& key, T& value) const = 0;

  /// The inverse of Read; kNothing for an absent optional.
  virtual YamlValue Write(const T& value) const = 0;

  /// What a value must be: "a number > 0".
  virtual std::string Expected() const = 0;

  /// Appends the documentation of a key of this type and of those below.
  virtual void Describe(YamlKeyHelp help, const T& value, std::vector<YamlKeyHelp>& out) const;

  /// True for mappings, which are read as empty when they are not there, so that their own checks
  /// run.
  virtual bool IsMapping() const { return false; }
};

template <typename T>
using YamlTypePtr = std::shared_ptr<const YamlType<T>>;

/// An interval of numbers; the ends belong to it unless said otherwise.
struct YamlRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool is_least_excluded = false;
};

/// A finite number in a range.
YamlTypePtr<double> YamlNumber(const YamlRange& range);

/// A whole number in [least, most]. Defined for int and uint64_t.
template <typename T>
YamlTypePtr<T> YamlInteger(T least, T most);

/// One of a few words.
YamlTypePtr<std::string> YamlChoice(std::vector<std::string> words);

/// Text of one line, not empty.
YamlTypePtr<std::string> YamlLine();

/// The path of a file; a relative one starts at the folder of the YAML file (for an override, at
/// the working directory) and is made absolute.
YamlTypePtr<std::string> YamlPath();

// What the templates below share.
std::string JoinYamlKey(const std::string& parent, const std::string& child);
std::string InlineYamlText(const YamlValue& value);
void FailExpected(const YamlValue& yaml, const std::string& key, const std::string& expected);
void CheckIsMapping(const YamlValue& yaml, const std::string& key);
/// Fails unless each of a mapping's keys is known; names the nearest known one.
void CheckKnownKeys(const YamlValue& yaml,
                    const std::string& key,
                    const std::vector<std::string>& known);
/// Fails unless a name (lenses.NAME) is of the form [a-z0-9_]+ and was written by somebody.
void CheckName(const YamlEntry& entry, const std::string& key, const YamlValue& mapping);
/// Whether the value, or anything inside it, was set by an override. False for null.
bool HasOverride(const YamlValue* yaml);
/// The mapping without alternatives to what an override set. Fails if several of the keys are left.
YamlValue ResolveExclusive(YamlValue yaml,
                           const std::string& key,
                           const std::vector<std::string>& keys);

/// A list of N values.
template <typename T, size_t N>
class YamlArrayType : public YamlType<std::array<T, N>> {
 public:
  YamlArrayType(YamlTypePtr<T> element, bool one_stands_for_all)
      : element_(std::move(element)), one_stands_for_all_(one_stands_for_all) {}

  void Read(const YamlValue& yaml, const std::string& key, std::array<T, N>& value) const override {
    if (one_stands_for_all_ && yaml.kind == YamlValue::Kind::kScalar) {
      element_->Read(yaml, key, value[0]);
      value.fill(value[0]);
      return;
    }
    if (yaml.kind != YamlValue::Kind::kList || yaml.items.size() != N) {
      FailExpected(yaml, key, Expected());
    }
    for (size_t i = 0; i < N; ++i) {
      element_->Read(yaml.items[i], key, value[i]);
    }
  }

  YamlValue Write(const std::array<T, N>& value) const override {
    YamlValue list;
    list.kind = YamlValue::Kind::kList;
    for (const T& element : value) {
      list.items.push_back(element_->Write(element));
    }
    return list;
  }

  std::string Expected() const override {
    return "a list of " + std::to_string(N) + " (each " + element_->Expected() +
           (one_stands_for_all_ ? "), or one for all" : ")");
  }

 private:
  YamlTypePtr<T> element_;
  bool one_stands_for_all_;
};

template <size_t N, typename T>
YamlTypePtr<std::array<T, N>> YamlArray(YamlTypePtr<T> element, bool one_stands_for_all = false) {
  return std::make_shared<YamlArrayType<T, N>>(std::move(element), one_stands_for_all);
}

/// A value that may be absent.
template <typename T>
class YamlOptionalType : public YamlType<std::optional<T>> {
 public:
  explicit YamlOptionalType(YamlTypePtr<T> type) : type_(std::move(type)) {}

  void Read(const YamlValue& yaml, const std::string& key, std::optional<T>& value) const override {
    type_->Read(yaml, key, value.emplace());
  }

  YamlValue Write(const std::optional<T>& value) const override {
    return value ? type_->Write(*value) : YamlValue{};
  }

  std::string Expected() const override { return type_->Expected(); }

  void Describe(YamlKeyHelp help,
                const std::optional<T>& value,
                std::vector<YamlKeyHelp>& out) const override {
    const size_t first = out.size();
    type_->Describe(std::move(help), value.value_or(T{}), out);
    if (!value && !type_->IsMapping()) {
      out[first].default_text = "absent";
    }
  }

 private:
  YamlTypePtr<T> type_;
};

template <typename T>
YamlTypePtr<std::optional<T>> YamlOptional(YamlTypePtr<T> type) {
  return std::make_shared<YamlOptionalType<T>>(std::move(type));
}

/// A value, or a word that stands for none.
template <typename T>
class YamlWordOrType : public YamlType<std::optional<T>> {
 public:
  YamlWordOrType(std::string word, YamlTypePtr<T> type)
      : word_(std::move(word)), type_(std::move(type)) {}

  void Read(const YamlValue& yaml, const std::string& key, std::optional<T>& value) const override {
    if (yaml.kind == YamlValue::Kind::kScalar && yaml.text == word_) {
      value.reset();
    } else {
      type_->Read(yaml, key, value.emplace());
    }
  }

  YamlValue Write(const std::optional<T>& value) const override {
    return value ? type_->Write(*value) : YamlValue::Scalar(word_);
  }

  std::string Expected() const override { return word_ + " or " + type_->Expected(); }

 private:
  std::string word_;
  YamlTypePtr<T> type_;
};

template <typename T>
YamlTypePtr<std::optional<T>> YamlWordOr(std::string word, YamlTypePtr<T> type) {
  return std::make_shared<YamlWordOrType<T>>(std::move(word), std::move(type));
}

/// A mapping from names to values, at least one unless none are allowed.
template <typename T>
class YamlNamedType : public YamlType<std::vector<Named<T>>> {
 public:
  YamlNamedType(std::string what, YamlTypePtr<T> type, bool may_be_none)
      : what_(std::move(what)), type_(std::move(type)), may_be_none_(may_be_none) {}

  void Read(const YamlValue& yaml,
            const std::string& key,
            std::vector<Named<T>>& value) const override {
    CheckIsMapping(yaml, key);
    if (yaml.entries.empty() && !may_be_none_) {
      FailExpected(yaml, key, Expected());
    }
    value.clear();
    for (const YamlEntry& entry : yaml.entries) {
      CheckName(entry, JoinYamlKey(key, entry.key), yaml);
      value.push_back({entry.key, T{}});
      type_->Read(entry.value, JoinYamlKey(key, entry.key), value.back().value);
    }
  }

  YamlValue Write(const std::vector<Named<T>>& value) const override {
    YamlValue mapping;
    mapping.kind = YamlValue::Kind::kMapping;
    for (const Named<T>& entry : value) {
      mapping.entries.push_back({entry.name, type_->Write(entry.value)});
    }
    return mapping;
  }

  std::string Expected() const override {
    return (may_be_none_ ? "any number of " : "at least one ") + what_ + " by name (a-z, 0-9, _)";
  }

  void Describe(YamlKeyHelp help,
                const std::vector<Named<T>>& /*value*/,
                std::vector<YamlKeyHelp>& out) const override {
    help.key = JoinYamlKey(help.key, "NAME");
    type_->Describe(std::move(help), T{}, out);
  }

  bool IsMapping() const override { return true; }

 private:
  std::string what_;
  YamlTypePtr<T> type_;
  bool may_be_none_;
};

template <typename T>
YamlTypePtr<std::vector<Named<T>>> YamlNamed(std::string what,
                                             YamlTypePtr<T> type,
                                             bool may_be_none = false) {
  return std::make_shared<YamlNamedType<T>>(std::move(what), std::move(type), may_be_none);
}

template <typename T>
void YamlType<T>::Describe(YamlKeyHelp help, const T& value, std::vector<YamlKeyHelp>& out) const {
  help.default_text = InlineYamlText(Write(value));
  help.expected = Expected();
  out.push_back(std::move(help));
}

}  // namespace pfseq
