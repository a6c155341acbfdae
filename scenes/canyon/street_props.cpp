// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/street_props.h"

#include "scenes/canyon/canyon_textures.h"
#include "scenes/canyon/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// Feet stand this far under the pavement's top.
constexpr double kSunk_m = 0.02;

/// A board with a picture before and behind; its rim has the plain material.
void AddBoard(const BuildContext& context,
              int rim,
              const SurfaceFrame& frame,
              const Vec3d& low_m,
              const Vec3d& high_m,
              const TextureWindow& picture) {
  AddBox(
      context.builder, rim, frame, low_m, high_m, kFaceLeft | kFaceRight | kFaceTop | kFaceBottom);
  const auto at = [&](double u, double v, double w) { return frame.At(u, v, w); };
  context.builder.PictureQuad(context.palette.street_picture,
                              at(low_m.x(), low_m.y(), high_m.z()),
                              at(high_m.x(), low_m.y(), high_m.z()),
                              at(high_m.x(), high_m.y(), high_m.z()),
                              at(low_m.x(), high_m.y(), high_m.z()),
                              picture);
  context.builder.PictureQuad(context.palette.street_picture,
                              at(high_m.x(), low_m.y(), low_m.z()),
                              at(low_m.x(), low_m.y(), low_m.z()),
                              at(low_m.x(), high_m.y(), low_m.z()),
                              at(high_m.x(), high_m.y(), low_m.z()),
                              picture);
}

/// A regular prism about the frame's vertical between two heights, radii given at both; closed.
void AddCone(MeshBuilder& builder,
             int material_idx,
             const SurfaceFrame& frame,
             const Vec2d& center_m,
             const Vec2d& heights_m,
             const Vec2d& radii_m,
             const Vec2d& flatness,
             int num_sides) {
  std::vector<Vec3d> low_m;
  std::vector<Vec3d> high_m;
  for (int i = 0; i < num_sides; ++i) {
    // Seen from above, right to left through the front: counter-clockwise.
    const double angle_rad = 2.0 * std::numbers::pi * (i + 0.5) / num_sides;
    const double u = std::cos(angle_rad) * flatness.x();
    const double w = -std::sin(angle_rad) * flatness.y();
    low_m.push_back(
        frame.At(center_m.x() + radii_m.x() * u, heights_m.x(), center_m.y() + radii_m.x() * w));
    high_m.push_back(
        frame.At(center_m.x() + radii_m.y() * u, heights_m.y(), center_m.y() + radii_m.y() * w));
  }
  for (size_t i = 0; i < low_m.size(); ++i) {
    const size_t next = (i + 1) % low_m.size();
    builder.Quad(material_idx, low_m[i], low_m[next], high_m[next], high_m[i]);
  }
  builder.Polygon(material_idx, high_m);
  std::reverse(low_m.begin(), low_m.end());
  builder.Polygon(material_idx, low_m);
}

}  // namespace

void BuildLampPost(const BuildContext& context, const SurfaceFrame& frame, double height_m) {
  MeshBuilder& builder = context.builder;
  const int material = context.palette.railing;
  ++context.stats.num_lamps;
  const Vec3d foot_m = frame.At(0, -kSunk_m, 0);
  AddPillar(builder, material, foot_m, 0.11, 0.9, 8);
  AddPillar(builder, material, foot_m, 0.06, height_m, 8);
  AddBox(builder,
         material,
         frame,
         {-0.03, height_m - 0.12, 0.0},
         {0.03, height_m - 0.05, 1.3},
         kFacesAll);
  AddBox(builder,
         context.palette.pale_metal,
         frame,
         {-0.14, height_m - 0.17, 0.75},
         {0.14, height_m - 0.02, 1.45},
         kFacesAll);
  AddBox(builder,
         context.palette.head_lamp,
         frame,
         {-0.11, height_m - 0.2, 0.8},
         {0.11, height_m - 0.171, 1.4},
         kFacesSides | kFaceBottom);
}

void BuildTrafficLight(const BuildContext& context,
                       const SurfaceFrame& frame,
                       RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_signs;
  AddPillar(builder, context.palette.pale_metal, frame.At(0, -kSunk_m, 0), 0.055, 3.5, 8);
  const int lit = random.Integer(0, 2);
  const auto signal = [&](const SurfaceFrame& face, double low_m, int num_lights, double size_m) {
    const double high_m = low_m + num_lights * (size_m + 0.06) + 0.06;
    AddBox(builder,
           context.palette.railing,
           face,
           {-0.5 * size_m - 0.05, low_m, 0.07},
           {0.5 * size_m + 0.05, high_m, 0.25},
           kFacesAll);
    for (int i = 0; i < num_lights; ++i) {
      const double foot_m = low_m + 0.06 + i * (size_m + 0.06);
      const int light = i == lit % num_lights
                            ? (i == 0 ? context.palette.signal_green : context.palette.tail_lamp)
                            : context.palette.tyre;
      AddBox(builder,
             light,
             face,
             {-0.5 * size_m, foot_m, 0.252},
             {0.5 * size_m, foot_m + size_m, 0.262},
             kFacesOnWall);
      // The hood over a light.
      AddBox(builder,
             context.palette.railing,
             face,
             {-0.5 * size_m - 0.03, foot_m + size_m, 0.251},
             {0.5 * size_m + 0.03, foot_m + size_m + 0.025, 0.42},
             kFacesAll);
    }
  };
  signal(frame, 2.3, 3, 0.21);
  SurfaceFrame along = frame;
  along.right = -frame.out;
  along.out = frame.right;
  signal(along, 2.2, 2, 0.17);
}

void BuildSignPost(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random) {
  ++context.stats.num_signs;
  const double height_m = random.Uniform(2.6, 3.3);
  AddPillar(
      context.builder, context.palette.pale_metal, frame.At(0, -kSunk_m, 0), 0.03, height_m, 6);
  SurfaceFrame face = frame;
  // Plates face along the street, one way or the other.
  const double way = random.Chance(0.5) ? 1.0 : -1.0;
  face.right = -way * frame.out;
  face.out = way * frame.right;
  double top_m = height_m - 0.03;
  for (int i = random.Integer(1, 3); i > 0 && top_m > 1.9; --i) {
    const double size_m = random.Uniform(0.42, 0.62);
    const double rise_m = random.Chance(0.3) ? 0.45 * size_m : size_m;
    AddBoard(
        context,
        context.palette.pale_metal,
        face,
        {-0.5 * size_m, top_m - rise_m, 0.035},
        {0.5 * size_m, top_m, 0.045},
        StreetPictureCell(rise_m < size_m ? StreetPicture::kPlate : StreetPicture::kSign, random));
    top_m -= rise_m + 0.04;
  }
}

void BuildBollard(const BuildContext& context, const SurfaceFrame& frame) {
  AddPillar(context.builder, context.palette.railing, frame.At(0, -kSunk_m, 0), 0.06, 0.95, 6);
  AddBox(context.builder,
         context.palette.pale_metal,
         frame,
         {-0.068, 0.78, -0.068},
         {0.068, 0.84, 0.068},
         kFacesAll);
}

void BuildPerson(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_people;
  const double scale = random.Uniform(1.55, 1.9) / 1.75;
  const int coat = Pick(context.palette.cloth, random);
  const int trousers = Pick(context.palette.cloth, random);
  const double stride_m = random.Chance(0.6) ? random.Uniform(0.1, 0.24) : 0.02;
  SurfaceFrame own = frame;
  const double turn_rad = random.Uniform(0.0, 2.0 * std::numbers::pi);
  own.right = std::cos(turn_rad) * frame.right + std::sin(turn_rad) * frame.out;
  own.out = own.right.cross(own.up);
  const auto part = [&](int material,
                        const Vec2d& center_m,
                        double low_m,
                        double high_m,
                        const Vec2d& radii_m,
                        const Vec2d& flatness,
                        int sides) {
    AddCone(builder,
            material,
            own,
            scale * center_m,
            scale * Vec2d(low_m, high_m),
            scale * radii_m,
            flatness,
            sides);
  };
  for (const double side : {-1.0, 1.0}) {
    part(trousers, {side * 0.5 * stride_m, side * 0.09}, -0.01, 0.86, {0.075, 0.1}, {1.0, 0.9}, 6);
    part(coat, {side * 0.3 * stride_m, side * 0.25}, 0.765, 1.4, {0.05, 0.07}, {1.0, 1.0}, 5);
  }
  part(coat, {0.0, 0.0}, 0.78, 1.12, {0.2, 0.17}, {0.75, 1.05}, 8);
  part(coat, {0.0, 0.0}, 1.12, 1.46, {0.17, 0.2}, {0.7, 1.15}, 8);
  part(context.palette.skin, {0.0, 0.0}, 1.44, 1.56, {0.06, 0.06}, {1.0, 1.0}, 6);
  part(context.palette.skin, {0.01, 0.0}, 1.53, 1.63, {0.07, 0.1}, {1.05, 0.9}, 7);
  part(random.Chance(0.3) ? coat : context.palette.tyre,
       {0.0, 0.0},
       1.63,
       1.75,
       {0.104, 0.06},
       {1.05, 0.95},
       7);
  if (random.Chance(0.4)) {
    AddBox(builder,
           Pick(context.palette.cloth, random),
           own,
           {-0.32 * scale, 0.95 * scale, -0.13},
           {-0.16 * scale, 1.4 * scale, 0.13},
           kFacesAll);
  }
}

void BuildAdvertisingColumn(const BuildContext& context,
                            const SurfaceFrame& frame,
                            RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_signs;
  constexpr int kSides = 12;
  constexpr double kRadius_m = 0.62;
  constexpr double kLow_m = 0.5;
  constexpr double kHigh_m = 3.0;
  const auto rim = [&](int i, double radius_m, double v_m) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kSides;
    return frame.At(radius_m * std::cos(angle_rad), v_m, -radius_m * std::sin(angle_rad));
  };
  AddCone(builder,
          context.palette.railing,
          frame,
          {0, 0},
          {-kSunk_m, kLow_m},
          {kRadius_m + 0.1, kRadius_m + 0.06},
          {1, 1},
          kSides);
  for (int i = 0; i < kSides; i += 2) {
    // One bill over two sides, another below it.
    const TextureWindow upper = StreetPictureCell(StreetPicture::kPoster, random);
    const TextureWindow lower = StreetPictureCell(StreetPicture::kPoster, random);
    const double split_m = random.Uniform(1.3, 2.1);
    for (int half = 0; half < 2; ++half) {
      const int a = i + half;
      const double x0 = 0.5 * half;
      const auto bill = [&](const TextureWindow& picture, double low_m, double high_m) {
        builder.PictureQuad(context.palette.street_picture,
                            rim(a, kRadius_m, low_m),
                            rim(a + 1, kRadius_m, low_m),
                            rim(a + 1, kRadius_m, high_m),
                            rim(a, kRadius_m, high_m),
                            picture.Part(x0, 0.0, x0 + 0.5, 1.0));
      };
      bill(lower, kLow_m - 0.01, split_m);
      bill(upper, split_m, kHigh_m + 0.01);
    }
  }
  AddCone(builder,
          context.palette.railing,
          frame,
          {0, 0},
          {kHigh_m, kHigh_m + 0.16},
          {kRadius_m + 0.14, kRadius_m + 0.1},
          {1, 1},
          kSides);
  AddCone(builder,
          context.palette.railing,
          frame,
          {0, 0},
          {kHigh_m + 0.15, kHigh_m + 0.6},
          {kRadius_m, 0.06},
          {1, 1},
          kSides);
}

void BuildBusShelter(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random) {
  MeshBuilder& builder = context.builder;
  ++context.stats.num_signs;
  constexpr double kHalf_m = 2.0;
  constexpr double kHeight_m = 2.45;
  const int metal = context.palette.pale_metal;
  for (const double u : {-kHalf_m, 0.0, kHalf_m}) {
    AddBox(builder,
           metal,
           frame,
           {u - 0.035, -kSunk_m, -1.33},
           {u + 0.035, kHeight_m, -1.26},
           kFacesSides);
  }
  AddBox(builder,
         metal,
         frame,
         {-kHalf_m - 0.15, kHeight_m, -1.4},
         {kHalf_m + 0.15, kHeight_m + 0.09, 0.0},
         kFacesAll);
  for (const double left_m : {-kHalf_m + 0.05, 0.05}) {
    AddBox(builder,
           context.palette.car_glass,
           frame,
           {left_m, 0.2, -1.3},
           {left_m + kHalf_m - 0.1, kHeight_m - 0.15, -1.29},
           kFacesAll);
  }
  SurfaceFrame side = frame.MovedTo(kHalf_m, 0.0, -0.68);
  side.right = -frame.out;
  side.out = frame.right;
  AddBoard(context,
           metal,
           side,
           {-0.6, 0.25, -0.08},
           {0.6, 2.1, 0.08},
           StreetPictureCell(StreetPicture::kPoster, random));
  AddBox(builder, metal, side, {-0.56, -kSunk_m, -0.05}, {0.56, 0.25, 0.05}, kFacesSides);
}

void BuildCabinet(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random) {
  const Vec3d half_m(
      random.Uniform(0.25, 0.6), random.Uniform(0.9, 1.3), random.Uniform(0.18, 0.3));
  const int material =
      random.Chance(0.5) ? context.palette.gutter : Pick(context.palette.shop_front, random);
  AddBox(context.builder,
         material,
         frame,
         {-half_m.x(), -kSunk_m, -half_m.z()},
         {half_m.x(), half_m.y(), half_m.z()},
         kFacesSides | kFaceTop);
}

}  // namespace pfseq
