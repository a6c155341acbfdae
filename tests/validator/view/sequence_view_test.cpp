// SPDX-License-Identifier: Apache-2.0
#include "validator/view/sequence_view.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"
#include "validator/false_color.h"
#include "validator/view/view_server.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using testing::HasSubstr;

class SequenceViewTest : public testing::Test {
 protected:
  SequenceViewTest() { TestSequence::Yard(64).Write(folder_.Path()); }

  ViewRequest Request(const std::string& channel = "clean") const {
    const SequenceReader reader(folder_.Path());
    return {reader.Lenses()[0], reader.Cameras()[0], channel, 1};
  }

  TempFolder folder_;
};

Vec3d Vector(const nlohmann::json& json) {
  return Vec3d(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

TEST_F(SequenceViewTest, PixelsHaveTheNumbersOfTheFiles) {
  const SequenceReader reader(folder_.Path());
  const SequenceView view(folder_.Path());
  const ViewRequest request = Request();
  const Image<float> map_m = reader.ReadDistance(request.lens, request.camera, 1);
  int num_finite = 0, num_sky = 0, num_outside = 0, num_visible = 0;
  for (int y = 0; y < 64; y += 3) {
    for (int x = 0; x < 64; x += 3) {
      const nlohmann::json pixel = view.Pixel(request, x, y);
      const float expected_m = map_m.At(x, y);
      EXPECT_EQ(pixel["sky"], std::isinf(expected_m));
      if (expected_m == 0.0F) {
        EXPECT_TRUE(pixel["distance_m"].is_null());
        num_outside += pixel["in_circle"] ? 0 : 1;
      } else if (std::isinf(expected_m)) {
        EXPECT_TRUE(pixel["point_world_m"].is_null());
        ++num_sky;
      } else {
        ++num_finite;
        EXPECT_EQ(pixel["distance_m"].get<float>(), expected_m);
        // The point lies on the ray, as far from the camera as the map says, and shows in the
        // pixel.
        const RigidTransform world_from_camera = reader.WorldFromCamera(request.camera, 1);
        const Vec3d point_m = world_from_camera.Inverse().Point(Vector(pixel["point_world_m"]));
        EXPECT_NEAR(point_m.norm(), expected_m, 1e-6 * expected_m);
        const Vec2d back_px = reader.LensOf(request.lens).Project(point_m).value();
        EXPECT_NEAR(back_px.x(), x + 0.5, 1e-6);
        EXPECT_NEAR(back_px.y(), y + 0.5, 1e-6);
        EXPECT_NEAR(Vector(pixel["direction_world"])
                        .dot(world_from_camera.Direction(Vector(pixel["direction_camera"]))),
                    1.0,
                    1e-9);
        num_visible += pixel["others"][0]["is_visible"] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(num_finite, 50);
  EXPECT_GT(num_sky, 10);
  EXPECT_GT(num_outside, 10);
  EXPECT_GT(num_visible, num_finite / 2);
}

TEST_F(SequenceViewTest, OtherCamerasSeeThePointWhereTheirLensPutsIt) {
  const SequenceReader reader(folder_.Path());
  const SequenceView view(folder_.Path());
  const ViewRequest request = Request();
  int num_seen = 0;
  for (int i = 0; i < 64; i += 2) {
    const nlohmann::json pixel = view.Pixel(request, i, 40);
    if (!pixel["point_world_m"].is_null() && !pixel["others"][0]["x_px"].is_null()) {
      const nlohmann::json other = pixel["others"][0];
      const RigidTransform world_from_other =
          reader.WorldFromCamera(other["camera"].get<std::string>(), 1);
      const Vec3d ray =
          reader.LensOf(request.lens)
              .Unproject(Vec2d(other["x_px"].get<double>(), other["y_px"].get<double>()))
              .value();
      const Vec3d back_m = world_from_other.Point(other["distance_m"].get<double>() * ray);
      EXPECT_LT((back_m - Vector(pixel["point_world_m"])).norm(), 1e-6);
      ++num_seen;
    }
  }
  EXPECT_GT(num_seen, 5);
}

TEST_F(SequenceViewTest, PicturesAreTheFilesAndDistancesAreInColour) {
  const SequenceView view(folder_.Path());
  const ViewRequest clean = Request(), distance = Request("distance");
  const std::string file =
      ReadFile(ViewPath(folder_.Path(), clean.lens, clean.camera, Output::kClean, 1));
  const Bytes picture = view.Picture(clean);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(picture.data()), picture.size()), file);
  EXPECT_EQ(view.Picture(distance),
            EncodePng(DistanceInColor(
                SequenceReader(folder_.Path()).ReadDistance(distance.lens, distance.camera, 1))));
}

TEST_F(SequenceViewTest, TellsWhatThereIs) {
  const nlohmann::json description = SequenceView(folder_.Path()).Description();
  EXPECT_EQ(description["lenses"][0]["frames"], nlohmann::json({1, 3}));
  EXPECT_EQ(description["lenses"][0]["channels"], nlohmann::json({"clean", "distance", "sky"}));
  EXPECT_EQ(description["width_px"], 64);
}

TEST_F(SequenceViewTest, RefusesNamesThatItDoesNotHave) {
  const SequenceView view(folder_.Path());
  const auto with = [&](auto change) {
    ViewRequest request = Request();
    change(request);
    return MessageOf<InputError>([&] { view.Picture(request); });
  };
  EXPECT_THAT(with([](ViewRequest& request) { request.lens = "../.."; }), HasSubstr("../.."));
  EXPECT_THAT(with([](ViewRequest& request) { request.camera = "../rear"; }), HasSubstr("../rear"));
  EXPECT_THAT(with([](ViewRequest& request) { request.channel = "../clean"; }),
              HasSubstr("../clean"));
  EXPECT_THAT(with([](ViewRequest& request) { request.frame = 99; }), HasSubstr("frame 99"));
  EXPECT_THAT(with([](ViewRequest& request) { request.frame = 2; }),
              HasSubstr("000002"));  // No file.
  EXPECT_THAT(MessageOf<InputError>([&] { view.Pixel(Request(), 64, 0); }), HasSubstr("(64, 0)"));
}

TEST(ViewServer, OnlyAnswersToItsOwnNames) {
  EXPECT_TRUE(IsOwnHost("127.0.0.1:8047", 8047));
  EXPECT_TRUE(IsOwnHost("localhost:8047", 8047));
  for (const char* host : {"",
                           "127.0.0.1",
                           "127.0.0.1:80",
                           "evil.example:8047",
                           "127.0.0.1:8047.evil.example",
                           "0.0.0.0:8047"}) {
    EXPECT_FALSE(IsOwnHost(host, 8047)) << host;
  }
}

TEST(FalseColor, NearIsDarkFarIsLightSkyIsGrey) {
  Image<float> map_m(4, 1, 1);
  map_m.At(0, 0) = 0.0F;
  map_m.At(1, 0) = 2.0F;
  map_m.At(2, 0) = 200.0F;
  map_m.At(3, 0) = std::numeric_limits<float>::infinity();
  const Image<uint8_t> picture = DistanceInColor(map_m);
  const auto sum = [&](int x) {
    return picture.At(x, 0, 0) + picture.At(x, 0, 1) + picture.At(x, 0, 2);
  };
  EXPECT_EQ(sum(0), 0);
  EXPECT_LT(sum(1), 250);
  EXPECT_GT(sum(2), 400);
  // Viridis ends in yellow, red before blue.
  EXPECT_GT(picture.At(2, 0, 0), picture.At(2, 0, 2) + 100);
  EXPECT_EQ(picture.At(3, 0, 0), picture.At(3, 0, 2));
}

}  // namespace
}  // namespace pfseq
