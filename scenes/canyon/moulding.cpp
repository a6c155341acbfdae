// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/moulding.h"

#include "scenes/canyon/facade.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

/// Mouldings end this far before the neighbour's wall.
constexpr double kEndGap_m = 0.025;
constexpr double kEave_m = 0.42;

/// Neighbouring street edges that a moulding follows in one go.
struct EdgeRun {
  WallPath path;
  Lod lod = Lod::kFlush;
};

/// All maximal runs of street edges, counter-clockwise.
std::vector<EdgeRun> StreetRuns(const Building& building, const std::vector<Lod>& lods) {
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  const std::vector<EdgeKind>& edges = building.lot.edges;
  const size_t count = edges.size();
  std::vector<EdgeRun> runs;
  const auto is_street = [&](size_t edge) { return edges[edge % count] == EdgeKind::kStreet; };
  const bool all_street = std::all_of(
      edges.begin(), edges.end(), [](EdgeKind kind) { return kind == EdgeKind::kStreet; });
  for (size_t first = 0; first < count; ++first) {
    if (!is_street(first) || (all_street ? first > 0 : is_street(first + count - 1))) {
      continue;
    }
    EdgeRun run;
    run.path.is_closed = all_street;
    size_t edge = first;
    do {
      run.path.points_m.push_back(points_m[edge % count]);
      run.lod = std::min(run.lod, lods[edge % count]);
      ++edge;
    } while (edge < first + count && is_street(edge));
    if (!all_street) {
      run.path.points_m.push_back(points_m[edge % count]);
      std::vector<Vec2d>& path_m = run.path.points_m;
      path_m.front() += kEndGap_m * (path_m[1] - path_m[0]).normalized();
      path_m.back() += kEndGap_m * (path_m[path_m.size() - 2] - path_m.back()).normalized();
    }
    runs.push_back(run);
  }
  return runs;
}

void BuildCornice(const BuildContext& context, const Building& building, const EdgeRun& run) {
  const double top_m = building.eave_m;
  const double depth_m = context.relief * building.cornice_m;
  if (depth_m <= 0.0) {
    const std::array<Vec2d, 4> coping = {
        Vec2d(0.0, top_m - 0.1), Vec2d(0.04, top_m - 0.1), Vec2d(0.04, top_m), Vec2d(0.0, top_m)};
    AddMoulding(context.builder, context.palette.coping, run.path, coping);
    return;
  }
  const double height_m = std::min(1.1 * building.cornice_m, 0.8 * building.top_band_m);
  const auto at = [&](double out, double up) {
    return Vec2d(out * depth_m, top_m - height_m + up * height_m);
  };
  const std::array<Vec2d, 9> profile = {at(0.0, 0.0),
                                        at(0.16, 0.0),
                                        at(0.16, 0.22),
                                        at(0.35, 0.3),
                                        at(0.45, 0.5),
                                        at(0.85, 0.55),
                                        at(0.85, 0.8),
                                        at(1.0, 0.97),
                                        at(0.0, 1.0)};
  const std::array<Vec2d, 5> plain = {
      at(0.0, 0.0), at(0.3, 0.2), at(1.0, 0.6), at(1.0, 0.95), at(0.0, 1.0)};
  if (run.lod == Lod::kFine) {
    AddMoulding(context.builder, building.trim, run.path, profile);
  } else {
    AddMoulding(context.builder, building.trim, run.path, plain);
  }
}

/// Small blocks under the cornice.
void BuildDentils(const BuildContext& context, const Building& building, size_t edge) {
  const SurfaceFrame facade = FrameOfEdge(building, edge);
  const double width_m = EdgeLength(building, edge);
  const double height_m = std::min(1.1 * building.cornice_m, 0.8 * building.top_band_m);
  const double head_m = building.eave_m - 0.47 * height_m;
  const int count = static_cast<int>(std::floor((width_m - 0.6) / 0.36));
  for (int i = 0; i <= count; ++i) {
    const double center_m = 0.5 * width_m + (i - 0.5 * count) * 0.36;
    AddBox(context.builder,
           building.trim,
           facade,
           {center_m - 0.07, head_m - 0.14, 0.0},
           {center_m + 0.07, head_m, 0.72 * context.relief * building.cornice_m},
           kFacesSides | kFaceBottom);
  }
}

/// The overhang of a pitched roof over one edge, with its gutter.
void BuildEave(const BuildContext& context, const Building& building, size_t edge, Lod lod) {
  const PlanRect bounds = BoundsOf(building);
  const double depth_m = building.lot.street_along_x ? bounds.Size().y() : bounds.Size().x();
  const double slope = building.roof_rise_m / (0.5 * depth_m);
  const double lip_m = building.eave_m - kEave_m * slope;
  const std::vector<Vec2d>& points_m = building.lot.footprint_m;
  const Vec2d along = (points_m[(edge + 1) % points_m.size()] - points_m[edge]).normalized();
  const WallPath path{{points_m[edge] + kEndGap_m * along,
                       points_m[(edge + 1) % points_m.size()] - kEndGap_m * along},
                      false};
  const std::array<Vec2d, 4> soffit = {Vec2d(0.0, lip_m - 0.2),
                                       Vec2d(kEave_m - 0.05, lip_m - 0.13),
                                       Vec2d(kEave_m, lip_m - 0.12),
                                       Vec2d(kEave_m, lip_m)};
  const std::array<Vec2d, 2> cover = {Vec2d(kEave_m, lip_m), Vec2d(0.0, building.eave_m)};
  AddMoulding(context.builder, building.trim, path, soffit);
  AddMoulding(context.builder, building.roof_material, path, cover);
  if (lod <= Lod::kMedium) {
    AddBox(context.builder,
           context.palette.gutter,
           FrameOfEdge(building, edge),
           {0.05, lip_m - 0.13, kEave_m},
           {EdgeLength(building, edge) - 0.05, lip_m - 0.03, kEave_m + 0.1},
           kFacesOnWall);
  }
}

void BuildBands(const BuildContext& context, const Building& building, const EdgeRun& run) {
  const double head_m = kKerbHeight_m + building.ground_floor_m;
  const auto band = [&](double low_m, double high_m, double ordinary_depth_m) {
    const double depth_m = context.relief * ordinary_depth_m;
    const std::array<Vec2d, 4> profile = {Vec2d(0.0, low_m),
                                          Vec2d(depth_m, low_m + 0.03),
                                          Vec2d(depth_m, high_m - 0.02),
                                          Vec2d(0.0, high_m)};
    AddMoulding(context.builder, building.trim, run.path, profile);
  };
  if (!building.photo) {
    band(head_m - 0.17, head_m - 0.02, 0.07);
  }
  const bool has_balconies =
      building.balcony != BalconyPattern::kNone && building.balcony != BalconyPattern::kFrench;
  for (int floor = 1; building.has_string_courses && floor < building.num_upper_floors; ++floor) {
    const double floor_m = head_m + floor * building.floor_height_m;
    if (run.lod == Lod::kFine && !has_balconies) {
      band(floor_m - 0.16, floor_m - 0.02, 0.045);
    }
  }
}

/// A pipe from the eave to the pavement, at the left end of a street front.
void BuildDownpipe(const BuildContext& context, const Building& building, size_t edge) {
  const SurfaceFrame facade = FrameOfEdge(building, edge);
  const Vec3d foot_m = facade.At(0.14, kKerbHeight_m - 0.02, 0.13);
  const double top_m =
      building.eave_m - (building.roof == RoofKind::kGable ? 0.25 : 0.5 * building.cornice_m);
  AddPillar(context.builder, context.palette.gutter, foot_m, 0.045, top_m - foot_m.z(), 8);
}

}  // namespace

void BuildMouldings(const BuildContext& context,
                    const Building& building,
                    const std::vector<Lod>& lods) {
  if (building.roof == RoofKind::kGable) {
    for (size_t edge = 0; edge < lods.size(); ++edge) {
      if (building.lot.edges[edge] != EdgeKind::kParty) {
        BuildEave(context, building, edge, lods[edge]);
      }
    }
  }
  if (context.detail <= 0.0) {
    return;
  }
  for (const EdgeRun& run : StreetRuns(building, lods)) {
    if (run.lod > Lod::kCoarse) {
      continue;
    }
    if (building.roof != RoofKind::kGable) {
      BuildCornice(context, building, run);
    }
    const bool is_old =
        building.style != FacadeStyle::kConcrete && building.style != FacadeStyle::kGlass;
    if (run.lod <= Lod::kMedium && is_old) {
      BuildBands(context, building, run);
    }
  }
  RandomStream random({building.seed, 20});
  const bool has_dentils = random.Chance(context.Share(0.6));
  for (size_t edge = 0; edge < lods.size(); ++edge) {
    if (building.lot.edges[edge] != EdgeKind::kStreet || lods[edge] != Lod::kFine) {
      continue;
    }
    if (building.cornice_m > 0.0 && EdgeLength(building, edge) > 6.0) {
      BuildDownpipe(context, building, edge);
    }
    if (has_dentils && building.cornice_m > 0.3 && building.roof != RoofKind::kGable) {
      BuildDentils(context, building, edge);
    }
  }
}

}  // namespace pfseq
