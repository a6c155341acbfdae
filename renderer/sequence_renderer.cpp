// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence_renderer.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "renderer/film/sensor.h"
#include "renderer/frame_renderer.h"
#include "renderer/ground_truth.h"
#include "renderer/lens/trajectory_file.h"
#include "renderer/sequence/poses_file.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/path_tracer.h"
#include "renderer/trace/ray_scene.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include <sys/resource.h>

namespace pfseq {
namespace {

/// One camera with one lens at one frame.
struct Record {
  int frame = 0;
  size_t camera_idx = 0;
  size_t lens_idx = 0;
};

/// CPU seconds of the process so far.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Standard error of a pixel at which it gets no more samples, relative to its value.
constexpr float kNoiseTolerance = 0.06F;

/// Stands for all that the light in a scene depends on.
std::string LightHash(const SequenceInput& input) {
  SequenceSpec light_alone;
  light_alone.light = input.spec.light;
  // Its bytes count, not its name.
  light_alone.light.sky.map.clear();
  std::string text = CanonicalYaml(light_alone);
  for (const DescriptionFile& file : input.files) {
    if (file.name == kSceneFile || file.name == kExrSkyMapFile || file.name == kHdrSkyMapFile) {
      text += Sha256Hex(file.bytes);
    }
  }
  return Sha256Hex(text);
}

/// All that the frames of a sequence share, built once.
class Studio {
 public:
  Studio(const SequenceInput& input, int num_threads)
      : input_(input),
        spec_(input.spec),
        rig_(MakeRigFile(input.spec)),
        poses_(FramePoses(input.spec.trajectory)),
        scene_(input.scene),
        textures_(*input.scene),
        lighting_(input.lighting != nullptr ? input.lighting
                                            : std::make_shared<const Lighting>(MakeLighting(
                                                  input.spec.light, input.scene->sun))),
        tracer_(scene_,
                textures_,
                *lighting_,
                PathTracerOptions{.max_bounces = input.spec.render.max_bounces,
                                  .min_indirect_roughness = static_cast<float>(
                                      input.spec.render.min_indirect_roughness)}) {
    for (const auto& lens : rig_.lenses) {
      rasters_.push_back(
          std::make_unique<LensRaster>(lens.value, rig_.width_px, rig_.height_px, num_threads));
    }
  }

  bool UsesCachedLight() const { return spec_.render.light == "cached"; }

  /// Loads the stored light; the tracer of UsesCachedLight.
  void LoadLight(const LightCacheOptions& options) {
    std::vector<Vec3d> positions_m;
    for (const StampedPose& pose : poses_) {
      positions_m.push_back(pose.world_from_rig.translation_m);
    }
    light_ = std::make_unique<CachedLight>(
        scene_, textures_, *lighting_, spec_.render, positions_m, LightHash(input_), options);
  }
  CachedLight& Light() const { return *light_; }
  const LensRaster& RasterOf(const Record& record) const { return *rasters_[record.lens_idx]; }

  PixelSampling Sampling() const {
    // White paint in the open, without the sun, is pi times as bright as this.
    const float reference = Luminance(lighting_->sky.HorizontalIrradiance()) / 10.0F;
    return {spec_.render.samples, spec_.render.max_samples, kNoiseTolerance, reference};
  }

  const RigFile& Rig() const { return rig_; }
  const std::vector<StampedPose>& Poses() const { return poses_; }
  const PathTracer& Tracer() const { return tracer_; }
  const RayScene& Rays() const { return scene_; }

  View ViewOf(const Record& record) const {
    // Keyed by the place in the description, not in the selection: a frame is the same whatever
    // else is rendered.
    constexpr uint64_t kMaxLenses = 1024;
    return {&rig_.lenses[record.lens_idx].value,
            poses_[static_cast<size_t>(record.frame)].world_from_rig *
                rig_.cameras[record.camera_idx].rig_from_camera,
            rig_.width_px,
            rig_.height_px,
            spec_.render.seed,
            static_cast<uint64_t>(record.frame),
            record.camera_idx * kMaxLenses + record.lens_idx};
  }

  FrameFile FileOf(const Record& record, Output output) const {
    return {rig_.lenses[record.lens_idx].name,
            rig_.cameras[record.camera_idx].name,
            output,
            record.frame};
  }

 private:
  const SequenceInput& input_;
  const SequenceSpec& spec_;
  RigFile rig_;
  std::vector<StampedPose> poses_;
  RayScene scene_;
  TextureSet textures_;
  std::shared_ptr<const Lighting> lighting_;
  PathTracer tracer_;
  std::vector<std::unique_ptr<LensRaster>> rasters_;
  std::unique_ptr<CachedLight> light_;
};

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
  }
  return files;
}

/// Renders the outputs of a record that are not there yet.
class RecordRenderer {
 public:
  RecordRenderer(const Studio& studio,
                 const SequenceSpec& spec,
                 const SequenceWriter& writer,
                 const RenderOptions& options)
      : studio_(studio), spec_(spec), writer_(writer), options_(options) {}

  std::vector<Output> Missing(const Record& record) const {
    std::vector<Output> missing;
    for (const Output output : options_.outputs) {
      if (!writer_.Has(studio_.FileOf(record, output))) {
        missing.push_back(output);
      }
    }
    return missing;
  }

  void Render(const Record& record, const std::vector<Output>& outputs, Progress& progress) const {
    const View view = studio_.ViewOf(record);
    const auto wanted = [&](Output output) {
      return std::find(outputs.begin(), outputs.end(), output) != outputs.end();
    };
    GroundTruth truth;
    if (wanted(Output::kDistance) || wanted(Output::kSky)) {
      truth = RenderGroundTruth(studio_.Rays(),
                                studio_.RasterOf(record),
                                view.world_from_camera,
                                spec_.ground_truth.max_distance_m,
                                options_.num_threads);
    }
    Image<float> radiance;
    if (wanted(Output::kClean) || wanted(Output::kLinear)) {
      const FrameFile file = studio_.FileOf(record, Output::kClean);
      const auto describe_pixel = [&](int x, int y) {
        return fmt::format(
            "to repeat: pfseq render {} --frames {} --cameras {} --lenses {} --pixel {},{}",
            (options_.folder / kSequenceFile).string(),
            file.frame,
            file.camera,
            file.lens,
            x,
            y);
      };
      radiance = studio_.UsesCachedLight() ? RenderCachedRadiance(studio_.Light().Tracer(),
                                                                  studio_.RasterOf(record),
                                                                  view,
                                                                  studio_.Sampling(),
                                                                  options_.num_threads,
                                                                  &progress,
                                                                  describe_pixel)
                                           : RenderRadiance(studio_.Tracer(),
                                                            view,
                                                            spec_.render.samples,
                                                            options_.num_threads,
                                                            &progress,
                                                            describe_pixel);
    }
    ParallelFor(outputs.size(), options_.num_threads, [&](size_t i) {
      writer_.WriteFrameFile(studio_.FileOf(record, outputs[i]),
                             Encode(outputs[i], truth, radiance));
    });
  }

 private:
  Bytes Encode(Output output, const GroundTruth& truth, const Image<float>& radiance) const {
    switch (output) {
      case Output::kClean:
        return EncodePng(Sensor(spec_.sensor).Encode(radiance));
      case Output::kLinear:
        return EncodeExrHalf(radiance);
      case Output::kDistance:
        return EncodeExrFloat(truth.distance_m);
      case Output::kSky:
        return EncodePng(truth.sky);
    }
    PFSEQ_CHECK(false, "output {}", static_cast<int>(output));
  }

  const Studio& studio_;
  const SequenceSpec& spec_;
  const SequenceWriter& writer_;
  const RenderOptions& options_;
};

}  // namespace

RigFile MakeRigFile(const SequenceSpec& spec) {
  return {spec.image.size_px[0],
          spec.image.size_px[1],
          spec.ground_truth.max_distance_m,
          MakeCameras(spec),
          MakeLenses(spec)};
}

RenderSummary RenderSequence(const SequenceInput& input, const RenderOptions& options) {
  PFSEQ_CHECK(options.num_shards >= 1 && options.shard_idx >= 0 &&
              options.shard_idx < options.num_shards);
  Studio studio(input, options.num_threads);
  const std::vector<Record> records = SelectRecords(studio, options);
  const SequenceWriter writer(options.folder, DescriptionFiles(input, studio), options.on_existing);
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
      std::vector<Output> missing = renderer.Missing(records[i]);
      summary.num_files_kept += static_cast<int>(options.outputs.size() - missing.size());
      if (!missing.empty()) {
        work.emplace_back(records[i], std::move(missing));
      }
    }
  }

  const uint64_t pixels_a_record =
      static_cast<uint64_t>(studio.Rig().width_px) * studio.Rig().height_px;
  const auto has_color = [](const auto& item) {
    return std::any_of(item.second.begin(), item.second.end(), [](Output output) {
      return output == Output::kClean || output == Output::kLinear;
    });
  };
  const auto num_color_records =
      static_cast<uint64_t>(std::count_if(work.begin(), work.end(), has_color));
  const double light_start_s = CpuSeconds();
  if (studio.UsesCachedLight() && num_color_records > 0) {
    studio.LoadLight(options.light_cache);
    std::vector<RasterView> views;
    for (const auto& item : work) {
      if (has_color(item)) {
        views.push_back({&studio.RasterOf(item.first), studio.ViewOf(item.first)});
      }
    }
    studio.Light().Prepare(views, options.num_threads, options.quiet);
  }
  const double frames_start_s = CpuSeconds();
  // Without colour each record is one step; with colour the pixels are what takes the time.
  Progress progress("render",
                    num_color_records > 0 ? num_color_records * pixels_a_record : work.size(),
                    options.quiet);
  for (const auto& [record, outputs] : work) {
    const FrameFile file = studio.FileOf(record, outputs.front());
    progress.SetDetail(fmt::format("frame {} {} {}", file.frame, file.camera, file.lens));
    renderer.Render(record, outputs, progress);
    summary.num_files_written += static_cast<int>(outputs.size());
    if (num_color_records == 0) {
      progress.Advance();
    }
  }
  progress.Finish();
  const double frames_end_s = CpuSeconds();
  if (studio.UsesCachedLight() && num_color_records > 0) {
    studio.Light().Save();
    if (!options.quiet) {
      fmt::print(stderr, "{}\n", studio.Light().Summary());
    }
  }
  if (!options.quiet) {
    fmt::print(stderr,
               "CPU time: start {:.2f} s, light {:.2f} s, {} records {:.2f} s\n",
               light_start_s,
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
