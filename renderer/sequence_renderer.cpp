// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence_renderer.h"

#include "renderer/core/error.h"
#include "renderer/core/progress.h"
#include "renderer/lens/trajectory_file.h"
#include "renderer/record_renderer.h"
#include "renderer/sequence/poses_file.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/studio.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include <sys/resource.h>

namespace pfseq {
namespace {

/// CPU seconds of the process so far.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Positions in `items` of the selected names, in the order of `items`; all when nothing is
/// selected.
template <typename Items, typename NameOf>
std::vector<size_t> Select(const std::vector<std::string>& selected,
                           const Items& items,
                           const NameOf& name_of,
                           const char* flag) {
  std::string known;
  std::vector<size_t> indices;
  for (size_t i = 0; i < items.size(); ++i) {
    const std::string& name = name_of(items[i]);
    known += (known.empty() ? "" : ", ") + name;
    if (selected.empty() || std::find(selected.begin(), selected.end(), name) != selected.end()) {
      indices.push_back(i);
    }
  }
  for (const std::string& name : selected) {
    const auto is_name = [&](const auto& item) { return name_of(item) == name; };
    if (std::none_of(items.begin(), items.end(), is_name)) {
      throw InputError("{} {}: the sequence has {}", flag, name, known);
    }
  }
  return indices;
}

std::vector<Record> SelectRecords(const Studio& studio, const RenderOptions& options) {
  const auto num_frames = static_cast<int>(studio.Poses().size());
  std::vector<int> frames = options.frames;
  if (frames.empty()) {
    frames.resize(static_cast<size_t>(num_frames));
    std::iota(frames.begin(), frames.end(), 0);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  for (const int frame : {frames.front(), frames.back()}) {
    if (frame < 0 || frame >= num_frames) {
      throw InputError("--frames {}: the sequence has frames 0 to {}", frame, num_frames - 1);
    }
  }
  const auto name_of = [](const auto& item) -> const std::string& { return item.name; };
  std::vector<Record> records;
  for (const int frame : frames) {
    for (const size_t camera_idx :
         Select(options.cameras, studio.Rig().cameras, name_of, "--cameras")) {
      for (const size_t lens_idx :
           Select(options.lenses, studio.Rig().lenses, name_of, "--lenses")) {
        records.push_back({frame, camera_idx, lens_idx});
      }
    }
  }
  return records;
}

std::vector<DescriptionFile> DescriptionFiles(const SequenceInput& input, const Studio& studio) {
  std::vector<DescriptionFile> files = input.files;
  files.push_back({std::string(kRigFile), studio.Rig().ToYaml()});
  files.push_back({std::string(kPosesFile), PosesCsv(studio.Poses())});
  for (const RigCamera& camera : studio.Rig().cameras) {
    std::vector<StampedPose> world_from_camera = studio.Poses();
    for (StampedPose& pose : world_from_camera) {
      pose.world_from_rig = pose.world_from_rig * camera.rig_from_camera;
    }
    files.push_back({TrajectoryFile(camera.name), TumText(world_from_camera)});
    if (input.spec.shutter.exposure_s > 0.0) {
      const Vec2d span_s = Shutter(input.spec.shutter).SpanS();
      std::vector<StampedPose> ends;
      for (const StampedPose& pose : studio.Poses()) {
        for (const double after_s : {span_s.x(), span_s.y()}) {
          ends.push_back({pose.time_s + after_s,
                          studio.WorldFromRig(pose.time_s + after_s) * camera.rig_from_camera});
        }
      }
      files.push_back({ExposureFile(camera.name), TumText(ends)});
    }
  }
  return files;
}

/// The outputs that a description asks for unless told otherwise; pictures in their file format.
RenderOptions WithOutputs(RenderOptions options, const SequenceSpec& spec) {
  if (options.outputs.empty()) {
    options.outputs = {Output::kClean, Output::kDistance, Output::kSky};
    if (spec.IsRealistic()) {
      options.outputs.insert(options.outputs.begin(), Output::kRealistic);
    }
  }
  if (spec.sensor.jpeg_quality > 0) {
    std::replace(
        options.outputs.begin(), options.outputs.end(), Output::kRealistic, Output::kRealisticJpeg);
  }
  return options;
}

}  // namespace

RigFile MakeRigFile(const SequenceSpec& spec) {
  RigFile rig{spec.image.size_px[0],
              spec.image.size_px[1],
              spec.ground_truth.max_distance_m,
              MakeCameras(spec),
              MakeLenses(spec),
              {}};
  const LateralColorSpec lateral = ScaledOptics(spec.optics, spec.image.size_px[0]).lateral_color;
  if (lateral.rim_px != 0.0) {
    for (const Named<Lens>& lens : rig.lenses) {
      rig.channel_polynomials.push_back(
          LateralColor(lateral.rim_px, lateral.cubic, 0.5 * lens.value.CirclePx())
              .ChannelPolynomials());
    }
  }
  return rig;
}

RenderSummary RenderSequence(const SequenceInput& input, const RenderOptions& given_options) {
  // A scene that is shared was made before, for others as well.
  const double start_s = input.lit_scene != nullptr ? CpuSeconds() : 0.0;
  const RenderOptions options = WithOutputs(given_options, input.spec);
  PFSEQ_CHECK(options.num_shards >= 1 && options.shard_idx >= 0 &&
              options.shard_idx < options.num_shards);
  Studio studio(input, options.num_threads);
  const std::vector<Record> records = SelectRecords(studio, options);
  const SequenceWriter writer(
      options.folder, DescriptionFiles(input, studio), options.on_existing, options.sibling);
  const RecordRenderer renderer(studio, input.spec, writer, options);

  RenderSummary summary;
  std::vector<std::pair<Record, std::vector<Output>>> work;
  std::vector<FrameFile> expected;
  for (size_t i = 0; i < records.size(); ++i) {
    for (const Output output : options.outputs) {
      expected.push_back(studio.FileOf(records[i], output));
    }
    if (static_cast<int>(i % static_cast<size_t>(options.num_shards)) == options.shard_idx) {
      ++summary.num_records;
      for (const Output output : options.sibling_outputs) {
        writer.LinkFrameFile(studio.FileOf(records[i], output));
      }
      std::vector<Output> missing = renderer.Missing(records[i]);
      summary.num_files_kept += static_cast<int>(options.outputs.size() - missing.size());
      if (!missing.empty()) {
        work.emplace_back(records[i], std::move(missing));
      }
    }
  }

  const uint64_t pixels_a_rendering =
      static_cast<uint64_t>(studio.Rig().width_px) * studio.Rig().height_px;
  uint64_t num_renderings = 0;
  for (const auto& [record, outputs] : work) {
    num_renderings += static_cast<uint64_t>(renderer.NumRenderings(record, outputs));
  }
  const double light_start_s = CpuSeconds();
  if (studio.UsesCachedLight() && num_renderings > 0) {
    studio.LoadLight(options.light_cache);
    std::vector<RasterView> views;
    for (const auto& [record, outputs] : work) {
      const std::vector<RasterView> lit = renderer.LitViews(record, outputs);
      views.insert(views.end(), lit.begin(), lit.end());
    }
    studio.Light().Prepare(views, studio.Sampling(), options.num_threads, options.quiet);
  }
  const double frames_start_s = CpuSeconds();
  // Without colour each record is one step; with colour the pixels are what takes the time.
  Progress progress("render",
                    num_renderings > 0 ? num_renderings * pixels_a_rendering : work.size(),
                    options.quiet);
  for (const auto& [record, outputs] : work) {
    const FrameFile file = studio.FileOf(record, outputs.front());
    progress.SetDetail(fmt::format("frame {} {} {}", file.frame, file.camera, file.lens));
    renderer.Render(record, outputs, progress);
    summary.num_files_written += static_cast<int>(outputs.size());
    if (num_renderings == 0) {
      progress.Advance();
    }
  }
  progress.Finish();
  const double frames_end_s = CpuSeconds();
  if (studio.UsesCachedLight() && num_renderings > 0) {
    studio.Light().Save();
    if (!options.quiet) {
      fmt::print(stderr, "{}\n", studio.Light().Summary());
    }
  }
  if (!options.quiet) {
    fmt::print(stderr,
               "CPU time: start {:.2f} s, light {:.2f} s, {} records {:.2f} s\n",
               light_start_s - start_s,
               frames_start_s - light_start_s,
               work.size(),
               frames_end_s - frames_start_s);
  }
  summary.is_complete = writer.FinishIfComplete(expected, options.num_threads);
  return summary;
}

std::string DescribePixel(const SequenceInput& input, const FrameFile& record, int x, int y) {
  Studio studio(input, 1);
  RenderOptions selection;
  selection.frames = {record.frame};
  selection.cameras = {record.camera};
  selection.lenses = {record.lens};
  const std::vector<Record> records = SelectRecords(studio, selection);
  const View view = studio.ViewOf(records.front());
  if (x < 0 || y < 0 || x >= view.width_px || y >= view.height_px) {
    throw InputError("--pixel {},{}: the image is {} x {} px", x, y, view.width_px, view.height_px);
  }
  std::string text =
      fmt::format("pixel {},{} of {}\n",
                  x,
                  y,
                  studio.FileOf(records.front(), Output::kClean).RelativePath().string());
  const std::optional<Vec3d> direction_camera = view.lens->Unproject(Vec2d(x + 0.5, y + 0.5));
  if (!direction_camera.has_value()) {
    return text + "centre: outside the image circle\n";
  }
  const Vec3d direction_world = view.world_from_camera.Direction(*direction_camera);
  text += fmt::format(
      "direction_world: {} {} {}\n", direction_world.x(), direction_world.y(), direction_world.z());
  const std::optional<RayHit> hit =
      studio.Rays().Intersect(view.world_from_camera.translation_m, direction_world);
  if (hit.has_value()) {
    const Mesh& mesh = input.scene->meshes[hit->mesh_idx];
    const Vec3d point_m = view.world_from_camera.translation_m + hit->distance_m * direction_world;
    text += fmt::format(
        "distance_m: {}\npoint_world_m: {} {} {}\nmesh: {}, triangle {}\nmaterial: {}\n",
        hit->distance_m,
        point_m.x(),
        point_m.y(),
        point_m.z(),
        mesh.name,
        hit->triangle_idx,
        input.scene->materials[static_cast<size_t>(mesh.material_idx)].name);
  } else {
    text += "distance_m: inf (sky)\n";
  }
  const Rgb radiance = RenderPixel(studio.Tracer(), view, input.spec.render.samples, x, y);
  text += fmt::format("radiance: {} {} {}\n", radiance[0], radiance[1], radiance[2]);
  return text;
}

}  // namespace pfseq
