// SPDX-License-Identifier: Apache-2.0
// Wires over one street along X between two rows of fronts.
#include "scenes/canyon/street_life.h"
#include "tests/scenes/canyon/canyon_test_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr double kFirst_m = -53.0;
constexpr double kLast_m = 53.0;

/// The drive's street and a cross street at each end.
StreetPlan OneStreet(double width_m) {
  StreetPlan plan;
  plan.streets_along_x = {{0.0, width_m, 2.5}};
  plan.streets_along_y = {{-60.0, 14.0, 2.5}, {60.0, 14.0, 2.5}};
  plan.blocks.resize(2);
  plan.blocks[0].lots = {{kFirst_m, 0.5 * width_m}, {kLast_m, 0.5 * width_m + 30.0}};
  plan.blocks[1].lots = {{kFirst_m, -0.5 * width_m - 30.0}, {kLast_m, -0.5 * width_m}};
  plan.drive_path_m = {{-50.0, 0.0}, {50.0, 0.0}};
  return plan;
}

struct Hung {
  explicit Hung(const StreetPlan& plan, uint64_t seed = 3, double street_life = 1.0) {
    HangWires(bench.Context(1.0, street_life), plan, seed);
    scene = bench.TakeScene();
  }

  PartBench bench;
  Scene scene;
};

/// A piece of a wire: its six corners are those of a prism.
struct Piece {
  Vec3d center_m = Vec3d::Zero();
  Vec3d low_m = Vec3d::Zero();
  Vec3d high_m = Vec3d::Zero();
};

/// The pieces of all wires: three quads each, in the order in which they were built. Expects their
/// faces to look away from the wire.
std::vector<Piece> PiecesOf(const Hung& hung) {
  std::vector<Piece> pieces;
  for (const Mesh& mesh : PartOf(hung.scene, hung.bench.palette.wire).meshes) {
    EXPECT_EQ(mesh.triangles.size() % 6, 0U);
    for (size_t first = 0; first < mesh.triangles.size(); first += 6) {
      std::vector<std::array<Vec3d, 3>> faces;
      Piece piece;
      piece.low_m = Vec3d::Constant(1e9);
      piece.high_m = Vec3d::Constant(-1e9);
      for (size_t i = first; i < first + 6; ++i) {
        std::array<Vec3d, 3> face;
        for (size_t k = 0; k < 3; ++k) {
          face[k] = mesh.positions_m[mesh.triangles[i][k]].cast<double>();
          piece.center_m += face[k] / 18.0;
          piece.low_m = piece.low_m.cwiseMin(face[k]);
          piece.high_m = piece.high_m.cwiseMax(face[k]);
        }
        faces.push_back(face);
      }
      for (const std::array<Vec3d, 3>& face : faces) {
        const Vec3d normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
        EXPECT_GT(normal.dot(face[0] - piece.center_m), 1e-3);
      }
      pieces.push_back(piece);
    }
  }
  return pieces;
}

/// Wires across the street: they touch both walls.
struct Span {
  double low_end_z_m = 0.0;
  double high_end_z_m = 0.0;
  double middle_z_m = 0.0;
  Vec3d low_m = Vec3d::Constant(1e9);
  Vec3d high_m = Vec3d::Constant(-1e9);
};

/// Spans of eight pieces; the street has no tramway.
std::vector<Span> SpansOf(const Hung& hung) {
  const std::vector<Piece> pieces = PiecesOf(hung);
  EXPECT_EQ(pieces.size(), 8U * static_cast<size_t>(hung.bench.stats.num_wires));
  std::vector<Span> spans;
  for (size_t first = 0; first + 8 <= pieces.size(); first += 8) {
    Span span;
    for (size_t i = first; i < first + 8; ++i) {
      span.low_m = span.low_m.cwiseMin(pieces[i].low_m);
      span.high_m = span.high_m.cwiseMax(pieces[i].high_m);
    }
    // From the street's low side to its high side.
    EXPECT_LT(pieces[first].center_m.y(), pieces[first + 7].center_m.y());
    span.low_end_z_m = pieces[first].high_m.z();
    span.high_end_z_m = pieces[first + 7].high_m.z();
    span.middle_z_m = std::min(pieces[first + 3].low_m.z(), pieces[first + 4].low_m.z());
    spans.push_back(span);
  }
  return spans;
}

/// A seed without a tramway in OneStreet.
uint64_t SeedWithoutTramway() {
  StreetPlan plan = OneStreet(14.0);
  plan.blocks.clear();
  for (uint64_t seed = 1; seed < 100; ++seed) {
    if (Hung(plan, seed).bench.stats.num_wires == 0) {
      return seed;
    }
  }
  ADD_FAILURE() << "expected one in 100 streets";
  return 0;
}

TEST(OverheadWires, EndInTheWallsOnBothSides) {
  for (const double width_m : {8.0, 14.0, 30.0}) {
    const Hung hung(OneStreet(width_m), SeedWithoutTramway());
    const std::vector<Span> spans = SpansOf(hung);
    // One each 13 to 24 m of the 94 m between the corners, give or take a fifth.
    EXPECT_GE(spans.size(), 3U);
    EXPECT_LE(spans.size(), 10U);
    for (const Span& span : spans) {
      EXPECT_LT(span.low_m.y(), -0.5 * width_m - 0.05);
      EXPECT_GT(span.low_m.y(), -0.5 * width_m - 0.2);
      EXPECT_GT(span.high_m.y(), 0.5 * width_m + 0.05);
      EXPECT_LT(span.high_m.y(), 0.5 * width_m + 0.2);
    }
  }
}

TEST(OverheadWires, SagInTheMiddleAndHangHighOverTheStreet) {
  for (const Span& span : SpansOf(Hung(OneStreet(14.0), SeedWithoutTramway()))) {
    EXPECT_GT(span.low_end_z_m - span.middle_z_m, 0.05);
    EXPECT_GT(span.high_end_z_m - span.middle_z_m, 0.05);
    const double sag_m = 0.5 * (span.low_end_z_m + span.high_end_z_m) - span.middle_z_m;
    EXPECT_GT(sag_m, 0.2);
    EXPECT_LT(sag_m, 0.8);
    // A lorry is 4 m high.
    EXPECT_GT(span.low_m.z(), 4.5);
    EXPECT_LT(span.high_m.z(), 9.8);
  }
}

TEST(OverheadWires, OfTheCityHangHighOverItsStreets) {
  const Hung hung(PlanStreets({}, {}));
  ASSERT_FALSE(hung.scene.meshes.empty());
  EXPECT_GT(BoundsOfScene(hung.scene).low_m.z(), 4.5F);
  EXPECT_LT(BoundsOfScene(hung.scene).high_m.z(), 9.8F);
  PiecesOf(hung);
}

TEST(OverheadWires, StayAwayFromTheCorners) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const Hung hung(OneStreet(14.0), seed);
    for (const Mesh& mesh : hung.scene.meshes) {
      for (const Vec3f& position_m : mesh.positions_m) {
        // Both ends are on fronts, 6 m or more from their corners; contact wires are in the middle.
        if (std::abs(position_m.y()) > 2.0F) {
          EXPECT_GT(position_m.x(), kFirst_m + 5.9);
          EXPECT_LT(position_m.x(), kLast_m - 5.9);
        }
      }
    }
  }
}

TEST(OverheadWires, AreNotHungWhereNothingHoldsThem) {
  const uint64_t seed = SeedWithoutTramway();
  EXPECT_GT(Hung(OneStreet(14.0), seed).bench.stats.num_wires, 0);
  // Across a street that is too wide, between fronts on one side alone, far from the drive.
  EXPECT_TRUE(Hung(OneStreet(30.5), seed).scene.meshes.empty());
  StreetPlan one_side = OneStreet(14.0);
  one_side.blocks.pop_back();
  EXPECT_TRUE(Hung(one_side, seed).scene.meshes.empty());
  StreetPlan far = OneStreet(14.0);
  far.drive_path_m = {{-50.0, 150.0}, {50.0, 150.0}};
  EXPECT_TRUE(Hung(far, seed).scene.meshes.empty());
  // And in empty streets.
  for (uint64_t other = 0; other < 10; ++other) {
    const Hung empty(OneStreet(14.0), other, 0.0);
    EXPECT_TRUE(empty.scene.meshes.empty());
    EXPECT_EQ(empty.bench.stats.num_wires, 0);
  }
}

TEST(OverheadWires, LampsHangFromTheMiddleOfTheirWire) {
  int num_lamps = 0;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const Hung hung(OneStreet(14.0), seed);
    num_lamps += hung.bench.stats.num_lamps;
    EXPECT_LE(hung.bench.stats.num_lamps, hung.bench.stats.num_wires);
    const Scene lamps = PartOf(hung.scene, hung.bench.palette.head_lamp);
    EXPECT_EQ(lamps.NumTriangles(), 12U * static_cast<size_t>(hung.bench.stats.num_lamps));
    if (hung.bench.stats.num_lamps == 0) {
      continue;
    }
    EXPECT_LT(AreaVectorSum(lamps).norm(), 1e-4);
    EXPECT_GT(SignedVolume(lamps), 0.0);
    EXPECT_LT(std::abs(BoundsOfScene(lamps).low_m.y()), 0.4F);
    EXPECT_LT(std::abs(BoundsOfScene(lamps).high_m.y()), 0.4F);
    EXPECT_GT(BoundsOfScene(lamps).low_m.z(), 4.5F);
  }
  EXPECT_GT(num_lamps, 20);
}

TEST(OverheadWires, FlagsOnALineAreClosedAndPointDown) {
  int num_flags = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const Hung hung(OneStreet(14.0), seed);
    for (const int cloth : hung.bench.palette.cloth) {
      for (const Mesh& mesh : PartOf(hung.scene, cloth).meshes) {
        ASSERT_EQ(mesh.triangles.size() % 6, 0U);
        for (size_t first = 0; first < mesh.triangles.size(); first += 6) {
          Scene flag;
          flag.meshes = {mesh};
          flag.meshes[0].triangles.assign(
              mesh.triangles.begin() + static_cast<ptrdiff_t>(first),
              mesh.triangles.begin() + static_cast<ptrdiff_t>(first + 6));
          EXPECT_LT(AreaVectorSum(flag).norm(), 1e-5);
          EXPECT_GT(SignedVolume(flag), 1e-5);
          ++num_flags;
        }
        EXPECT_GT(BoundsOfScene(PartOf(hung.scene, cloth)).low_m.z(), 4.5F);
      }
    }
  }
  EXPECT_GT(num_flags, 100);
}

TEST(OverheadWires, TramwaysHaveTwoContactWires) {
  StreetPlan plan = OneStreet(14.0);
  plan.blocks.clear();
  constexpr int kNumSeeds = 200;
  int num_tramways = 0;
  for (uint64_t seed = 0; seed < kNumSeeds; ++seed) {
    const Hung hung(plan, seed);
    if (hung.bench.stats.num_wires == 0) {
      continue;
    }
    ++num_tramways;
    EXPECT_EQ(hung.bench.stats.num_wires, 2);
    const Bounds bounds = BoundsOfScene(hung.scene);
    // Level, from the middle of one crossing to that of the next, on both sides of the street's
    // middle in a zigzag of 30 cm.
    EXPECT_NEAR(bounds.low_m.z(), 5.7, 0.02);
    EXPECT_NEAR(bounds.high_m.z(), 5.7, 0.02);
    EXPECT_NEAR(bounds.low_m.x(), -60.0, 0.02);
    EXPECT_NEAR(bounds.high_m.x(), 60.0, 0.02);
    EXPECT_NEAR(bounds.low_m.y(), -1.75, 0.02);
    EXPECT_NEAR(bounds.high_m.y(), 1.75, 0.02);
    for (const Piece& piece : PiecesOf(hung)) {
      EXPECT_GT(std::abs(piece.center_m.y()), 1.4);
    }
  }
  // In three of ten streets; four standard deviations.
  EXPECT_NEAR(num_tramways, 0.3 * kNumSeeds, 4.0 * std::sqrt(0.21 * kNumSeeds));
}

TEST(OverheadWires, AreTheSameForTheSameSeed) {
  const auto positions = [](uint64_t seed) {
    std::vector<Vec3f> all;
    for (const Mesh& mesh : Hung(OneStreet(14.0), seed).scene.meshes) {
      all.insert(all.end(), mesh.positions_m.begin(), mesh.positions_m.end());
    }
    return all;
  };
  EXPECT_EQ(positions(7), positions(7));
  EXPECT_NE(positions(7), positions(8));
}

}  // namespace
}  // namespace pfseq
