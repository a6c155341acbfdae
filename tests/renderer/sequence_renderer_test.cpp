// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence_renderer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/lens/trajectory_file.h"
#include "renderer/lit_scene.h"
#include "renderer/sequence/manifest.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_reader.h"
#include "tests/renderer/room.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

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

TEST(RenderSequence, TakesAgreedOutputsFromASibling) {
  const TempFolder folder;
  SequenceInput input = RealisticRoom();
  RenderOptions options{.folder = folder / "first", .frames = {0}, .quiet = true};
  RenderSequence(input, options);
  input.spec.shutter.exposure_s = 0.5;
  options.folder = folder / "alone";
  RenderSequence(input, options);
  options.folder = folder / "second";
  options.sibling = folder / "first";
  options.sibling_outputs = {Output::kClean, Output::kDistance, Output::kSky};
  const RenderSummary summary = RenderSequence(input, options);
  EXPECT_TRUE(summary.is_complete);
  EXPECT_EQ(summary.num_files_written, 4);  // The realistic ones.
  EXPECT_EQ(summary.num_files_kept, 12);
  for (const char* file : {"scene.glb", "a/front/distance/000000.exr", "b/rear/clean/000000.png"}) {
    EXPECT_EQ(std::filesystem::hard_link_count(folder / "second" / file), 2U) << file;
  }
  // As if it had no sibling.
  const std::map<std::string, Manifest::Entry> expected = Manifest::Read(folder / "alone").files;
  for (const auto& [name, entry] : Manifest::Read(folder / "second").files) {
    EXPECT_EQ(entry.sha256, expected.at(name).sha256) << name;
  }
}

TEST(RenderSequence, SharesALitScene) {
  const TempFolder folder;
  SequenceInput input = RealisticRoom();
  input.lit_scene = std::make_shared<LitScene>(input);
  for (const double exposure_s : {0.0, 0.5}) {
    input.spec.shutter.exposure_s = exposure_s;
    SequenceInput alone = input;
    alone.lit_scene = nullptr;
    RenderOptions options{.folder = folder / "shared", .frames = {1}, .quiet = true};
    options.on_existing = OnExisting::kOverwrite;
    RenderSequence(input, options);
    options.folder = folder / "alone";
    RenderSequence(alone, options);
    const std::filesystem::path picture = "a/front/realistic/000001.png";
    EXPECT_EQ(ReadFile(folder / "shared" / picture), ReadFile(folder / "alone" / picture));
  }
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

const std::vector<Output> kAllButJpeg = {Output::kRealistic,
                                         Output::kClean,
                                         Output::kLinear,
                                         Output::kDistance,
                                         Output::kSky,
                                         Output::kBlur,
                                         Output::kRealisticLinear,
                                         Output::kFlare};

TEST(RenderSequence, RealisticFramesAreMadeWhereTheCameraHasFaults) {
  const TempFolder folder;
  RenderOptions options{.folder = folder / "s", .frames = {1}, .cameras = {"front"}, .quiet = true};
  RenderSequence(RealisticRoom(), options);
  for (const char* file : {"a/front/realistic/000001.png", "b/front/realistic/000001.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "s" / file)) << file;
  }
  options.folder = folder / "jpeg";
  SequenceInput input = RealisticRoom();
  input.spec.sensor.jpeg_quality = 80;
  RenderSequence(input, options);
  const std::string jpeg = ReadFile(folder / "jpeg/a/front/realistic/000001.jpg");
  EXPECT_EQ(jpeg.substr(0, 2), "\xff\xd8");
  EXPECT_FALSE(std::filesystem::exists(folder / "jpeg/a/front/realistic/000001.png"));
}

TEST(RenderSequence, RealisticFramesHaveTheSameBytesForThreadsAndShards) {
  const TempFolder folder;
  RenderOptions options{.folder = folder / "one",
                        .frames = {0, 2},
                        .cameras = {"rear"},
                        .outputs = kAllButJpeg,
                        .quiet = true};
  RenderSequence(RealisticRoom(), options);
  options.folder = folder / "shards";
  options.on_existing = OnExisting::kResume;
  options.num_threads = 3;
  options.num_shards = 2;
  for (const int shard_idx : {1, 0}) {
    options.shard_idx = shard_idx;
    RenderSequence(RealisticRoom(), options);
  }
  EXPECT_EQ(ReadFile(folder / "one/manifest.json"), ReadFile(folder / "shards/manifest.json"));
  // And when the clean frame, with which they may share samples, is there already.
  for (const std::string lens : {"a", "b"}) {
    for (const std::string frame : {"000000.png", "000002.png"}) {
      std::filesystem::remove(folder / "one" / lens / "rear/realistic" / frame);
    }
  }
  options.folder = folder / "one";
  options.num_shards = 1;
  options.shard_idx = 0;
  RenderSequence(RealisticRoom(), options);
  EXPECT_EQ(ReadFile(folder / "one/manifest.json"), ReadFile(folder / "shards/manifest.json"));
}

TEST(RenderSequence, TheCamerasFaultsLeaveCleanFramesAndGroundTruthAlone) {
  const TempFolder folder;
  RenderOptions options{.folder = folder / "on",
                        .frames = {1},
                        .cameras = {"front"},
                        .lenses = {"b"},
                        .outputs = kAllButJpeg,
                        .quiet = true};
  RenderSequence(RealisticRoom(), options);
  SequenceInput without = RealisticRoom();
  without.spec.shutter = {};
  without.spec.optics = {};
  without.spec.sensor.white_electrons = 0.0;
  options.folder = folder / "off";
  RenderSequence(without, options);
  const auto same = [&](const std::string& file) {
    return ReadFile(folder / "on/b/front" / file) == ReadFile(folder / "off/b/front" / file);
  };
  EXPECT_TRUE(same("clean/000001.png"));
  EXPECT_TRUE(same("linear/000001.exr"));
  EXPECT_TRUE(same("distance/000001.exr"));
  EXPECT_TRUE(same("sky/000001.png"));
  EXPECT_FALSE(same("realistic/000001.png"));
  EXPECT_FALSE(same("blur/000001.exr"));
  EXPECT_FALSE(same("flare/000001.exr"));
  // With every effect off, realistic is clean to the last bit.
  EXPECT_EQ(ReadFile(folder / "off/b/front/realistic/000001.png"),
            ReadFile(folder / "off/b/front/clean/000001.png"));
  EXPECT_FALSE(same("realistic_linear/000001.exr"));
  EXPECT_EQ(ReadFile(folder / "off/b/front/realistic_linear/000001.exr"),
            ReadFile(folder / "off/b/front/linear/000001.exr"));
}

TEST(RenderSequence, TellsWhereTheCamerasAreWhenTheShutterOpensAndCloses) {
  const TempFolder folder;
  SequenceInput input = RealisticRoom();
  input.spec.shutter = {.exposure_s = 0.02, .offset_s = 0.005};
  RenderOptions options{.folder = folder / "s", .outputs = {Output::kSky}, .quiet = true};
  RenderSequence(input, options);
  const std::vector<StampedPose> middle = ReadTum(folder / "s/trajectory_rear.txt");
  const std::vector<StampedPose> ends = ReadTum(folder / "s/exposure_rear.txt");
  ASSERT_EQ(ends.size(), 2 * middle.size());
  const std::unique_ptr<Trajectory> trajectory = MakeTrajectory(input.spec.trajectory);
  const RigidTransform rig_from_camera = MakeCameras(input.spec)[1].rig_from_camera;
  for (size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR(ends[i].time_s - middle[i / 2].time_s, i % 2 == 0 ? -0.005 : 0.015, 1e-9);
    const RigidTransform expected = trajectory->WorldFromRig(ends[i].time_s) * rig_from_camera;
    EXPECT_LT((ends[i].world_from_rig.translation_m - expected.translation_m).norm(), 1e-6);
    EXPECT_LT(ends[i].world_from_rig.rotation.angularDistance(expected.rotation), 1e-6);
  }
  // Without an exposure there is nothing to tell.
  input.spec.shutter = {};
  options.folder = folder / "still";
  RenderSequence(input, options);
  EXPECT_FALSE(std::filesystem::exists(folder / "still/exposure_rear.txt"));
}

TEST(MakeRigFile, HasTheImageHeightsOfTheChannels) {
  SequenceInput input = RealisticRoom();
  const RigFile rig = MakeRigFile(input.spec);
  ASSERT_EQ(rig.channel_polynomials.size(), 2U);
  // Red falls outside green and blue inside, half of it linear: c1 = c3 R^2, R = 12 px.
  const auto& [red, green, blue] = rig.channel_polynomials[0];
  EXPECT_GT(red[0], green[0]);
  EXPECT_GT(green[0], blue[0]);
  EXPECT_NEAR(red[1] * 144.0, red[0], 1e-9);
  EXPECT_THAT(rig.ToYaml(), HasSubstr("    lateral_color:\n      red: ["));
  EXPECT_TRUE(MakeRigFile(Room().spec).channel_polynomials.empty());
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
