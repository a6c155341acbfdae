// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/dataset_views.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/sequence_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"
#include "validator/benchmark/benchmark.h"
#include "validator/benchmark/results_writer.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

/// A yard's files, described as if they came from elsewhere.
class Dataset : public testing::Test {
 protected:
  Dataset() {
    sequence_ = TestSequence::Yard(300);
    sequence_.rig.lenses.erase(sequence_.rig.lenses.begin());  // equisolid is left.
    sequence_.frames = {1, 3};
    sequence_.Write(folder_.Path());
    const Lens& lens = sequence_.rig.lenses[0].value;
    Write("lens.yaml",
          fmt::format("model: {}\nfov_deg: {}\nfocal_px: {}\nprincipal_point_px: [{}, {}]\n"
                      "image_width_px: 300\n",
                      lens.ModelName(),
                      2.0 * lens.MaxAngleRad() * 180.0 / M_PI,
                      lens.FocalPx().x(),
                      lens.PrincipalPointPx().x(),
                      lens.PrincipalPointPx().y()));
  }

  void Write(const char* name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
  }

  std::string Describe(const std::string& more = "") const {
    std::string text = "lenses: {equisolid: lens.yaml}\nimage_size_px: 300\nscene: scene.glb\n" +
                       more + "cameras:\n";
    for (const char* camera : {"front", "rear"}) {
      text += fmt::format(
          "  {0}:\n    images: {{clean: \"{{lens}}/{0}/clean/{{frame:06}}.png\"}}\n"
          "    distances: \"equisolid/{0}/distance/*.exr\"\n    poses: trajectory_{0}.txt\n",
          camera);
    }
    return text;
  }

  std::string ResultsOf(const std::filesystem::path& path, Judge judge) const {
    BenchmarkOptions options;
    options.quiet = true;
    options.judge = judge;
    options.pairs = "1";
    options.lenses = {"equisolid"};
    const TempFolder out;
    WriteResults(RunBenchmark(*OpenViews(path),
                              Grid::FromNames({"SIFT nopol 0.02 10.0 1.6 SIFT BruteForce"}),
                              options),
                 out.Path());
    return ReadFile(out / "results.csv");
  }

  TempFolder folder_;
  TestSequence sequence_;
};

TEST_F(Dataset, IsJudgedAsTheSequenceItself) {
  Write("set.yaml", Describe());
  EXPECT_EQ(ResultsOf(folder_ / "set.yaml", Judge::kRay), ResultsOf(folder_.Path(), Judge::kRay));
}

TEST_F(Dataset, GlobsCountFilesFromZero) {
  Write("set.yaml", Describe());
  const DatasetViews views(folder_ / "set.yaml");
  EXPECT_THAT(views.Frames("equisolid", "front", "clean"), testing::ElementsAre(1, 3));
  // The maps of frames 1 and 3 are the first and second file.
  const Image<float> first = views.ReadDistance("equisolid", {"front", 0});
  const Image<float> own = SequenceReader(folder_.Path()).ReadDistance("equisolid", "front", 1);
  EXPECT_EQ(first.At(150, 100), own.At(150, 100));
  EXPECT_THROW(views.ReadDistance("equisolid", {"front", 2}), InputError);
}

TEST_F(Dataset, DepthScaleAndAxesAreConverted) {
  Write("plain.yaml", Describe());
  Write("depth.yaml", Describe("distance: {kind: depth, scale_m: 2}\naxes: opengl\n"));
  const DatasetViews plain(folder_ / "plain.yaml"), depth(folder_ / "depth.yaml");
  const Image<float> distance_m = plain.ReadDistance("equisolid", {"front", 0});
  const Image<float> from_depth_m = depth.ReadDistance("equisolid", {"front", 0});
  int num_compared = 0;
  for (int x = 40; x < 260; ++x) {
    const Vec3d direction = *plain.LensOf("equisolid").Unproject({x + 0.5, 120.5});
    const double expected_m = 2.0 * distance_m.At(x, 120) / direction.z();
    if (std::isfinite(distance_m.At(x, 120)) && expected_m < 499.0) {
      ++num_compared;
      EXPECT_NEAR(from_depth_m.At(x, 120), expected_m, 1e-4 * expected_m);
    }
  }
  EXPECT_GT(num_compared, 20);
  // OpenGL's camera looks along -z with y up.
  const RigidTransform opencv = plain.WorldFromCamera({"rear", 1});
  const RigidTransform opengl = depth.WorldFromCamera({"rear", 1});
  EXPECT_LT((opengl.Direction(Vec3d::UnitZ()) + opencv.Direction(Vec3d::UnitZ())).norm(), 1e-9);
  EXPECT_LT((opengl.Direction(Vec3d::UnitX()) - opencv.Direction(Vec3d::UnitX())).norm(), 1e-9);
}

TEST_F(Dataset, FaultsAreToldWithTheirPlace) {
  const auto refusal = [&](const std::string& text) {
    Write("bad.yaml", text);
    return MessageOf<InputError>([&] { DatasetViews{folder_ / "bad.yaml"}; });
  };
  EXPECT_THAT(refusal("image_size_px: 300\n"), HasSubstr("lenses: missing"));
  EXPECT_THAT(refusal(Describe("axis: opencv\n")), HasSubstr("axes"));
  EXPECT_THAT(refusal(Describe("axes: blender\n")), HasSubstr("opengl"));
  EXPECT_THAT(refusal("lenses: {a: lens.yaml}\nimage_size_px: 300\ncameras: {a: {images: x}}\n"),
              HasSubstr("poses"));
}

}  // namespace
}  // namespace pfseq
