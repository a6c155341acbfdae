// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade_clutter.h"

#include "scenes/canyon/canyon_textures.h"
#include "scenes/canyon/shapes.h"
#include "scenes/canyon/street_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfseq {
namespace {

/// Green and coloured leaves over a box on the sill.
void BuildFlowerBox(const BuildContext& context,
                    const SurfaceFrame& facade,
                    const Opening& opening,
                    RandomStream& random) {
  const double left_m = opening.low_m.x() + 0.04;
  const double right_m = opening.high_m.x() - 0.04;
  const double foot_m = opening.low_m.y() + 0.002;
  AddBox(context.builder,
         context.palette.chimney_pot,
         facade,
         {left_m, foot_m, 0.065},
         {right_m, foot_m + 0.16, 0.26},
         kFacesAll);
  const int leaf = Pick(context.palette.leaf, random);
  const int bloom = Pick(context.palette.bloom, random);
  const int count = static_cast<int>(26.0 * (right_m - left_m));
  for (int i = 0; i < count; ++i) {
    const Vec3d at_m = facade.At(random.Uniform(left_m, right_m),
                                 foot_m + random.Uniform(0.1, 0.38),
                                 random.Uniform(0.06, 0.34));
    const Vec3d along =
        (random.Uniform(-1.0, 1.0) * facade.right + random.Uniform(-0.4, 1.0) * facade.up +
         random.Uniform(-0.3, 1.0) * facade.out)
            .normalized();
    const Vec3d across = along.cross(facade.right + 0.3 * facade.up).normalized();
    const double half_m = random.Uniform(0.03, 0.075);
    context.builder.Quad(random.Chance(0.2) ? bloom : leaf,
                         at_m - half_m * along,
                         at_m + 0.5 * half_m * across,
                         at_m + half_m * along,
                         at_m - 0.5 * half_m * across);
  }
}

void BuildAirConditioner(const BuildContext& context,
                         const SurfaceFrame& facade,
                         double u_m,
                         double v_m) {
  const int metal = context.palette.pale_metal;
  AddBox(context.builder,
         metal,
         facade,
         {u_m - 0.4, v_m, 0.08},
         {u_m + 0.4, v_m + 0.55, 0.38},
         kFacesAll);
  AddBox(context.builder,
         context.palette.tyre,
         facade,
         {u_m - 0.32, v_m + 0.07, 0.381},
         {u_m + 0.12, v_m + 0.48, 0.39},
         kFacesOnWall);
  for (const double along_m : {-0.3, 0.3}) {
    AddBox(context.builder,
           context.palette.railing,
           facade,
           {u_m + along_m - 0.02, v_m - 0.05, 0.0},
           {u_m + along_m + 0.02, v_m - 0.001, 0.36},
           kFacesOnWall);
  }
}

/// A flag on a staff that leans out from the wall.
void BuildFlag(const BuildContext& context,
               const SurfaceFrame& facade,
               double u_m,
               double v_m,
               RandomStream& random) {
  const Vec3d from_m = facade.At(u_m, v_m, -0.02);
  const Vec3d tip_m = facade.At(u_m, v_m + 1.0, 1.2);
  const Vec3d along = (tip_m - from_m).normalized();
  const Vec3d side = facade.right;
  const Vec3d up = side.cross(along);
  MeshBuilder& builder = context.builder;
  constexpr double kHalf_m = 0.018;
  const auto at = [&](const Vec3d& base_m, double s, double t) {
    return Vec3d(base_m + kHalf_m * (s * side + t * up));
  };
  constexpr std::array<std::array<double, 2>, 4> kRing = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (size_t i = 0; i < 4; ++i) {
    const auto& a = kRing[i];
    const auto& b = kRing[(i + 1) % 4];
    builder.Quad(context.palette.pale_metal,
                 at(from_m, b[0], b[1]),
                 at(from_m, a[0], a[1]),
                 at(tip_m, a[0], a[1]),
                 at(tip_m, b[0], b[1]));
  }
  builder.Quad(context.palette.pale_metal,
               at(tip_m, -1, 1),
               at(tip_m, 1, 1),
               at(tip_m, 1, -1),
               at(tip_m, -1, -1));
  // Three stripes of cloth, a thin slab each, hanging from the upper half of the staff.
  for (int stripe = 0; stripe < 3; ++stripe) {
    const int cloth = Pick(context.palette.cloth, random);
    const double from = 0.35 + 0.2 * stripe;
    const Vec3d a = from_m + from * (tip_m - from_m);
    const Vec3d b = from_m + (from + 0.2) * (tip_m - from_m);
    const Vec3d drop(0, 0, -1.15);
    const Vec3d thick = -0.004 * side;
    builder.Quad(cloth, a - thick, b - thick, b + drop - thick, a + drop - thick);
    builder.Quad(cloth, b + thick, a + thick, a + drop + thick, b + drop + thick);
    builder.Quad(cloth, b + drop + thick, a + drop + thick, a + drop - thick, b + drop - thick);
    builder.Quad(cloth, a + thick, a - thick, a + drop - thick, a + drop + thick);
    builder.Quad(cloth, b - thick, b + thick, b + drop + thick, b + drop - thick);
    builder.Quad(cloth, a + thick, b + thick, b - thick, a - thick);
  }
}

}  // namespace

void BuildWindowClutter(const BuildContext& context,
                        const SurfaceFrame& facade,
                        const Opening& opening,
                        bool has_balcony,
                        RandomStream& random) {
  const double draw = random.Uniform() / std::max(0.05, context.street_life);
  const double middle_m = 0.5 * (opening.low_m.x() + opening.high_m.x());
  if (has_balcony || context.detail <= 0.0 || context.street_life <= 0.0) {
    return;
  }
  if (draw < 0.10) {
    BuildFlowerBox(context, facade, opening, random);
  } else if (draw < 0.15 && opening.low_m.y() > 4.5) {
    BuildAirConditioner(context, facade, middle_m, opening.low_m.y() - 0.78);
  } else if (draw < 0.165) {
    BuildFlag(context, facade, opening.high_m.x() + 0.2, opening.low_m.y() + 0.3, random);
  }
}

void BuildHangingSign(const BuildContext& context,
                      const SurfaceFrame& facade,
                      double along_m,
                      double head_m,
                      RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_signs;
  const double low_m = std::max(kKerbHeight_m + 2.7, head_m - 1.3);
  const double high_m = low_m + random.Uniform(0.55, 0.95);
  const double out_m = random.Uniform(0.55, 0.85);
  constexpr double kGap_m = 0.14;
  SurfaceFrame board = facade.MovedTo(along_m, 0.0, 0.0);
  // The board's right points out of the wall.
  board.right = facade.out;
  board.out = -facade.right;
  constexpr double kHalf_m = 0.05;
  AddBox(builder,
         context.palette.railing,
         board,
         {kGap_m, low_m, -kHalf_m},
         {kGap_m + out_m, high_m, kHalf_m},
         kFaceLeft | kFaceRight | kFaceTop | kFaceBottom);
  const TextureWindow picture = StreetPictureCell(StreetPicture::kPoster, random);
  const auto at = [&](double u, double v, double w) { return board.At(u, v, w); };
  const double right_m = kGap_m + out_m;
  builder.PictureQuad(context.palette.street_picture,
                      at(kGap_m, low_m, kHalf_m),
                      at(right_m, low_m, kHalf_m),
                      at(right_m, high_m, kHalf_m),
                      at(kGap_m, high_m, kHalf_m),
                      picture);
  builder.PictureQuad(context.palette.street_picture,
                      at(right_m, low_m, -kHalf_m),
                      at(kGap_m, low_m, -kHalf_m),
                      at(kGap_m, high_m, -kHalf_m),
                      at(right_m, high_m, -kHalf_m),
                      picture);
  for (const double v_m : {low_m + 0.1, high_m - 0.1}) {
    AddBox(builder,
           context.palette.railing,
           board,
           {-0.02, v_m - 0.015, -0.015},
           {kGap_m + 0.001, v_m + 0.015, 0.015},
           kFacesSides | kFaceTop | kFaceBottom);
  }
}

}  // namespace pfseq
