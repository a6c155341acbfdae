// SPDX-License-Identifier: Apache-2.0
// The file that keeps stored light.
#include "renderer/cached_light.h"

#include "renderer/cached_frame_renderer.h"
#include "renderer/core/file.h"
#include "tests/renderer/two_boxes.h"
#include "tests/support/temp_folder.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

class CachedLightTest : public testing::Test {
 protected:
  LightCacheOptions Options() const { return {.folder = folder_ / "cache"}; }

  /// Prepares and keeps the light of a view.
  void Keep(const View& view, const std::string& content_hash = "two boxes") const {
    const auto light = stage_.MakeCachedLight(Options(), content_hash);
    light->Prepare({{&stage_.Raster(), view}}, {}, 2, true);
  }

  /// Makes the light from the file and gives what it says.
  std::unique_ptr<CachedLight> Load(std::string* said,
                                    const std::string& content_hash = "two boxes") const {
    testing::internal::CaptureStderr();
    auto light = stage_.MakeCachedLight(Options(), content_hash);
    *said = testing::internal::GetCapturedStderr();
    return light;
  }

  std::vector<std::filesystem::path> Files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache")) {
      files.push_back(entry.path());
    }
    return files;
  }

  Image<float> Render(const CachedLight& light) const {
    return RenderCachedRadiance(light.Tracer(),
                                stage_.Raster(),
                                stage_.MakeView(),
                                {.num_samples = 2, .max_samples = 2},
                                2,
                                nullptr,
                                {});
  }

  TwoBoxesStage stage_;
  TempFolder folder_;
};

TEST_F(CachedLightTest, SecondRunFindsAllRecords) {
  const auto first = stage_.MakeCachedLight(Options());
  EXPECT_EQ(first->Store().NumRecords(), 0);
  first->Prepare({{&stage_.Raster(), stage_.MakeView()}}, {}, 2, true);
  EXPECT_GT(first->Store().NumRecords(), 500);
  ASSERT_EQ(Files().size(), 1U);

  std::string said;
  const auto second = Load(&said);
  EXPECT_EQ(said, "");
  EXPECT_EQ(second->Store().NumRecords(), first->Store().NumRecords());
  EXPECT_TRUE(second->Store().Serialize() == first->Store().Serialize());
  EXPECT_EQ(Render(*second), Render(*first));
  EXPECT_EQ(Render(*second), Render(*stage_.MakeCachedLight()));
}

TEST_F(CachedLightTest, WithoutAFolderNothingIsWritten) {
  const auto light = stage_.MakeCachedLight({});
  light->Prepare({{&stage_.Raster(), stage_.MakeView()}}, {}, 2, true);
  light->Save();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.Path()));
}

TEST_F(CachedLightTest, DamageIsToldOfAndMadeGood) {
  Keep(stage_.MakeView());
  ASSERT_EQ(Files().size(), 1U);
  const std::filesystem::path path = Files().front();
  const std::string sound = ReadFile(path);
  const size_t start = sound.find('\n', sound.find('\n', sound.find('\n') + 1) + 1) + 1;
  ASSERT_GT(sound.size(), start + 1000);
  std::string flipped = sound;
  flipped[start + 600] = static_cast<char>(flipped[start + 600] ^ 1);
  std::string wrong_checksum = sound;
  wrong_checksum[start - 5] = wrong_checksum[start - 5] == '0' ? '1' : '0';
  for (const std::string& damaged : {flipped,
                                     wrong_checksum,
                                     sound + "x",
                                     sound.substr(0, sound.size() / 2),
                                     sound.substr(0, start)}) {
    WriteFileAtomically(path, damaged);
    std::string said;
    const auto light = Load(&said);
    EXPECT_THAT(said, HasSubstr(path.string() + ": is damaged"));
    EXPECT_EQ(light->Store().NumRecords(), 0);
  }
  WriteFileAtomically(path, std::string_view());
  std::string said;
  EXPECT_EQ(Load(&said)->Store().NumRecords(), 0);
  EXPECT_THAT(said, HasSubstr(path.string()));

  testing::internal::CaptureStderr();
  Keep(stage_.MakeView());
  testing::internal::GetCapturedStderr();
  EXPECT_TRUE(ReadFile(path) == sound);
}

TEST_F(CachedLightTest, FileOfAnotherKeyIsToldOf) {
  Keep(stage_.MakeView());
  const std::filesystem::path path = Files().front();
  Keep(stage_.MakeView(), "other light");
  for (const std::filesystem::path& file : Files()) {
    if (file != path) {
      std::filesystem::copy_file(path, file, std::filesystem::copy_options::overwrite_existing);
    }
  }
  std::string said;
  const auto other = Load(&said, "other light");
  EXPECT_THAT(said, HasSubstr("belongs to another scene or version"));
  EXPECT_EQ(other->Store().NumRecords(), 0);
  EXPECT_GT(Load(&said)->Store().NumRecords(), 0);
  EXPECT_EQ(said, "");
}

TEST_F(CachedLightTest, WhatTheLightDependsOnMakesAFileOfItsOwn) {
  size_t num_files = 0;
  const auto expect_new_file = [&](const RenderSpec& spec, const std::string& content_hash) {
    const auto light = stage_.MakeCachedLight(Options(), content_hash, spec);
    EXPECT_EQ(light->Store().NumRecords(), 0);
    light->Prepare({{&stage_.Raster(), stage_.MakeView()}}, {}, 2, true);
    EXPECT_EQ(Files().size(), ++num_files);
  };
  RenderSpec spec = CoarseLightSpec();
  spec.light_quality = 0.2;
  expect_new_file(spec, "a");
  expect_new_file(spec, "b");
  spec.max_bounces = 3;
  expect_new_file(spec, "a");
  spec.min_indirect_roughness = 0.5;
  expect_new_file(spec, "a");
  spec.light_quality = 0.25;
  expect_new_file(spec, "a");
  // What the light does not depend on finds it.
  spec.seed = 7;
  spec.samples = 3;
  spec.max_samples = 5;
  EXPECT_GT(stage_.MakeCachedLight(Options(), "a", spec)->Store().NumRecords(), 0);
}

TEST_F(CachedLightTest, RunsOfOtherFramesAddUp) {
  const View first = stage_.MakeView();
  const View second = stage_.MakeView(1, Vec3d(2.0, 1.0, 3.0));
  // The second starts before the first has kept anything.
  const auto other = stage_.MakeCachedLight(Options());
  Keep(first);
  std::string said;
  const int64_t num_first = Load(&said)->Store().NumRecords();
  other->Prepare({{&stage_.Raster(), second}}, {}, 2, true);
  const auto both = Load(&said);
  EXPECT_EQ(said, "");
  EXPECT_GT(both->Store().NumRecords(), num_first);
  EXPECT_TRUE(WantedRecords(both->Tracer(), stage_.Raster(), first, PixelSampling(), 1).empty());
  EXPECT_TRUE(WantedRecords(both->Tracer(), stage_.Raster(), second, PixelSampling(), 1).empty());
}

TEST_F(CachedLightTest, KeepsWhatRenderingAddsWhenSaved) {
  Keep(stage_.MakeView(1, Vec3d(2.0, 1.0, 3.0)));
  std::string said;
  const auto light = Load(&said);
  const int64_t num_prepared = light->Store().NumRecords();
  Render(*light);
  EXPECT_GT(light->Store().NumRecords(), num_prepared);
  EXPECT_EQ(Load(&said)->Store().NumRecords(), num_prepared);
  light->Save();
  EXPECT_EQ(Load(&said)->Store().NumRecords(), light->Store().NumRecords());
  EXPECT_THAT(light->Summary(), HasSubstr("kept in " + (folder_ / "cache").string()));
}

}  // namespace
}  // namespace pfseq
