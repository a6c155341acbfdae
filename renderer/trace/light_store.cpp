// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_store.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include <immintrin.h>

namespace pfseq {
namespace {

/// Rows of a grid at most; larger triangles have wider rows.
constexpr float kMaxRows = 8192.0F;

/// Records stay this far off the triangle's edges, so that they do not sit in a corner where
/// rounding decides what they see; but never further than this share of the triangle's height.
constexpr float kInsetShareOfSpacing = 0.04F;
constexpr float kMaxInsetShare = 0.2F;

/// States of a record, in the fourth half of its first group.
constexpr uint16_t kEmpty = 0;
constexpr uint16_t kWanted = 1;
constexpr uint16_t kReady = 2;
constexpr size_t kStateIdx = 3;
constexpr size_t kBuriedIdx = 7;

/// What a buried record counts for beside others.
constexpr float kBuriedWeight = 1e-4F;

/// Corners of a parallelogram may be off by this share of its longest side.
constexpr float kParallelogramTolerance = 1e-3F;

/// Edges shorter than this many spacings need one record across.
constexpr float kThinInSpacings = 0.5F;

uint16_t State(const std::array<uint16_t, 12>& halves) {
  return std::atomic_ref<uint16_t>(const_cast<uint16_t&>(halves[kStateIdx]))
      .load(std::memory_order_acquire);
}

Eigen::Array4f FloatsFromHalves(const uint16_t* halves) {
  const __m128i bits = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(halves));
  Eigen::Array4f values;
  _mm_storeu_ps(values.data(), _mm_cvtph_ps(bits));
  return values;
}

void HalvesFromFloats(const Eigen::Array4f& values, uint16_t* halves) {
  constexpr float kLargestHalf = 65504.0F;
  const Eigen::Array4f clamped = values.max(-kLargestHalf).min(kLargestHalf);
  const __m128i bits =
      _mm_cvtps_ph(_mm_loadu_ps(clamped.data()), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  std::memcpy(halves, &bits, 4 * sizeof(uint16_t));
}

template <typename T>
void Append(const T& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Takes values off the front of a text of bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  template <typename T>
  bool Take(T& value) {
    if (bytes_.size() < sizeof(T)) {
      return false;
    }
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return true;
  }
  bool IsAtEnd() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// Positions of the vertices of two triangles, in their order, that are not on the edge which they
/// share, if together they are a parallelogram whose sides go round the same way.
std::optional<std::array<uint8_t, 2>> ParallelogramApexes(const Mesh& mesh,
                                                          const std::array<uint32_t, 3>& first,
                                                          const std::array<uint32_t, 3>& second) {
  const auto position = [&](const std::array<uint32_t, 3>& triangle, size_t i) -> const Vec3f& {
    return mesh.positions_m[triangle[i % 3]];
  };
  for (uint8_t a = 0; a < 3; ++a) {
    for (uint8_t b = 0; b < 3; ++b) {
      const Vec3f& apex = position(first, a);
      const Vec3f& next = position(first, a + 1U);
      const Vec3f& last = position(first, a + 2U);
      if (next != position(second, b + 2U) || last != position(second, b + 1U)) {
        continue;
      }
      const Vec3f off = position(second, b) - (next + last - apex);
      const float longest = std::max((next - apex).norm(), (last - apex).norm());
      if (off.norm() <= kParallelogramTolerance * longest) {
        return std::array<uint8_t, 2>{a, b};
      }
    }
  }
  return std::nullopt;
}

/// How a page lies in the serialised store.
struct PageHeader {
  uint32_t face_idx = 0;
  uint32_t page_idx = 0;
};

}  // namespace

LightStore::LightStore(const SurfaceTable& surfaces,
                       const LightGatherer& gatherer,
                       const LightStoreOptions& options)
    : surfaces_(surfaces),
      gatherer_(gatherer),
      options_(options),
      grids_(surfaces.NumTriangles()),
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

std::unique_ptr<LightStore::Grid> LightStore::MakeGrid(uint32_t face_idx) const {
  auto grid = std::make_unique<Grid>();
  const auto [mesh_idx, in_mesh] = surfaces_.MeshAndTriangle(face_idx);
  const Mesh& mesh = surfaces_.PlainScene().meshes[mesh_idx];
  const std::array<Vec3f, 3> corners = surfaces_.CornersM(face_idx);
  // Along: what the rows follow each other along; across: the longest row.
  float along_m = 0.0F;
  float across_m = 0.0F;
  Vec3f centre_m;
  if (face_idx + 1 < is_second_.size() && is_second_[face_idx + 1] != 0) {
    const std::array<uint8_t, 2> apexes =
        *ParallelogramApexes(mesh, mesh.triangles[in_mesh], mesh.triangles[in_mesh + 1]);
    grid->is_quad = true;
    grid->apex = apexes[0];
    grid->second_apex = apexes[1];
    const Vec3f& next = corners[(grid->apex + 1U) % 3];
    const Vec3f& last = corners[(grid->apex + 2U) % 3];
    along_m = (next - corners[grid->apex]).norm();
    across_m = (last - corners[grid->apex]).norm();
    grid->is_turned = across_m > along_m;
    if (grid->is_turned) {
      std::swap(along_m, across_m);
    }
    centre_m = 0.5F * (next + last);
  } else {
    // Lengths of the edges opposite to each corner.
    std::array<float, 3> opposite_m;
    for (size_t i = 0; i < 3; ++i) {
      opposite_m[i] = (corners[(i + 1) % 3] - corners[(i + 2) % 3]).norm();
    }
    grid->apex = static_cast<uint8_t>(std::min_element(opposite_m.begin(), opposite_m.end()) -
                                      opposite_m.begin());
    along_m = *std::max_element(opposite_m.begin(), opposite_m.end());
    across_m = opposite_m[grid->apex];
    centre_m = (corners[0] + corners[1] + corners[2]) / 3.0F;
  }

  const float spacing_m = SpacingAt(centre_m, along_m);
  if (along_m < kThinInSpacings * spacing_m) {
    grid->num_records = 1;
  } else {
    const float rows = std::clamp(std::ceil(along_m / spacing_m), 1.0F, kMaxRows);
    grid->num_rows = static_cast<uint16_t>(rows);
    grid->row_start = std::make_unique<uint32_t[]>(size_t{grid->num_rows} + 2);
    uint32_t count = 0;
    for (uint32_t row = 0; row <= grid->num_rows; ++row) {
      grid->row_start[row] = count;
      const float length_m = grid->is_quad ? across_m : across_m * static_cast<float>(row) / rows;
      count +=
          1 + (length_m < kThinInSpacings * spacing_m
                   ? 0U
                   : static_cast<uint32_t>(std::min(kMaxRows, std::ceil(length_m / spacing_m))));
    }
    grid->row_start[size_t{grid->num_rows} + 1] = count;
    grid->num_records = count;
  }
  grid->num_pages = (grid->num_records + kRecordsPerPage - 1) / kRecordsPerPage;
  grid->pages = std::make_unique<std::atomic<Page*>[]>(2 * size_t{grid->num_pages});
  return grid;
}

LightStore::Grid& LightStore::GridOf(uint32_t face_idx) {
  std::atomic<Grid*>& slot = grids_[face_idx];
  Grid* grid = slot.load(std::memory_order_acquire);
  if (grid == nullptr) [[unlikely]] {
    std::unique_ptr<Grid> made = MakeGrid(face_idx);
    const std::lock_guard lock(allocation_mutex_);
    grid = slot.load(std::memory_order_relaxed);
    if (grid == nullptr) {
      grid = made.get();
      owned_grids_.push_back(std::move(made));
      slot.store(grid, std::memory_order_release);
    }
  }
  return *grid;
}

LightStore::Record* LightStore::RecordAt(Grid& grid, bool is_front, uint32_t record_idx) {
  const size_t page_idx = record_idx / kRecordsPerPage + (is_front ? 0 : size_t{grid.num_pages});
  std::atomic<Page*>& slot = grid.pages[page_idx];
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

LightStore::FacePoint LightStore::FacePointAt(const Grid& grid, bool is_second, float u, float v) {
  const size_t apex = is_second ? grid.second_apex : grid.apex;
  const std::array<float, 3> weights = {1.0F - u - v, u, v};
  const float next = std::clamp(weights[(apex + 1) % 3], 0.0F, 1.0F);
  const float last = std::clamp(weights[(apex + 2) % 3], 0.0F, 1.0F);
  if (!grid.is_quad) {
    const float along = std::min(1.0F, next + last);
    return {along, along > 0.0F ? std::min(1.0F, last / (next + last)) : 0.0F};
  }
  // The second triangle goes round the other way: its next vertex is the first one's last.
  const float to_next = is_second ? 1.0F - next : next;
  const float to_last = is_second ? 1.0F - last : last;
  return grid.is_turned ? FacePoint{to_last, to_next} : FacePoint{to_next, to_last};
}

LightStore::Stencil LightStore::StencilAt(const Grid& grid, const FacePoint& place) {
  Stencil stencil;
  if (grid.num_rows == 0) {
    stencil.weights[0] = 1.0F;
    stencil.count = 1;
    return stencil;
  }
  const float row_position = place.along * static_cast<float>(grid.num_rows);
  const auto row =
      std::min(static_cast<uint32_t>(row_position), static_cast<uint32_t>(grid.num_rows) - 1);
  const float row_weight = row_position - static_cast<float>(row);
  for (uint32_t k = 0; k < 2; ++k) {
    const float weight = k == 0 ? 1.0F - row_weight : row_weight;
    const uint32_t start = grid.row_start[row + k];
    const uint32_t num_cells = grid.row_start[row + k + 1] - start - 1;
    const float position = place.across * static_cast<float>(num_cells);
    const uint32_t cell =
        num_cells == 0 ? 0 : std::min(static_cast<uint32_t>(position), num_cells - 1);
    const float cell_weight = position - static_cast<float>(cell);
    const auto add = [&](uint32_t record_idx, float share) {
      if (share > 0.0F) {
        stencil.records[static_cast<size_t>(stencil.count)] = record_idx;
        stencil.weights[static_cast<size_t>(stencil.count)] = share;
        ++stencil.count;
      }
    };
    add(start + cell, weight * (1.0F - cell_weight));
    add(start + cell + 1, weight * cell_weight);
  }
  return stencil;
}

Vec3f LightStore::RecordPositionM(uint32_t face_idx, const Grid& grid, uint32_t record_idx) const {
  const std::array<Vec3f, 3> corners = surfaces_.CornersM(face_idx);
  const Vec3f& apex = corners[grid.apex];
  const Vec3f& next = corners[(grid.apex + 1U) % 3];
  const Vec3f& last = corners[(grid.apex + 2U) % 3];
  FacePoint place{grid.is_quad ? 0.5F : 2.0F / 3.0F, 0.5F};
  if (grid.num_rows > 0) {
    const uint32_t* row_end = std::upper_bound(
        grid.row_start.get(), grid.row_start.get() + grid.num_rows + 1, record_idx);
    const auto row = static_cast<uint32_t>(row_end - grid.row_start.get() - 1);
    const uint32_t num_cells = grid.row_start[row + 1] - grid.row_start[row] - 1;
    place.along = static_cast<float>(row) / static_cast<float>(grid.num_rows);
    place.across = num_cells == 0 ? 0.5F
                                  : static_cast<float>(record_idx - grid.row_start[row]) /
                                        static_cast<float>(num_cells);
  }
  const float inset_m = kInsetShareOfSpacing * options_.spacing_m;
  const float double_area = (next - apex).cross(last - apex).norm();
  // Share of the height over an edge of this length that the inset is.
  const auto inset_share = [&](float edge_m) {
    return double_area > 0.0F ? std::min(kMaxInsetShare, inset_m * edge_m / double_area) : 0.0F;
  };
  if (grid.is_quad) {
    const float to_next = grid.is_turned ? place.across : place.along;
    const float to_last = grid.is_turned ? place.along : place.across;
    const float least_next = inset_share((last - apex).norm());
    const float least_last = inset_share((next - apex).norm());
    return apex + std::clamp(to_next, least_next, 1.0F - least_next) * (next - apex) +
           std::clamp(to_last, least_last, 1.0F - least_last) * (last - apex);
  }
  const std::array<float, 3> weights = {
      1.0F - place.along, place.along * (1.0F - place.across), place.along * place.across};
  const std::array<float, 3> least = {inset_share((last - next).norm()),
                                      inset_share((last - apex).norm()),
                                      inset_share((next - apex).norm())};
  const float rest = 1.0F - least[0] - least[1] - least[2];
  return (least[0] + rest * weights[0]) * apex + (least[1] + rest * weights[1]) * next +
         (least[2] + rest * weights[2]) * last;
}

void LightStore::Publish(const Record& computed, Record& record) {
  // The state comes last: who sees it sees the rest.
  for (size_t i = 0; i < record.halves.size(); ++i) {
    if (i != kStateIdx) {
      std::atomic_ref<uint16_t>(record.halves[i])
          .store(computed.halves[i], std::memory_order_relaxed);
    }
  }
  const uint16_t before = std::atomic_ref<uint16_t>(record.halves[kStateIdx])
                              .exchange(kReady, std::memory_order_acq_rel);
  if (before != kReady) {
    num_records_.fetch_add(1, std::memory_order_relaxed);
  }
}

LightStore::Record LightStore::ComputeRecord(const Grid& grid, const RecordId& id) const {
  ShadingPoint point;
  point.position_m = RecordPositionM(id.face_idx, grid, id.record_idx);
  const Vec3f normal = surfaces_.Normal(id.face_idx);
  point.geometric_normal = id.is_front ? normal : Vec3f(-normal);
  const uint64_t key =
      HashKey({0x7265636f7264ULL, id.face_idx, id.record_idx, id.is_front ? 0ULL : 1ULL});
  const GatheredLight gathered = gatherer_.Gather(point.RayOriginM(), point.geometric_normal, key);
  Record record;
  HalvesFromFloats(gathered.light.x, &record.halves[0]);
  HalvesFromFloats(gathered.light.y, &record.halves[4]);
  HalvesFromFloats(gathered.light.z, &record.halves[8]);
  record.halves[kStateIdx] = kReady;
  record.halves[kBuriedIdx] = gathered.is_buried ? 1 : 0;
  return record;
}

VectorIrradiance LightStore::Lookup(const ShadingPoint& point) {
  const uint32_t face_idx = FaceOf(point.triangle_idx);
  Grid& grid = GridOf(face_idx);
  const Stencil stencil =
      StencilAt(grid, FacePointAt(grid, face_idx != point.triangle_idx, point.u, point.v));
  VectorIrradiance light;
  float sum_of_weights = 0.0F;
  for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
    Record* record = RecordAt(grid, point.is_front, stencil.records[i]);
    Record computed;
    if (record == nullptr || State(record->halves) != kReady) [[unlikely]] {
      computed = ComputeRecord(grid, {face_idx, stencil.records[i], point.is_front});
      if (record != nullptr) {
        Publish(computed, *record);
      }
      record = &computed;
    }
    const float weight =
        stencil.weights[i] * (record->halves[kBuriedIdx] != 0 ? kBuriedWeight : 1.0F);
    sum_of_weights += weight;
    light.x += weight * FloatsFromHalves(&record->halves[0]);
    light.y += weight * FloatsFromHalves(&record->halves[4]);
    light.z += weight * FloatsFromHalves(&record->halves[8]);
  }
  const float scale = 1.0F / sum_of_weights;
  light.x *= scale;
  light.y *= scale;
  light.z *= scale;
  return light;
}

void LightStore::Want(const ShadingPoint& point, std::vector<RecordId>& missing) {
  const uint32_t face_idx = FaceOf(point.triangle_idx);
  Grid& grid = GridOf(face_idx);
  const Stencil stencil =
      StencilAt(grid, FacePointAt(grid, face_idx != point.triangle_idx, point.u, point.v));
  for (size_t i = 0; i < static_cast<size_t>(stencil.count); ++i) {
    Record* record = RecordAt(grid, point.is_front, stencil.records[i]);
    uint16_t expected = kEmpty;
    if (record != nullptr &&
        std::atomic_ref<uint16_t>(record->halves[kStateIdx])
            .compare_exchange_strong(expected, kWanted, std::memory_order_relaxed)) {
      missing.push_back({face_idx, stencil.records[i], point.is_front});
    }
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
      Grid& grid = GridOf(records[i].face_idx);
      Record* record = RecordAt(grid, records[i].is_front, records[i].record_idx);
      if (record != nullptr && State(record->halves) != kReady) {
        Publish(ComputeRecord(grid, records[i]), *record);
      }
    }
    progress.Advance(end - task * kRecordsPerTask);
  });
}

int64_t LightStore::MemoryBytes() const {
  int64_t bytes = static_cast<int64_t>(grids_.size() * sizeof(grids_[0]) +
                                       owned_pages_.size() * (sizeof(Page) + sizeof(void*)));
  for (const std::unique_ptr<Grid>& grid : owned_grids_) {
    bytes += static_cast<int64_t>(sizeof(Grid) + (grid->num_rows + 2) * sizeof(uint32_t) +
                                  2 * grid->num_pages * sizeof(void*));
  }
  return bytes;
}

std::string LightStore::Serialize() const {
  std::string bytes;
  Append(static_cast<uint64_t>(grids_.size()), bytes);
  for (size_t triangle_idx = 0; triangle_idx < grids_.size(); ++triangle_idx) {
    const Grid* grid = grids_[triangle_idx].load(std::memory_order_acquire);
    for (uint32_t page_idx = 0; grid != nullptr && page_idx < 2 * grid->num_pages; ++page_idx) {
      const Page* page = grid->pages[page_idx].load(std::memory_order_acquire);
      if (page == nullptr) {
        continue;
      }
      uint32_t ready = 0;
      for (size_t i = 0; i < kRecordsPerPage; ++i) {
        ready |= State(page->records[i].halves) == kReady ? 1U << i : 0U;
      }
      if (ready == 0) {
        continue;
      }
      Append(PageHeader{static_cast<uint32_t>(triangle_idx), page_idx}, bytes);
      Append(ready, bytes);
      for (size_t i = 0; i < kRecordsPerPage; ++i) {
        if ((ready >> i & 1U) != 0) {
          Append(page->records[i], bytes);
        }
      }
    }
  }
  return bytes;
}

bool LightStore::Load(std::string_view bytes) {
  // Looked through before anything is taken over.
  for (const bool is_rehearsal : {true, false}) {
    ByteReader reader(bytes);
    uint64_t num_triangles = 0;
    if (!reader.Take(num_triangles) || num_triangles != grids_.size()) {
      return false;
    }
    while (!reader.IsAtEnd()) {
      PageHeader header;
      uint32_t ready = 0;
      if (!reader.Take(header) || !reader.Take(ready) || header.face_idx >= grids_.size() ||
          is_second_[header.face_idx] != 0) {
        return false;
      }
      Grid& grid = GridOf(header.face_idx);
      if (header.page_idx >= 2 * grid.num_pages) {
        return false;
      }
      const bool is_front = header.page_idx < grid.num_pages;
      const uint32_t first =
          (is_front ? header.page_idx : header.page_idx - grid.num_pages) * kRecordsPerPage;
      for (uint32_t i = 0; i < kRecordsPerPage; ++i) {
        Record stored;
        if ((ready >> i & 1U) == 0) {
          continue;
        }
        if (first + i >= grid.num_records || !reader.Take(stored) ||
            stored.halves[kStateIdx] != kReady) {
          return false;
        }
        if (!is_rehearsal) {
          Record* record = RecordAt(grid, is_front, first + i);
          if (record != nullptr) {
            Publish(stored, *record);
          }
        }
      }
    }
  }
  return true;
}

}  // namespace pfseq
