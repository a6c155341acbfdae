// SPDX-License-Identifier: Apache-2.0
#include "validator/view/sequence_view.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "validator/false_color.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <nlohmann/json.hpp>

namespace pfseq {
namespace {

using Json = nlohmann::json;

/// A map's distance and the point's may differ by this, as the map has one value a pixel.
constexpr double kVisibleShare = 0.02;
constexpr double kVisibleM = 0.05;
constexpr double kWhitePercentile = 0.99;

Json VectorJson(const Vec3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Nothing for sky and outside the circle.
Json DistanceJson(float distance_m) {
  return std::isfinite(distance_m) && distance_m > 0.0F ? Json(distance_m) : Json(nullptr);
}

/// IEC 61966-2-1.
uint8_t Srgb(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(255.0 * encoded));
}

Image<uint8_t> ToneMapped(const Image<float>& radiance) {
  std::vector<float> sorted(radiance.Values().begin(), radiance.Values().end());
  const auto white =
      sorted.begin() +
      static_cast<std::ptrdiff_t>(kWhitePercentile * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), white, sorted.end());
  const double scale = *white > 0.0F ? 1.0 / *white : 1.0;
  Image<uint8_t> picture(radiance.WidthPx(), radiance.HeightPx(), 3);
  std::transform(radiance.Values().begin(),
                 radiance.Values().end(),
                 picture.Values().begin(),
                 [&](float value) { return Srgb(scale * value); });
  return picture;
}

}  // namespace

Json SequenceView::Description() const {
  Json json = {{"name", std::filesystem::weakly_canonical(reader_.Folder()).filename().string()},
               {"width_px", reader_.WidthPx()},
               {"height_px", reader_.HeightPx()},
               {"max_distance_m", reader_.MaxDistanceM()},
               {"cameras", reader_.Cameras()},
               {"lenses", Json::array()}};
  for (const std::string& lens : reader_.Lenses()) {
    std::set<int> frames;
    Json channels = Json::array();
    for (const Output output : kAllOutputs) {
      const size_t num_before = frames.size();
      bool has_any = false;
      for (const std::string& camera : reader_.Cameras()) {
        const std::vector<int> found = reader_.Frames(lens, camera, output);
        frames.insert(found.begin(), found.end());
        has_any |= !found.empty();
      }
      if (has_any || frames.size() > num_before) {
        channels.push_back(OutputName(output));
      }
    }
    if (!frames.empty()) {
      json["lenses"].push_back({{"name", lens}, {"channels", channels}, {"frames", frames}});
    }
  }
  return json;
}

void SequenceView::Check(const ViewRequest& request) const {
  reader_.LensOf(request.lens);
  reader_.RigFromCamera(request.camera);
  if (request.frame < 0 || static_cast<size_t>(request.frame) >= reader_.Poses().size()) {
    throw InputError("frame {}: the sequence has frames 0 to {}",
                     request.frame,
                     static_cast<int>(reader_.Poses().size()) - 1);
  }
}

Bytes SequenceView::Picture(const ViewRequest& request) const {
  Check(request);
  const Output output = OutputFromName(request.channel);
  if (output == Output::kDistance) {
    return EncodePng(
        DistanceInColor(reader_.ReadDistance(request.lens, request.camera, request.frame)));
  }
  const std::filesystem::path path =
      reader_.Folder() /
      FrameFile{request.lens, request.camera, output, request.frame}.RelativePath();
  if (path.extension() == ".exr") {
    return EncodePng(ToneMapped(ReadHdrRgb(path)));
  }
  const std::string file = ReadFile(path);
  const auto bytes = std::as_bytes(std::span(file));
  return {bytes.begin(), bytes.end()};
}

Json SequenceView::Pixel(const ViewRequest& request, int x, int y) const {
  Check(request);
  if (x < 0 || y < 0 || x >= reader_.WidthPx() || y >= reader_.HeightPx()) {
    throw InputError(
        "pixel ({}, {}): the images have {} x {}", x, y, reader_.WidthPx(), reader_.HeightPx());
  }
  Json json = {{"x", x},
               {"y", y},
               {"in_circle", false},
               {"sky", false},
               {"distance_m", nullptr},
               {"point_world_m", nullptr},
               {"others", Json::array()}};
  const std::optional<Vec3d> direction =
      reader_.LensOf(request.lens).Unproject(Vec2d(x + 0.5, y + 0.5));
  if (!direction) {
    return json;
  }
  const RigidTransform world_from_camera = reader_.WorldFromCamera(request.camera, request.frame);
  const float distance_m =
      reader_.ReadDistance(request.lens, request.camera, request.frame).At(x, y);
  json["in_circle"] = true;
  json["sky"] = std::isinf(distance_m);
  json["incidence_deg"] = DegFromRad(Lens::IncidenceAngleRad(*direction));
  json["direction_camera"] = VectorJson(*direction);
  json["direction_world"] = VectorJson(world_from_camera.Direction(*direction));
  json["distance_m"] = DistanceJson(distance_m);
  if (!json["distance_m"].is_null()) {
    const Vec3d point_world_m =
        world_from_camera.Point(static_cast<double>(distance_m) * *direction);
    json["point_world_m"] = VectorJson(point_world_m);
    for (const std::string& other : reader_.Cameras()) {
      if (other != request.camera) {
        json["others"].push_back(InOther(request, other, point_world_m));
      }
    }
  }
  return json;
}

Json SequenceView::InOther(const ViewRequest& request,
                           const std::string& other,
                           const Vec3d& point_world_m) const {
  Json json = {{"camera", other},
               {"x_px", nullptr},
               {"y_px", nullptr},
               {"map_distance_m", nullptr},
               {"is_visible", false}};
  const Vec3d point_m =
      reader_.WorldFromCamera(other, request.frame).Inverse().Point(point_world_m);
  json["distance_m"] = point_m.norm();
  const std::optional<Vec2d> pixel_px = reader_.LensOf(request.lens).Project(point_m);
  if (!pixel_px || pixel_px->minCoeff() < 0.0 || pixel_px->x() >= reader_.WidthPx() ||
      pixel_px->y() >= reader_.HeightPx()) {
    return json;
  }
  json["x_px"] = pixel_px->x();
  json["y_px"] = pixel_px->y();
  const std::vector<int> frames = reader_.Frames(request.lens, other, Output::kDistance);
  if (std::find(frames.begin(), frames.end(), request.frame) == frames.end()) {
    return json;
  }
  const float seen_m = reader_.ReadDistance(request.lens, other, request.frame)
                           .At(static_cast<int>(pixel_px->x()), static_cast<int>(pixel_px->y()));
  json["map_distance_m"] = DistanceJson(seen_m);
  json["is_visible"] =
      std::abs(seen_m - point_m.norm()) <= std::max(kVisibleM, kVisibleShare * point_m.norm());
  return json;
}

}  // namespace pfseq
