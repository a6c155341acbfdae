// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/block_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

using EdgeKinds = std::array<EdgeKind, 4>;

/// Less than this and a block stays open ground; less than the others and it holds one or two rows
/// of houses.
constexpr double kLeastRowDepth_m = 6.0;
constexpr double kLeastTwoRows_m = 15.0;
constexpr double kLeastCourtyardBlock_m = 28.0;
constexpr double kGreatestSetback_m = 0.09;
constexpr double kDepthJitter_m = 0.8;
/// Of a house from the middle of the drive: half a car, and room to walk.
constexpr double kLotClearance_m = 1.9;

/// A rectangle to be cut into lots across its long axis.
struct Row {
  PlanRect rect;
  EdgeKinds kinds = {EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
  std::array<double, 4> chamfer_m = {};
};

/// Widths that fill a length, in whole decimetres but for the last.
std::vector<double> SplitWidths(double length_m, RandomStream& random) {
  const int count =
      std::max(1, static_cast<int>(std::lround(length_m / random.Uniform(12.0, 16.0))));
  std::vector<double> shares;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    shares.push_back(random.Uniform(0.65, 1.35));
    sum += shares.back();
  }
  std::vector<double> widths_m;
  double used_m = 0.0;
  for (int i = 0; i + 1 < count; ++i) {
    const double share = shares[static_cast<size_t>(i)] / sum;
    widths_m.push_back(std::round(share * length_m * 10.0) / 10.0);
    used_m += widths_m.back();
  }
  widths_m.push_back(length_m - used_m);
  return widths_m;
}

Lot MakeLot(const PlanRect& rect, const EdgeKinds& kinds, const std::array<double, 4>& chamfer_m) {
  Lot lot;
  std::array<double, 4> cut_m = {};
  const double most_m = 0.8 * rect.Size().minCoeff();
  for (size_t i = 0; i < 4; ++i) {
    const bool on_corner = kinds[i] == EdgeKind::kStreet && kinds[(i + 3) % 4] == EdgeKind::kStreet;
    cut_m[i] = on_corner ? std::min(chamfer_m[i], most_m) : 0.0;
  }
  lot.footprint_m = ChamferedRect(rect, cut_m);
  for (size_t i = 0; i < 4; ++i) {
    if (cut_m[i] > 0.0) {
      lot.edges.push_back(EdgeKind::kStreet);
    }
    lot.edges.push_back(kinds[i]);
  }
  const bool along_x = kinds[kSouth] == EdgeKind::kStreet || kinds[kNorth] == EdgeKind::kStreet;
  const bool along_y = kinds[kWest] == EdgeKind::kStreet || kinds[kEast] == EdgeKind::kStreet;
  lot.has_one_street_axis = along_x != along_y;
  lot.street_along_x = along_x;
  return lot;
}

/// Moves the street and court edges of a lot a little, so that no two neighbours are flush.
void JitterEdges(RandomStream& random, const EdgeKinds& kinds, PlanRect& rect) {
  const auto shift = [&](EdgeKind kind) {
    const double setback_m = std::round(random.Uniform(0.0, kGreatestSetback_m) * 100.0) / 100.0;
    const double depth_m = std::round(random.Uniform(-1.0, 1.0) * kDepthJitter_m * 100.0) / 100.0;
    return kind == EdgeKind::kStreet ? setback_m : kind == EdgeKind::kCourt ? depth_m : 0.0;
  };
  rect.low_m.y() += shift(kinds[kSouth]);
  rect.high_m.x() -= shift(kinds[kEast]);
  rect.high_m.y() -= shift(kinds[kNorth]);
  rect.low_m.x() += shift(kinds[kWest]);
}

void CutRow(const Row& row, RandomStream& random, std::vector<Lot>& lots) {
  const Vec2d size_m = row.rect.Size();
  if (size_m.minCoeff() < 1.0) {
    return;
  }
  const bool along_x = size_m.x() >= size_m.y();
  const int axis = along_x ? 0 : 1;
  const size_t low_end = along_x ? kWest : kSouth;
  const size_t high_end = along_x ? kEast : kNorth;
  const std::vector<double> widths_m = SplitWidths(size_m[axis], random);
  double at_m = row.rect.low_m[axis];
  for (size_t i = 0; i < widths_m.size(); ++i) {
    const bool is_first = i == 0;
    const bool is_last = i + 1 == widths_m.size();
    PlanRect rect = row.rect;
    rect.low_m[axis] = at_m;
    rect.high_m[axis] = is_last ? row.rect.high_m[axis] : at_m + widths_m[i];
    at_m = rect.high_m[axis];
    EdgeKinds kinds = row.kinds;
    if (!is_first) {
      kinds[low_end] = EdgeKind::kParty;
    }
    if (!is_last) {
      kinds[high_end] = EdgeKind::kParty;
    }
    JitterEdges(random, kinds, rect);
    lots.push_back(MakeLot(rect, kinds, row.chamfer_m));
  }
}

EdgeKinds StreetKinds(const Block& block) {
  EdgeKinds kinds;
  for (size_t i = 0; i < 4; ++i) {
    kinds[i] = block.is_street[i] ? EdgeKind::kStreet : EdgeKind::kParty;
  }
  return kinds;
}

void CutTwoRows(const Block& block, RandomStream& random, std::vector<Lot>& lots) {
  const Vec2d size_m = block.lots.Size();
  const int across = size_m.x() >= size_m.y() ? 1 : 0;
  const size_t low_side = across == 1 ? kSouth : kWest;
  const size_t high_side = across == 1 ? kNorth : kEast;
  const double middle_m = block.lots.Center()[across];
  Row low{block.lots, StreetKinds(block), block.lots_chamfer_m};
  Row high = low;
  low.rect.high_m[across] = middle_m;
  low.kinds[high_side] = EdgeKind::kParty;
  high.rect.low_m[across] = middle_m;
  high.kinds[low_side] = EdgeKind::kParty;
  CutRow(low, random, lots);
  CutRow(high, random, lots);
}

/// Lengths of the corner houses along one side: as drawn, or half the side each when too little is
/// left between.
void FitCorners(double side_m, double& first_m, double& second_m) {
  constexpr double kLeastBetween_m = 8.0;
  if (side_m - first_m - second_m < kLeastBetween_m) {
    first_m = std::round(0.5 * side_m * 10.0) / 10.0;
    second_m = side_m - first_m;
  }
}

void CutRing(const Block& block, RandomStream& random, std::vector<Lot>& lots) {
  const PlanRect& rect = block.lots;
  const Vec2d size_m = rect.Size();
  // The sizes (along X, along Y) of the corner houses, and the depth of the rows between them.
  std::array<Vec2d, 4> corner_m;
  for (size_t i = 0; i < 4; ++i) {
    const double least_m = std::max(13.4, block.lots_chamfer_m[i] + 4.0);
    corner_m[i] = {std::round(random.Uniform(least_m, least_m + 4.0) * 10.0) / 10.0,
                   std::round(random.Uniform(least_m, least_m + 4.0) * 10.0) / 10.0};
  }
  FitCorners(size_m.x(), corner_m[0].x(), corner_m[1].x());
  FitCorners(size_m.x(), corner_m[3].x(), corner_m[2].x());
  FitCorners(size_m.y(), corner_m[0].y(), corner_m[3].y());
  FitCorners(size_m.y(), corner_m[1].y(), corner_m[2].y());
  std::array<double, 4> depth_m;
  for (double& depth : depth_m) {
    depth = std::min(std::round(random.Uniform(10.0, 12.4) * 10.0) / 10.0,
                     0.5 * size_m.minCoeff() - kDepthJitter_m - 1.2);
  }
  const EdgeKinds streets = StreetKinds(block);
  const std::array<Vec2d, 4> points_m = rect.Corners();
  for (size_t i = 0; i < 4; ++i) {
    const Vec2d inward_m(i == 0 || i == 3 ? corner_m[i].x() : -corner_m[i].x(),
                         i < 2 ? corner_m[i].y() : -corner_m[i].y());
    const Vec2d other_m = points_m[i] + inward_m;
    EdgeKinds kinds = {EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
    kinds[i] = streets[i];
    kinds[(i + 3) % 4] = streets[(i + 3) % 4];
    lots.push_back(MakeLot({points_m[i].cwiseMin(other_m), points_m[i].cwiseMax(other_m)},
                           kinds,
                           block.lots_chamfer_m));
  }
  const auto row = [&](size_t side, const Vec2d& low_m, const Vec2d& high_m) {
    Row side_row{{low_m, high_m}, {}, {}};
    side_row.kinds = {EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
    side_row.kinds[side] = streets[side];
    side_row.kinds[(side + 2) % 4] = EdgeKind::kCourt;
    // A row that is deeper than long would be cut across the wrong axis: it becomes one lot.
    const Vec2d row_size_m = high_m - low_m;
    const bool is_long =
        side % 2 == 0 ? row_size_m.x() >= row_size_m.y() : row_size_m.y() >= row_size_m.x();
    if (row_size_m.minCoeff() < 1.0) {
      return;
    }
    if (is_long) {
      CutRow(side_row, random, lots);
    } else {
      JitterEdges(random, side_row.kinds, side_row.rect);
      lots.push_back(MakeLot(side_row.rect, side_row.kinds, {}));
    }
  };
  row(kSouth,
      {rect.low_m.x() + corner_m[0].x(), rect.low_m.y()},
      {rect.high_m.x() - corner_m[1].x(), rect.low_m.y() + depth_m[0]});
  row(kEast,
      {rect.high_m.x() - depth_m[1], rect.low_m.y() + corner_m[1].y()},
      {rect.high_m.x(), rect.high_m.y() - corner_m[2].y()});
  row(kNorth,
      {rect.low_m.x() + corner_m[3].x(), rect.high_m.y() - depth_m[2]},
      {rect.high_m.x() - corner_m[2].x(), rect.high_m.y()});
  row(kWest,
      {rect.low_m.x(), rect.low_m.y() + corner_m[0].y()},
      {rect.low_m.x() + depth_m[3], rect.high_m.y() - corner_m[3].y()});
}

}  // namespace

std::vector<Lot> SubdivideBlock(const Block& block,
                                const std::vector<Vec2d>& drive_path_m,
                                RandomStream random) {
  const double depth_m = block.lots.Size().minCoeff();
  std::vector<Lot> lots;
  if (depth_m < kLeastRowDepth_m) {
    return lots;
  }
  if (depth_m < kLeastTwoRows_m || block.is_rim) {
    CutRow({block.lots, StreetKinds(block), block.lots_chamfer_m}, random, lots);
  } else if (depth_m < kLeastCourtyardBlock_m) {
    CutTwoRows(block, random, lots);
  } else {
    CutRing(block, random, lots);
  }
  std::erase_if(lots, [&](const Lot& lot) {
    return DistanceToPath(lot.footprint_m, drive_path_m) < kLotClearance_m;
  });
  return lots;
}

}  // namespace pfseq
