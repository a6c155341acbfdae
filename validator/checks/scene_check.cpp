// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/scene_check.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr double kRelativeTolerance = 1e-5;
/// A ray that passes an edge closer than this may fall on either side of it by rounding alone (the
/// ray tracer's float arithmetic widens a large triangle by some micrometres). A pixel of a 1200 px
/// image is 260 times as wide.
constexpr double kEdgeRad = 1e-5;
/// A map shows a view when no more than this share of its pixels contradicts.
constexpr double kShowsShare = 0.99;
/// With more agreement than this a map alone is taken for a damaged one of the right view.
constexpr double kPartlyShare = 0.5;
constexpr int kNumTriedPixels = 256;

/// Where and how a map is thought to have been taken.
struct Station {
  const Lens* lens = nullptr;
  RigidTransform world_from_camera;
};

struct MapComparison {
  size_t num_compared = 0;
  /// Those that are not sky both in the map and in the scene: sky looks alike from everywhere.
  size_t num_telling = 0;
  size_t num_differing = 0;
  double max_relative_error = 0.0;
  /// Of the first pixel that differs.
  std::string first_difference;
  size_t num_sky_differing = 0;
  std::string first_sky_difference;

  double AgreeingShare() const {
    return num_telling == 0
               ? 1.0
               : 1.0 - static_cast<double>(num_differing) / static_cast<double>(num_telling);
  }
};

/// One map against the scene.
class MapCaster {
 public:
  MapCaster(const RayScene& scene, double max_distance_m, const Image<float>& distance_m)
      : scene_(scene), max_distance_m_(max_distance_m), distance_m_(distance_m) {}

  /// The distance along a direction of the camera; +inf where nothing is hit, at any distance.
  double Cast(const Station& station, const Vec3d& direction_camera) const {
    const std::optional<RayHit> hit =
        scene_.Intersect(station.world_from_camera.translation_m,
                         station.world_from_camera.Direction(direction_camera));
    return hit ? hit->distance_m : std::numeric_limits<double>::infinity();
  }

  /// |found - cast| / cast; infinite when one of them is beyond the maximum and the other is not.
  double RelativeError(float found_m, double cast_m) const {
    const bool found_far = std::isinf(found_m);
    if (found_far && cast_m > max_distance_m_ * (1.0 - kRelativeTolerance)) {
      return 0.0;
    }
    if (found_far || !(cast_m <= max_distance_m_ * (1.0 + kRelativeTolerance))) {
      return std::numeric_limits<double>::infinity();
    }
    return std::abs(found_m - cast_m) / cast_m;
  }

  /// True when a ray closer than kEdgeRad agrees with the map: the pixel's centre lies on an edge.
  bool AgreesBesideEdge(const Station& station,
                        const Vec3d& direction_camera,
                        float found_m) const {
    const Vec3d side = direction_camera.unitOrthogonal();
    const Vec3d other_side = direction_camera.cross(side);
    for (const Vec3d& offset : {side, Vec3d(-side), other_side, Vec3d(-other_side)}) {
      const double cast_m = Cast(station, (direction_camera + kEdgeRad * offset).normalized());
      if (RelativeError(found_m, cast_m) <= kRelativeTolerance) {
        return true;
      }
    }
    return false;
  }

  /// Compares every stride-th pixel; the sky mask too when there is one.
  MapComparison Compare(const Station& station, int stride_px, const Image<uint8_t>* sky) const {
    MapComparison comparison;
    for (int y = stride_px / 2; y < distance_m_.HeightPx(); y += stride_px) {
      for (int x = stride_px / 2; x < distance_m_.WidthPx(); x += stride_px) {
        const std::optional<Vec3d> direction_camera =
            station.lens->Unproject(Vec2d(x + 0.5, y + 0.5));
        if (direction_camera) {
          ComparePixel(station, *direction_camera, x, y, sky, comparison);
        }
      }
    }
    return comparison;
  }

  /// The share of a few pixels, spread over the image, that agree with a station.
  double QuickAgreement(const Station& station) const {
    size_t num_compared = 0;
    size_t num_agreeing = 0;
    const auto per_side = static_cast<int>(std::sqrt(kNumTriedPixels));
    for (int i = 0; i < per_side * per_side; ++i) {
      const int x = (2 * (i % per_side) + 1) * distance_m_.WidthPx() / (2 * per_side);
      const int y = (2 * (i / per_side) + 1) * distance_m_.HeightPx() / (2 * per_side);
      const std::optional<Vec3d> direction_camera =
          station.lens->Unproject(Vec2d(x + 0.5, y + 0.5));
      const float found_m = distance_m_.At(x, y);
      if (!direction_camera || !std::isfinite(found_m)) {
        continue;
      }
      ++num_compared;
      num_agreeing +=
          RelativeError(found_m, Cast(station, *direction_camera)) <= kRelativeTolerance ? 1 : 0;
    }
    return num_compared == 0
               ? 0.0
               : static_cast<double>(num_agreeing) / static_cast<double>(num_compared);
  }

 private:
  void ComparePixel(const Station& station,
                    const Vec3d& direction_camera,
                    int x,
                    int y,
                    const Image<uint8_t>* sky,
                    MapComparison& comparison) const {
    const float found_m = distance_m_.At(x, y);
    const double cast_m = Cast(station, direction_camera);
    const double error = RelativeError(found_m, cast_m);
    ++comparison.num_compared;
    comparison.num_telling += std::isinf(found_m) && std::isinf(cast_m) ? 0 : 1;
    if (error <= kRelativeTolerance) {
      comparison.max_relative_error = std::max(comparison.max_relative_error, error);
      const bool is_sky = std::isinf(cast_m);
      if (sky != nullptr && (sky->At(x, y) != 0) != is_sky) {
        if (comparison.num_sky_differing++ == 0) {
          comparison.first_sky_difference = fmt::format("({}, {})", x, y);
        }
      }
    } else if (!AgreesBesideEdge(station, direction_camera, found_m)) {
      if (comparison.num_differing++ == 0) {
        comparison.first_difference =
            fmt::format("({}, {}): {:.6g} m instead of {:.6g} m", x, y, found_m, cast_m);
      }
    }
  }

  const RayScene& scene_;
  double max_distance_m_;
  const Image<float>& distance_m_;
};

enum class Verdict {
  kShows,
  kFewPixels,  ///< all but a few pixels
  kOtherView,  ///< what another camera, frame or lens sees
  kPartly,     ///< about half of it or more: surfaces along which the camera was shifted look alike
  kNothing,
  kUnread,
};

struct JudgedView {
  CheckedView view;
  Verdict verdict = Verdict::kUnread;
  MapComparison comparison;
  /// Of kOtherView: whose view it is.
  std::string other_view;
  /// The fault of this map has been told together with that of others.
  bool is_told = false;

  /// Not what the pose says, and not another view either.
  bool IsUnexplained() const {
    return !is_told && (verdict == Verdict::kPartly || verdict == Verdict::kNothing);
  }
};

/// What other view a map shows, of all that the sequence has; nothing when none fits.
std::optional<std::string> FindOtherView(const CheckContext& context,
                                         const CheckedView& view,
                                         const MapCaster& caster) {
  for (const std::string& lens : context.reader.Lenses()) {
    for (const std::string& camera : context.reader.Cameras()) {
      for (size_t frame = 0; frame < context.reader.Poses().size(); ++frame) {
        const int frame_idx = static_cast<int>(frame);
        if (lens == view.lens && camera == view.camera && frame_idx == view.frame) {
          continue;
        }
        const Station station{&context.reader.LensOf(lens),
                              context.reader.WorldFromCamera(camera, frame_idx)};
        if (caster.QuickAgreement(station) >= kShowsShare) {
          return fmt::format("{}'s view of frame {}{}",
                             camera,
                             frame,
                             lens == view.lens ? std::string() : fmt::format(" through {}", lens));
        }
      }
    }
  }
  return std::nullopt;
}

JudgedView Judge(const CheckContext& context, const CheckedView& view) {
  JudgedView result;
  result.view = view;
  Image<float> distance_m;
  std::optional<Image<uint8_t>> sky;
  try {
    distance_m = context.reader.ReadDistance(view.lens, view.camera, view.frame);
    if (view.Has(Output::kSky)) {
      sky = context.reader.ReadSky(view.lens, view.camera, view.frame);
    }
  } catch (const InputError&) {
    if (distance_m.Empty()) {
      return result;  // Told by the check of the images.
    }
  }
  const MapCaster caster(*context.scene, context.reader.MaxDistanceM(), distance_m);
  const Station station{&context.reader.LensOf(view.lens),
                        context.reader.WorldFromCamera(view.camera, view.frame)};
  result.comparison = caster.Compare(station, context.StridePx(), sky ? &*sky : nullptr);
  if (result.comparison.num_differing == 0) {
    result.verdict = Verdict::kShows;
  } else if (result.comparison.AgreeingShare() >= kShowsShare) {
    result.verdict = Verdict::kFewPixels;
  } else if (const std::optional<std::string> other = FindOtherView(context, view, caster)) {
    result.verdict = Verdict::kOtherView;
    result.other_view = *other;
  } else {
    result.verdict =
        result.comparison.AgreeingShare() >= kPartlyShare ? Verdict::kPartly : Verdict::kNothing;
  }
  return result;
}

/// Something that views share, and that is suspected when the maps of all of them fail.
struct SharedCause {
  /// Which group a view belongs to, as the beginning of the fault's text.
  std::function<std::string(const CheckedView&)> group;
  std::string file;
  std::string suspicion;
};

/// Tells once, as a fault of what they share, what at least two maps have that all fail
/// unexplained.
void BlameShared(const SharedCause& cause, std::vector<JudgedView>& judged, CheckReport& report) {
  std::map<std::string, std::vector<JudgedView*>> groups;
  for (JudgedView& one : judged) {
    if (one.verdict != Verdict::kUnread) {
      groups[cause.group(one.view)].push_back(&one);
    }
  }
  for (const auto& [name, members] : groups) {
    const bool all_fail = std::all_of(
        members.begin(), members.end(), [](const JudgedView* one) { return one->IsUnexplained(); });
    if (members.size() < 2 || !all_fail) {
      continue;
    }
    report.AddFault(cause.file,
                    fmt::format("{}none of {} distance maps shows {} from the stored pose: {}",
                                name,
                                members.size(),
                                kSceneFile,
                                cause.suspicion));
    for (JudgedView* one : members) {
      one->is_told = true;
    }
  }
}

void BlameAllShared(std::vector<JudgedView>& judged, CheckReport& report) {
  const bool has_many_frames = std::any_of(judged.begin(), judged.end(), [&](const auto& one) {
    return one.view.frame != judged.front().view.frame;
  });
  if (has_many_frames) {
    BlameShared({[](const CheckedView&) { return std::string(); },
                 std::string(kSceneFile),
                 "another scene, or edited calibration or poses?"},
                judged,
                report);
  }
  BlameShared({[](const CheckedView& view) { return fmt::format("frame {}: ", view.frame); },
               std::string(kPosesFile),
               "edited pose?"},
              judged,
              report);
  BlameShared({[](const CheckedView& view) { return fmt::format("camera {}: ", view.camera); },
               std::string(kRigFile),
               "edited calibration?"},
              judged,
              report);
  BlameShared({[](const CheckedView& view) { return fmt::format("lens {}: ", view.lens); },
               std::string(kRigFile),
               "edited calibration?"},
              judged,
              report);
}

void ReportOne(const JudgedView& judged, CheckReport& report) {
  const MapComparison& comparison = judged.comparison;
  const std::string file = judged.view.File(Output::kDistance);
  const std::string difference = fmt::format("{} of {} compared pixels differ, first {}",
                                             comparison.num_differing,
                                             comparison.num_compared,
                                             comparison.first_difference);
  if (judged.verdict == Verdict::kOtherView) {
    // Its sky mask may well be the right one; whether the two fit is another check's.
    report.AddFault(file, fmt::format("shows {}: swapped?", judged.other_view));
    return;
  }
  if (judged.verdict == Verdict::kFewPixels ||
      (judged.verdict == Verdict::kPartly && judged.IsUnexplained())) {
    report.AddFault(
        file, fmt::format("differs from {} in part: {}: damaged map?", kSceneFile, difference));
  } else if (judged.IsUnexplained()) {
    report.AddFault(
        file,
        fmt::format("does not show {} from the pose of frame {} ({}): edited pose or damaged map?",
                    kSceneFile,
                    judged.view.frame,
                    difference));
  }
  if (comparison.num_sky_differing > 0) {
    report.AddFault(judged.view.File(Output::kSky),
                    fmt::format("{} pixels contradict {}, first {}",
                                comparison.num_sky_differing,
                                kSceneFile,
                                comparison.first_sky_difference));
  }
}

}  // namespace

void CheckScene(const CheckContext& context, CheckReport& report) {
  if (context.scene == nullptr) {
    return;
  }
  std::vector<CheckedView> views;
  std::copy_if(context.views.begin(),
               context.views.end(),
               std::back_inserter(views),
               [](const CheckedView& view) { return view.Has(Output::kDistance); });
  std::vector<JudgedView> judged(views.size());
  Progress progress("distance maps against the scene", views.size(), context.options.quiet);
  ParallelFor(views.size(), context.options.num_threads, [&](size_t i) {
    judged[i] = Judge(context, views[i]);
    progress.Advance();
  });
  progress.Finish();

  for (const JudgedView& one : judged) {
    if (one.verdict != Verdict::kUnread) {
      ++report.num_maps_recast;
      report.num_pixels_recast += one.comparison.num_compared;
      report.max_relative_error =
          std::max(report.max_relative_error, one.comparison.max_relative_error);
    }
  }
  BlameAllShared(judged, report);
  for (const JudgedView& one : judged) {
    ReportOne(one, report);
  }
}

}  // namespace pfseq
