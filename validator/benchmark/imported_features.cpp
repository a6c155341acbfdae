// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/imported_features.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"
#include "validator/benchmark/npz_file.h"
#include "validator/features/pixel_convention.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// OpenCV's size of points without one.
constexpr double kDefaultSizePx = 7.0;

using Table = std::map<std::string, NpzArray>;

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  for (const char c : line + ",") {
    if (c == ',') {
      cells.push_back(cell);
      cell.clear();
    } else if (c != ' ' && c != '\r') {
      cell += c;
    }
  }
  return cells;
}

/// A CSV file as columns; d0, d1, ... become one array.
Table ReadCsv(const std::string& path) {
  std::istringstream lines(ReadFile(path));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = Cells(line);
  std::vector<std::vector<double>> columns(names.size());
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = Cells(line);
    if (cells.size() != names.size()) {
      throw InputError(
          "{}:{}: expected {} columns, got {}", path, number, names.size(), cells.size());
    }
    for (size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> value = ParseNumber<double>(cells[i]);
      if (!value) {
        throw InputError(
            "{}:{}: {}: expected a number, got '{}'", path, number, names[i], cells[i]);
      }
      columns[i].push_back(*value);
    }
  }
  Table table;
  const size_t num_rows = columns[0].size();
  std::vector<const std::vector<double>*> descriptor;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == fmt::format("d{}", descriptor.size())) {
      descriptor.push_back(&columns[i]);
    } else {
      table[names[i]] = {num_rows, 1, columns[i], false};
    }
  }
  if (!descriptor.empty()) {
    NpzArray& rows = table["descriptors"];
    rows = {num_rows, descriptor.size(), {}, false};
    for (size_t row = 0; row < num_rows; ++row) {
      for (const std::vector<double>* column : descriptor) {
        rows.values.push_back((*column)[row]);
      }
    }
  }
  return table;
}

/// Two columns of a CSV file as an array of two columns.
void Join(Table& table, const std::string& path, const char* a, const char* b, const char* joined) {
  if (!table.contains(a) || !table.contains(b)) {
    throw InputError("{}: expected the columns {} and {}", path, a, b);
  }
  NpzArray pairs{table[a].num_rows, 2, {}, false};
  for (size_t row = 0; row < pairs.num_rows; ++row) {
    pairs.values.push_back(table[a].values[row]);
    pairs.values.push_back(table[b].values[row]);
  }
  table[joined] = pairs;
}

Table ReadTable(const std::string& path, const char* a, const char* b, const char* joined) {
  if (path.ends_with(".csv")) {
    Table table = ReadCsv(path);
    Join(table, path, a, b, joined);
    if (table.contains("score")) {
      table["scores"] = table["score"];
    }
    if (table.contains("size")) {
      table["sizes"] = table["size"];
    }
    return table;
  }
  if (!path.ends_with(".npz")) {
    throw InputError("{}: expected a .npz or .csv file", path);
  }
  Table table = ReadNpz(path);
  if (!table.contains(joined) || table[joined].num_columns < 2) {
    throw InputError("{}: expected the array '{}' of two columns", path, joined);
  }
  return table;
}

/// A column of values, one for each key point; nothing when it is not there.
std::vector<double> Column(Table& table,
                           const std::string& path,
                           const char* name,
                           size_t num_rows) {
  if (!table.contains(name)) {
    return {};
  }
  if (table[name].values.size() != num_rows) {
    throw InputError(
        "{}: {}: expected {} values, got {}", path, name, num_rows, table[name].values.size());
  }
  return table[name].values;
}

Descriptors DescriptorsOf(NpzArray array, Norm norm, size_t num_rows, const std::string& path) {
  if (array.num_rows != num_rows && array.num_columns == num_rows) {
    NpzArray turned{array.num_columns, array.num_rows, {}, array.is_bytes};
    for (size_t row = 0; row < turned.num_rows; ++row) {
      for (size_t column = 0; column < turned.num_columns; ++column) {
        turned.values.push_back(array.At(column, row));
      }
    }
    array = std::move(turned);
  }
  const bool is_bits = norm != Norm::kL2;
  const size_t most = is_bits ? 124 : array.is_bytes ? 2048 : 8192;
  if (array.num_rows != num_rows || array.num_columns < 1 || array.num_columns > most) {
    throw InputError("{}: descriptors: expected {} rows of at most {} columns, got {} of {}",
                     path,
                     num_rows,
                     most,
                     array.num_rows,
                     array.num_columns);
  }
  const bool is_bytes = is_bits || array.is_bytes;
  Descriptors descriptors;
  descriptors.norm = norm;
  descriptors.rows = cv::Mat(
      static_cast<int>(num_rows), static_cast<int>(array.num_columns), is_bytes ? CV_8U : CV_32F);
  for (size_t row = 0; row < num_rows; ++row) {
    descriptors.key_point_idx.push_back(static_cast<int>(row));
    for (size_t column = 0; column < array.num_columns; ++column) {
      const double value = array.At(row, column);
      const bool fits = is_bytes ? value >= 0.0 && value <= 255.0 && value == std::floor(value)
                                 : std::isfinite(value);
      if (!fits) {
        throw InputError("{}: descriptors: expected {}, got {}",
                         path,
                         is_bytes ? "bytes" : "finite numbers",
                         value);
      }
      const int y = static_cast<int>(row), x = static_cast<int>(column);
      if (is_bytes) {
        descriptors.rows.at<uint8_t>(y, x) = static_cast<uint8_t>(value);
      } else {
        descriptors.rows.at<float>(y, x) = static_cast<float>(value);
      }
    }
  }
  return descriptors;
}

}  // namespace

std::string FillPath(const std::string& pattern,
                     const std::vector<std::pair<std::string, std::string>>& words) {
  std::string path;
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      path += pattern[i];
      continue;
    }
    const size_t end = pattern.find('}', i);
    const std::string inside = pattern.substr(i + 1, end == std::string::npos ? end : end - i - 1);
    const std::string name = inside.substr(0, inside.find(':'));
    const auto word =
        std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == name; });
    const std::string format = name.size() < inside.size() ? inside.substr(name.size() + 1) : "";
    const std::optional<int> width = format.empty() ? 0 : ParseNumber<int>(format);
    if (end == std::string::npos || word == words.end() || !width || *width < 0 || *width > 20) {
      throw InputError("{}: what does {{{}}} stand for?", pattern, inside);
    }
    const size_t missing =
        static_cast<size_t>(*width) - std::min(static_cast<size_t>(*width), word->second.size());
    path += std::string(missing, '0') + word->second;
    i = end;
  }
  return path;
}

ImportedFeatures ReadImportedFeatures(const ImportedSetting& setting,
                                      const std::string& lens,
                                      const ViewName& view,
                                      const std::string& variant) {
  const std::string path = FillPath(setting.files,
                                    {{"lens", lens},
                                     {"camera", view.camera},
                                     {"variant", variant},
                                     {"frame", fmt::format("{}", view.frame)}});
  Table table = ReadTable(path, "x", "y", "keypoints");
  const NpzArray& points = table["keypoints"];
  ImportedFeatures features;
  for (size_t i = 0; i < points.num_rows; ++i) {
    const double x = points.At(i, 0), y = points.At(i, 1);
    if (!std::isfinite(x) || !std::isfinite(y)) {
      throw InputError("{}: keypoints: expected finite numbers in row {}", path, i);
    }
    features.pixels_px.push_back(setting.origin_is_pixel_centre ? PixelFromOpenCv(x, y)
                                                                : Vec2d(x, y));
    features.sizes_px.push_back(points.num_columns > 2 ? points.At(i, 2) : kDefaultSizePx);
    features.scores.push_back(-static_cast<double>(i));
  }
  for (const auto& [name, values] :
       {std::pair("scores", &features.scores), std::pair("sizes", &features.sizes_px)}) {
    const std::vector<double> column = Column(table, path, name, points.num_rows);
    if (!column.empty()) {
      *values = column;
    }
  }
  features.descriptors.norm = setting.norm;
  if (table.contains("descriptors") && points.num_rows > 0) {
    features.descriptors = DescriptorsOf(table["descriptors"], setting.norm, points.num_rows, path);
  }
  return features;
}

std::vector<std::pair<int, int>> ReadImportedMatches(const ImportedSetting& setting,
                                                     const std::string& lens,
                                                     const ViewName& first,
                                                     const ViewName& second) {
  const std::string path = FillPath(setting.matches,
                                    {{"lens", lens},
                                     {"first_camera", first.camera},
                                     {"first_frame", fmt::format("{}", first.frame)},
                                     {"second_camera", second.camera},
                                     {"second_frame", fmt::format("{}", second.frame)}});
  Table table = ReadTable(path, "first", "second", "matches");
  const NpzArray& rows = table["matches"];
  std::vector<std::pair<int, int>> matches;
  for (size_t i = 0; i < rows.num_rows; ++i) {
    const double a = rows.At(i, 0), b = rows.At(i, 1);
    if (a != std::floor(a) || b != std::floor(b) || a > 1e9 || b > 1e9) {
      throw InputError("{}: matches: expected indices in row {}", path, i);
    }
    if (a >= 0.0 && b >= 0.0) {
      matches.emplace_back(static_cast<int>(a), static_cast<int>(b));
    }
  }
  return matches;
}

}  // namespace pfseq
