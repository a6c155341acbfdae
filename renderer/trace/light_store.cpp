// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_store.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace pfseq {
namespace {

/// Records stay this share of the spacing off the faces' edges.
constexpr float kInsetShareOfSpacing = 0.04F;

/// Cells of a grid for what is seen that are narrower than this many of its spacings, 1.4 of
/// PFSeq's pixels on far surfaces, need fewer rays; those of any grid below half of it still fewer.
constexpr float kNarrowInSpacings = 0.125F;
constexpr float kTinyInSpacings = 0.0625F;

/// Nearer surfaces around a record, in cells, and light changes too fast for its grid.
constexpr float kContactInCells = 0.5F;

/// What a buried record counts for beside others.
constexpr float kBuriedWeight = 1e-4F;

/// Between neighbours that differ by more the light is looked up more finely: a factor of 1.4, and
/// of 4 where it is looked up finely already.
constexpr int kFastChangeInLevels = LightRecord::kLevelsPerStop / 2;
constexpr int kFasterChangeInLevels = 2 * LightRecord::kLevelsPerStop;

/// The grid to look at where a grid's neighbours differ much, if there is one.
std::optional<LightDetail> FinerThan(LightDetail detail) {
  switch (detail) {
    case LightDetail::kSeen:
      return LightDetail::kFine;
    case LightDetail::kFine:
      return LightDetail::kFinest;
    case LightDetail::kReflected:
    case LightDetail::kFinest:
      break;
  }
  return std::nullopt;
}

/// Places that are tried for a record that would lie within a body.
constexpr int kPlacesTried = 24;

/// The i-th of them, in cells off its regular place: the R2 sequence (Roberts 2018, "The
/// Unreasonable Effectiveness of Quasirandom Sequences").
Vec2f PlaceInCell(int i) {
  constexpr float kReach = 0.9F;
  constexpr double kPlastic = 1.32471795724474602596;
  const double u = 0.5 + i / kPlastic;
  const double v = 0.5 + i / (kPlastic * kPlastic);
  return kReach * Vec2f(static_cast<float>(2.0 * (u - std::floor(u)) - 1.0),
                        static_cast<float>(2.0 * (v - std::floor(v)) - 1.0));
}

/// Tells by the records around a point whether light changes too fast there for their grid.
class FastChange {
 public:
  explicit FastChange(LightDetail detail)
      : limit_in_levels_(detail == LightDetail::kFine ? kFasterChangeInLevels
                                                      : kFastChangeInLevels) {}

  /// Whether it does, by this record and those before.
  bool ShowsIn(const LightRecord& record) {
    least_level_ = std::min(least_level_, record.Level());
    greatest_level_ = std::max(greatest_level_, record.Level());
    return record.IsBesideBody() || greatest_level_ - least_level_ > limit_in_levels_;
  }

 private:
  int least_level_ = std::numeric_limits<int>::max();
  int greatest_level_ = 0;
  int limit_in_levels_;
};

/// What a record needs that stands for a cell of this side. One of many in a pixel need not be good
/// by itself, nor what is seen weakly or where light changes anyway.
ShareOfRays ShareFor(float cell_in_spacings, bool is_grid_of_what_is_seen) {
  if (cell_in_spacings < kTinyInSpacings) {
    return ShareOfRays::kSixteenth;
  }
  return !is_grid_of_what_is_seen || cell_in_spacings < kNarrowInSpacings ? ShareOfRays::kQuarter
                                                                          : ShareOfRays::kAll;
}

bool IsDark(const VectorIrradiance& light) {
  return (light.x.abs() + light.y.abs() + light.z.abs()).maxCoeff() <= 0.0F;
}

}  // namespace

LightStore::LightStore(const SurfaceTable& surfaces,
                       const LightGatherer& gatherer,
                       const LightStoreOptions& options)
    : surfaces_(surfaces),
      gatherer_(gatherer),
      options_(options),
      faces_(kNumLightDetails * surfaces.NumTriangles()),
      is_second_(surfaces.NumTriangles(), 0) {
  FindParallelograms();
}

LightStore::~LightStore() = default;

void LightStore::FindParallelograms() {
  const Scene& scene = surfaces_.PlainScene();
  uint32_t first = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (size_t k = 0; k + 1 < mesh.triangles.size(); ++k) {
      if (is_second_[first + k] == 0 &&
          ParallelogramApexes(mesh, mesh.triangles[k], mesh.triangles[k + 1]).has_value()) {
        is_second_[first + k + 1] = 1;
      }
    }
    first += static_cast<uint32_t>(mesh.triangles.size());
  }
}

float LightStore::SpacingAt(const Vec3f& centre_m, float size_m) const {
  if (options_.viewpoints_m.empty()) {
    return options_.spacing_m;
  }
  float nearest_m = std::numeric_limits<float>::infinity();
  for (const Vec3f& viewpoint_m : options_.viewpoints_m) {
    nearest_m = std::min(nearest_m, (viewpoint_m - centre_m).norm());
  }
  return std::max(options_.spacing_m, options_.spacing_by_distance * (nearest_m - 0.6F * size_m));
}

float LightStore::SpacingScale(LightDetail detail) const {
  switch (detail) {
    case LightDetail::kSeen:
      return 1.0F;
    case LightDetail::kReflected:
      return options_.reflected_spacing;
    case LightDetail::kFine:
      return options_.fine_spacing;
    case LightDetail::kFinest:
      return options_.finest_spacing;
  }
  return 1.0F;
}

std::unique_ptr<LightStore::Face> LightStore::MakeFace(uint32_t face_idx,
                                                       LightDetail detail) const {
  const auto [mesh_idx, in_mesh] = surfaces_.MeshAndTriangle(face_idx);
  const Mesh& mesh = surfaces_.PlainScene().meshes[mesh_idx];
  std::optional<std::array<uint8_t, 2>> apexes;
  if (face_idx + 1 < is_second_.size() && is_second_[face_idx + 1] != 0) {
    apexes = ParallelogramApexes(mesh, mesh.triangles[in_mesh], mesh.triangles[in_mesh + 1]);
  }
  const float scale = SpacingScale(detail);
  float spacing_m = 0.0F;
  const auto spacing_at = [&](const Vec3f& middle_m, float size_m) {
    spacing_m = SpacingAt(middle_m, size_m);
    return scale * spacing_m;
  };
  const std::array<Vec3f, 3> corners_m = surfaces_.CornersM(face_idx);
  auto face = std::make_unique<Face>();
  face->grid = RecordGrid(corners_m, apexes, spacing_at);
  const float double_area = (corners_m[1] - corners_m[0]).cross(corners_m[2] - corners_m[0]).norm();
  const float area = apexes.has_value() ? double_area : 0.5F * double_area;
  const uint32_t num_records = face->grid.NumRecords();
  face->cell_m = std::sqrt(area / static_cast<float>(num_records));
  face->share_of_rays =
      ShareFor(face->cell_m / spacing_m, detail == LightDetail::kSeen && num_records > 1);
  face->num_pages = (face->grid.NumRecords() + kRecordsPerPage - 1) / kRecordsPerPage;
  face->pages = std::make_unique<std::atomic<Page*>[]>(2 * size_t{face->num_pages});
  return face;
}

LightStore::Face& LightStore::FaceAt(uint32_t face_idx, LightDetail detail) {
  std::atomic<Face*>& slot = faces_[SlotOf(face_idx, detail)];
  Face* face = slot.load(std::memory_order_acquire);
  if (face == nullptr) [[unlikely]] {
    std::unique_ptr<Face> made = MakeFace(face_idx, detail);
    const std::lock_guard lock(allocation_mutex_);
    face = slot.load(std::memory_order_relaxed);
    if (face == nullptr) {
      face = made.get();
      owned_faces_.push_back(std::move(made));
      slot.store(face, std::memory_order_release);
    }
  }
  return *face;
}

LightDetail LightStore::DetailFor(uint32_t face_idx, LightDetail detail) {
  return detail == LightDetail::kReflected &&
                 FaceAt(face_idx, LightDetail::kSeen).grid.NumRecords() == 1
             ? LightDetail::kSeen
             : detail;
}

LightRecord* LightStore::RecordAt(Face& face, bool is_front, uint32_t record_idx) {
  const size_t page_idx = record_idx / kRecordsPerPage + (is_front ? 0 : size_t{face.num_pages});
  std::atomic<Page*>& slot = face.pages[page_idx];
  Page* page = slot.load(std::memory_order_acquire);
  if (page == nullptr) [[unlikely]] {
    const std::lock_guard lock(allocation_mutex_);
    page = slot.load(std::memory_order_relaxed);
    if (page == nullptr) {
      if (static_cast<int64_t>((owned_pages_.size() + 1) * sizeof(Page)) > options_.max_bytes) {
        return nullptr;
      }
      owned_pages_.push_back(std::make_unique<Page>());
      page = owned_pages_.back().get();
      slot.store(page, std::memory_order_release);
    }
  }
  return &page->records[record_idx % kRecordsPerPage];
}

void LightStore::Publish(const LightRecord& computed, LightRecord& record) {
  if (record.Publish(computed)) {
    num_records_.fetch_add(1, std::memory_order_relaxed);
  }
}

LightRecord LightStore::ComputeRecord(const Face& face, const RecordId& id) const {
  const std::array<Vec3f, 3> corners_m = surfaces_.CornersM(id.face_idx);
  const float inset_m = kInsetShareOfSpacing * options_.spacing_m;
  const Vec3f normal = surfaces_.Normal(id.face_idx);
  ShadingPoint point;
  point.position_m = face.grid.PositionM(corners_m, id.record_idx, inset_m);
  point.geometric_normal = id.is_front ? normal : Vec3f(-normal);
  const uint64_t key = HashKey({0x7265636f7264ULL,
                                id.face_idx,
                                id.record_idx,
                                id.is_front ? 0ULL : 1ULL,
                                static_cast<uint64_t>(id.detail)});
  const auto gather = [&](const ShadingPoint& place) {
    return gatherer_.Gather(place.RayOriginM(), place.geometric_normal, key, face.share_of_rays);
  };
  GatheredLight gathered = gather(point);
  const bool is_beside_body =
      gathered.is_buried || gathered.mean_distance_m < kContactInCells * face.cell_m;
  if (gathered.is_buried) {
    // What shows of the face may lie between its records, all of them behind mouldings.
    float least_from_behind = 0.5F;
    ShadingPoint best = point;
    for (int i = 1; least_from_behind > 0.0F && i <= kPlacesTried; ++i) {
      point.position_m = face.grid.PositionM(corners_m, id.record_idx, inset_m, PlaceInCell(i));
      const float from_behind =
          gatherer_.ShareFromBehind(point.RayOriginM(), point.geometric_normal, key);
      if (from_behind < least_from_behind) {
        least_from_behind = from_behind;
        best = point;
      }
    }
    if (least_from_behind < 0.5F) {
      gathered = gather(best);
    }
  }
  return LightRecord(gathered, point.geometric_normal, is_beside_body);
}

VectorIrradiance LightStore::Lookup(const ShadingPoint& point, LightDetail detail) {
  const uint32_t face_idx = FaceOf(point.triangle_idx);
  detail = DetailFor(face_idx, detail);
  Face& face = FaceAt(face_idx, detail);
  const RecordGrid::Stencil stencil =
      face.grid.StencilAt(face_idx != point.triangle_idx, point.u, point.v);
  const std::optional<LightDetail> finer =
      face.grid.NumRecords() > 1 ? FinerThan(detail) : std::nullopt;
  FastChange change(detail);
  VectorIrradiance light;
  float sum_of_weights = 0.0F;
  for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
    LightRecord* record = RecordAt(face, point.is_front, stencil.records[i]);
    LightRecord computed;
    if (record == nullptr || !record->IsReady()) [[unlikely]] {
      computed = ComputeRecord(face, {face_idx, stencil.records[i], point.is_front, detail});
      if (record != nullptr) {
        Publish(computed, *record);
      }
      record = &computed;
    }
    if (finer.has_value() && change.ShowsIn(*record)) {
      return Lookup(point, *finer);
    }
    const float weight = stencil.weights[i] * (record->IsBuried() ? kBuriedWeight : 1.0F);
    sum_of_weights += weight;
    record->AddTo(weight, light);
  }
  if (sum_of_weights < 2.0F * kBuriedWeight && IsDark(light)) {
    // A gap too small for a record of its own, seen all the same.
    const uint64_t key = HashKey({std::bit_cast<uint32_t>(point.position_m.x()),
                                  std::bit_cast<uint32_t>(point.position_m.y()),
                                  std::bit_cast<uint32_t>(point.position_m.z())});
    return gatherer_.GatherRoughly(point.RayOriginM(), point.geometric_normal, key).light;
  }
  const float scale = 1.0F / sum_of_weights;
  light.x *= scale;
  light.y *= scale;
  light.z *= scale;
  return light;
}

void LightStore::Want(const ShadingPoint& point,
                      LightDetail detail,
                      std::vector<RecordId>& missing) {
  const uint32_t face_idx = FaceOf(point.triangle_idx);
  detail = DetailFor(face_idx, detail);
  Face& face = FaceAt(face_idx, detail);
  const RecordGrid::Stencil stencil =
      face.grid.StencilAt(face_idx != point.triangle_idx, point.u, point.v);
  const std::optional<LightDetail> finer =
      face.grid.NumRecords() > 1 ? FinerThan(detail) : std::nullopt;
  bool is_finer = false;
  FastChange change(detail);
  for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
    LightRecord* record = RecordAt(face, point.is_front, stencil.records[i]);
    if (record == nullptr) {
      continue;
    }
    if (record->MarkWanted()) {
      missing.push_back({face_idx, stencil.records[i], point.is_front, detail});
    }
    is_finer = (record->IsReady() && change.ShowsIn(*record)) || is_finer;
  }
  if (is_finer && finer.has_value()) {
    Want(point, *finer, missing);
  }
}

void LightStore::Compute(const std::vector<RecordId>& records,
                         int num_threads,
                         Progress& progress) {
  constexpr size_t kRecordsPerTask = 64;
  const size_t num_tasks = (records.size() + kRecordsPerTask - 1) / kRecordsPerTask;
  ParallelFor(num_tasks, num_threads, [&](size_t task) {
    const size_t end = std::min(records.size(), (task + 1) * kRecordsPerTask);
    for (size_t i = task * kRecordsPerTask; i < end; ++i) {
      Face& face = FaceAt(records[i].face_idx, records[i].detail);
      LightRecord* record = RecordAt(face, records[i].is_front, records[i].record_idx);
      if (record != nullptr && !record->IsReady()) {
        Publish(ComputeRecord(face, records[i]), *record);
      }
    }
    progress.Advance(end - task * kRecordsPerTask);
  });
}

int64_t LightStore::MemoryBytes() const {
  int64_t bytes = static_cast<int64_t>(faces_.size() * sizeof(faces_[0]) +
                                       owned_pages_.size() * (sizeof(Page) + sizeof(void*)));
  for (const std::unique_ptr<Face>& face : owned_faces_) {
    bytes += face->grid.MemoryBytes() +
             static_cast<int64_t>(sizeof(Face) + 2 * size_t{face->num_pages} * sizeof(void*));
  }
  return bytes;
}

}  // namespace pfseq
