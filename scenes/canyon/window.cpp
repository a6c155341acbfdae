// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/window.h"

#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>

namespace pfseq {
namespace {

constexpr double kPaneDepth_m = 0.035;
constexpr double kSillHeight_m = 0.07;
constexpr double kSillOverhang_m = 0.06;
constexpr double kJamb_m = 0.14;
constexpr double kLintel_m = 0.2;

/// The boundaries of panes along one direction: pairs of (begin, end), ascending.
std::vector<std::array<double, 2>> PaneSpans(
    double low_m, double high_m, const std::vector<double>& shares, double rim_m, double bar_m) {
  const double free_m =
      high_m - low_m - 2.0 * rim_m - bar_m * (static_cast<double>(shares.size()) - 1.0);
  std::vector<std::array<double, 2>> spans;
  double at_m = low_m + rim_m;
  for (const double share : shares) {
    spans.push_back({at_m, at_m + share * free_m});
    at_m += share * free_m + bar_m;
  }
  return spans;
}

void BuildSill(const BuildContext& context,
               int material_idx,
               const SurfaceFrame& facade,
               const Opening& opening) {
  AddBox(context.builder,
         material_idx,
         facade,
         {opening.low_m.x() - kSillOverhang_m, opening.low_m.y() - kSillHeight_m, 0.0},
         {opening.high_m.x() + kSillOverhang_m, opening.low_m.y(), 0.06},
         kFacesOnWall);
}

void BuildSurround(const BuildContext& context,
                   const Building& building,
                   const SurfaceFrame& facade,
                   const Opening& opening) {
  MeshBuilder& builder = context.builder;
  const double left_m = opening.low_m.x();
  const double right_m = opening.high_m.x();
  const double foot_m = opening.low_m.y();
  const double head_m = opening.high_m.y();
  if (!building.window.has_surround) {
    AddBox(builder,
           building.trim,
           facade,
           {left_m - 0.12, head_m, 0.0},
           {right_m + 0.12, head_m + kLintel_m, 0.02},
           kFacesOnWall);
    return;
  }
  // Jambs end at sill and lintel: no face where they touch.
  constexpr unsigned kJambFaces = kFaceFront | kFaceLeft | kFaceRight;
  AddBox(builder,
         building.trim,
         facade,
         {left_m - kJamb_m, foot_m, 0.0},
         {left_m, head_m, 0.035},
         kJambFaces | kFaceBottom);
  AddBox(builder,
         building.trim,
         facade,
         {right_m, foot_m, 0.0},
         {right_m + kJamb_m, head_m, 0.035},
         kJambFaces | kFaceBottom);
  AddBox(builder,
         building.trim,
         facade,
         {left_m - kJamb_m - 0.03, head_m, 0.0},
         {right_m + kJamb_m + 0.03, head_m + kLintel_m, 0.06},
         kFacesOnWall);
}

/// A cloth or slats in front of the frame, down from the head of the opening.
void BuildBlind(const BuildContext& context,
                int material_idx,
                const SurfaceFrame& facade,
                const Opening& opening,
                double frame_w_m,
                double drop_m) {
  AddBox(context.builder,
         material_idx,
         facade,
         {opening.low_m.x() + 0.012, opening.high_m.y() - drop_m, frame_w_m + 0.005},
         {opening.high_m.x() - 0.012, opening.high_m.y(), frame_w_m + 0.035},
         kFacesSides | kFaceBottom);
}

void BuildShutters(const BuildContext& context,
                   const Building& building,
                   const SurfaceFrame& facade,
                   const Opening& opening) {
  const double leaf_m = 0.5 * opening.Width();
  const double low_m = opening.low_m.y() + 0.01;
  const double high_m = opening.high_m.y();
  for (const double left_m : {opening.low_m.x() - leaf_m - 0.02, opening.high_m.x() + 0.02}) {
    AddBox(context.builder,
           building.shutter,
           facade,
           {left_m, low_m, 0.0},
           {left_m + leaf_m, high_m, 0.045},
           kFacesOnWall);
  }
}

}  // namespace

void BuildWallWithOpenings(MeshBuilder& builder,
                           int material_idx,
                           const SurfaceFrame& facade,
                           const Vec2d& low_m,
                           const Vec2d& high_m,
                           const std::vector<OpeningColumn>& columns) {
  double left_m = low_m.x();
  for (const OpeningColumn& column : columns) {
    builder.Rectangle(material_idx, facade, {left_m, low_m.y()}, {column.left_m, high_m.y()}, 0.0);
    double foot_m = low_m.y();
    for (const auto& [span_low_m, span_high_m] : column.spans_m) {
      builder.Rectangle(
          material_idx, facade, {column.left_m, foot_m}, {column.right_m, span_low_m}, 0.0);
      foot_m = span_high_m;
    }
    builder.Rectangle(
        material_idx, facade, {column.left_m, foot_m}, {column.right_m, high_m.y()}, 0.0);
    left_m = column.right_m;
  }
  builder.Rectangle(material_idx, facade, {left_m, low_m.y()}, high_m, 0.0);
}

void BuildReveal(MeshBuilder& builder,
                 int material_idx,
                 const SurfaceFrame& facade,
                 const Opening& opening,
                 double front_w_m,
                 double back_w_m,
                 bool has_bottom) {
  const auto at = [&](double u, double v, double w) { return facade.At(u, v, w); };
  const double u0 = opening.low_m.x();
  const double u1 = opening.high_m.x();
  const double v0 = opening.low_m.y();
  const double v1 = opening.high_m.y();
  const double f = front_w_m;
  const double b = back_w_m;
  builder.Quad(material_idx, at(u0, v0, f), at(u0, v0, b), at(u0, v1, b), at(u0, v1, f));
  builder.Quad(material_idx, at(u1, v0, b), at(u1, v0, f), at(u1, v1, f), at(u1, v1, b));
  builder.Quad(material_idx, at(u0, v1, b), at(u1, v1, b), at(u1, v1, f), at(u0, v1, f));
  if (has_bottom) {
    builder.Quad(material_idx, at(u0, v0, f), at(u1, v0, f), at(u1, v0, b), at(u0, v0, b));
  }
}

void BuildGlazing(MeshBuilder& builder,
                  const SurfaceFrame& facade,
                  const Opening& opening,
                  double w_m,
                  const Glazing& glazing) {
  const std::vector<double> column_shares(static_cast<size_t>(glazing.num_columns),
                                          1.0 / glazing.num_columns);
  const std::vector<double> row_shares =
      glazing.transom_share > 0.0
          ? std::vector<double>{1.0 - glazing.transom_share, glazing.transom_share}
          : std::vector<double>{1.0};
  const auto columns =
      PaneSpans(opening.low_m.x(), opening.high_m.x(), column_shares, glazing.rim_m, glazing.bar_m);
  const auto rows =
      PaneSpans(opening.low_m.y(), opening.high_m.y(), row_shares, glazing.rim_m, glazing.bar_m);
  double foot_m = opening.low_m.y();
  for (const auto& [row_low_m, row_high_m] : rows) {
    builder.Rectangle(
        glazing.frame, facade, {opening.low_m.x(), foot_m}, {opening.high_m.x(), row_low_m}, w_m);
    double left_m = opening.low_m.x();
    for (const auto& [pane_left_m, pane_right_m] : columns) {
      builder.Rectangle(glazing.frame, facade, {left_m, row_low_m}, {pane_left_m, row_high_m}, w_m);
      left_m = pane_right_m;
      const Opening pane{{pane_left_m, row_low_m}, {pane_right_m, row_high_m}};
      const double pane_w_m = w_m - kPaneDepth_m;
      BuildReveal(builder, glazing.frame, facade, pane, w_m, pane_w_m, true);
      const TextureWindow picture =
          glazing.picture.Part((pane_left_m - opening.low_m.x()) / opening.Width(),
                               (opening.high_m.y() - row_high_m) / opening.Height(),
                               (pane_right_m - opening.low_m.x()) / opening.Width(),
                               (opening.high_m.y() - row_low_m) / opening.Height());
      builder.PictureQuad(glazing.glass,
                          facade.At(pane_left_m, row_low_m, pane_w_m),
                          facade.At(pane_right_m, row_low_m, pane_w_m),
                          facade.At(pane_right_m, row_high_m, pane_w_m),
                          facade.At(pane_left_m, row_high_m, pane_w_m),
                          picture);
    }
    builder.Rectangle(
        glazing.frame, facade, {left_m, row_low_m}, {opening.high_m.x(), row_high_m}, w_m);
    foot_m = row_high_m;
  }
  builder.Rectangle(glazing.frame, facade, {opening.low_m.x(), foot_m}, opening.high_m, w_m);
}

TextureWindow AtlasCell(int cells, RandomStream& random) {
  constexpr double kRim = 0.012;
  const int column = random.Integer(0, cells - 1);
  const int row = random.Integer(0, cells - 1);
  const double size = 1.0 / cells;
  return TextureWindow{column * size, row * size, (column + 1) * size, (row + 1) * size}.Part(
      kRim, kRim, 1.0 - kRim, 1.0 - kRim);
}

void BuildWindow(const BuildContext& context,
                 const Building& building,
                 const SurfaceFrame& facade,
                 const Opening& opening,
                 int wall,
                 Lod lod,
                 RandomStream& random) {
  const WindowDesign& design = building.window;
  MeshBuilder& builder = context.builder;
  ++context.stats.num_windows;
  const TextureWindow picture = AtlasCell(kWindowAtlasCells, random);
  const bool has_blind = random.Chance(design.blind_share);
  const double drop_share = random.Chance(0.12) ? 1.0 : random.Uniform(0.12, 0.7);
  const double frame_w_m = lod == Lod::kFlush ? 0.0 : -design.reveal_m;
  if (lod != Lod::kFlush) {
    BuildReveal(builder, wall, facade, opening, 0.0, frame_w_m, true);
  }
  if (lod == Lod::kFine) {
    Glazing glazing;
    glazing.frame = building.frame;
    glazing.glass = context.palette.window_glass;
    glazing.num_columns = opening.Width() < 0.8 ? 1 : design.num_columns;
    glazing.transom_share = opening.Height() < 1.1 ? 0.0 : design.transom_share;
    if (RandomStream replaced({building.seed, 60, random.Bits()}); replaced.Chance(0.14)) {
      // Someone has had a new window put in.
      glazing.frame = Pick(context.palette.window_frame, replaced);
      glazing.num_columns = std::max(1, glazing.num_columns - replaced.Integer(0, 1));
      glazing.transom_share = replaced.Chance(0.7) ? 0.0 : glazing.transom_share;
      glazing.rim_m = replaced.Uniform(0.05, 0.085);
    }
    glazing.picture = picture;
    BuildGlazing(builder, facade, opening, frame_w_m, glazing);
  } else {
    builder.PictureQuad(context.palette.window_framed,
                        facade.At(opening.low_m.x(), opening.low_m.y(), frame_w_m),
                        facade.At(opening.high_m.x(), opening.low_m.y(), frame_w_m),
                        facade.At(opening.high_m.x(), opening.high_m.y(), frame_w_m),
                        facade.At(opening.low_m.x(), opening.high_m.y(), frame_w_m),
                        picture);
  }
  if (lod == Lod::kFlush || lod == Lod::kCoarse) {
    return;
  }
  if (has_blind && design.reveal_m > 0.08) {
    BuildBlind(context,
               context.palette.roller_blind,
               facade,
               opening,
               frame_w_m,
               drop_share * opening.Height());
  }
  if (context.detail <= 0.0) {
    return;
  }
  BuildSill(context, building.trim, facade, opening);
  if (design.has_surround || design.has_lintel) {
    BuildSurround(context, building, facade, opening);
  }
  if (design.has_shutters && random.Chance(0.9)) {
    BuildShutters(context, building, facade, opening);
  }
}

}  // namespace pfseq
