// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/party_wall.h"

#include "renderer/core/check.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfseq {
namespace {

/// Walls start this far below the pavement or the neighbour's roof, inside closed matter.
constexpr double kSunk_m = 0.04;
/// Outlines and breakpoints closer than this are the same.
constexpr double kSame_m = 1e-6;

/// An edge's place: along X or Y, at which coordinate of the other axis, facing up or down that
/// axis.
struct EdgeLine {
  bool along_x = true;
  double at_m = 0.0;
  bool is_ascending = true;
};

std::optional<EdgeLine> LineOf(const Building& building, size_t edge) {
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  const Vec2d& a_m = points_m[edge];
  const Vec2d& b_m = points_m[(edge + 1) % points_m.size()];
  if (std::abs(a_m.y() - b_m.y()) < kSame_m) {
    return EdgeLine{true, a_m.y(), b_m.x() > a_m.x()};
  }
  if (std::abs(a_m.x() - b_m.x()) < kSame_m) {
    return EdgeLine{false, a_m.x(), b_m.y() > a_m.y()};
  }
  return std::nullopt;
}

bool Touches(const EdgeLine& a, const EdgeLine& b) {
  return a.along_x == b.along_x && a.is_ascending != b.is_ascending &&
         std::abs(a.at_m - b.at_m) < kSame_m;
}

/// The height of an outline at s, taking the side that lies towards `inner`.
double HeightAt(const Outline& outline, double s, double inner) {
  for (size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vec2d& a = outline[i];
    const Vec2d& b = outline[i + 1];
    if (b.x() - a.x() > kSame_m && inner >= a.x() && inner <= b.x()) {
      return a.y() + (b.y() - a.y()) * (s - a.x()) / (b.x() - a.x());
    }
  }
  return outline.back().y();
}

bool Covers(const Outline& outline, double s) {
  return s >= outline.front().x() && s <= outline.back().x();
}

/// Where the differences of two linear functions cross between s0 and s1.
void AddCrossing(
    const Outline& a, const Outline& b, double s0, double s1, std::vector<double>& breaks) {
  const double middle = 0.5 * (s0 + s1);
  if (!Covers(a, middle) || !Covers(b, middle)) {
    return;
  }
  const double at_0 = HeightAt(a, s0, middle) - HeightAt(b, s0, middle);
  const double at_1 = HeightAt(a, s1, middle) - HeightAt(b, s1, middle);
  if (at_0 * at_1 < 0.0) {
    breaks.push_back(s0 + (s1 - s0) * at_0 / (at_0 - at_1));
  }
}

std::vector<double> BreaksOf(const Outline& own, const std::vector<Outline>& others) {
  std::vector<double> breaks;
  for (const Vec2d& point : own) {
    breaks.push_back(point.x());
  }
  for (const Outline& other : others) {
    for (const Vec2d& point : other) {
      if (point.x() > own.front().x() && point.x() < own.back().x()) {
        breaks.push_back(point.x());
      }
    }
  }
  std::sort(breaks.begin(), breaks.end());
  const size_t num_corners = breaks.size();
  for (size_t i = 0; i + 1 < num_corners; ++i) {
    for (const Outline& other : others) {
      AddCrossing(own, other, breaks[i], breaks[i + 1], breaks);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/// Builds the area between `own` and the greater of `base_m` and the others.
void BuildBetween(const Building& building,
                  const EdgeLine& line,
                  const Outline& own,
                  const std::vector<Outline>& others,
                  double base_m,
                  MeshBuilder& builder) {
  const auto point = [&](double s, double z) {
    return line.along_x ? Vec3d(s, line.at_m, z) : Vec3d(line.at_m, s, z);
  };
  const std::vector<double> breaks = BreaksOf(own, others);
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double s0 = breaks[i];
    const double s1 = breaks[i + 1];
    if (s1 - s0 < kSame_m) {
      continue;
    }
    const double middle = 0.5 * (s0 + s1);
    double low_0 = base_m;
    double low_1 = base_m;
    for (const Outline& other : others) {
      if (Covers(other, middle)) {
        low_0 = std::max(low_0, HeightAt(other, s0, middle) - kSunk_m);
        low_1 = std::max(low_1, HeightAt(other, s1, middle) - kSunk_m);
      }
    }
    const double high_0 = HeightAt(own, s0, middle);
    const double high_1 = HeightAt(own, s1, middle);
    if (0.5 * (high_0 + high_1) <= 0.5 * (low_0 + low_1) + kSunk_m * (others.empty() ? 0.0 : 1.0)) {
      continue;
    }
    if (line.is_ascending) {
      builder.Quad(building.blank_wall,
                   point(s0, low_0),
                   point(s1, low_1),
                   point(s1, high_1),
                   point(s0, high_0));
    } else {
      builder.Quad(building.blank_wall,
                   point(s1, low_1),
                   point(s0, low_0),
                   point(s0, high_0),
                   point(s1, high_1));
    }
  }
}

}  // namespace

Outline OutlineOf(const Building& building, size_t edge) {
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  const size_t next = (edge + 1) % points_m.size();
  const std::optional<EdgeLine> line = LineOf(building, edge);
  PFSEQ_CHECK(line.has_value(), "edge {} is not along an axis", edge);
  const int axis = line->along_x ? 0 : 1;
  const double a = points_m[edge][axis];
  const double b = points_m[next][axis];
  const double eave = building.eave_m;
  const double top = eave + building.roof_rise_m;
  Outline outline = {{a, eave}, {b, eave}};
  if (building.roof == RoofKind::kGable && building.lot.street_along_x != line->along_x) {
    outline = {{a, eave}, {0.5 * (a + b), top}, {b, eave}};
  } else if (building.roof == RoofKind::kMansard && building.lot.edges[edge] != EdgeKind::kStreet) {
    const std::vector<Vec2d> inner_m = MansardTop(building);
    outline = {{a, eave}, {inner_m[edge][axis], top}, {inner_m[next][axis], top}, {b, eave}};
  }
  if (!line->is_ascending) {
    std::reverse(outline.begin(), outline.end());
  }
  return outline;
}

void BuildBlankWalls(std::span<const Building> houses, size_t house, MeshBuilder& builder) {
  const Building& own = houses[house];
  for (size_t edge = 0; edge < own.lot.edges.size(); ++edge) {
    const std::optional<EdgeLine> line = LineOf(own, edge);
    if (!line) {
      continue;
    }
    const bool is_party = own.lot.edges[edge] == EdgeKind::kParty;
    std::vector<Outline> others;
    for (size_t other = 0; is_party && other < houses.size(); ++other) {
      for (size_t k = 0; other != house && k < houses[other].lot.edges.size(); ++k) {
        const std::optional<EdgeLine> other_line = LineOf(houses[other], k);
        if (other_line && Touches(*line, *other_line)) {
          others.push_back(OutlineOf(houses[other], k));
        }
      }
    }
    const double base_m = is_party ? kKerbHeight_m - kSunk_m : own.eave_m;
    BuildBetween(own, *line, OutlineOf(own, edge), others, base_m, builder);
  }
}

}  // namespace pfseq
