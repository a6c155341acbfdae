// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/yaml_value.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "renderer/core/file.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace pfseq {
namespace {

/// Nobody nests deeper by hand; a damaged file must not exhaust the stack.
constexpr size_t kMaxDepth = 32;

std::string OnOneLine(std::string_view text) {
  std::string printable(text);
  std::replace_if(
      printable.begin(),
      printable.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      '?');
  return printable;
}

/// Text for a message: one line, not too long.
std::string Shortened(std::string_view text) {
  return OnOneLine(text.substr(0, 60)) + (text.size() > 60 ? "..." : "");
}

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string origin, std::filesystem::path folder, bool has_lines)
      : origin_(std::move(origin)), folder_(std::move(folder)), has_lines_(has_lines) {}

  YamlValue TakeRoot() { return std::move(root_); }

  std::string Where(const YAML::Mark& mark) const {
    return has_lines_ && !mark.is_null() ? fmt::format("{}:{}", origin_, mark.line + 1) : origin_;
  }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Begin(YamlValue::Kind::kNothing, mark, anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { RefuseAnchors(mark); }

  void OnScalar(const YAML::Mark& mark,
                const std::string& tag,
                YAML::anchor_t anchor,
                const std::string& value) override {
    if (ExpectsKey()) {
      AddKey(mark, value);
      return;
    }
    YamlValue* scalar = Begin(YamlValue::Kind::kScalar, mark, anchor);
    scalar->text = value;
    scalar->is_quoted = tag == "!";
  }

  void OnSequenceStart(const YAML::Mark& mark,
                       const std::string& /*tag*/,
                       YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    Open(Begin(YamlValue::Kind::kList, mark, anchor), mark);
  }

  void OnSequenceEnd() override { open_.pop_back(); }

  void OnMapStart(const YAML::Mark& mark,
                  const std::string& /*tag*/,
                  YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    Open(Begin(YamlValue::Kind::kMapping, mark, anchor), mark);
  }

  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct OpenValue {
    YamlValue* value;
    bool has_key = false;
  };

  bool ExpectsKey() const {
    return !open_.empty() && open_.back().value->kind == YamlValue::Kind::kMapping &&
           !open_.back().has_key;
  }

  [[noreturn]] void RefuseAnchors(const YAML::Mark& mark) const {
    throw InputError("{}: anchors and aliases (& and *) are not supported", Where(mark));
  }

  void AddKey(const YAML::Mark& mark, const std::string& key) {
    YamlValue& mapping = *open_.back().value;
    if (const YamlValue* first = mapping.Find(key)) {
      throw InputError("{}: {}: key given twice (first at {})",
                       Where(mark),
                       Shortened(key),
                       first->origin.where);
    }
    mapping.entries.push_back({key, {}});
    mapping.entries.back().value.origin = {Where(mark), "", folder_, false};
    open_.back().has_key = true;
  }

  /// Puts an empty value where the next one belongs.
  YamlValue* Begin(YamlValue::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) {
      RefuseAnchors(mark);
    }
    if (ExpectsKey()) {
      throw InputError("{}: expected a key, got {}",
                       Where(mark),
                       kind == YamlValue::Kind::kNothing
                           ? "nothing"
                           : "a list or mapping (is a bracket left open?)");
    }
    YamlValue* value = &root_;
    if (!open_.empty()) {
      OpenValue& parent = open_.back();
      if (parent.value->kind == YamlValue::Kind::kList) {
        value = &parent.value->items.emplace_back();
      } else {
        value = &parent.value->entries.back().value;
        parent.has_key = false;
      }
    }
    value->kind = kind;
    // A value of a mapping is where its key is, even if it starts a line below.
    if (value->origin.where.empty()) {
      value->origin = {Where(mark), "", folder_, false};
    }
    return value;
  }

  void Open(YamlValue* value, const YAML::Mark& mark) {
    if (open_.size() >= kMaxDepth) {
      throw InputError("{}: nested too deeply", Where(mark));
    }
    open_.push_back({value});
  }

  const std::string origin_;
  const std::filesystem::path folder_;
  const bool has_lines_;
  YamlValue root_;
  /// Lists and mappings that are not closed yet; parents stay in place while children grow.
  std::vector<OpenValue> open_;
};

YamlValue ParseDocument(const std::string& text,
                        const std::string& origin,
                        const std::filesystem::path& folder,
                        bool has_lines) {
  TreeBuilder builder(origin, folder, has_lines);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (parser.HandleNextDocument(builder)) {
      TreeBuilder rest(origin, folder, has_lines);
      if (parser.HandleNextDocument(rest)) {
        throw InputError("{}: expected one YAML document, got several",
                         rest.TakeRoot().origin.where);
      }
    }
  } catch (const YAML::Exception& error) {
    throw InputError("{}: not YAML: {}", builder.Where(error.mark), Shortened(error.msg));
  }
  YamlValue root = builder.TakeRoot();
  if (root.origin.where.empty()) {
    root.origin = {origin, "", folder, false};
  }
  return root;
}

void MarkAsOverride(const YamlOrigin& origin, YamlValue& value) {
  value.origin = origin;
  for (YamlValue& item : value.items) {
    MarkAsOverride(origin, item);
  }
  for (YamlEntry& entry : value.entries) {
    MarkAsOverride(origin, entry.value);
  }
}

std::vector<std::string> SplitKey(const std::string& key, const std::string& where) {
  std::vector<std::string> parts;
  for (size_t start = 0; start <= key.size();) {
    const size_t end = std::min(key.find('.', start), key.size());
    parts.push_back(key.substr(start, end - start));
    if (parts.back().empty()) {
      throw InputError("{}: expected KEY=VALUE with a key such as image.size_px", where);
    }
    start = end + 1;
  }
  return parts;
}

void Emit(const YamlValue& value, YAML::Emitter& emitter) {
  switch (value.kind) {
    case YamlValue::Kind::kNothing:
      emitter << YAML::Null;
      break;
    case YamlValue::Kind::kScalar:
      emitter << value.text;
      break;
    case YamlValue::Kind::kList:
      emitter << YAML::Flow << YAML::BeginSeq;
      for (const YamlValue& item : value.items) {
        Emit(item, emitter);
      }
      emitter << YAML::EndSeq;
      break;
    case YamlValue::Kind::kMapping:
      emitter << YAML::Block << YAML::BeginMap;
      for (const auto& [key, entry_value] : value.entries) {
        emitter << YAML::Key << key << YAML::Value;
        Emit(entry_value, emitter);
      }
      emitter << YAML::EndMap;
      break;
  }
}

}  // namespace

YamlValue YamlValue::Scalar(std::string text) {
  YamlValue value;
  value.kind = Kind::kScalar;
  value.text = std::move(text);
  return value;
}

const YamlValue* YamlValue::Find(std::string_view key) const {
  const auto entry = std::find_if(
      entries.begin(), entries.end(), [&](const YamlEntry& e) { return e.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

YamlValue* YamlValue::Find(std::string_view key) {
  return const_cast<YamlValue*>(std::as_const(*this).Find(key));
}

YamlValue ParseYaml(const std::string& text,
                    const std::string& origin,
                    const std::filesystem::path& folder) {
  return ParseDocument(text, origin, folder, true);
}

YamlValue ReadYaml(const std::filesystem::path& path) {
  return ParseYaml(ReadFile(path), path.string(), path.parent_path());
}

void ApplyOverride(const std::string& override_text, YamlValue& root) {
  const std::string where = "--set " + Shortened(override_text);
  const size_t equals = override_text.find('=');
  if (equals == std::string::npos) {
    throw InputError("{}: expected KEY=VALUE", where);
  }
  SetYamlKey(override_text.substr(0, equals),
             ParseDocument(override_text.substr(equals + 1), where, {}, false),
             {where, "", {}, false},
             root);
}

void SetYamlKey(const std::string& key, YamlValue value, YamlOrigin origin, YamlValue& root) {
  origin.override_key = key;
  YamlValue* target = &root;
  for (const std::string& part : SplitKey(key, origin.where)) {
    // A place above the target that holds no mapping becomes one; the reader tells if none belongs
    // there.
    if (target->kind != YamlValue::Kind::kMapping) {
      *target = {};
      target->kind = YamlValue::Kind::kMapping;
      target->origin = origin;
      target->origin.is_implied = true;
    }
    YamlValue* next = target->Find(part);
    if (next == nullptr) {
      target->entries.push_back({part, {}});
      next = &target->entries.back().value;
    }
    target = next;
  }
  *target = std::move(value);
  MarkAsOverride(origin, *target);
}

std::string YamlText(const YamlValue& root) {
  YAML::Emitter emitter;
  Emit(root, emitter);
  PFSEQ_CHECK(emitter.good(), "{}", emitter.GetLastError());
  return std::string(emitter.c_str()) + '\n';
}

std::string DescribeYaml(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::kNothing:
      return "nothing";
    case YamlValue::Kind::kScalar:
      return value.is_quoted ? '"' + Shortened(value.text) + '"' : Shortened(value.text);
    case YamlValue::Kind::kList:
      return fmt::format("a list of {}", value.items.size());
    case YamlValue::Kind::kMapping:
      return "a mapping";
  }
  return {};
}

void FailAtYaml(const YamlValue& value, const std::string& key, const std::string& text) {
  if (key.empty() || value.origin.override_key == key) {
    throw InputError("{}: {}", value.origin.where, text);
  }
  throw InputError("{}: {}: {}", value.origin.where, OnOneLine(key), text);
}

}  // namespace pfseq
