// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/sequence_views.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SequenceViewsTest : public testing::Test {
 protected:
  SequenceViewsTest() { sequence_.Write(folder_.Path()); }

  std::filesystem::path Clean(int frame) const {
    return ViewPath(folder_.Path(), lens_, camera_, Output::kClean, frame);
  }

  const TestSequence sequence_ = TestSequence::Yard(40);
  const std::string lens_ = sequence_.rig.lenses[0].name;
  const std::string camera_ = sequence_.rig.cameras[1].name;
  TempFolder folder_;
};

TEST_F(SequenceViewsTest, TellWhatTheFolderHas) {
  const SequenceViews views(folder_.Path());
  EXPECT_EQ(views.Name(), folder_.Path().filename().string());
  EXPECT_EQ(SequenceViews(folder_.Path() / "").Name().empty(), false);
  EXPECT_THAT(views.Variants(), ElementsAre("clean"));
  EXPECT_THAT(views.Frames(lens_, camera_, "clean"), ElementsAre(1, 3));
  EXPECT_THAT(views.Frames(lens_, camera_, "realistic"), ElementsAre());
  EXPECT_EQ(views.Cameras().size(), sequence_.rig.cameras.size());
  EXPECT_EQ(views.Lenses().size(), sequence_.rig.lenses.size());
}

TEST_F(SequenceViewsTest, RealisticFramesComeFirst) {
  const std::filesystem::path folder = folder_.Path() / lens_ / camera_ / "realistic";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(Clean(3), folder / "000003.png");
  std::filesystem::copy_file(Clean(3), folder / "notes.png");
  std::filesystem::copy_file(Clean(3), folder / "000002.txt");
  const SequenceViews views(folder_.Path());
  EXPECT_THAT(views.Variants(), ElementsAre("realistic", "clean"));
  // What is no number, or no picture, is no frame.
  EXPECT_THAT(views.Frames(lens_, camera_, "realistic"), ElementsAre(3));
}

TEST_F(SequenceViewsTest, ACameraStandsWhereTheRigAndThePoseSay) {
  const SequenceViews views(folder_.Path());
  const RigidTransform found = views.WorldFromCamera({camera_, 3});
  const RigidTransform expected =
      sequence_.poses[3].world_from_rig * sequence_.rig.cameras[1].rig_from_camera;
  EXPECT_LT((found.translation_m - expected.translation_m).norm(), 1e-6);
  EXPECT_LT(found.rotation.angularDistance(expected.rotation), 1e-6);
}

TEST_F(SequenceViewsTest, PicturesAndDistancesAreThoseOfTheView) {
  const SequenceViews views(folder_.Path());
  EXPECT_EQ(views.ReadImage(lens_, {camera_, 1}, "clean").WidthPx(), 40);
  EXPECT_EQ(views.ReadDistance(lens_, {camera_, 1}).HeightPx(), 40);
  const Image<uint8_t> first = views.ReadImage(lens_, {camera_, 1}, "clean");
  const Image<uint8_t> other = views.ReadImage(lens_, {camera_, 3}, "clean");
  EXPECT_FALSE(std::ranges::equal(first.Values(), other.Values()));
}

TEST_F(SequenceViewsTest, APictureOfAnotherSizeIsRefused) {
  const TempFolder other;
  TestSequence::Yard(30).Write(other.Path());
  std::filesystem::copy_file(ViewPath(other.Path(), lens_, camera_, Output::kClean, 1),
                             Clean(1),
                             std::filesystem::copy_options::overwrite_existing);
  const SequenceViews views(folder_.Path());
  EXPECT_THAT(MessageOf<InputError>([&] {
                views.ReadImage(lens_, {camera_, 1}, "clean");
              }),
              HasSubstr("expected 40 x 40 px"));
}

TEST_F(SequenceViewsTest, TheSceneIsThereWhenItsFileIs) {
  EXPECT_NE(SequenceViews(folder_.Path()).Scene(), nullptr);
  std::filesystem::remove(folder_.Path() / kSceneFile);
  EXPECT_EQ(SequenceViews(folder_.Path()).Scene(), nullptr);
}

TEST_F(SequenceViewsTest, AFolderOpensAsASequence) {
  EXPECT_THAT(OpenViews(folder_.Path())->Variants(), ElementsAre("clean"));
}

}  // namespace
}  // namespace pfseq
