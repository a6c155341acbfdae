// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/dataset_views.h"

#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"
#include "renderer/core/units.h"
#include "renderer/lens/camera_rig.h"
#include "renderer/lens/trajectory_file.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "renderer/sequence/yaml_schema.h"
#include "scenes/gltf/gltf_reader.h"
#include "validator/benchmark/imported_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

namespace pfseq {
namespace {

constexpr const char* kOnlyVariant = "realistic";

/// Typed access to the description.
class Description {
 public:
  explicit Description(const YamlValue& yaml) : yaml_(yaml) {}

  const YamlValue& Required(const std::string& key) const {
    const YamlValue* value = yaml_.Find(key);
    if (value == nullptr) {
      FailAtYaml(yaml_, key, "missing");
    }
    return *value;
  }

  std::string Text(const std::string& key, const std::string& otherwise) const {
    std::string text = otherwise;
    if (const YamlValue* value = yaml_.Find(key)) {
      YamlLine()->Read(*value, key, text);
    }
    return text;
  }

  std::string Choice(const std::string& key, const std::vector<std::string>& words) const {
    std::string word = words.front();
    if (const YamlValue* value = yaml_.Find(key)) {
      YamlChoice(words)->Read(*value, key, word);
    }
    return word;
  }

  double Number(const std::string& key, double otherwise) const {
    double number = otherwise;
    if (const YamlValue* value = yaml_.Find(key)) {
      YamlNumber({0.0, 1e9, true})->Read(*value, key, number);
    }
    return number;
  }

  std::array<double, 3> Three(const std::string& key) const {
    std::array<double, 3> numbers = {};
    if (const YamlValue* value = yaml_.Find(key)) {
      YamlArray<3>(YamlNumber({}))->Read(*value, key, numbers);
    }
    return numbers;
  }

  std::vector<StampedPose> Poses(const std::string& key) const {
    std::string path;
    if (const YamlValue* value = yaml_.Find(key)) {
      YamlPath()->Read(*value, key, path);
    }
    if (path.empty()) {
      return {};
    }
    constexpr double kAnyRateHz = 1.0;
    constexpr double kHeightM = 0.0;
    return path.ends_with(".csv") ? ReadPoseCsv(path, kAnyRateHz, kHeightM)
                                  : ReadTum(std::filesystem::path(path));
  }

 private:
  const YamlValue& yaml_;
};

bool MatchesGlob(std::string_view name, std::string_view glob) {
  if (glob.empty()) {
    return name.empty();
  }
  if (glob[0] == '*') {
    return MatchesGlob(name, glob.substr(1)) ||
           (!name.empty() && MatchesGlob(name.substr(1), glob));
  }
  return !name.empty() && name[0] == glob[0] && MatchesGlob(name.substr(1), glob.substr(1));
}

}  // namespace

DatasetViews::DatasetViews(const std::filesystem::path& path) : path_(path) {
  const YamlValue root = ReadYaml(path);
  CheckIsMapping(root, "");
  CheckKnownKeys(root,
                 "",
                 {"lenses",
                  "image_size_px",
                  "max_distance_m",
                  "axes",
                  "poses",
                  "distance",
                  "scene",
                  "cameras"});
  const Description description(root);
  std::array<int, 2> size_px = {};
  YamlArray<2>(YamlInteger<int>(1, 32768), true)
      ->Read(description.Required("image_size_px"), "image_size_px", size_px);
  width_px_ = size_px[0];
  height_px_ = size_px[1];
  max_distance_m_ = description.Number("max_distance_m", max_distance_m_);
  is_opengl_ = description.Choice("axes", {"opencv", "opengl"}) == "opengl";
  poses_ = description.Poses("poses");
  if (const YamlValue* scene = root.Find("scene")) {
    YamlPath()->Read(*scene, "scene", scene_);
  }
  if (const YamlValue* distance = root.Find("distance")) {
    CheckIsMapping(*distance, "distance");
    CheckKnownKeys(*distance, "distance", {"kind", "scale_m"});
    is_depth_ = Description(*distance).Choice("kind", {"distance", "depth"}) == "depth";
    scale_m_ = Description(*distance).Number("scale_m", 1.0);
  }
  const YamlValue& lenses = description.Required("lenses");
  CheckIsMapping(lenses, "lenses");
  for (const YamlEntry& entry : lenses.entries) {
    std::string file;
    YamlPath()->Read(entry.value, "lenses." + entry.key, file);
    lenses_.emplace_back(entry.key, MakeLens(ReadLensSpec(file), size_px));
  }
  const YamlValue& cameras = description.Required("cameras");
  CheckIsMapping(cameras, "cameras");
  for (const YamlEntry& entry : cameras.entries) {
    const std::string key = "cameras." + entry.key;
    CheckIsMapping(entry.value, key);
    CheckKnownKeys(
        entry.value, key, {"images", "distances", "position_m", "rotation_deg", "poses"});
    const Description own(entry.value);
    Camera camera{entry.key, {}, own.Text("distances", ""), {}, own.Poses("poses")};
    const YamlValue& images = own.Required("images");
    if (images.kind == YamlValue::Kind::kMapping) {
      for (const YamlEntry& variant : images.entries) {
        camera.images.emplace_back(variant.key, variant.value.text);
      }
    } else {
      camera.images.emplace_back(kOnlyVariant, own.Text("images", ""));
    }
    const std::array<double, 3> position_m = own.Three("position_m");
    std::array<double, 3> angles_rad = own.Three("rotation_deg");
    for (double& angle : angles_rad) {
      angle = RadFromDeg(angle);
    }
    camera.rig_from_camera = {RotationFromXzy(angles_rad),
                              Vec3d(position_m[0], position_m[1], position_m[2])};
    if (camera.poses.empty() && poses_.empty()) {
      FailAtYaml(entry.value, key, "expected poses, here or of the rig");
    }
    cameras_.push_back(std::move(camera));
  }
}

std::vector<std::string> DatasetViews::Cameras() const {
  std::vector<std::string> names;
  for (const Camera& camera : cameras_) {
    names.push_back(camera.name);
  }
  return names;
}

std::vector<std::string> DatasetViews::Lenses() const {
  std::vector<std::string> names;
  for (const auto& [name, lens] : lenses_) {
    names.push_back(name);
  }
  return names;
}

const Lens& DatasetViews::LensOf(const std::string& lens) const {
  for (const auto& [name, value] : lenses_) {
    if (name == lens) {
      return value;
    }
  }
  throw InputError("lens '{}': {} has no such", lens, path_.string());
}

const DatasetViews::Camera& DatasetViews::CameraOf(const std::string& name) const {
  for (const Camera& camera : cameras_) {
    if (camera.name == name) {
      return camera;
    }
  }
  throw InputError("camera '{}': {} has no such", name, path_.string());
}

RigidTransform DatasetViews::WorldFromCamera(const ViewName& view) const {
  const Camera& camera = CameraOf(view.camera);
  const bool is_own = !camera.poses.empty();
  const std::vector<StampedPose>& poses = is_own ? camera.poses : poses_;
  if (view.frame < 0 || static_cast<size_t>(view.frame) >= poses.size()) {
    throw InputError(
        "{}: frame {}: expected a pose, there are {}", path_.string(), view.frame, poses.size());
  }
  RigidTransform world_from_camera = poses[static_cast<size_t>(view.frame)].world_from_rig;
  if (!is_own) {
    world_from_camera = world_from_camera * camera.rig_from_camera;
  }
  if (is_opengl_) {
    // y up and z backwards to y down and z forwards: half a turn about x.
    world_from_camera.rotation =
        world_from_camera.rotation * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  }
  return world_from_camera;
}

std::vector<std::string> DatasetViews::Variants() const {
  std::vector<std::string> variants;
  for (const auto& [variant, pattern] : cameras_.front().images) {
    variants.push_back(variant);
  }
  return variants;
}

std::map<int, std::filesystem::path> DatasetViews::FilesOf(const std::string& pattern,
                                                           const std::string& lens) const {
  std::map<int, std::filesystem::path> files;
  const std::filesystem::path folder = std::filesystem::absolute(path_).parent_path();
  if (pattern.find("{frame") != std::string::npos) {
    const int num_frames = static_cast<int>(
        std::max(poses_.size(), cameras_.empty() ? 0 : cameras_.front().poses.size()));
    for (int frame = 0; frame < num_frames; ++frame) {
      const std::filesystem::path file =
          folder / FillPath(pattern, {{"lens", lens}, {"frame", fmt::format("{}", frame)}});
      if (std::filesystem::exists(file)) {
        files[frame] = file;
      }
    }
    return files;
  }
  const std::filesystem::path glob = folder / FillPath(pattern, {{"lens", lens}});
  std::vector<std::filesystem::path> found;
  if (std::filesystem::is_directory(glob.parent_path())) {
    for (const auto& entry : std::filesystem::directory_iterator(glob.parent_path())) {
      if (MatchesGlob(entry.path().filename().string(), glob.filename().string())) {
        found.push_back(entry.path());
      }
    }
  }
  std::sort(found.begin(), found.end());
  for (size_t i = 0; i < found.size(); ++i) {
    files[static_cast<int>(i)] = found[i];
  }
  return files;
}

std::vector<int> DatasetViews::Frames(const std::string& lens,
                                      const std::string& camera,
                                      const std::string& variant) const {
  std::vector<int> frames;
  for (const auto& [name, pattern] : CameraOf(camera).images) {
    if (name == variant) {
      for (const auto& [frame, path] : FilesOf(pattern, lens)) {
        frames.push_back(frame);
      }
    }
  }
  return frames;
}

Image<uint8_t> DatasetViews::ReadImage(const std::string& lens,
                                       const ViewName& view,
                                       const std::string& variant) const {
  for (const auto& [name, pattern] : CameraOf(view.camera).images) {
    const std::map<int, std::filesystem::path> files = FilesOf(pattern, lens);
    const auto file = files.find(view.frame);
    if (name == variant && file != files.end()) {
      Image<uint8_t> image = ReadImage8(file->second);
      if (image.WidthPx() != width_px_ || image.HeightPx() != height_px_ ||
          image.NumChannels() == 2) {
        throw InputError("{}: expected {} x {} px, got {} x {}",
                         file->second.string(),
                         width_px_,
                         height_px_,
                         image.WidthPx(),
                         image.HeightPx());
      }
      return image;
    }
  }
  throw InputError(
      "{}: camera {}: frame {}: no {} image", path_.string(), view.camera, view.frame, variant);
}

Image<float> DatasetViews::ReadRaster(const std::filesystem::path& path) const {
  if (path.extension() == ".exr") {
    const Image<float> exr = ReadExr(path);
    Image<float> first(exr.WidthPx(), exr.HeightPx(), 1);
    for (int y = 0; y < exr.HeightPx(); ++y) {
      for (int x = 0; x < exr.WidthPx(); ++x) {
        first.At(x, y) = exr.At(x, y);
      }
    }
    return first;
  }
  const cv::Mat file = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (file.empty() || file.channels() != 1) {
    throw InputError("{}: expected distances in one channel (.exr, 16-bit .png)", path.string());
  }
  cv::Mat floats;
  file.convertTo(floats, CV_32F);
  Image<float> raster(floats.cols, floats.rows, 1);
  for (int y = 0; y < floats.rows; ++y) {
    std::copy_n(floats.ptr<float>(y), floats.cols, &raster.At(0, y));
  }
  return raster;
}

Image<float> DatasetViews::ReadDistance(const std::string& lens_name, const ViewName& view) const {
  const std::string& pattern = CameraOf(view.camera).distances;
  const std::map<int, std::filesystem::path> files = FilesOf(pattern, lens_name);
  const auto file = files.find(view.frame);
  if (pattern.empty() || file == files.end()) {
    throw InputError(
        "{}: camera {}: frame {}: no distance map", path_.string(), view.camera, view.frame);
  }
  Image<float> map = ReadRaster(file->second);
  if (map.WidthPx() != width_px_ || map.HeightPx() != height_px_) {
    throw InputError("{}: expected {} x {} px, got {} x {}",
                     file->second.string(),
                     width_px_,
                     height_px_,
                     map.WidthPx(),
                     map.HeightPx());
  }
  const Lens& lens = LensOf(lens_name);
  for (int y = 0; y < map.HeightPx(); ++y) {
    for (int x = 0; x < map.WidthPx(); ++x) {
      double distance_m = scale_m_ * map.At(x, y);
      if (is_depth_) {
        const std::optional<Vec3d> direction_camera = lens.Unproject(Vec2d(x + 0.5, y + 0.5));
        distance_m = direction_camera && direction_camera->z() > 0.0
                         ? distance_m / direction_camera->z()
                         : 0.0;
      }
      const bool is_place = distance_m > 0.0 && distance_m < max_distance_m_;
      map.At(x, y) =
          is_place ? static_cast<float>(distance_m) : std::numeric_limits<float>::infinity();
    }
  }
  return map;
}

std::shared_ptr<const RayScene> DatasetViews::Scene() const {
  if (scene_.empty()) {
    return nullptr;
  }
  return std::make_shared<const RayScene>(std::make_shared<const pfseq::Scene>(ReadGltf(scene_)));
}

}  // namespace pfseq
