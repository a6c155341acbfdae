// SPDX-License-Identifier: Apache-2.0
// Skylight and indirect light, computed once and kept on the surfaces of a scene. Each side of each
// triangle has a grid of records (RecordGrid) that needs nothing of the scene but its triangles;
// two neighbours in a mesh that make up a parallelogram share one. A record belongs to one side of
// one such face, so that no light leaks round an edge; what it holds depends on the scene and its
// place alone, so that it is the same whoever asks first. Records that would lie within a body,
// where faces run into each other, are told by what they see and moved to where the face shows
// nearby; if that is nowhere, they count only where there is no other. Beside such records, and
// between neighbours that differ much, the face has a finer grid, for there its light changes fast,
// and where that grid's neighbours differ very much, as in gaps between mouldings, the finest; what
// is seen by reflection alone has a coarser one.
#pragma once

#include "renderer/core/progress.h"
#include "renderer/core/vector.h"
#include "renderer/trace/light_gatherer.h"
#include "renderer/trace/light_record.h"
#include "renderer/trace/record_grid.h"
#include "renderer/trace/surface_table.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// How finely light is stored: for what the camera sees, for what it sees by reflection, and for
/// what it sees where the light changes fast, and faster.
enum class LightDetail : uint8_t { kSeen, kReflected, kFine, kFinest };
inline constexpr size_t kNumLightDetails = 4;

struct LightStoreOptions {
  /// Distance of the records on surfaces near the viewpoints.
  float spacing_m = 0.25F;
  /// On surfaces further off it grows with the distance to the nearest viewpoint.
  float spacing_by_distance = 0.03F;
  /// Both are so many times wider for what is seen by reflection, where light changes fast, and
  /// where it changes faster.
  float reflected_spacing = 4.0F;
  float fine_spacing = 0.25F;
  float finest_spacing = 0.0625F;
  /// Where the cameras come by, about. None: spacing_m everywhere.
  std::vector<Vec3f> viewpoints_m;
  /// Records beyond this are computed each time they are asked for.
  int64_t max_bytes = int64_t{4} << 30;
};

class LightStore {
 public:
  /// Names a record.
  struct RecordId {
    /// The face's first triangle.
    uint32_t face_idx = 0;
    uint32_t record_idx = 0;
    bool is_front = true;
    LightDetail detail = LightDetail::kSeen;
  };

  /// All must outlive this.
  LightStore(const SurfaceTable& surfaces,
             const LightGatherer& gatherer,
             const LightStoreOptions& options);
  ~LightStore();
  LightStore(const LightStore&) = delete;
  LightStore& operator=(const LightStore&) = delete;

  /// The light at a point, interpolated between the four records around it; those that are missing
  /// are computed now. Any number of threads may ask.
  VectorIrradiance Lookup(const ShadingPoint& point, LightDetail detail);

  /// Marks the records around a point as wanted and appends those that nobody marked before to
  /// `missing`.
  void Want(const ShadingPoint& point, LightDetail detail, std::vector<RecordId>& missing);

  /// Computes records; `progress` is advanced by one for each.
  void Compute(const std::vector<RecordId>& records, int num_threads, Progress& progress);

  const LightStoreOptions& Options() const { return options_; }
  int64_t NumRecords() const { return num_records_.load(std::memory_order_relaxed); }
  int64_t MemoryBytes() const;

  /// All records as bytes and back. Load gives false, and loads nothing, when the bytes do not
  /// belong to a store of these triangles.
  std::string Serialize() const;
  bool Load(std::string_view bytes);

 private:
  static constexpr uint32_t kRecordsPerPage = 8;
  struct Page {
    std::array<LightRecord, kRecordsPerPage> records;
  };
  /// The grid of a triangle or parallelogram and the pages of its two sides.
  struct Face {
    RecordGrid grid;
    /// Side of a record's cell.
    float cell_m = 0.0F;
    ShareOfRays share_of_rays = ShareOfRays::kAll;
    uint32_t num_pages = 0;
    std::unique_ptr<std::atomic<Page*>[]> pages;
  };

  size_t NumTriangles() const { return is_second_.size(); }
  /// The place of a face's grid in faces_.
  size_t SlotOf(uint32_t face_idx, LightDetail detail) const {
    return face_idx + static_cast<size_t>(detail) * NumTriangles();
  }
  Face& FaceAt(uint32_t face_idx, LightDetail detail);
  std::unique_ptr<Face> MakeFace(uint32_t face_idx, LightDetail detail) const;
  float SpacingScale(LightDetail detail) const;
  float SpacingAt(const Vec3f& centre_m, float size_m) const;
  /// Records that serve for both are those of what is seen.
  LightDetail DetailFor(uint32_t face_idx, LightDetail detail);
  /// The triangle that names the face that a triangle belongs to.
  uint32_t FaceOf(uint32_t triangle_idx) const {
    return is_second_[triangle_idx] != 0 ? triangle_idx - 1 : triangle_idx;
  }
  void FindParallelograms();
  /// Null when the store is full and the record's page not there.
  LightRecord* RecordAt(Face& face, bool is_front, uint32_t record_idx);
  LightRecord ComputeRecord(const Face& face, const RecordId& id) const;
  void Publish(const LightRecord& computed, LightRecord& record);

  const SurfaceTable& surfaces_;
  const LightGatherer& gatherer_;
  LightStoreOptions options_;
  /// One after another for each LightDetail.
  std::vector<std::atomic<Face*>> faces_;
  /// 1 for the second triangle of a parallelogram, which the one before begins.
  std::vector<uint8_t> is_second_;
  std::mutex allocation_mutex_;
  std::vector<std::unique_ptr<Face>> owned_faces_;
  std::vector<std::unique_ptr<Page>> owned_pages_;
  std::atomic<int64_t> num_records_{0};
};

}  // namespace pfseq
