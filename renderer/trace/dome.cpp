// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/dome.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"

#include <numbers>

namespace pfseq {
namespace {

/// Share of a sampler's directions that are spread evenly.
constexpr double kUniformShare = 0.02;

}  // namespace

Vec3d DomeDirection(const Vec2d& point) {
  const double x = 0.5 * (point.x() + point.y());
  const double y = 0.5 * (point.x() - point.y());
  return Vec3d(x, y, std::max(0.0, 1.0 - std::abs(x) - std::abs(y))).normalized();
}

DomeImage::DomeImage(int num_nodes, const std::function<Rgb(const Vec3d&)>& function)
    : num_nodes_(num_nodes),
      half_(0.5F * static_cast<float>(num_nodes - 1)),
      last_(std::nextafter(static_cast<float>(num_nodes - 1), 0.0F)),
      nodes_(static_cast<size_t>(num_nodes) * num_nodes) {
  PFSEQ_CHECK(num_nodes >= 3 && num_nodes % 2 == 1, "{} nodes", num_nodes);
  ParallelFor(static_cast<size_t>(num_nodes), NumHardwareThreads(), [&](size_t row) {
    for (int column = 0; column < num_nodes; ++column) {
      const Rgb color = function(NodeDirection(column, static_cast<int>(row)));
      nodes_[row * num_nodes + column] = {color[0], color[1], color[2], 0.0F};
    }
  });
}

Rgb DomeImage::OnDiagonal(
    const Eigen::Array4f* below, const Eigen::Array4f* above, float dx, float dy, bool is_rising) {
  if (is_rising) {
    const Eigen::Array4f& corner = dx > dy ? below[1] : above[0];
    return (below[0] + std::max(dx, dy) * (corner - below[0]) +
            std::min(dx, dy) * (above[1] - corner))
        .head<3>();
  }
  if (dx + dy < 1.0F) {
    return (below[0] + dx * (below[1] - below[0]) + dy * (above[0] - below[0])).head<3>();
  }
  return (above[1] + (1.0F - dx) * (above[0] - above[1]) + (1.0F - dy) * (below[1] - above[1]))
      .head<3>();
}

Vec3d DomeImage::NodeDirection(int column, int row) const {
  const double spacing = 2.0 / (num_nodes_ - 1);
  return DomeDirection({column * spacing - 1.0, row * spacing - 1.0});
}

Rgb DomeImage::HorizontalIrradiance() const {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const int last = num_nodes_ - 1;
  for (int row = 0; row <= last; ++row) {
    for (int column = 0; column <= last; ++column) {
      const Vec3d direction = NodeDirection(column, row);
      // Nodes on the rim count half and have no cosine.
      sum += Node(column, row).cast<double>() * (direction.z() * DomeSolidAngle(direction));
    }
  }
  return (sum * (4.0 / (static_cast<double>(last) * last))).cast<float>();
}

RunningSum::RunningSum(const std::vector<double>& weights) {
  PFSEQ_CHECK(!weights.empty() && weights.size() < 65536, "{} weights", weights.size());
  sums_.push_back(0.0);
  for (const double weight : weights) {
    sums_.push_back(sums_.back() + weight);
  }
  PFSEQ_CHECK(sums_.back() > 0.0, "sum {}", sums_.back());
  size_t interval = 0;
  for (size_t step = 0; step < weights.size(); ++step) {
    const double value = sums_.back() * (static_cast<double>(step) / weights.size());
    while (interval + 1 < weights.size() && sums_[interval + 1] <= value) {
      ++interval;
    }
    starts_.push_back(static_cast<uint16_t>(interval));
  }
}

double RunningSum::Place(double value) const {
  const auto num = static_cast<double>(starts_.size());
  // One step back, lest rounding have led past the interval.
  const auto step = static_cast<size_t>(value * num);
  size_t interval = starts_[step > 0 ? step - 1 : 0];
  value *= sums_.back();
  while (interval + 1 < starts_.size() && sums_[interval + 1] <= value) {
    ++interval;
  }
  const double width = sums_[interval + 1] - sums_[interval];
  const double fraction = width > 0.0 ? (value - sums_[interval]) / width : 0.5;
  // Not rounded up into the next one.
  return static_cast<double>(interval) + std::clamp(fraction, 0.0, 1.0 - 0x1.0p-40);
}

DomeSampler::DomeSampler(const DomeImage& image, int intervals_a_cell)
    : num_cells_((image.NumNodes() - 1) / intervals_a_cell) {
  PFSEQ_CHECK(num_cells_ * intervals_a_cell == image.NumNodes() - 1,
              "{} nodes, {} intervals a cell",
              image.NumNodes(),
              intervals_a_cell);
  const auto num = static_cast<size_t>(num_cells_);
  // Each cell's mean over its nodes, those on its rim by their share in it (trapezoidal rule).
  std::vector<double> light(num * num, 0.0);
  std::vector<double> solid_angle(num * num, 0.0);
  ParallelFor(num, NumHardwareThreads(), [&](size_t row) {
    for (size_t column = 0; column < num; ++column) {
      for (int i = 0; i <= intervals_a_cell; ++i) {
        for (int j = 0; j <= intervals_a_cell; ++j) {
          const int node_row = static_cast<int>(row) * intervals_a_cell + i;
          const int node_column = static_cast<int>(column) * intervals_a_cell + j;
          const double weight = (i % intervals_a_cell == 0 ? 0.5 : 1.0) *
                                (j % intervals_a_cell == 0 ? 0.5 : 1.0) *
                                DomeSolidAngle(image.NodeDirection(node_column, node_row));
          light[row * num + column] += weight * Luminance(image.Node(node_column, node_row));
          solid_angle[row * num + column] += weight;
        }
      }
    }
  });
  double light_sum = 0.0;
  double solid_angle_sum = 0.0;
  for (size_t i = 0; i < num * num; ++i) {
    light_sum += light[i];
    solid_angle_sum += solid_angle[i];
  }
  total_ = light_sum * 4.0 / std::pow(image.NumNodes() - 1, 2.0);

  const double cell_area = 4.0 / (static_cast<double>(num_cells_) * num_cells_);
  density_.resize(num * num);
  std::vector<double> row_shares;
  std::vector<double> shares(num);
  for (size_t row = 0; row < num; ++row) {
    for (size_t column = 0; column < num; ++column) {
      const double even = solid_angle[row * num + column] / solid_angle_sum;
      const double share =
          light_sum > 0.0
              ? (1.0 - kUniformShare) * light[row * num + column] / light_sum + kUniformShare * even
              : even;
      shares[column] = share;
      density_[row * num + column] = static_cast<float>(share / cell_area);
    }
    columns_.emplace_back(shares);
    row_shares.push_back(columns_.back().Total());
  }
  rows_ = RunningSum(row_shares);
}

Vec3d DomeSampler::Sample(const Vec2d& sample) const {
  const double row = rows_.Place(sample.y());
  const double column = columns_[static_cast<size_t>(row)].Place(sample.x());
  const double spacing = 2.0 / num_cells_;
  return DomeDirection({column * spacing - 1.0, row * spacing - 1.0});
}

double DomeSampler::Pdf(const Vec3d& direction) const {
  const Vec2d point = DomePoint(direction);
  const auto index = [this](double coordinate) {
    return std::min(static_cast<int>((coordinate + 1.0) * 0.5 * num_cells_), num_cells_ - 1);
  };
  const size_t cell = static_cast<size_t>(index(point.y())) * num_cells_ + index(point.x());
  return density_[cell] / DomeSolidAngle(direction);
}

}  // namespace pfseq
