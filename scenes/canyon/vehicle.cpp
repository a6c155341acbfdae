// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/vehicle.h"

#include "scenes/canyon/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace pfseq {
namespace {

/// A cross-section of a body, symmetric about its middle: where it stands along the vehicle, its
/// belt line and roof above the road, and its half widths there.
struct Station {
  double along_m;
  double belt_m;
  double roof_m;
  double belt_half_m;
  double roof_half_m;
};

struct VehicleForm {
  Vec2d size_m;
  double sill_m;
  double wheel_m;
  /// From rear to front.
  std::vector<Station> stations;
  /// Whether the upper side and the top behind station i are glass.
  std::vector<bool> has_side_glass;
  std::vector<bool> has_top_glass;
};

VehicleForm FormOf(VehicleKind kind) {
  switch (kind) {
    case VehicleKind::kHatchback:
      return {{3.95, 1.7},
              0.2,
              0.31,
              {{-1.97, 0.72, 0.72, 0.74, 0.74},
               {-1.93, 0.92, 0.95, 0.80, 0.74},
               {-1.60, 0.95, 1.42, 0.83, 0.60},
               {-0.40, 0.95, 1.48, 0.85, 0.62},
               {0.25, 0.93, 1.43, 0.85, 0.61},
               {0.98, 0.90, 0.92, 0.84, 0.72},
               {1.75, 0.78, 0.80, 0.78, 0.66},
               {1.97, 0.55, 0.57, 0.70, 0.62}},
              {false, true, true, true, true, false, false},
              {false, true, false, false, true, false, false}};
    case VehicleKind::kSaloon:
      return {{4.55, 1.76},
              0.2,
              0.32,
              {{-2.27, 0.70, 0.72, 0.76, 0.70},
               {-2.20, 0.94, 0.96, 0.82, 0.70},
               {-1.60, 0.97, 0.99, 0.86, 0.72},
               {-0.95, 0.96, 1.40, 0.88, 0.61},
               {0.05, 0.95, 1.45, 0.88, 0.62},
               {0.45, 0.94, 1.40, 0.88, 0.61},
               {1.20, 0.90, 0.92, 0.86, 0.72},
               {2.05, 0.78, 0.80, 0.80, 0.66},
               {2.27, 0.52, 0.54, 0.72, 0.62}},
              {false, false, true, true, true, true, false, false},
              {false, false, true, false, false, true, false, false}};
    case VehicleKind::kOffRoader:
      return {{4.6, 1.88},
              0.3,
              0.38,
              {{-2.30, 0.80, 0.85, 0.86, 0.80},
               {-2.26, 1.10, 1.15, 0.90, 0.82},
               {-2.05, 1.12, 1.74, 0.92, 0.72},
               {-0.20, 1.10, 1.80, 0.93, 0.74},
               {0.55, 1.10, 1.74, 0.93, 0.73},
               {1.15, 1.06, 1.08, 0.92, 0.78},
               {2.15, 0.98, 1.00, 0.88, 0.74},
               {2.30, 0.62, 0.66, 0.80, 0.72}},
              {false, true, true, true, true, false, false},
              {false, true, false, false, true, false, false}};
    case VehicleKind::kVan:
      return {{5.6, 2.0},
              0.28,
              0.34,
              {{-2.80, 1.00, 2.40, 0.97, 0.88},
               {-1.20, 1.05, 2.52, 1.0, 0.9},
               {0.60, 1.05, 2.52, 1.0, 0.9},
               {1.35, 1.05, 2.46, 1.0, 0.88},
               {2.05, 1.08, 1.45, 0.98, 0.80},
               {2.65, 1.00, 1.04, 0.92, 0.76},
               {2.80, 0.60, 0.64, 0.86, 0.74}},
              {false, false, false, true, false, false},
              {false, false, false, true, false, false}};
    case VehicleKind::kLorry:
      break;
  }
  return {{7.2, 2.3},
          0.45,
          0.45,
          {{-3.60, 1.00, 3.30, 1.14, 1.14},
           {1.55, 1.00, 3.30, 1.14, 1.14},
           {1.60, 1.30, 2.55, 1.10, 1.02},
           {2.60, 1.30, 2.62, 1.10, 1.02},
           {3.35, 1.30, 2.50, 1.08, 0.98},
           {3.60, 1.25, 1.30, 1.04, 0.96}},
          {false, false, true, true, false},
          {false, false, false, false, true}};
}

void BuildBody(const BuildContext& context,
               const VehicleForm& form,
               int paint,
               const SurfaceFrame& frame) {
  MeshBuilder& builder = context.builder;
  const int glass = context.palette.car_glass;
  // Corners of a cross-section: (along, up, out), on the side +1 or -1.
  const auto sill = [&](const Station& s, double side) {
    return frame.At(s.along_m, form.sill_m, side * 0.94 * s.belt_half_m);
  };
  const auto belt = [&](const Station& s, double side) {
    return frame.At(s.along_m, s.belt_m, side * s.belt_half_m);
  };
  const auto roof = [&](const Station& s, double side) {
    return frame.At(s.along_m, s.roof_m, side * s.roof_half_m);
  };
  for (size_t i = 0; i + 1 < form.stations.size(); ++i) {
    const Station& a = form.stations[i];
    const Station& b = form.stations[i + 1];
    const int upper = form.has_side_glass[i] ? glass : paint;
    const int top = form.has_top_glass[i] ? glass : paint;
    builder.Quad(paint, sill(a, 1), sill(b, 1), belt(b, 1), belt(a, 1));
    builder.Quad(paint, sill(b, -1), sill(a, -1), belt(a, -1), belt(b, -1));
    builder.Quad(upper, belt(a, 1), belt(b, 1), roof(b, 1), roof(a, 1));
    builder.Quad(upper, belt(b, -1), belt(a, -1), roof(a, -1), roof(b, -1));
    builder.Quad(top, roof(a, 1), roof(b, 1), roof(b, -1), roof(a, -1));
    builder.Quad(context.palette.tyre, sill(a, -1), sill(b, -1), sill(b, 1), sill(a, 1));
  }
  const auto cap = [&](const Station& s, double side) {
    builder.Quad(paint, sill(s, -side), sill(s, side), belt(s, side), belt(s, -side));
    builder.Quad(paint, belt(s, -side), belt(s, side), roof(s, side), roof(s, -side));
  };
  cap(form.stations.front(), 1.0);
  cap(form.stations.back(), -1.0);
}

/// A wheel whose outer disc stands a little before the body's side.
void BuildWheel(const BuildContext& context,
                const SurfaceFrame& frame,
                const Vec2d& hub_m,
                double side,
                double half_width_m,
                double radius_m) {
  constexpr int kSides = 12;
  MeshBuilder& builder = context.builder;
  const double outer_m = side * half_width_m;
  const double inner_m = side * (half_width_m - 0.22);
  const auto rim = [&](int i, double radius, double w_m) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kSides;
    return frame.At(
        hub_m.x() + radius * std::cos(angle_rad), hub_m.y() + radius * std::sin(angle_rad), w_m);
  };
  std::vector<Vec3d> disc_m;
  std::vector<Vec3d> back_m;
  for (int i = 0; i < kSides; ++i) {
    const int next = i + 1;
    if (side > 0.0) {
      builder.Quad(context.palette.tyre,
                   rim(i, radius_m, inner_m),
                   rim(next, radius_m, inner_m),
                   rim(next, radius_m, outer_m),
                   rim(i, radius_m, outer_m));
      builder.Quad(context.palette.tyre,
                   rim(i, 0.62 * radius_m, outer_m),
                   rim(i, radius_m, outer_m),
                   rim(next, radius_m, outer_m),
                   rim(next, 0.62 * radius_m, outer_m));
    } else {
      builder.Quad(context.palette.tyre,
                   rim(next, radius_m, inner_m),
                   rim(i, radius_m, inner_m),
                   rim(i, radius_m, outer_m),
                   rim(next, radius_m, outer_m));
      builder.Quad(context.palette.tyre,
                   rim(i, radius_m, outer_m),
                   rim(i, 0.62 * radius_m, outer_m),
                   rim(next, 0.62 * radius_m, outer_m),
                   rim(next, radius_m, outer_m));
    }
    const int turn = side > 0.0 ? i : kSides - i;
    disc_m.push_back(rim(turn, 0.62 * radius_m, outer_m));
    back_m.push_back(rim(kSides - turn, radius_m, inner_m));
  }
  builder.Polygon(context.palette.pale_metal, disc_m);
  builder.Polygon(context.palette.tyre, back_m);
}

/// Lamps, plates, mirrors and a door's shadow lines.
void BuildFittings(const BuildContext& context,
                   const VehicleForm& form,
                   int paint,
                   const SurfaceFrame& frame) {
  MeshBuilder& builder = context.builder;
  const Station& rear = form.stations.front();
  const Station& front = form.stations.back();
  const double lamp_m = 0.8 * rear.belt_m;
  for (const double side : {-1.0, 1.0}) {
    const double rear_w = side * (rear.belt_half_m - 0.16);
    AddBox(builder,
           context.palette.tail_lamp,
           frame,
           {rear.along_m - 0.02, lamp_m - 0.08, rear_w - 0.1},
           {rear.along_m + 0.06, lamp_m + 0.1, rear_w + 0.1},
           kFacesAll);
    const double front_w = side * (front.belt_half_m - 0.14);
    AddBox(builder,
           context.palette.head_lamp,
           frame,
           {front.along_m - 0.1, front.belt_m - 0.16, front_w - 0.12},
           {front.along_m + 0.02, front.belt_m - 0.02, front_w + 0.12},
           kFacesAll);
    // The mirror sits before the front side window.
    const Station& pillar = form.stations[form.stations.size() - 3];
    AddBox(builder,
           paint,
           frame,
           {pillar.along_m - 0.32,
            pillar.belt_m + 0.03,
            side * pillar.belt_half_m + (side > 0 ? -0.02 : -0.18)},
           {pillar.along_m - 0.20,
            pillar.belt_m + 0.17,
            side * pillar.belt_half_m + (side > 0 ? 0.18 : 0.02)},
           kFacesAll);
  }
  for (const auto& [along_m, level_m] : {std::array{rear.along_m, 0.62 * rear.belt_m},
                                         std::array{front.along_m, 0.72 * front.belt_m}}) {
    AddBox(builder,
           context.palette.head_lamp,
           frame,
           {along_m - 0.025, level_m - 0.055, -0.26},
           {along_m + 0.025, level_m + 0.055, 0.26},
           kFacesAll);
  }
}

}  // namespace

Vec2d VehicleSize(VehicleKind kind) { return FormOf(kind).size_m; }

void BuildVehicle(const BuildContext& context,
                  VehicleKind kind,
                  const SurfaceFrame& frame,
                  RandomStream& random) {
  const VehicleForm form = FormOf(kind);
  const int paint = Pick(context.palette.car_paint, random);
  ++context.stats.num_vehicles;
  BuildBody(context, form, paint, frame);
  BuildFittings(context, form, paint, frame);
  for (const double along : {-0.3, 0.31}) {
    for (const double side : {-1.0, 1.0}) {
      BuildWheel(context,
                 frame,
                 {along * form.size_m.x(), form.wheel_m},
                 side,
                 0.5 * form.size_m.y() + 0.005,
                 form.wheel_m);
    }
  }
}

}  // namespace pfseq
