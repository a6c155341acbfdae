// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pfseq {

/// An entry of a mapping whose keys are names (lenses.NAME, rig.cameras.NAME); lists of them keep
/// the order of the file.
template <typename T>
struct Named {
  std::string name;
  T value;

  bool operator==(const Named&) const = default;
};

}  // namespace pfseq
