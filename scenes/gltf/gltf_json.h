// SPDX-License-Identifier: Apache-2.0
// Typed access to a JSON document in which each fault is told with its place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace pfseq {

/// An object of the document and where it stands ("nodes[3].extensions"; empty for the document
/// itself).
struct JsonPlace {
  const nlohmann::json* object;
  std::string path;
};

/// Checks of single members. All throw InputError "ORIGIN: PATH: fault" when a member has another
/// type or value than asked for, or is missing although required.
class JsonChecker {
 public:
  /// Both arguments must outlive the checker. The document must be an object.
  JsonChecker(const nlohmann::json& root, const std::string& origin);

  [[noreturn]] void Fail(const std::string& path, const std::string& fault) const;

  /// "nodes[3].name".
  static std::string Join(const std::string& path, std::string_view key);

  /// The document as a place.
  JsonPlace Document() const { return {&root_, ""}; }

  /// The entries of an array of the document; 0 when there is none.
  size_t NumEntries(const char* array) const;

  /// The member of any type, or nullptr; so below.
  const nlohmann::json* Member(const JsonPlace& place,
                               const char* key,
                               bool is_required = false) const;
  std::optional<JsonPlace> Object(const JsonPlace& place,
                                  const char* key,
                                  bool is_required = false) const;
  const nlohmann::json* Array(const JsonPlace& place,
                              const char* key,
                              bool is_required = false) const;
  const std::string* String(const JsonPlace& place,
                            const char* key,
                            bool is_required = false) const;
  void Boolean(const JsonPlace& place, const char* key) const;

  /// The object extensions.NAME.
  std::optional<JsonPlace> Extension(const JsonPlace& place, const char* name) const;

  /// An integer in [min, max].
  std::optional<uint64_t> Unsigned(const JsonPlace& place,
                                   const char* key,
                                   uint64_t min,
                                   uint64_t max,
                                   bool is_required = false) const;

  /// An index into an array of the document.
  size_t Index(const nlohmann::json& value, const std::string& path, const char* array) const;
  std::optional<size_t> Index(const JsonPlace& place,
                              const char* key,
                              const char* array,
                              bool is_required = false) const;

  /// A number of at least `min` that is finite as float, and as int where it is written as an
  /// integer.
  void Number(const JsonPlace& place, const char* key, double min = -kMaxNumber) const;

  /// An array of `count` such numbers; whether there is one.
  bool Numbers(const JsonPlace& place,
               const char* key,
               size_t count,
               double min = -kMaxNumber) const;

  /// Calls visit(place, index) for each entry of an array of objects.
  template <typename Visit>
  void ForEach(const JsonPlace& place, const char* key, const Visit& visit) const {
    const nlohmann::json* array = Array(place, key);
    for (size_t i = 0; array != nullptr && i < array->size(); ++i) {
      visit(Entry(*array, i, Join(place.path, key)), i);
    }
  }

 private:
  /// Factors beyond this would not be finite as float once multiplied.
  static constexpr double kMaxNumber = 1e30;

  JsonPlace Entry(const nlohmann::json& array, size_t idx, const std::string& array_path) const;
  void CheckNumber(const nlohmann::json& value, const std::string& path, double min) const;

  const nlohmann::json& root_;
  const std::string& origin_;
};

}  // namespace pfseq
