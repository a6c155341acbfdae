// SPDX-License-Identifier: Apache-2.0
#include "renderer/lens/trajectory_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// How far a quaternion's length in a file may be from 1: digits may have been cut off, but not
/// more.
constexpr double kQuaternionLengthTolerance = 0.01;

constexpr std::string_view kBlanks = " \t\r";

std::string_view Trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Parts between single separators, trimmed; empty parts count.
std::vector<std::string_view> SplitAtEach(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(Trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  return parts;
}

/// Parts between runs of blanks.
std::vector<std::string_view> SplitAtBlanks(std::string_view text) {
  std::vector<std::string_view> parts;
  size_t start = text.find_first_not_of(kBlanks);
  while (start != std::string_view::npos) {
    const size_t end = std::min(text.find_first_of(kBlanks, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = text.find_first_not_of(kBlanks, end);
  }
  return parts;
}

/// A line of a text file with its place, for messages.
struct Line {
  std::string where;
  std::string_view text;
};

/// The lines that are neither blank nor comments; spreadsheets put a byte order mark in front.
std::vector<Line> ContentLines(const std::filesystem::path& path, std::string_view file_text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (file_text.starts_with(kByteOrderMark)) {
    file_text.remove_prefix(kByteOrderMark.size());
  }
  std::vector<Line> lines;
  int line_number = 0;
  for (const std::string_view text : SplitAtEach(file_text, '\n')) {
    ++line_number;
    if (!text.empty() && text[0] != '#') {
      lines.push_back({fmt::format("{}:{}", path.string(), line_number), text});
    }
  }
  return lines;
}

/// Text from a file for a message: one line, not too long.
std::string Quoted(std::string_view text) {
  std::string printable(text.substr(0, 40));
  std::replace_if(
      printable.begin(),
      printable.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      '?');
  return '"' + printable + (text.size() > 40 ? "...\"" : "\"");
}

template <typename T>
T NumberAt(const Line& line, std::string_view column, std::string_view text) {
  const std::optional<T> value = ParseNumber<T>(text);
  if (!value) {
    throw InputError("{}: {}: expected {}, got {}",
                     line.where,
                     column,
                     std::is_integral_v<T> ? "a whole number" : "a finite number",
                     Quoted(text));
  }
  return *value;
}

void CheckAscending(const Line& line,
                    std::string_view column,
                    const std::vector<StampedPose>& poses,
                    double time_s) {
  if (!poses.empty() && !(time_s > poses.back().time_s)) {
    throw InputError("{}: {}: expected more than in the row before", line.where, column);
  }
}

StampedPose TumPose(const Line& line) {
  constexpr std::array<std::string_view, 8> kColumns = {
      "timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  const std::vector<std::string_view> parts = SplitAtBlanks(line.text);
  if (parts.size() != kColumns.size()) {
    throw InputError("{}: expected 8 columns (timestamp tx ty tz qx qy qz qw), got {}",
                     line.where,
                     parts.size());
  }
  std::array<double, kColumns.size()> values{};
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = NumberAt<double>(line, kColumns[i], parts[i]);
  }
  const auto& [time_s, tx, ty, tz, qx, qy, qz, qw] = values;
  const Eigen::Quaterniond rotation(qw, qx, qy, qz);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionLengthTolerance)) {
    throw InputError("{}: qx qy qz qw: expected a quaternion of length 1, got length {:.6g}",
                     line.where,
                     rotation.norm());
  }
  return {time_s, {rotation.normalized(), {tx, ty, tz}}};
}

/// Positions of the wanted columns in the header.
std::array<size_t, 4> FindColumns(const Line& header,
                                  const std::array<std::string_view, 4>& wanted) {
  const std::vector<std::string_view> columns = SplitAtEach(header.text, ',');
  std::array<size_t, 4> positions{};
  for (size_t i = 0; i < wanted.size(); ++i) {
    const auto column = std::find(columns.begin(), columns.end(), wanted[i]);
    if (column == columns.end()) {
      throw InputError(
          "{}: expected a header with the columns frame,x_m,y_m,yaw_deg; {} is missing",
          header.where,
          wanted[i]);
    }
    if (std::count(columns.begin(), columns.end(), wanted[i]) > 1) {
      throw InputError("{}: column {} is there twice", header.where, wanted[i]);
    }
    positions[i] = static_cast<size_t>(column - columns.begin());
  }
  return positions;
}

}  // namespace

std::vector<StampedPose> ReadTum(const std::filesystem::path& path) {
  const std::string file_text = ReadFile(path);
  std::vector<StampedPose> poses;
  for (const Line& line : ContentLines(path, file_text)) {
    const StampedPose pose = TumPose(line);
    CheckAscending(line, "timestamp", poses, pose.time_s);
    poses.push_back(pose);
  }
  if (poses.empty()) {
    throw InputError("{}: expected at least one pose (timestamp tx ty tz qx qy qz qw), got none",
                     path.string());
  }
  return poses;
}

std::string TumText(std::span<const StampedPose> poses) {
  std::string text;
  for (const auto& [time_s, world_from_rig] : poses) {
    const Vec3d& t = world_from_rig.translation_m;
    Eigen::Quaterniond q = world_from_rig.rotation;
    if (q.w() < 0.0) {
      q.coeffs() = -q.coeffs();
    }
    fmt::format_to(std::back_inserter(text),
                   "{:.9f} {} {} {} {} {} {} {}\n",
                   time_s,
                   t.x(),
                   t.y(),
                   t.z(),
                   q.x(),
                   q.y(),
                   q.z(),
                   q.w());
  }
  return text;
}

std::vector<StampedPose> ReadPoseCsv(const std::filesystem::path& path,
                                     double frame_rate_hz,
                                     double height_m) {
  const std::string file_text = ReadFile(path);
  const std::vector<Line> lines = ContentLines(path, file_text);
  if (lines.empty()) {
    throw InputError(
        "{}: expected a header with the columns frame,x_m,y_m,yaw_deg, the file is empty",
        path.string());
  }
  const auto [frame_column, x_column, y_column, yaw_column] =
      FindColumns(lines[0], {"frame", "x_m", "y_m", "yaw_deg"});
  const size_t num_columns = SplitAtEach(lines[0].text, ',').size();
  std::vector<StampedPose> poses;
  for (const Line& line : std::span(lines).subspan(1)) {
    const std::vector<std::string_view> parts = SplitAtEach(line.text, ',');
    if (parts.size() != num_columns) {
      throw InputError("{}: expected {} columns as in the header, got {}",
                       line.where,
                       num_columns,
                       parts.size());
    }
    const auto frame = NumberAt<int64_t>(line, "frame", parts[frame_column]);
    const auto x_m = NumberAt<double>(line, "x_m", parts[x_column]);
    const auto y_m = NumberAt<double>(line, "y_m", parts[y_column]);
    const double yaw_rad = RadFromDeg(NumberAt<double>(line, "yaw_deg", parts[yaw_column]));
    const double time_s = static_cast<double>(frame) / frame_rate_hz;
    CheckAscending(line, "frame", poses, time_s);
    poses.push_back({time_s, PoseFromYaw({x_m, y_m, height_m}, yaw_rad)});
  }
  if (poses.empty()) {
    throw InputError("{}: expected at least one row below the header, got none", path.string());
  }
  return poses;
}

}  // namespace pfseq
