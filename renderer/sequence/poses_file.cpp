// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/poses_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

namespace pfseq {
namespace {

constexpr const char* kHeader = "frame,time_s,x_m,y_m,yaw_deg,z_m,qx,qy,qz,qw";
constexpr size_t kNumColumns = 10;
constexpr double kUnitTolerance = 1e-9;

std::array<double, kNumColumns> ParseRow(std::string_view row, const std::string& where) {
  std::array<double, kNumColumns> values{};
  for (size_t column = 0; column < kNumColumns; ++column) {
    const size_t comma = row.find(',');
    const std::string_view cell = row.substr(0, comma);
    const auto [last, error] =
        std::from_chars(cell.data(), cell.data() + cell.size(), values[column]);
    const bool is_last = column + 1 == kNumColumns;
    if (error != std::errc() || last != cell.data() + cell.size() ||
        !std::isfinite(values[column]) || (comma == std::string_view::npos) != is_last) {
      throw InputError("{}: expected {} finite numbers separated by commas", where, kNumColumns);
    }
    row = is_last ? std::string_view() : row.substr(comma + 1);
  }
  return values;
}

}  // namespace

std::string PosesCsv(const std::vector<StampedPose>& world_from_rig_by_frame) {
  std::string text = std::string(kHeader) + "\n";
  for (size_t frame = 0; frame < world_from_rig_by_frame.size(); ++frame) {
    const StampedPose& pose = world_from_rig_by_frame[frame];
    const Vec3d& t = pose.world_from_rig.translation_m;
    const Eigen::Quaterniond& q = pose.world_from_rig.rotation;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n",
                        frame,
                        pose.time_s,
                        t.x(),
                        t.y(),
                        DegFromRad(YawRad(pose.world_from_rig)),
                        t.z(),
                        q.x(),
                        q.y(),
                        q.z(),
                        q.w());
  }
  return text;
}

std::vector<StampedPose> ReadPosesCsv(const std::filesystem::path& path) {
  std::istringstream stream(ReadFile(path));
  std::string line;
  if (!std::getline(stream, line) || line != kHeader) {
    throw InputError("{}:1: expected the columns {}", path.string(), kHeader);
  }
  std::vector<StampedPose> poses;
  while (std::getline(stream, line)) {
    const std::string where = fmt::format("{}:{}", path.string(), poses.size() + 2);
    const std::array<double, kNumColumns> row = ParseRow(line, where);
    if (row[0] != static_cast<double>(poses.size())) {
      throw InputError("{}: expected frame {}, got {}", where, poses.size(), row[0]);
    }
    StampedPose pose{
        row[1],
        {Eigen::Quaterniond(row[9], row[6], row[7], row[8]), Vec3d(row[2], row[3], row[5])}};
    if (std::abs(pose.world_from_rig.rotation.norm() - 1.0) > kUnitTolerance) {
      throw InputError("{}: expected a unit quaternion", where);
    }
    poses.push_back(pose);
  }
  if (poses.empty()) {
    throw InputError("{}: expected at least one pose", path.string());
  }
  return poses;
}

}  // namespace pfseq
