// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/pair_check.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "validator/checks/gap_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr double kAgreementM = 1e-3;
constexpr double kAgreementRelative = 1e-4;
constexpr double kLeastAgreeingShare = 0.999;
// Two triangles are one surface when their planes are the same: normals to 4.5e-5 rad, and one's
// point on the other to 10 micrometres, which is the rounding of float vertices some 100 m away
// from the origin.
constexpr double kSameNormalCosine = 1.0 - 1e-9;
constexpr double kSamePlaneM = 1e-5;

/// One camera's map in one frame.
struct MapView {
  const Lens* lens = nullptr;
  RigidTransform world_from_camera;
  RigidTransform camera_from_world;
  Image<float> distance_m;

  const Vec3d& CentreM() const { return world_from_camera.translation_m; }

  std::optional<Vec3d> DirectionWorld(int x, int y) const {
    const std::optional<Vec3d> direction_camera = lens->Unproject(Vec2d(x + 0.5, y + 0.5));
    return direction_camera ? std::optional(world_from_camera.Direction(*direction_camera))
                            : std::nullopt;
  }
};

/// What some pixels add up to.
struct Tally {
  PairAgreement counts;
  GapHistogram gaps;

  void Add(const Tally& other) {
    counts.num_sampled += other.counts.num_sampled;
    counts.num_outside += other.counts.num_outside;
    counts.num_occluded += other.counts.num_occluded;
    counts.num_no_common += other.counts.num_no_common;
    counts.num_agreeing += other.counts.num_agreeing;
    counts.num_disagreeing += other.counts.num_disagreeing;
    gaps.Add(other.gaps);
  }

  PairAgreement Finish() const {
    PairAgreement result = counts;
    result.median_gap_m = gaps.QuantileM(0.5);
    result.percentile_99_gap_m = gaps.QuantileM(0.99);
    return result;
  }
};

/// Compares the map of one camera with that of another.
class PairComparison {
 public:
  PairComparison(const RayScene& scene,
                 double max_distance_m,
                 const MapView& from,
                 const MapView& to)
      : scene_(scene), max_distance_m_(max_distance_m), from_(from), to_(to) {}

  void ComparePixel(int x, int y, Tally& tally) const {
    const double distance_m = from_.distance_m.At(x, y);
    const std::optional<Vec3d> direction = from_.DirectionWorld(x, y);
    if (!direction || !std::isfinite(distance_m) || distance_m <= 0.0) {
      return;
    }
    ++tally.counts.num_sampled;
    const Vec3d point_m = from_.CentreM() + distance_m * *direction;
    const std::optional<Vec2d> pixel_px = to_.lens->Project(to_.camera_from_world.Point(point_m));
    if (!pixel_px) {
      ++tally.counts.num_outside;
      return;
    }
    if (IsOccluded(point_m)) {
      ++tally.counts.num_occluded;
      return;
    }
    // A point where the scene has nothing at all cannot agree with anything.
    double gap_m = std::numeric_limits<double>::infinity();
    if (const std::optional<RayHit> hit = scene_.Intersect(from_.CentreM(), *direction)) {
      const Vec3d hit_m = from_.CentreM() + hit->distance_m * *direction;
      const std::optional<Vec3d> other_m = CommonPoint(*hit, hit_m, *pixel_px);
      if (!other_m) {
        ++tally.counts.num_no_common;
        return;
      }
      gap_m = std::abs(hit->geometric_normal.dot(*other_m - point_m));
    }
    tally.gaps.Add(gap_m);
    const bool agrees = gap_m <= kAgreementM + kAgreementRelative * distance_m;
    ++(agrees ? tally.counts.num_agreeing : tally.counts.num_disagreeing);
  }

 private:
  bool IsOccluded(const Vec3d& point_m) const {
    const Vec3d to_point_m = point_m - to_.CentreM();
    const double distance_m = to_point_m.norm();
    const std::optional<RayHit> hit = scene_.Intersect(to_.CentreM(), to_point_m / distance_m);
    return hit && hit->distance_m < distance_m - (kAgreementM + kAgreementRelative * distance_m);
  }

  static bool IsSameSurface(const RayHit& a, const Vec3d& a_m, const RayHit& b, const Vec3d& b_m) {
    if (a.mesh_idx == b.mesh_idx && a.triangle_idx == b.triangle_idx) {
      return true;
    }
    return std::abs(a.geometric_normal.dot(b.geometric_normal)) > kSameNormalCosine &&
           std::abs(a.geometric_normal.dot(b_m - a_m)) < kSamePlaneM;
  }

  /// The point that the other map has for the pixel nearest to `pixel_px` that shows the surface of
  /// `hit`.
  std::optional<Vec3d> CommonPoint(const RayHit& hit,
                                   const Vec3d& hit_m,
                                   const Vec2d& pixel_px) const {
    const int centre_x = static_cast<int>(std::floor(pixel_px.x()));
    const int centre_y = static_cast<int>(std::floor(pixel_px.y()));
    std::array<std::pair<double, std::pair<int, int>>, 9> candidates;
    for (int i = 0; i < 9; ++i) {
      const int x = centre_x + i % 3 - 1;
      const int y = centre_y + i / 3 - 1;
      candidates[i] = {(Vec2d(x + 0.5, y + 0.5) - pixel_px).squaredNorm(), {x, y}};
    }
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [squared_px2, pixel] : candidates) {
      const auto& [x, y] = pixel;
      if (x < 0 || x >= to_.distance_m.WidthPx() || y < 0 || y >= to_.distance_m.HeightPx()) {
        continue;
      }
      const std::optional<Vec3d> direction = to_.DirectionWorld(x, y);
      const std::optional<RayHit> other =
          direction ? scene_.Intersect(to_.CentreM(), *direction, max_distance_m_) : std::nullopt;
      if (other &&
          IsSameSurface(hit, hit_m, *other, to_.CentreM() + other->distance_m * *direction)) {
        return to_.CentreM() + to_.distance_m.At(x, y) * *direction;
      }
    }
    return std::nullopt;
  }

  const RayScene& scene_;
  double max_distance_m_;
  const MapView& from_;
  const MapView& to_;
};

/// Two cameras with distance maps of the same frame through the same lens, the first earlier in the
/// rig.
struct MapPair {
  std::string lens;
  std::array<std::string, 2> cameras;
  int frame = 0;
};

std::vector<MapPair> PairsOnDisk(const CheckContext& context) {
  std::set<std::pair<std::string, std::pair<std::string, int>>> maps;
  std::set<int> frames;
  for (const CheckedView& view : context.views) {
    if (view.Has(Output::kDistance)) {
      maps.insert({view.lens, {view.camera, view.frame}});
      frames.insert(view.frame);
    }
  }
  std::vector<MapPair> pairs;
  const std::vector<std::string>& cameras = context.reader.Cameras();
  for (const std::string& lens : context.reader.Lenses()) {
    for (size_t i = 0; i < cameras.size(); ++i) {
      for (size_t j = i + 1; j < cameras.size(); ++j) {
        for (const int frame : frames) {
          if (maps.contains({lens, {cameras[i], frame}}) &&
              maps.contains({lens, {cameras[j], frame}})) {
            pairs.push_back({lens, {cameras[i], cameras[j]}, frame});
          }
        }
      }
    }
  }
  return pairs;
}

MapView ReadMap(const SequenceReader& reader,
                const std::string& lens,
                const std::string& camera,
                int frame) {
  const RigidTransform world_from_camera = reader.WorldFromCamera(camera, frame);
  return {&reader.LensOf(lens),
          world_from_camera,
          world_from_camera.Inverse(),
          reader.ReadDistance(lens, camera, frame)};
}

Tally CompareMaps(const CheckContext& context, const MapView& from, const MapView& to) {
  const PairComparison comparison(*context.scene, context.reader.MaxDistanceM(), from, to);
  const int stride_px = context.StridePx();
  const int first_px = stride_px / 2;
  const int num_rows = (context.reader.HeightPx() - first_px + stride_px - 1) / stride_px;
  std::vector<Tally> rows(static_cast<size_t>(std::max(0, num_rows)));
  ParallelFor(rows.size(), context.options.num_threads, [&](size_t row) {
    const int y = first_px + static_cast<int>(row) * stride_px;
    for (int x = first_px; x < context.reader.WidthPx(); x += stride_px) {
      comparison.ComparePixel(x, y, rows[row]);
    }
  });
  Tally sum;
  for (const Tally& row : rows) {
    sum.Add(row);
  }
  return sum;
}

void ReportDisagreement(const PairAgreement& pair, CheckReport& report) {
  if (pair.AgreeingShare() >= kLeastAgreeingShare) {
    return;
  }
  const auto file = [&](const std::string& camera) {
    return FrameFile{pair.lens, camera, Output::kDistance, pair.frame}
        .RelativePath()
        .generic_string();
  };
  report.AddFault(file(pair.from_camera),
                  fmt::format("agrees with {} in {:.3f} % of {} points that both see, expected {} "
                              "% (median gap {:.2g} m)",
                              file(pair.to_camera),
                              100.0 * pair.AgreeingShare(),
                              pair.NumCompared(),
                              100.0 * kLeastAgreeingShare,
                              pair.median_gap_m));
}

/// Adds to the total of the same lens and direction, or starts one.
void AddToTotals(const Tally& tally, std::vector<Tally>& totals) {
  const PairAgreement& counts = tally.counts;
  const auto same = std::find_if(totals.begin(), totals.end(), [&](const Tally& total) {
    return total.counts.lens == counts.lens && total.counts.from_camera == counts.from_camera &&
           total.counts.to_camera == counts.to_camera;
  });
  if (same != totals.end()) {
    same->Add(tally);
    return;
  }
  totals.push_back(tally);
  totals.back().counts.frame = -1;
}

}  // namespace

void CheckPairs(const CheckContext& context, CheckReport& report) {
  if (context.scene == nullptr) {
    return;
  }
  const std::vector<MapPair> pairs = PairsOnDisk(context);
  if (pairs.empty()) {
    return;
  }
  std::vector<Tally> totals;
  Progress progress("agreement between cameras", pairs.size(), context.options.quiet);
  for (const MapPair& pair : pairs) {
    std::array<MapView, 2> maps;
    try {
      for (size_t i = 0; i < maps.size(); ++i) {
        maps[i] = ReadMap(context.reader, pair.lens, pair.cameras[i], pair.frame);
      }
    } catch (const InputError&) {
      progress.Advance();
      continue;  // Told by the check of the images.
    }
    for (const size_t from : {0, 1}) {
      Tally tally = CompareMaps(context, maps[from], maps[1 - from]);
      tally.counts.lens = pair.lens;
      tally.counts.from_camera = pair.cameras[from];
      tally.counts.to_camera = pair.cameras[1 - from];
      tally.counts.frame = pair.frame;
      AddToTotals(tally, totals);
      report.pairs.push_back(tally.Finish());
      ReportDisagreement(report.pairs.back(), report);
    }
    progress.Advance();
  }
  progress.Finish();
  for (const Tally& total : totals) {
    report.pair_totals.push_back(total.Finish());
  }
}

}  // namespace pfseq
