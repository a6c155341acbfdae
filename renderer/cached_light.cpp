// SPDX-License-Identifier: Apache-2.0
#include "renderer/cached_light.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// Changes whenever the same input would give other records.
constexpr std::string_view kFormat = "pfseq light 13";

/// Records near the cameras are this far apart in a street, and this share of the scene's size in
/// a small one.
constexpr float kSpacingM = 0.25F;
constexpr float kSpacingShareOfScene = 1.0F / 400.0F;
constexpr int kNumRays = 256;

/// What is nearer than this many spacings is followed by real paths.
constexpr float kNearInSpacings = 6.0F;

/// Size of the coarse light's patches.
constexpr float kPatchInSpacings = 12.0F;

/// Viewpoints that share a cell of this many spacings count as one: the same store serves other
/// frame rates and other places of the cameras on the rig.
constexpr float kViewpointCellInSpacings = 8.0F;

constexpr double kMebi = 1024.0 * 1024.0;

float SpacingM(const Scene& scene, double quality) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3f& position_m : mesh.positions_m) {
      box.extend(position_m);
    }
  }
  return std::min(kSpacingM, kSpacingShareOfScene * box.diagonal().norm()) /
         static_cast<float>(quality);
}

/// The middles of the grid's cells that the polygon through the positions touches.
std::vector<Vec3f> Viewpoints(const std::vector<Vec3d>& positions_m, float cell_m) {
  std::set<std::array<int, 3>> cells;
  const auto add = [&](const Vec3d& position_m) {
    const Eigen::Array3d cell = (position_m.array() / cell_m).floor();
    cells.insert({static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])});
  };
  for (size_t i = 0; i < positions_m.size(); ++i) {
    add(positions_m[i]);
    if (i > 0) {
      const Vec3d step_m = positions_m[i] - positions_m[i - 1];
      // Far jumps (a trajectory of single views) are no route.
      const auto num_steps =
          static_cast<int>(std::min(1e4, std::ceil(2.0 * step_m.norm() / cell_m)));
      for (int k = 1; k < num_steps; ++k) {
        add(positions_m[i - 1] + step_m * (static_cast<double>(k) / num_steps));
      }
    }
  }
  std::vector<Vec3f> viewpoints_m;
  for (const std::array<int, 3>& cell : cells) {
    viewpoints_m.push_back(cell_m * Vec3f(static_cast<float>(cell[0]) + 0.5F,
                                          static_cast<float>(cell[1]) + 0.5F,
                                          static_cast<float>(cell[2]) + 0.5F));
  }
  return viewpoints_m;
}

GatherOptions MakeGatherOptions(const Scene& scene, const RenderSpec& spec) {
  return {static_cast<int>(std::ceil(kNumRays * spec.light_quality * spec.light_quality)),
          spec.max_bounces,
          static_cast<float>(spec.min_indirect_roughness),
          kNearInSpacings * SpacingM(scene, 1.0),
          kPatchInSpacings * SpacingM(scene, 1.0)};
}

LightStoreOptions MakeStoreOptions(const Scene& scene,
                                   const RenderSpec& spec,
                                   const std::vector<Vec3d>& positions_m,
                                   int64_t max_bytes) {
  LightStoreOptions options;
  options.spacing_m = SpacingM(scene, spec.light_quality);
  options.spacing_by_distance /= static_cast<float>(spec.light_quality);
  options.viewpoints_m = Viewpoints(positions_m, kViewpointCellInSpacings * SpacingM(scene, 1.0));
  options.max_bytes = max_bytes;
  return options;
}

std::string MakeKey(const std::string& content_hash,
                    const RenderSpec& spec,
                    const LightStoreOptions& options) {
  std::string text = fmt::format("{}\n{}\n{} {} {}\n",
                                 kFormat,
                                 content_hash,
                                 spec.light_quality,
                                 spec.max_bounces,
                                 spec.min_indirect_roughness);
  for (const Vec3f& viewpoint_m : options.viewpoints_m) {
    fmt::format_to(
        std::back_inserter(text), "{} {} {}\n", viewpoint_m.x(), viewpoint_m.y(), viewpoint_m.z());
  }
  return Sha256Hex(text);
}

/// The text up to the next line feed, taken off the front.
std::string_view TakeLine(std::string_view& bytes) {
  const size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(std::min(end + 1, bytes.size()));
  return line;
}

}  // namespace

CachedLight::CachedLight(const RayScene& rays,
                         const TextureSet& textures,
                         const Lighting& lighting,
                         const RenderSpec& spec,
                         const std::vector<Vec3d>& rig_positions_m,
                         const std::string& content_hash,
                         const LightCacheOptions& options)
    : options_(options),
      surfaces_(rays.PlainScene(), textures),
      gatherer_(rays, surfaces_, lighting, MakeGatherOptions(rays.PlainScene(), spec)),
      store_(surfaces_,
             gatherer_,
             MakeStoreOptions(rays.PlainScene(), spec, rig_positions_m, options.max_memory_bytes)),
      tracer_(rays,
              surfaces_,
              lighting,
              store_,
              static_cast<float>(spec.min_indirect_roughness),
              spec.max_bounces) {
  key_ = MakeKey(content_hash, spec, store_.Options());
  Load();
  num_saved_records_ = store_.NumRecords();
}

void CachedLight::Load() {
  std::error_code error;
  if (options_.folder.empty() || !std::filesystem::exists(CachePath(), error)) {
    return;
  }
  const std::string file = ReadFile(CachePath());
  std::string_view rest = file;
  const std::string_view format = TakeLine(rest);
  const std::string_view key = TakeLine(rest);
  const std::string_view checksum = TakeLine(rest);
  const char* fault = nullptr;
  if (format != kFormat || key != key_) {
    fault = "belongs to another scene or version";
  } else if (checksum != Sha256Hex(rest) || !gatherer_.Load(rest) || !store_.Load(rest)) {
    fault = "is damaged (its checksum is wrong)";
  }
  if (fault != nullptr) {
    fmt::print(stderr, "{}: {}; the light is computed anew\n", CachePath().string(), fault);
  }
}

void CachedLight::Prepare(const std::vector<RasterView>& views,
                          const PixelSampling& sampling,
                          int num_threads,
                          bool quiet) {
  // Where light changes fast shows once the first records are there, and where faster, the second.
  constexpr int kNumRounds = 3;
  for (int round = 0; round < kNumRounds; ++round) {
    std::vector<LightStore::RecordId> missing;
    Progress progress("light, what the views see of it", views.size(), quiet);
    for (const RasterView& item : views) {
      const std::vector<LightStore::RecordId> wanted =
          WantedRecords(tracer_, *item.raster, item.view, sampling, num_threads);
      missing.insert(missing.end(), wanted.begin(), wanted.end());
      progress.Advance();
    }
    progress.Finish();
    if (missing.empty()) {
      return;
    }
    Compute(std::move(missing), num_threads, quiet);
  }
}

void CachedLight::Compute(std::vector<LightStore::RecordId> missing, int num_threads, bool quiet) {
  // Neighbours together, whoever marked them first.
  std::sort(missing.begin(), missing.end(), [](const auto& a, const auto& b) {
    return std::tie(a.face_idx, a.detail, a.is_front, a.record_idx) <
           std::tie(b.face_idx, b.detail, b.is_front, b.record_idx);
  });
  Progress progress("light", missing.size(), quiet);
  constexpr size_t kBatch = 16384;
  constexpr auto kSaveInterval = std::chrono::seconds(60);
  auto last_save = std::chrono::steady_clock::now();
  for (size_t start = 0; start < missing.size(); start += kBatch) {
    const auto begin = missing.begin() + static_cast<ptrdiff_t>(start);
    const auto end =
        missing.begin() + static_cast<ptrdiff_t>(std::min(missing.size(), start + kBatch));
    store_.Compute({begin, end}, num_threads, progress);
    // What is there is kept, should the run be stopped.
    if (std::chrono::steady_clock::now() - last_save > kSaveInterval) {
      Save();
      last_save = std::chrono::steady_clock::now();
    }
  }
  progress.Finish();
  Save();
}

void CachedLight::Save() {
  if (options_.folder.empty() || store_.NumRecords() == num_saved_records_) {
    return;
  }
  // Another run may have kept more in the meantime.
  Load();
  const std::string bytes = gatherer_.Serialize() + store_.Serialize();
  WriteFileAtomically(CachePath(),
                      fmt::format("{}\n{}\n{}\n", kFormat, key_, Sha256Hex(bytes)) + bytes);
  num_saved_records_ = store_.NumRecords();
}

std::string CachedLight::Summary() const {
  return fmt::format(
      "light: {} records, {:.0f} MiB{}",
      store_.NumRecords(),
      static_cast<double>(store_.MemoryBytes() + gatherer_.MemoryBytes() +
                          surfaces_.MemoryBytes()) /
          kMebi,
      options_.folder.empty() ? std::string() : ", kept in " + options_.folder.string());
}

}  // namespace pfseq
