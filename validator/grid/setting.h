// SPDX-License-Identifier: Apache-2.0
// Algorithms with their parameters, and the names of settings. A name is complete: it can be read
// back.
//
//   SIFT nopol 0.04 5.0 1.6                        detector: algorithm, polar or not, parameters
//   SIFT nopol 0.04 5.0 1.6 FREAK 44.0 BruteForce  triplet: detector, descriptor, matcher
//
// The parameters of the form above are those that the report of 2014 varies, in its order; further
// ones follow as key=value where they differ from their default.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// A number that an algorithm takes. Names are those of OpenCV, which the report uses too.
struct Parameter {
  std::string name;
  /// Nothing: chosen by the algorithm from the image or the other parameters ("auto" in files).
  std::optional<double> default_value;
  double least = 0.0;
  double most = 0.0;
  bool is_integer = false;
  /// Always in the name, by position.
  bool is_positional = false;
  /// Whether "auto" is a value.
  bool may_be_auto = false;
};

/// How descriptors are compared.
enum class Norm {
  kL2,        ///< bytes or floats, Euclidean
  kHamming,   ///< bits
  kHamming2,  ///< symbols of two bits: those that differ count one (ORB with WTA_K 3 and 4)
};

struct Algorithm {
  std::string name;
  std::vector<Parameter> parameters;
};

/// What a setting can be made of, in the order of documentation. SURF is there when OpenCV was
/// built with it.
const std::vector<Algorithm>& KnownDetectors();
const std::vector<Algorithm>& KnownDescriptors();
const std::vector<Algorithm>& KnownMatchers();

/// An algorithm with values for all of its parameters, in the order of Algorithm::parameters.
class Setting {
 public:
  /// Defaults.
  explicit Setting(const Algorithm& algorithm);

  const Algorithm& Kind() const { return *algorithm_; }
  bool Is(std::string_view algorithm) const { return algorithm_->name == algorithm; }

  /// The value of a parameter that the algorithm has; nothing stands for "auto".
  std::optional<double> Value(std::string_view parameter) const;
  /// A value that cannot be "auto".
  double Number(std::string_view parameter) const;
  int Integer(std::string_view parameter) const;
  void Set(std::string_view parameter, std::optional<double> value);

  /// Values of the name: positional ones, then key=value. Without the algorithm.
  std::string ValuesText() const;

  bool operator==(const Setting& other) const {
    return algorithm_ == other.algorithm_ && values_ == other.values_;
  }

 private:
  size_t IndexOf(std::string_view parameter) const;

  const Algorithm* algorithm_;
  std::vector<std::optional<double>> values_;
};

struct DetectorSetting {
  Setting setting;
  /// On the polar rectification of the image.
  bool is_polar = false;

  std::string Name() const;
  bool operator==(const DetectorSetting&) const = default;
};

/// "FREAK 44.0", "SIFT".
std::string DescriptorName(const Setting& descriptor);
std::string MatcherName(const Setting& matcher);

/// How a descriptor's rows are compared.
Norm NormOf(const Setting& descriptor);

/// Whether a matcher can work with a descriptor: FLANN needs Euclidean distances.
bool CanMatch(const Setting& matcher, const Setting& descriptor);

/// A number as names have it: whole numbers of a real parameter with ".0".
std::string NumberText(double value, bool is_integer);

/// The text of a value ("auto" or a number) as a value of a parameter; nothing when it is not one.
/// The outer optional tells of success.
std::optional<std::optional<double>> ParseValue(const Parameter& parameter, std::string_view text);

/// "a number from 0 to 1, or auto".
std::string ExpectedText(const Parameter& parameter);

/// The algorithm of that name. InputError with the known names.
const Algorithm& FindAlgorithm(const std::vector<Algorithm>& algorithms,
                               std::string_view name,
                               std::string_view kind);

/// What a full name stands for; a detector's alone has neither descriptor nor matcher.
struct ParsedName {
  DetectorSetting detector;
  std::optional<Setting> descriptor;
  std::optional<Setting> matcher;
};

/// Reads a name. InputError that names the word that does not fit.
ParsedName ParseName(const std::string& name);

}  // namespace pfseq
