// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence_renderer.h"

#include "renderer/core/error.h"
#include "renderer/sequence/manifest.h"
#include "renderer/sequence/sequence_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/simple_scenes.h"
#include "tests/support/temp_folder.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

/// A room of 60 x 12 x 20 m around the default drive's first street; two cameras, two lenses, three
/// frames.
SequenceInput Room() {
  SequenceInput input;
  SequenceSpec& spec = input.spec;
  spec.image.size_px = {24, 24};
  const LensSpec lens{.model = "equidistant", .circle_px = 24.0};
  spec.lenses = {{"a", lens}, {"b", LensSpec{.model = "equisolid", .circle_px = 22.0}}};
  spec.cameras = {{"front", {}}, {"rear", CameraSpec{.position_m = {-2.0, 0.0, 0.0}}}};
  spec.trajectory.num_frames = 3;
  spec.light.sun = SunSpec{};
  spec.sensor.exposure = 0.06;
  spec.render.samples = 2;
  spec.render.max_samples = 4;
  spec.render.light_quality = 0.2;
  input.scene = BoxScene(Vec3f(-10, -6, -0.1F), Vec3f(50, 6, 20));
  input.files = {{"sequence.yaml", "room"}, {"scene.glb", "glb"}};
  return input;
}

TEST(RenderSequence, WritesEachSelectedFileAndDescribesItself) {
  const TempFolder folder;
  RenderOptions options{
      .folder = folder / "s", .frames = {2, 0, 2}, .cameras = {"rear"}, .quiet = true};
  const RenderSummary summary = RenderSequence(Room(), options);
  EXPECT_EQ(summary.num_records, 4);
  EXPECT_EQ(summary.num_files_written, 12);
  EXPECT_TRUE(summary.is_complete);
  // 12 frames' files, sequence, scene, rig, poses and a trajectory for each of the two cameras.
  EXPECT_EQ(Manifest::Read(folder / "s").files.size(), 18U);
  const SequenceReader reader(folder / "s");
  EXPECT_EQ(reader.Poses().size(), 3U);
  // Looking straight up from 1.6 m to the ceiling at 20 m, the four pixels about the centre.
  EXPECT_NEAR(reader.ReadDistance("a", "rear", 2).At(12, 12), 18.4, 0.1);
}

TEST(RenderSequence, ResumingRendersOnlyWhatIsMissing) {
  const TempFolder folder;
  RenderOptions options{.folder = folder / "s", .frames = {0}, .quiet = true};
  RenderSequence(Room(), options);
  std::filesystem::remove(folder / "s/b/front/clean/000000.png");
  options.on_existing = OnExisting::kResume;
  const RenderSummary summary = RenderSequence(Room(), options);
  EXPECT_EQ(summary.num_files_written, 1);
  EXPECT_EQ(summary.num_files_kept, 11);
}

TEST(RenderSequence, ShardsShareTheWorkWithoutOverlap) {
  const TempFolder folder;
  RenderOptions options{
      .folder = folder / "s", .on_existing = OnExisting::kResume, .num_shards = 5, .quiet = true};
  int num_records = 0;
  for (int shard_idx = 0; shard_idx < 5; ++shard_idx) {
    options.shard_idx = shard_idx;
    const RenderSummary summary = RenderSequence(Room(), options);
    EXPECT_EQ(summary.num_files_kept, 0);
    EXPECT_EQ(summary.is_complete, shard_idx == 4);
    num_records += summary.num_records;
  }
  EXPECT_EQ(num_records, 3 * 2 * 2);
}

TEST(RenderSequence, RefusesWhatTheSequenceDoesNotHave) {
  const TempFolder folder;
  const auto message = [&](const RenderOptions& options) {
    return MessageOf<InputError>([&] { RenderSequence(Room(), options); });
  };
  EXPECT_THAT(message({.folder = folder / "s", .frames = {3}}), HasSubstr("frames 0 to 2"));
  EXPECT_THAT(message({.folder = folder / "s", .cameras = {"top"}}),
              HasSubstr("--cameras top: the sequence has front, rear"));
  EXPECT_THAT(message({.folder = folder / "s", .lenses = {"c"}}),
              HasSubstr("--lenses c: the sequence has a, b"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s"));
}

TEST(DescribePixel, TellsDistanceAndWhatIsSeen) {
  SequenceInput input = Room();
  const std::string text = DescribePixel(input, {"a", "front", Output::kClean, 0}, 12, 12);
  EXPECT_THAT(text, HasSubstr("distance_m: 18.4"));
  EXPECT_THAT(text, HasSubstr("radiance: "));
  EXPECT_THAT(DescribePixel(input, {"a", "front", Output::kClean, 0}, 0, 0),
              HasSubstr("outside the image circle"));
  EXPECT_THAT(MessageOf<InputError>([&] {
                DescribePixel(input, {"a", "front", Output::kClean, 0}, 24, 0);
              }),
              HasSubstr("the image is 24 x 24 px"));
}

}  // namespace
}  // namespace pfseq
