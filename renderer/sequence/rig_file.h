// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/lens/camera_rig.h"
#include "renderer/lens/lens.h"
#include "renderer/sequence/sequence_spec.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// The calibration of a sequence, as rig.yaml holds it: every camera is rendered with every lens.
struct RigFile {
  int width_px = 0;
  int height_px = 0;
  /// Distances beyond this are +inf in the maps.
  double max_distance_m = 0.0;
  /// The first camera is the reference.
  std::vector<RigCamera> cameras;
  std::vector<Named<Lens>> lenses;
  /// Of realistic frames, by lens: c1, c3 of red, green and blue (LateralColor); empty without
  /// lateral colour. Written for people and other programs, not read.
  std::vector<std::array<std::array<double, 2>, 3>> channel_polynomials;

  /// Text of rig.yaml; numbers are written so that they read back to the same bits.
  std::string ToYaml() const;

  /// InputError with file, line and key when something is missing or wrong.
  static RigFile Read(const std::filesystem::path& path);
};

}  // namespace pfseq
