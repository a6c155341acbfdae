// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_json.h"

#include "renderer/core/error.h"

#include <limits>

namespace pfseq {
namespace {

using Json = nlohmann::json;

/// A number as it stands in the file, else the type.
std::string Shown(const Json& value) {
  return value.is_number() ? value.dump() : value.type_name();
}

}  // namespace

JsonChecker::JsonChecker(const Json& root, const std::string& origin)
    : root_(root), origin_(origin) {
  if (!root.is_object()) {
    throw InputError("{}: expected a JSON object, got {}", origin, root.type_name());
  }
}

void JsonChecker::Fail(const std::string& path, const std::string& fault) const {
  throw InputError("{}: {}: {}", origin_, path.empty() ? "document" : path, fault);
}

std::string JsonChecker::Join(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

size_t JsonChecker::NumEntries(const char* array) const {
  const auto member = root_.find(array);
  return member != root_.end() && member->is_array() ? member->size() : 0;
}

const Json* JsonChecker::Member(const JsonPlace& place, const char* key, bool is_required) const {
  const auto member = place.object->find(key);
  if (member != place.object->end()) {
    return &*member;
  }
  if (is_required) {
    Fail(place.path, fmt::format("'{}' is missing", key));
  }
  return nullptr;
}

std::optional<JsonPlace> JsonChecker::Object(const JsonPlace& place,
                                             const char* key,
                                             bool is_required) const {
  const Json* member = Member(place, key, is_required);
  if (member == nullptr) {
    return std::nullopt;
  }
  if (!member->is_object()) {
    Fail(Join(place.path, key), fmt::format("expected an object, got {}", Shown(*member)));
  }
  return JsonPlace{member, Join(place.path, key)};
}

const Json* JsonChecker::Array(const JsonPlace& place, const char* key, bool is_required) const {
  const Json* member = Member(place, key, is_required);
  if (member != nullptr && !member->is_array()) {
    Fail(Join(place.path, key), fmt::format("expected an array, got {}", Shown(*member)));
  }
  return member;
}

const std::string* JsonChecker::String(const JsonPlace& place,
                                       const char* key,
                                       bool is_required) const {
  const Json* member = Member(place, key, is_required);
  if (member != nullptr && !member->is_string()) {
    Fail(Join(place.path, key), fmt::format("expected a string, got {}", Shown(*member)));
  }
  return member != nullptr ? member->get_ptr<const std::string*>() : nullptr;
}

void JsonChecker::Boolean(const JsonPlace& place, const char* key) const {
  const Json* member = Member(place, key);
  if (member != nullptr && !member->is_boolean()) {
    Fail(Join(place.path, key), fmt::format("expected true or false, got {}", Shown(*member)));
  }
}

std::optional<JsonPlace> JsonChecker::Extension(const JsonPlace& place, const char* name) const {
  const std::optional<JsonPlace> extensions = Object(place, "extensions");
  return extensions ? Object(*extensions, name) : std::nullopt;
}

std::optional<uint64_t> JsonChecker::Unsigned(
    const JsonPlace& place, const char* key, uint64_t min, uint64_t max, bool is_required) const {
  const Json* member = Member(place, key, is_required);
  if (member == nullptr) {
    return std::nullopt;
  }
  if (!member->is_number_unsigned() || member->get<uint64_t>() < min ||
      member->get<uint64_t>() > max) {
    Fail(Join(place.path, key),
         fmt::format("expected an integer from {} to {}, got {}", min, max, Shown(*member)));
  }
  return member->get<uint64_t>();
}

size_t JsonChecker::Index(const Json& value, const std::string& path, const char* array) const {
  const size_t num_entries = NumEntries(array);
  if (!value.is_number_unsigned()) {
    Fail(path, fmt::format("expected an index into {}, got {}", array, Shown(value)));
  }
  if (value.get<uint64_t>() >= num_entries) {
    Fail(path,
         fmt::format("{}, expected less than {} (the number of {})",
                     value.get<uint64_t>(),
                     num_entries,
                     array));
  }
  return value.get<size_t>();
}

std::optional<size_t> JsonChecker::Index(const JsonPlace& place,
                                         const char* key,
                                         const char* array,
                                         bool is_required) const {
  const Json* member = Member(place, key, is_required);
  return member != nullptr ? std::optional(Index(*member, Join(place.path, key), array))
                           : std::nullopt;
}

void JsonChecker::CheckNumber(const Json& value, const std::string& path, double min) const {
  if (!value.is_number()) {
    Fail(path, fmt::format("expected a number, got {}", Shown(value)));
  }
  // tinygltf keeps the integers of extensions as int.
  const double max =
      value.is_number_integer() ? static_cast<double>(std::numeric_limits<int>::max()) : kMaxNumber;
  const auto number = value.get<double>();
  if (!(number >= std::max(min, -max) && number <= max)) {
    Fail(path, fmt::format("{} is out of range", Shown(value)));
  }
}

void JsonChecker::Number(const JsonPlace& place, const char* key, double min) const {
  if (const Json* member = Member(place, key)) {
    CheckNumber(*member, Join(place.path, key), min);
  }
}

bool JsonChecker::Numbers(const JsonPlace& place, const char* key, size_t count, double min) const {
  const Json* array = Array(place, key);
  if (array == nullptr) {
    return false;
  }
  const std::string path = Join(place.path, key);
  if (array->size() != count) {
    Fail(path, fmt::format("{} numbers, expected {}", array->size(), count));
  }
  for (const Json& value : *array) {
    CheckNumber(value, path, min);
  }
  return true;
}

JsonPlace JsonChecker::Entry(const Json& array, size_t idx, const std::string& array_path) const {
  JsonPlace entry{&array[idx], fmt::format("{}[{}]", array_path, idx)};
  if (!entry.object->is_object()) {
    Fail(entry.path, fmt::format("expected an object, got {}", Shown(*entry.object)));
  }
  return entry;
}

}  // namespace pfseq
