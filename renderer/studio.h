// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/cached_light.h"
#include "renderer/film/optics.h"
#include "renderer/film/shutter.h"
#include "renderer/frame_renderer.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence_renderer.h"
#include "renderer/trace/path_tracer.h"
#include "renderer/trace/ray_scene.h"

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
  /// The input must outlive this.
  Studio(const SequenceInput& input, int num_threads);

  bool UsesCachedLight() const { return spec_.render.light == "cached"; }

  /// Loads the stored light; the tracer of UsesCachedLight.
  void LoadLight(const LightCacheOptions& options);
  CachedLight& Light() const { return *light_; }

  PixelSampling Sampling() const;

  const RigFile& Rig() const { return rig_; }
  const std::vector<StampedPose>& Poses() const { return poses_; }
  const PathTracer& Tracer() const { return tracer_; }
  const RayScene& Rays() const { return scene_; }
  /// Null without one.
  const SunDisc* Sun() const { return lighting_->sun ? &*lighting_->sun : nullptr; }

  const LensRaster& RasterOf(const Record& record) const { return *rasters_[record.lens_idx]; }
  const Optics& OpticsOf(const Record& record) const { return *optics_[record.lens_idx]; }

  /// At the frame's pose, without an exposure.
  View ViewOf(const Record& record) const;
  /// The camera's pose so long after the frame's.
  RigidTransform WorldFromCamera(const Record& record, double after_s) const;
  ExposurePoses ExposureOf(const Record& record) const;

  FrameFile FileOf(const Record& record, Output output) const;

 private:
  const SequenceInput& input_;
  const SequenceSpec& spec_;
  RigFile rig_;
  std::vector<StampedPose> poses_;
  std::unique_ptr<Trajectory> trajectory_;
  RayScene scene_;
  TextureSet textures_;
  std::shared_ptr<const Lighting> lighting_;
  PathTracer tracer_;
  std::vector<std::unique_ptr<LensRaster>> rasters_;
  std::vector<std::unique_ptr<Optics>> optics_;
  std::unique_ptr<CachedLight> light_;
};

}  // namespace pfseq
