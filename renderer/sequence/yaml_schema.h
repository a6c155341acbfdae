// SPDX-License-Identifier: Apache-2.0
// Descriptions of YAML mappings as C++ structs: each key is listed once with its type, range and
// meaning, and that list reads, writes and documents it. A value that is not there keeps the
// default of the struct's member.
#pragma once

#include "renderer/sequence/yaml_type.h"

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pfseq {

/// A mapping being read, for checks between keys.
class YamlMappingView {
 public:
  YamlMappingView(const YamlValue& yaml, const std::string& key) : yaml_(yaml), key_(key) {}

  bool Has(const std::string& child) const { return yaml_.Find(child) != nullptr; }

  /// The child's value, or null.
  const YamlValue* Find(const std::string& child) const { return yaml_.Find(child); }

  /// InputError at the child's place, or at the mapping's when the child is not there.
  [[noreturn]] void Fail(const std::string& child, const std::string& text) const {
    const YamlValue* value = yaml_.Find(child);
    FailAtYaml(value != nullptr ? *value : yaml_, JoinYamlKey(key_, child), text);
  }

 private:
  const YamlValue& yaml_;
  const std::string& key_;
};

/// A mapping with known keys for the members of a struct.
template <typename T>
class YamlMapping : public YamlType<T> {
 public:
  using Condition = std::function<bool(const T&)>;
  using Check = std::function<void(const YamlMappingView&, T&)>;

  /// A key for a member. With a condition it is written only where that holds.
  template <typename M>
  YamlMapping& Key(std::string name,
                   M T::*member,
                   std::type_identity_t<YamlTypePtr<M>> type,
                   std::string meaning,
                   Condition is_written = {}) {
    return Add<M>(
        std::move(name),
        [member](const T& object) -> const M& { return object.*member; },
        [member](T& object) -> M& { return object.*member; },
        std::move(type),
        std::move(meaning),
        std::move(is_written));
  }

  /// A key for a mapping whose values are members of this same struct.
  YamlMapping& Group(std::string name, YamlTypePtr<T> type) {
    return Add<T>(
        std::move(name),
        [](const T& object) -> const T& { return object; },
        [](T& object) -> T& { return object; },
        std::move(type),
        "",
        {});
  }

  /// A key that is written with a fixed text; any text is accepted and not looked at.
  YamlMapping& Note(std::string name, std::string text, std::string meaning) {
    const YamlTypePtr<std::string> type = YamlLine();
    keys_.push_back(
        {name,
         [type](const YamlValue& yaml, const std::string& key, T& /*object*/) {
           std::string ignored;
           type->Read(yaml, key, ignored);
         },
         [text](const T& /*object*/) { return YamlValue::Scalar(text); },
         [type, text, meaning](
             const std::string& key, const T& /*object*/, std::vector<YamlKeyHelp>& out) {
           type->Describe({key, "", "", meaning}, text, out);
         },
         false});
    return *this;
  }

  /// At most one of these keys; one set by an override replaces another one from the file.
  YamlMapping& Exclusive(std::vector<std::string> names) {
    exclusive_.push_back(std::move(names));
    return *this;
  }

  /// Runs when all keys are read: checks between them, and defaults that depend on others.
  YamlMapping& Finish(Check check) {
    finish_ = std::move(check);
    return *this;
  }

  void Read(const YamlValue& yaml, const std::string& key, T& value) const override {
    CheckIsMapping(yaml, key);
    std::vector<std::string> names;
    for (const KeyOf& known : keys_) {
      names.push_back(known.name);
    }
    CheckKnownKeys(yaml, key, names);
    YamlValue resolved = yaml;
    for (const std::vector<std::string>& alternatives : exclusive_) {
      resolved = ResolveExclusive(std::move(resolved), key, alternatives);
    }
    YamlValue absent;
    absent.origin = yaml.origin;
    for (const KeyOf& known : keys_) {
      const YamlValue* child = resolved.Find(known.name);
      if (child != nullptr || known.is_mapping) {
        known.read(child != nullptr ? *child : absent, JoinYamlKey(key, known.name), value);
      }
    }
    if (finish_) {
      finish_(YamlMappingView(resolved, key), value);
    }
  }

  YamlValue Write(const T& value) const override {
    YamlValue mapping;
    mapping.kind = YamlValue::Kind::kMapping;
    for (const KeyOf& known : keys_) {
      YamlValue child = known.write(value);
      if (child.kind != YamlValue::Kind::kNothing) {
        mapping.entries.push_back({known.name, std::move(child)});
      }
    }
    return mapping;
  }

  std::string Expected() const override { return "a mapping"; }

  void Describe(YamlKeyHelp help, const T& value, std::vector<YamlKeyHelp>& out) const override {
    for (const KeyOf& known : keys_) {
      known.describe(JoinYamlKey(help.key, known.name), value, out);
    }
  }

  bool IsMapping() const override { return true; }

 private:
  struct KeyOf {
    std::string name;
    std::function<void(const YamlValue&, const std::string&, T&)> read;
    std::function<YamlValue(const T&)> write;
    std::function<void(const std::string&, const T&, std::vector<YamlKeyHelp>&)> describe;
    bool is_mapping;
  };

  template <typename M>
  YamlMapping& Add(std::string name,
                   std::function<const M&(const T&)> get,
                   std::function<M&(T&)> access,
                   YamlTypePtr<M> type,
                   std::string meaning,
                   Condition is_written) {
    keys_.push_back({std::move(name),
                     [type, access](const YamlValue& yaml, const std::string& key, T& object) {
                       type->Read(yaml, key, access(object));
                     },
                     [type, get, is_written](const T& object) {
                       return is_written && !is_written(object) ? YamlValue{}
                                                                : type->Write(get(object));
                     },
                     [type, get, meaning, is_written](
                         const std::string& key, const T& object, std::vector<YamlKeyHelp>& out) {
                       const size_t first = out.size();
                       type->Describe({key, "", "", meaning}, get(object), out);
                       if (is_written && !is_written(object) && !type->IsMapping()) {
                         out[first].default_text = "absent";
                       }
                     },
                     type->IsMapping()});
    return *this;
  }

  std::vector<KeyOf> keys_;
  std::vector<std::vector<std::string>> exclusive_;
  Check finish_;
};

}  // namespace pfseq
