// SPDX-License-Identifier: Apache-2.0
#include "renderer/record_renderer.h"

#include "tests/renderer/room.h"
#include "tests/support/temp_folder.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

constexpr int kWidthPx = 24;
constexpr int kHeightPx = 20;
constexpr uint64_t kNumPixels = kWidthPx * kHeightPx;

/// At rest at frame 0, then with 2 m/s2; a frame each second. Paths, so that no light is stored.
SequenceInput StartingRoom() {
  SequenceInput input = Room();
  input.spec.image.size_px = {kWidthPx, kHeightPx};
  input.spec.render.light = "path";
  input.spec.trajectory.drive.stop_s = 1.0;
  input.spec.trajectory.drive.acceleration_mps2 = 2.0;
  input.spec.trajectory.frame_rate_hz = 1.0;
  input.spec.shutter = {.exposure_s = 0.2, .ramp = 0.2, .offset_s = 0.05, .readout_s = 0.1};
  return input;
}

constexpr Record kResting{0, 1, 0};
constexpr Record kDriving{2, 1, 0};

/// A renderer of the rear camera, with all it needs.
struct Workshop {
  explicit Workshop(const SequenceInput& sequence)
      : input(sequence),
        studio(input, 1),
        options{.folder = folder / "s", .num_threads = 2, .quiet = true},
        writer(options.folder, input.files, OnExisting::kRefuse),
        renderer(studio, input.spec, writer, options) {}

  /// Paths of the frames' files that there are.
  std::set<std::string> Files() const {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(options.folder)) {
      const std::filesystem::path path = std::filesystem::relative(entry.path(), options.folder);
      if (FrameFile::FromRelativePath(path).has_value()) {
        files.insert(path.string());
      }
    }
    return files;
  }

  /// Whether rendering advances the progress by `amount` at least.
  bool AdvancesBy(uint64_t amount, const Record& record, const std::vector<Output>& outputs) const {
    testing::internal::CaptureStderr();
    {
      Progress progress("render", amount, false);
      renderer.Render(record, outputs, progress);
    }
    return testing::internal::GetCapturedStderr().find("render: done") != std::string::npos;
  }

  TempFolder folder;
  SequenceInput input;
  Studio studio;
  RenderOptions options;
  SequenceWriter writer;
  RecordRenderer renderer;
};

TEST(RecordRenderer, MissesWhatIsNotThere) {
  Workshop workshop(StartingRoom());
  workshop.options.outputs = {Output::kSky, Output::kClean, Output::kDistance};
  EXPECT_EQ(workshop.renderer.Missing(kResting), workshop.options.outputs);
  workshop.writer.WriteFrameFile(workshop.studio.FileOf(kResting, Output::kClean), Bytes{});
  EXPECT_EQ(workshop.renderer.Missing(kResting), (std::vector{Output::kSky, Output::kDistance}));
  // Another frame, camera or lens is another record.
  for (const Record& other : {kDriving, Record{0, 0, 0}, Record{0, 1, 1}}) {
    EXPECT_EQ(workshop.renderer.Missing(other), workshop.options.outputs);
  }
}

TEST(RecordRenderer, RendersTwiceOnlyWhereTheCameraMoves) {
  const Workshop workshop(StartingRoom());
  const auto num = [&](const Record& record, const std::vector<Output>& outputs) {
    return workshop.renderer.NumRenderings(record, outputs);
  };
  for (const Record& record : {kResting, kDriving}) {
    EXPECT_EQ(num(record, {}), 0);
    EXPECT_EQ(num(record, {Output::kDistance, Output::kSky, Output::kBlur, Output::kFlare}), 0);
    EXPECT_EQ(num(record, {Output::kClean}), 1);
    EXPECT_EQ(num(record, {Output::kSky, Output::kLinear}), 1);
    EXPECT_EQ(num(record, {Output::kLinear, Output::kClean}), 1);
    EXPECT_EQ(num(record, {Output::kRealistic}), 1);
    EXPECT_EQ(num(record, {Output::kRealisticLinear, Output::kRealisticJpeg}), 1);
  }
  for (const Output clean : {Output::kClean, Output::kLinear}) {
    for (const Output realistic :
         {Output::kRealistic, Output::kRealisticJpeg, Output::kRealisticLinear}) {
      EXPECT_EQ(num(kResting, {clean, realistic}), 1);
      EXPECT_EQ(num(kDriving, {realistic, clean}), 2);
    }
  }
}

TEST(RecordRenderer, LooksUpLightFromBothEndsOfTheExposure) {
  const Workshop workshop(StartingRoom());
  const auto places_m = [&](const Record& record, const std::vector<Output>& outputs) {
    std::vector<double> places;
    for (const RasterView& item : workshop.renderer.LitViews(record, outputs)) {
      EXPECT_EQ(item.raster, &workshop.studio.RasterOf(record));
      EXPECT_EQ(item.view.frame, static_cast<uint64_t>(record.frame));
      EXPECT_EQ(item.view.view_idx, workshop.studio.ViewOf(record).view_idx);
      places.push_back(item.view.world_from_camera.translation_m.x());
    }
    return places;
  };
  // A second after the start, 2 m behind the rig: x = t^2 - 2. The first line's shutter opens, and
  // the last one's closes, (0.2 * 1.2 + 0.1) / 2 before and after the middle of the exposure.
  const auto place_m = [](double time_s) { return time_s * time_s - 2.0; };
  const std::vector<double> all = places_m(kDriving, {Output::kRealistic});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NEAR(all[0], place_m(1.0), 1e-6);
  EXPECT_NEAR(all[1], place_m(1.0 + 0.05 - 0.17), 1e-6);
  EXPECT_NEAR(all[2], place_m(1.0 + 0.05 + 0.17), 1e-6);
  EXPECT_EQ(places_m(kDriving, {Output::kClean, Output::kRealisticLinear}), all);
  // A clean frame is exposed at once, a resting camera is where it is, and distances need no light.
  EXPECT_THAT(places_m(kDriving, {Output::kClean}), testing::ElementsAre(all[0]));
  EXPECT_THAT(places_m(kResting, {Output::kClean, Output::kRealistic}),
              testing::ElementsAre(testing::DoubleNear(-2.0, 1e-9)));
  EXPECT_THAT(places_m(kDriving, {Output::kDistance, Output::kFlare}), testing::IsEmpty());
}

TEST(RecordRenderer, WritesWhatIsAskedAndNothingElse) {
  const Workshop workshop(StartingRoom());
  Progress progress("render", 1, true);
  workshop.renderer.Render(kDriving, {}, progress);
  EXPECT_THAT(workshop.Files(), testing::IsEmpty());
  workshop.renderer.Render(kDriving, {Output::kSky, Output::kBlur}, progress);
  EXPECT_THAT(workshop.Files(),
              testing::ElementsAre("a/rear/blur/000002.exr", "a/rear/sky/000002.png"));
  workshop.renderer.Render(kDriving, {Output::kRealisticLinear}, progress);
  workshop.renderer.Render(kResting, {Output::kDistance, Output::kClean}, progress);
  EXPECT_THAT(workshop.Files(),
              testing::ElementsAre("a/rear/blur/000002.exr",
                                   "a/rear/clean/000000.png",
                                   "a/rear/distance/000000.exr",
                                   "a/rear/realistic_linear/000002.exr",
                                   "a/rear/sky/000002.png"));
}

TEST(RecordRenderer, ProgressIsThatOfTheRenderedPixels) {
  const Workshop workshop(StartingRoom());
  const std::vector<Output> both = {Output::kClean, Output::kRealistic};
  EXPECT_TRUE(workshop.AdvancesBy(kNumPixels, kResting, both));
  EXPECT_FALSE(workshop.AdvancesBy(kNumPixels + 1, kResting, both));
  EXPECT_TRUE(workshop.AdvancesBy(2 * kNumPixels, kDriving, both));
  EXPECT_FALSE(workshop.AdvancesBy(2 * kNumPixels + 1, kDriving, both));
  EXPECT_FALSE(workshop.AdvancesBy(1, kDriving, {Output::kSky, Output::kBlur, Output::kFlare}));
  SequenceInput input = StartingRoom();
  input.spec.render.light = "cached";
  Workshop cached(input);
  cached.studio.LoadLight({});
  EXPECT_TRUE(cached.AdvancesBy(kNumPixels, kResting, both));
  EXPECT_FALSE(cached.AdvancesBy(kNumPixels + 1, kResting, both));
}

TEST(RecordRenderer, BlurVectorsAreThoseOfTheRecord) {
  const Workshop workshop(StartingRoom());
  Progress progress("render", 1, true);
  workshop.renderer.Render(kDriving, {Output::kBlur}, progress);
  const FrameFile file = workshop.studio.FileOf(kDriving, Output::kBlur);
  const Image<float> vectors = ReadExr(workshop.options.folder / file.RelativePath());
  // 2 m/s for 0.2 s, 18.4 m below the ceiling, in the middle of the image.
  const Lens& lens = workshop.studio.RasterOf(kDriving).OwnLens();
  EXPECT_NEAR(vectors.At(kWidthPx / 2, kHeightPx / 2, 0),
              -lens.FocalPx().x() * 2.0 * 0.2 / 18.4,
              0.01 * lens.FocalPx().x() * 2.0 * 0.2 / 18.4);
  EXPECT_NEAR(vectors.At(kWidthPx / 2, kHeightPx / 2, 1), 0.0, 1e-3);
}

TEST(RecordRenderer, ARestingCamerasFramesAreTheSameAloneAndTogether) {
  SequenceInput input = StartingRoom();
  input.scene = BoxScene(Vec3f(-10, -6, 5), Vec3f(50, -2, 6));
  for (const double defocus_px : {0.0, 2.0}) {
    input.spec.optics.defocus_px = defocus_px;
    const Workshop together(input);
    const Workshop alone(input);
    Progress progress("render", 1, true);
    together.renderer.Render(kResting, {Output::kLinear, Output::kRealisticLinear}, progress);
    alone.renderer.Render(kResting, {Output::kLinear}, progress);
    alone.renderer.Render(kResting, {Output::kRealisticLinear}, progress);
    const auto picture = [](const Workshop& workshop, Output output) {
      return ReadExr(workshop.options.folder /
                     workshop.studio.FileOf(kResting, output).RelativePath());
    };
    const Image<float> clean = picture(alone, Output::kLinear);
    const Image<float> realistic = picture(alone, Output::kRealisticLinear);
    EXPECT_EQ(picture(together, Output::kLinear), clean);
    EXPECT_EQ(picture(together, Output::kRealisticLinear), realistic);
    EXPECT_EQ(clean == realistic, defocus_px == 0.0);
  }
}

}  // namespace
}  // namespace pfseq
