// SPDX-License-Identifier: Apache-2.0
// A function of direction over half a sphere, stored as an image on a square, and directions drawn
// in proportion to it.
//
// The square is the octahedral map of the hemisphere z >= 0 (Cigolle et al. 2014, "A Survey of
// Efficient Representations for Independent Unit Vectors", JCGT 3(2), "hemi-oct"): with s =
// |x| + |y| + z, (u, v) = ((x + y) / s, (x - y) / s) in [-1, 1]^2; the zenith is its centre, the
// horizon its rim. A solid angle is du dv s^3 / 2.
#pragma once

#include "renderer/core/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace pfseq {

/// Point of the square of a direction with z >= 0 (the sign of z is not looked at).
template <typename T>
Eigen::Matrix<T, 2, 1> DomePoint(const Eigen::Matrix<T, 3, 1>& direction) {
  const T s = std::abs(direction.x()) + std::abs(direction.y()) + std::abs(direction.z());
  return {(direction.x() + direction.y()) / s, (direction.x() - direction.y()) / s};
}

/// The unit direction, z >= 0, of a point of the square.
Vec3d DomeDirection(const Vec2d& point);

/// Solid angle of a unit area of the square about a unit direction.
inline double DomeSolidAngle(const Vec3d& direction) {
  const double s = direction.lpNorm<1>();
  return 0.5 * s * s * s;
}

/// Colours at the nodes of a square grid with nodes on its rim, bilinear between them (linear on
/// triangles along the diagonals).
class DomeImage {
 public:
  /// `function` gets unit directions with z >= 0, on several threads at once; the image does not
  /// depend on their number. At least two nodes a side.
  DomeImage(int num_nodes, const std::function<Rgb(const Vec3d&)>& function);

  /// Toward a direction; the sign of z is not looked at.
  Rgb At(const Vec3f& direction) const {
    const Vec2f point = DomePoint(direction);
    const float x = std::min((point.x() + 1.0F) * half_, last_);
    const float y = std::min((point.y() + 1.0F) * half_, last_);
    const auto column = static_cast<int>(x);
    const auto row = static_cast<int>(y);
    const float dx = x - static_cast<float>(column);
    const float dy = y - static_cast<float>(row);
    const Eigen::Array4f* below = &nodes_[static_cast<size_t>(row) * num_nodes_ + column];
    const Eigen::Array4f* above = below + num_nodes_;
    // The map is bent along both diagonals: a square on one of them is two triangles.
    if (row == column || row + column == num_nodes_ - 2) {
      return OnDiagonal(below, above, dx, dy, row == column);
    }
    const Eigen::Array4f low = below[0] + dx * (below[1] - below[0]);
    const Eigen::Array4f high = above[0] + dx * (above[1] - above[0]);
    return (low + dy * (high - low)).head<3>();
  }

  int NumNodes() const { return num_nodes_; }
  Rgb Node(int column, int row) const {
    return nodes_[static_cast<size_t>(row) * num_nodes_ + column].head<3>();
  }
  Vec3d NodeDirection(int column, int row) const;

  /// Integral of radiance times |z| over the half sphere, by the trapezoidal rule on the nodes.
  Rgb HorizontalIrradiance() const;

 private:
  /// Within a square with a diagonal, from its lower left to its upper right corner or across.
  static Rgb OnDiagonal(
      const Eigen::Array4f* below, const Eigen::Array4f* above, float dx, float dy, bool is_rising);

  int num_nodes_;
  /// Half the number of intervals a side, and the last place within the last one.
  float half_;
  float last_;
  /// Row-major; the fourth value is not used.
  std::vector<Eigen::Array4f> nodes_;
};

/// Numbers of intervals in proportion to their weights.
class RunningSum {
 public:
  /// At least one weight; none below 0, not all 0.
  explicit RunningSum(const std::vector<double>& weights);

  /// The place, in [0, number of weights), that `value` in [0, 1) stands for: the whole part is the
  /// interval, the rest the way through it.
  double Place(double value) const;

  double Total() const { return sums_.back(); }

 private:
  /// First 0, last the total.
  std::vector<double> sums_;
  /// The interval of each of equal steps of the total, from which the search starts (the cutpoint
  /// method of Chen and Asau 1974).
  std::vector<uint16_t> starts_;
};

/// Directions with a density near proportional to the luminance of a DomeImage, plus a small even
/// part, so that no direction is without samples.
class DomeSampler {
 public:
  /// The cells are `intervals_a_cell` intervals of the image wide, which must divide their number.
  DomeSampler(const DomeImage& image, int intervals_a_cell);

  /// Integral of the luminance over the half sphere.
  double Total() const { return total_; }

  /// z >= 0, from two numbers in [0, 1).
  Vec3d Sample(const Vec2d& sample) const;

  /// Sample's density by solid angle; the sign of z is not looked at.
  double Pdf(const Vec3d& direction) const;

 private:
  int num_cells_;
  double total_ = 0.0;
  /// Density over the square of each cell, row-major.
  std::vector<float> density_;
  /// Of the rows, and of the columns of each row.
  RunningSum rows_ = RunningSum({1.0});
  std::vector<RunningSum> columns_;
};

}  // namespace pfseq
