// SPDX-License-Identifier: Apache-2.0
// NumPy's archives of arrays (.npz): a zip file, stored or deflated, of .npy files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfseq {

/// A numeric array of up to two dimensions, in C order.
struct NpzArray {
  /// Rows and columns; a vector has one column.
  size_t num_rows = 0;
  size_t num_columns = 1;
  std::vector<double> values;
  /// Unsigned bytes, else any other number.
  bool is_bytes = false;

  double At(size_t row, size_t column) const { return values[row * num_columns + column]; }
};

/// All arrays by name. Types: float32, float64, integers of 1 to 8 bytes, bool;
/// little-endian. InputError that names the path and the fault.
std::map<std::string, NpzArray> ReadNpz(const std::filesystem::path& path);

}  // namespace pfseq
