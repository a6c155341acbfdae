// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/pairs.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <map>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Views that there are by name only.
class NamedViews : public ViewSource {
 public:
  std::string Name() const override { return "views"; }
  std::vector<std::string> Cameras() const override { return cameras; }
  std::vector<std::string> Lenses() const override { return {"wide", "narrow"}; }
  const Lens& LensOf(const std::string& name) const override {
    if (name != "wide" && name != "narrow") {
      throw InputError("no lens {}", name);
    }
    return lens_;
  }
  RigidTransform WorldFromCamera(const ViewName& view) const override {
    if (view == without_pose) {
      throw InputError("no pose of frame {}", view.frame);
    }
    return {};
  }
  std::vector<std::string> Variants() const override { return variants; }
  std::vector<int> Frames(const std::string& lens,
                          const std::string& camera,
                          const std::string& variant) const override {
    const auto found = frames.find({lens, camera, variant});
    return found != frames.end() ? found->second : std::vector<int>();
  }
  Image<uint8_t> ReadImage(const std::string&, const ViewName&, const std::string&) const override {
    return {};
  }
  Image<float> ReadDistance(const std::string&, const ViewName&) const override { return {}; }
  std::shared_ptr<const RayScene> Scene() const override { return nullptr; }
  double MaxDistanceM() const override { return 100.0; }

  std::vector<std::string> cameras = {"left", "right", "back"};
  std::vector<std::string> variants = {"realistic", "clean"};
  /// By lens, camera and variant.
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<int>> frames = {
      {{"wide", "left", "clean"}, {0, 1, 2, 4, 6}},
      {{"wide", "right", "clean"}, {1, 2, 3, 4, 5}},
      {{"wide", "back", "clean"}, {2, 9}},
      {{"wide", "left", "realistic"}, {0}}};
  ViewName without_pose;

 private:
  Lens lens_ = Lens(Equidistant{}, {100, 100}, {150, 150}, 1.5);
};

TEST(FramesOfPairs, AreAllThatAreNamedAscending) {
  EXPECT_THAT(FramesOfPairs("24"), ElementsAre(24));
  EXPECT_THAT(FramesOfPairs("8:10"), ElementsAre(8, 9));
  EXPECT_THAT(FramesOfPairs("0:64:16"), ElementsAre(0, 16, 32, 48));
  EXPECT_THAT(FramesOfPairs("0:65:16"), ElementsAre(0, 16, 32, 48, 64));
  EXPECT_THAT(FramesOfPairs("left:7-right:2"), ElementsAre(2, 7));
  EXPECT_THAT(FramesOfPairs("5,left:7-left:1,0:6:5,1000000"), ElementsAre(0, 1, 5, 7, 1000000));
}

TEST(FramesOfPairs, RefusesOtherFormsAndTellsWhichPart) {
  for (const char* item : {"",
                           "x",
                           " 1",
                           "1.5",
                           "-1",
                           "1:",
                           "3:3",
                           "3:1",
                           "0:4:0",
                           "0:4:1:1",
                           "1000001",
                           "1-2",
                           "left:1-right",
                           ":1-right:2",
                           "left:1-right:-2",
                           "left:1-right:2-back:3"}) {
    EXPECT_THAT(MessageOf<InputError>([&] { FramesOfPairs(fmt::format("5,{}", item)); }),
                HasSubstr(fmt::format("--pairs {}: expected FRAME", item)))
        << item;
  }
}

TEST(ChooseVariant, TakesTheBestUnlessAskedForAnother) {
  NamedViews views;
  EXPECT_EQ(ChooseVariant(views, ""), "realistic");
  EXPECT_EQ(ChooseVariant(views, "clean"), "clean");
  EXPECT_THAT(MessageOf<InputError>([&] { ChooseVariant(views, "noisy"); }),
              HasSubstr("--variant noisy: views has realistic and clean images only"));
  views.variants.clear();
  EXPECT_THAT(MessageOf<InputError>([&] { ChooseVariant(views, ""); }),
              HasSubstr("views: expected realistic or clean images, got none"));
}

class ChoosePairsTest : public testing::Test {
 protected:
  /// "wide left:0 right:0 (0)": lens, views, label.
  std::vector<std::string> Pairs(const std::string& pairs = "") {
    options_.pairs = pairs;
    std::vector<std::string> texts;
    for (const PairOfViews& pair : ChoosePairs(views_, "clean", options_)) {
      texts.push_back(fmt::format("{} {}:{} {}:{} ({})",
                                  pair.lens,
                                  pair.first.camera,
                                  pair.first.frame,
                                  pair.second.camera,
                                  pair.second.frame,
                                  pair.label));
    }
    return texts;
  }
  std::string Refusal(const std::string& pairs = "") {
    return MessageOf<InputError>([&] { Pairs(pairs); });
  }

  NamedViews views_;
  BenchmarkOptions options_;
};

TEST_F(ChoosePairsTest, AreOfFramesThatTheFirstTwoCamerasHave) {
  EXPECT_THAT(
      Pairs(),
      ElementsAre("wide left:1 right:1 (1)", "wide left:2 right:2 (2)", "wide left:4 right:4 (4)"));
}

TEST_F(ChoosePairsTest, ComeLensByLensWhereThereAreImages) {
  views_.frames[{"narrow", "left", "clean"}] = {2};
  views_.frames[{"narrow", "right", "clean"}] = {2};
  EXPECT_THAT(Pairs("2"), ElementsAre("wide left:2 right:2 (2)", "narrow left:2 right:2 (2)"));
  options_.lenses = {"narrow", "wide"};
  EXPECT_THAT(Pairs("2"), ElementsAre("narrow left:2 right:2 (2)", "wide left:2 right:2 (2)"));
  options_.lenses = {"narrow"};
  EXPECT_THAT(Pairs(), ElementsAre("narrow left:2 right:2 (2)"));
  views_.frames.erase({"narrow", "right", "clean"});
  EXPECT_THAT(Refusal(), HasSubstr("views: no pair of clean images"));
  EXPECT_THAT(Refusal("2"),
              HasSubstr("views: narrow: frame 2: expected a clean image of camera "
                        "'right'"));
  options_.lenses = {"long"};
  EXPECT_THAT(Refusal(), HasSubstr("no lens long"));
}

TEST_F(ChoosePairsTest, AreOfTheCamerasAskedForInTheirOrder) {
  options_.cameras = {"back", "left"};
  EXPECT_THAT(Pairs(), ElementsAre("wide back:2 left:2 (2)"));
  EXPECT_THAT(Pairs("2"), ElementsAre("wide back:2 left:2 (2)"));
  options_.cameras = {"back", "top"};
  EXPECT_THAT(Refusal(), HasSubstr("camera 'top': the sequence has left, right, back"));
  options_.cameras = {"back", "back"};
  EXPECT_THAT(Refusal(), HasSubstr("two different ones, got 'back' twice"));
  options_.cameras = {"back", ""};
  EXPECT_THAT(Refusal(), HasSubstr("camera ''"));
  options_.cameras = {};
  views_.cameras = {"left"};
  EXPECT_THAT(Refusal(), HasSubstr("a pair needs two cameras, got 1; see --successive"));
}

TEST_F(ChoosePairsTest, SuccessiveOnesAreOfEachCameraAndSoManyFramesApart) {
  options_.successive = 2;
  EXPECT_THAT(Pairs(),
              ElementsAre("wide left:0 left:2 (left:0-left:2)",
                          "wide left:2 left:4 (left:2-left:4)",
                          "wide left:4 left:6 (left:4-left:6)",
                          "wide right:1 right:3 (right:1-right:3)",
                          "wide right:2 right:4 (right:2-right:4)",
                          "wide right:3 right:5 (right:3-right:5)"));
  views_.cameras = {"back"};
  options_.successive = 7;
  EXPECT_THAT(Pairs(), ElementsAre("wide back:2 back:9 (back:2-back:9)"));
}

TEST_F(ChoosePairsTest, KeepTheOrderOfTheirNamesAndComeOnce) {
  EXPECT_THAT(Pairs("4,left:6-back:9,1:5:3,left:1-right:1"),
              ElementsAre("wide left:4 right:4 (4)",
                          "wide left:6 back:9 (left:6-back:9)",
                          "wide left:1 right:1 (1)"));
  // There and back are two.
  EXPECT_THAT(
      Pairs("left:1-right:2,right:2-left:1"),
      ElementsAre("wide left:1 right:2 (left:1-right:2)", "wide right:2 left:1 (right:2-left:1)"));
}

TEST_F(ChoosePairsTest, NeedAnImageAndAPoseOfBothViews) {
  EXPECT_THAT(Refusal("4,6"), HasSubstr("frame 6: expected a clean image of camera 'right'"));
  EXPECT_THAT(Refusal("left:3-right:3"),
              HasSubstr("frame 3: expected a clean image of camera 'left'"));
  EXPECT_THAT(Refusal("left:1-top:1"), HasSubstr("of camera 'top'"));
  for (const char* camera : {"left", "right"}) {
    views_.without_pose = {camera, 4};
    EXPECT_EQ(Pairs("1,2").size(), 2U);
    EXPECT_EQ(Refusal("4"), "no pose of frame 4") << camera;
  }
}

}  // namespace
}  // namespace pfseq
