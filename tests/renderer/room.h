// SPDX-License-Identifier: Apache-2.0
// Small sequences for the tests of what renders them.
#pragma once

#include "renderer/sequence_renderer.h"
#include "tests/support/simple_scenes.h"

namespace pfseq {

/// A room of 60 x 12 x 20 m around the default drive's first street; two cameras, two lenses, three
/// frames.
inline SequenceInput Room() {
  SequenceInput input;
  SequenceSpec& spec = input.spec;
  spec.image.size_px = {24, 24};
  const LensSpec lens{.model = "equidistant", .circle_px = 24.0};
  spec.lenses = {{"a", lens}, {"b", LensSpec{.model = "equisolid", .circle_px = 22.0}}};
  spec.cameras = {{"front", {}}, {"rear", CameraSpec{.position_m = {-2.0, 0.0, 0.0}}}};
  spec.trajectory.num_frames = 3;
  spec.light.sun = SunSpec{};
  spec.sensor.exposure = 0.06;
  spec.render.samples = 2;
  spec.render.max_samples = 4;
  spec.render.light_quality = 0.2;
  input.scene = BoxScene(Vec3f(-10, -6, -0.1F), Vec3f(50, 6, 20));
  input.files = {{"sequence.yaml", "room"}, {"scene.glb", "glb"}};
  return input;
}

/// A beam beside the street, away from the sun, before a camera that has every fault.
inline SequenceInput RealisticRoom() {
  SequenceInput input = Room();
  input.scene = BoxScene(Vec3f(-10, -6, 5), Vec3f(50, -2, 6));
  SequenceSpec& spec = input.spec;
  spec.trajectory.drive.stop_s = 0.0;
  spec.shutter = {.exposure_s = 0.2, .ramp = 0.2, .readout_s = 0.1};
  spec.optics.lateral_color.rim_px = 1.0;
  spec.optics.blur = {0.5, {1.0, 0.7}};
  spec.optics.vignetting.natural = 0.3;
  spec.optics.rim.width_px = 2.0;
  spec.optics.glare = {.bloom = 0.02, .bloom_radius_px = 3.0, .veil = 0.01};
  spec.optics.sun_star = {.strength = 0.01, .length_px = 4.0, .width_px = 0.7};
  spec.optics.ghosts = {
      {"one", {.position = -0.5, .radius_px = 3.0, .strength = {1e-4, 1e-4, 2e-4}}}};
  spec.sensor.white_electrons = 3000.0;
  return input;
}

}  // namespace pfseq
