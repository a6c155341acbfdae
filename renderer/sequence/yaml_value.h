// SPDX-License-Identifier: Apache-2.0
// YAML as a plain tree that remembers where each value was written, so that any fault can be told
// with its place.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// Where a value was written.
struct YamlOrigin {
  /// "demo.yaml:14" or "--set image.size_px=300".
  std::string where;
  /// For an override the key that it names, else empty.
  std::string override_key;
  /// Relative paths start here: the file's folder; empty (the working directory) for an override.
  std::filesystem::path folder;
  /// A mapping that nobody wrote: it was made because an override names a key inside it.
  bool is_implied = false;

  bool IsOverride() const { return !override_key.empty(); }
};

struct YamlEntry;

struct YamlValue {
  enum class Kind { kNothing, kScalar, kList, kMapping };

  Kind kind = Kind::kNothing;
  /// Of a scalar.
  std::string text;
  /// A scalar in quotes is text, never a number.
  bool is_quoted = false;
  /// Of a list.
  std::vector<YamlValue> items;
  /// Of a mapping, in the order of the file; keys differ.
  std::vector<YamlEntry> entries;
  YamlOrigin origin;

  static YamlValue Scalar(std::string text);

  /// The value of a mapping's key, or null.
  const YamlValue* Find(std::string_view key) const;
  YamlValue* Find(std::string_view key);
};

struct YamlEntry {
  std::string key;
  YamlValue value;
};

/// Reads one YAML document. InputError "ORIGIN:LINE: ..." when it is not YAML, has more than one
/// document, repeats a key, or uses anchors or a key that is no scalar. An empty text gives
/// kNothing.
YamlValue ParseYaml(const std::string& text,
                    const std::string& origin,
                    const std::filesystem::path& folder);

/// ParseYaml of a file; InputError when it cannot be read.
YamlValue ReadYaml(const std::filesystem::path& path);

/// Carries out "a.b.c=value" on a tree: the value, itself YAML, replaces or adds the key; mappings
/// on the way are made. InputError "--set ...: ..." when the text is not of that form.
void ApplyOverride(const std::string& override_text, YamlValue& root);

/// The same of a value that was read already; it and all in it become an override from `origin`.
/// InputError when the key is not of the form "a.b.c".
void SetYamlKey(const std::string& key, YamlValue value, YamlOrigin origin, YamlValue& root);

/// Block style, lists in one line, two spaces a level, newline at the end.
std::string YamlText(const YamlValue& root);

/// What a value is, in words for a message: "a mapping", "nothing", or the scalar itself.
std::string DescribeYaml(const YamlValue& value);

/// Throws InputError with the value's place, its key and the text.
[[noreturn]] void FailAtYaml(const YamlValue& value,
                             const std::string& key,
                             const std::string& text);

}  // namespace pfseq
