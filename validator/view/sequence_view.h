// SPDX-License-Identifier: Apache-2.0
// What a person asks of a sequence while leafing through it.
#pragma once

#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_reader.h"

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace pfseq {

/// A frame's channel as named in addresses.
struct ViewRequest {
  std::string lens;
  std::string camera;
  std::string channel;
  int frame = 0;
};

/// A sequence's folder, read anew at each question. Safe for many threads. Names that the sequence
/// does not have are InputError; no path is ever made of them.
class SequenceView {
 public:
  explicit SequenceView(const std::filesystem::path& folder) : reader_(folder) {}

  /// {name, width_px, height_px, max_distance_m, cameras, lenses: [{name, channels, frames}]}
  nlohmann::json Description() const;

  /// A PNG file: images and masks as they are, distances in colour (false_color.h), radiance with
  /// its 99th percentile as white.
  Bytes Picture(const ViewRequest& request) const;

  /// The pixel (x, y), counted from 0, by the ray through its centre:
  ///   {x, y, in_circle, sky, incidence_deg, direction_camera, direction_world, distance_m,
  ///    point_world_m, others: [{camera, x_px, y_px, distance_m, map_distance_m, is_visible}]}
  /// Distances come from the distance map; null where there is none. `others` tells where the point
  /// lies in the other cameras (continuous pixels, null outside their view) and whether their map
  /// sees it there.
  nlohmann::json Pixel(const ViewRequest& request, int x, int y) const;

 private:
  void Check(const ViewRequest& request) const;
  nlohmann::json InOther(const ViewRequest& request,
                         const std::string& other,
                         const Vec3d& point_world_m) const;

  SequenceReader reader_;
};

}  // namespace pfseq
