// SPDX-License-Identifier: Apache-2.0
// Rectified photographs of facades, described by a YAML file:
//
//   source: where the photographs come from
//   credit: who took them
//   licence: under what terms
//   facades:
//     NAME:
//       file: PATH                     relative to the YAML file
//       width_m: 34                    of the photograph, after cropping
//       height_m: 16.5
//       floors: 5
//       normal: PATH                   tangent-space normal map of the photograph's size, green up
//       roughness: PATH                the same for roughness, in green (glTF's channel)
//       crop_px: [left, top, right, bottom]        the part to use; left out: all of it
//       recess_m: 0.15                             how deep windows lie
//       windows_px:                                rectangles in the whole photograph, or grids of
//       them
//         first: [left, top, width, height]
//         upper: [left, top, width, height, step_x, columns, step_y, rows]
#pragma once

#include "renderer/core/image.h"
#include "scenes/canyon/wall_painting.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pfseq {

struct FacadePhoto {
  std::string name;
  /// Cropped, 4 channels; the maps are null where there are none.
  std::shared_ptr<const Image<uint8_t>> image;
  std::shared_ptr<const Image<uint8_t>> normal;
  std::shared_ptr<const Image<uint8_t>> roughness;
  Vec2d size_m = Vec2d::Ones();
  int num_floors = 1;
  double recess_m = 0.15;
  /// From the lower left corner of the photograph.
  std::vector<WallRect> windows;
};

struct FacadePhotos {
  std::vector<std::shared_ptr<const FacadePhoto>> photos;
  /// One line: source, credit and licence.
  std::string credits;
};

/// InputError "FILE:LINE: ..." when the description or a photograph is missing or not as said.
FacadePhotos ReadFacadePhotos(const std::filesystem::path& path);

/// The credits of the description alone; its photographs need not be there.
std::string ReadFacadeCredits(const std::filesystem::path& path);

/// A photograph for a front of this height: one of those that need not be stretched by more than a
/// third; null when there is none.
std::shared_ptr<const FacadePhoto> ChoosePhoto(const FacadePhotos& photos,
                                               double height_m,
                                               uint64_t seed);

}  // namespace pfseq
