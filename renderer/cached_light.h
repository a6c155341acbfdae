// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/cached_frame_renderer.h"
#include "renderer/lens/lens_raster.h"
#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/cached_light_tracer.h"
#include "renderer/trace/light_gatherer.h"
#include "renderer/trace/light_store.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/surface_table.h"
#include "renderer/trace/texture.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// Where stored light is kept between runs, and how much memory it may take.
struct LightCacheOptions {
  /// Empty: it is kept nowhere.
  std::filesystem::path folder;
  int64_t max_memory_bytes = int64_t{4} << 30;
};

/// A view with the raster of its lens.
struct RasterView {
  const LensRaster* raster = nullptr;
  View view;
};

/// The stored light of a scene, from disk as far as an earlier run has left it there.
///
/// File FOLDER/KEY.light: a line with the format's name, a line with KEY (SHA-256 of all that the
/// light depends on), a line with the SHA-256 of the rest, and LightStore::Serialize's bytes. A
/// file that is damaged or another's is told of and made anew.
class CachedLight {
 public:
  /// `content_hash` stands for scene and light, `rig_positions_m` are the places of the trajectory.
  /// All must outlive this.
  CachedLight(const RayScene& rays,
              const TextureSet& textures,
              const Lighting& lighting,
              const RenderSpec& spec,
              const std::vector<Vec3d>& rig_positions_m,
              const std::string& content_hash,
              const LightCacheOptions& options);

  /// Computes what the views look up and keeps it on disk.
  void Prepare(const std::vector<RasterView>& views,
               const PixelSampling& sampling,
               int num_threads,
               bool quiet);

  /// Keeps on disk what was computed since the last time.
  void Save();

  const CachedLightTracer& Tracer() const { return tracer_; }
  const LightStore& Store() const { return store_; }

  /// One line on how much there is.
  std::string Summary() const;

 private:
  std::filesystem::path CachePath() const { return options_.folder / (key_ + ".light"); }
  void Load();
  void Compute(std::vector<LightStore::RecordId> missing, int num_threads, bool quiet);

  LightCacheOptions options_;
  std::string key_;
  SurfaceTable surfaces_;
  LightGatherer gatherer_;
  LightStore store_;
  CachedLightTracer tracer_;
  int64_t num_saved_records_ = 0;
};

}  // namespace pfseq
