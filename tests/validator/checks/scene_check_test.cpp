// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/scene_check.h"

#include "tests/support/simple_scenes.h"
#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/checks/view_fixture.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class SceneCheck : public ViewFixture {};

constexpr const char* kFrontFile = "equisolid/front/distance/000001.exr";
constexpr const char* kRearFile = "equisolid/rear/distance/000001.exr";

TEST_F(SceneCheck, SoundMapsHaveNoFindings) {
  const CheckReport report = Check(CheckScene, 2);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_maps_recast, 8U);
  EXPECT_GT(report.num_pixels_recast, 8U * 1200U);
  EXPECT_LT(report.max_relative_error, 1.2e-7);  // Float's rounding, on which pixels are stored.
  EXPECT_GT(report.max_relative_error, 0.0);
}

TEST_F(SceneCheck, TellsASwappedPair) {
  SwapFiles(folder_ / kFrontFile, folder_ / kRearFile);
  SwapFiles(PathOf("equisolid", "front", Output::kSky, 1),
            PathOf("equisolid", "rear", Output::kSky, 1));
  EXPECT_THAT(Check(CheckScene).findings,
              UnorderedElementsAre(IsFault(kFrontFile, "shows rear's view of frame 1: swapped?"),
                                   IsFault(kRearFile, "shows front's view of frame 1: swapped?")));
}

TEST_F(SceneCheck, TellsSwappedFramesAndLenses) {
  SwapFiles(folder_ / kFrontFile, PathOf("equisolid", "front", Output::kDistance, 3));
  std::filesystem::copy_file(PathOf("equidistant", "rear", Output::kDistance, 1),
                             folder_ / kRearFile,
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(Check(CheckScene).findings,
              testing::IsSupersetOf({
                  IsFault(kFrontFile, "shows front's view of frame 3: swapped?"),
                  IsFault("equisolid/front/distance/000003.exr", "shows front's view of frame 1"),
                  IsFault(kRearFile, "shows rear's view of frame 1 through equidistant: swapped?"),
              }));
}

TEST_F(SceneCheck, AFrameWhoseMapsAllFailHasAnEditedPose) {
  EditLines(folder_ / "poses.csv", [](std::vector<std::string>& lines) {
    const size_t x = lines[4].find(',', lines[4].find(',') + 1) + 1;
    lines[4].replace(x, lines[4].find(',', x) - x, "2.701");
  });
  EXPECT_THAT(Check(CheckScene).findings,
              ElementsAre(IsFault("poses.csv", "frame 3: none of 4 distance maps")));
}

TEST_F(SceneCheck, ACameraWhoseMapsAllFailHasAnEditedPlace) {
  EditLines(folder_ / "rig.yaml", [](std::vector<std::string>& lines) {
    for (std::string& line : lines) {
      if (line.find("position_m: [-2") != std::string::npos) {
        line = "    position_m: [-2.001, 0, 0]";
      }
    }
  });
  EXPECT_THAT(Check(CheckScene).findings,
              ElementsAre(IsFault("rig.yaml", "camera rear: none of 4 distance maps")));
}

TEST_F(SceneCheck, ALensWhoseMapsAllFailIsEdited) {
  EditLines(folder_ / "rig.yaml", [](std::vector<std::string>& lines) {
    for (std::string& line : lines) {
      if (line.find("model: equisolid") != std::string::npos) {
        line = "    model: stereographic";
      }
    }
  });
  EXPECT_THAT(Check(CheckScene).findings,
              Contains(IsFault("rig.yaml", "lens equisolid: none of 4 distance maps")));
}

TEST_F(SceneCheck, AnotherSceneIsToldOnce) {
  Scene moved = *sequence_.scene;
  for (Vec3f& position_m : moved.meshes[0].positions_m) {
    position_m.x() += 0.01F;
    position_m.y() += 0.01F;
    position_m.z() += 0.01F;
  }
  const RayScene moved_scene(std::make_shared<const Scene>(moved));
  const auto check = [&](CheckContext context, CheckReport& report) {
    context.scene = &moved_scene;
    CheckScene(context, report);
  };
  EXPECT_THAT(Check(check).findings, ElementsAre(IsFault("scene.glb", "none of 8 distance maps")));
}

TEST_F(SceneCheck, AMapShiftedByHalfAPixelDoesNotShowTheScene) {
  sequence_.sample_px = {1.0, 0.5};
  sequence_.WriteView(
      folder_.Path(), ray_scene_, sequence_.rig.cameras[0], sequence_.rig.lenses[1], 1);
  EXPECT_THAT(Check(CheckScene).findings,
              Contains(IsFault(kFrontFile, "edited pose or damaged map")));
}

TEST_F(SceneCheck, ASmallDamageIsFoundAndPlaced) {
  EditDistance(folder_ / kRearFile, [](Image<float>& distance_m) {
    ASSERT_TRUE(std::isfinite(distance_m.At(20, 40)));
    distance_m.At(20, 40) *= 1.00002F;
  });
  EXPECT_THAT(Check(CheckScene).findings,
              ElementsAre(IsFault(kRearFile, "1 of 1592 compared pixels differ, first (20, 40)")));
}

TEST_F(SceneCheck, APartOfAMapThatIsWrongIsADamage) {
  EditDistance(folder_ / kRearFile, [](Image<float>& distance_m) {
    for (int y = 0; y < kSizePx / 3; ++y) {
      for (int x = 0; x < kSizePx; ++x) {
        distance_m.At(x, y) *= 1.01F;
      }
    }
  });
  EXPECT_THAT(Check(CheckScene).findings, ElementsAre(IsFault(kRearFile, "in part")));
}

TEST_F(SceneCheck, ASkyMaskThatContradictsTheSceneIsFound) {
  EditSky(PathOf("equisolid", "rear", Output::kSky, 1), [](Image<uint8_t>& sky) {
    for (uint8_t& value : sky.Values()) {
      value = 0;
    }
  });
  EXPECT_THAT(Check(CheckScene).findings,
              ElementsAre(IsFault("equisolid/rear/sky/000001.png", "contradict scene.glb")));
}

/// Findings when the middle column of a map, cast at a low roof that ends at `edge_m` beside the
/// column's rays, shows the sky above the roof's end instead.
std::vector<Finding> FindingsWithMiddleColumnBesideEdge(float edge_m) {
  constexpr int kOddSizePx = 49;
  TestSequence sequence = TestSequence::Yard(kOddSizePx);
  sequence.rig.cameras.pop_back();
  sequence.rig.lenses.pop_back();
  sequence.poses = {{0.0, {}}};
  sequence.frames = {0};
  sequence.scene = SceneOfMesh(Quad({-50.0F, -50.0F, 5.0F},
                                    {edge_m, -50.0F, 5.0F},
                                    {edge_m, 50.0F, 5.0F},
                                    {-50.0F, 50.0F, 5.0F}));
  const TempFolder folder;
  sequence.Write(folder.Path());
  const std::filesystem::path path =
      ViewPath(folder.Path(), "equidistant", "front", Output::kDistance, 0);
  Image<float> distance_m = ReadExr(path);
  for (int y = 0; y < kOddSizePx; ++y) {
    distance_m.At(kOddSizePx / 2, y) = std::numeric_limits<float>::infinity();
  }
  WriteFileAtomically(path, std::span<const std::byte>(EncodeExrFloat(distance_m)));

  const SequenceReader reader(folder.Path());
  const RayScene ray_scene(sequence.scene);
  CheckReport report;
  CheckContext context{reader, &ray_scene, CheckCompleteness(reader, report), {}};
  context.options.quiet = true;
  CheckScene(context, report);
  return report.findings;
}

TEST(SceneCheckAtEdges, APixelOnAnEdgeMayShowEitherSide) {
  EXPECT_THAT(FindingsWithMiddleColumnBesideEdge(0.0F), IsEmpty());
  EXPECT_THAT(FindingsWithMiddleColumnBesideEdge(1e-5F), IsEmpty());  // 2 microradians.
}

TEST(SceneCheckAtEdges, APixelBesideAnEdgeMayNot) {
  EXPECT_THAT(FindingsWithMiddleColumnBesideEdge(1e-3F),
              Contains(IsFault("equidistant/front/distance/000000.exr", "differ")));
}

TEST_F(SceneCheck, LeavesUnreadableMapsToTheOtherChecks) {
  std::filesystem::resize_file(folder_ / kRearFile, 100);
  const CheckReport report = Check(CheckScene);
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_maps_recast, 7U);
}

TEST_F(SceneCheck, DoesNotDependOnTheNumberOfThreads) {
  SwapFiles(folder_ / kFrontFile, folder_ / kRearFile);
  EXPECT_EQ(Check(CheckScene, 1).Text(), Check(CheckScene, 3).Text());
}

}  // namespace
}  // namespace pfseq
