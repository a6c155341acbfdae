// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/film/optics.h"
#include "renderer/film/shutter.h"
#include "renderer/frame_renderer.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/lit_scene.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence_renderer.h"

#include <memory>
#include <vector>

namespace pfseq {

/// One camera with one lens at one frame.
struct Record {
  int frame = 0;
  size_t camera_idx = 0;
  size_t lens_idx = 0;
};

/// All that the frames of a sequence share, built once.
class Studio {
 public:
  /// The input must outlive this. Its lit scene is used where it has one.
  Studio(const SequenceInput& input, int num_threads);

  bool UsesCachedLight() const { return spec_.render.light == "cached"; }

  /// Loads the stored light; the tracer of UsesCachedLight.
  void LoadLight(const LightCacheOptions& options) { light_ = &scene_->Stored(options); }
  CachedLight& Light() const { return *light_; }

  PixelSampling Sampling() const;

  const RigFile& Rig() const { return rig_; }
  const std::vector<StampedPose>& Poses() const { return poses_; }
  const PathTracer& Tracer() const { return scene_->Tracer(); }
  const RayScene& Rays() const { return scene_->Rays(); }
  /// Null without one.
  const SunDisc* Sun() const { return scene_->Light().sun ? &*scene_->Light().sun : nullptr; }

  const LensRaster& RasterOf(const Record& record) const { return *rasters_[record.lens_idx]; }
  const Optics& OpticsOf(const Record& record) const { return *optics_[record.lens_idx]; }

  /// At the frame's pose, without an exposure.
  View ViewOf(const Record& record) const;
  RigidTransform WorldFromRig(double time_s) const { return trajectory_->WorldFromRig(time_s); }
  /// The camera's pose so long after the frame's.
  RigidTransform WorldFromCamera(const Record& record, double after_s) const;
  ExposurePoses ExposureOf(const Record& record) const;

  FrameFile FileOf(const Record& record, Output output) const;

 private:
  const SequenceSpec& spec_;
  RigFile rig_;
  std::vector<StampedPose> poses_;
  std::unique_ptr<Trajectory> trajectory_;
  std::shared_ptr<LitScene> scene_;
  std::vector<std::unique_ptr<LensRaster>> rasters_;
  std::vector<std::unique_ptr<Optics>> optics_;
  CachedLight* light_ = nullptr;
};

}  // namespace pfseq
