// SPDX-License-Identifier: Apache-2.0
#include "tests/validator/test_sequence.h"

#include "renderer/core/file.h"
#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "renderer/lens/trajectory_file.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/manifest.h"
#include "renderer/sequence/poses_file.h"
#include "scenes/gltf/gltf_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

namespace pfseq {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void AddBox(Mesh& mesh, const Vec3f& low_m, const Vec3f& high_m, bool with_roof) {
  const auto first = static_cast<uint32_t>(mesh.positions_m.size());
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions_m.emplace_back((corner & 1) != 0 ? high_m.x() : low_m.x(),
                                  (corner & 2) != 0 ? high_m.y() : low_m.y(),
                                  (corner & 4) != 0 ? high_m.z() : low_m.z());
  }
  std::vector<std::array<uint32_t, 4>> faces = {
      {0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  if (with_roof) {
    faces.push_back({4, 5, 7, 6});
  }
  for (const std::array<uint32_t, 4>& face : faces) {
    mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
    mesh.triangles.push_back({first + face[0], first + face[2], first + face[3]});
  }
}

/// A yard of 30 x 20 m with walls of 12 m and no roof, a beam across it, and a far wall of which
/// the upper part stands out behind, beyond the maximum distance.
std::shared_ptr<const Scene> YardScene() {
  Scene scene;
  scene.materials.resize(1);
  Mesh yard;
  AddBox(yard, {-13.0F, -8.5F, 0.0F}, {17.0F, 11.5F, 12.0F}, false);
  AddBox(yard, {3.0F, -8.5F, 5.0F}, {3.7F, 11.5F, 5.5F}, true);
  AddBox(yard, {-600.0F, -50.0F, 0.0F}, {-590.0F, 50.0F, 900.0F}, true);
  scene.meshes.push_back(yard);
  return std::make_shared<const Scene>(std::move(scene));
}

/// Grey value of a point of a surface: smoothed random lattice values of two sizes.
double SurfaceTexture(const Vec3d& point_m) {
  double sum = 0.0;
  for (const double cell_m : {0.8, 0.35}) {
    const Vec3d scaled = point_m / cell_m;
    const Vec3d low = scaled.array().floor();
    const Vec3d t = scaled - low;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      uint64_t key[3];
      for (int axis = 0; axis < 3; ++axis) {
        const bool high = ((corner >> axis) & 1) != 0;
        const double smooth = t[axis] * t[axis] * (3.0 - 2.0 * t[axis]);
        weight *= high ? smooth : 1.0 - smooth;
        key[axis] = static_cast<uint64_t>(static_cast<int64_t>(low[axis]) + (high ? 1 : 0));
      }
      sum += 0.5 * weight * UniformFromHash(HashKey({key[0], key[1], key[2]}));
    }
  }
  return sum;
}

void WriteBytes(const std::filesystem::path& path, const Bytes& bytes) {
  WriteFileAtomically(path, std::span<const std::byte>(bytes));
}

}  // namespace

TestSequence TestSequence::Yard(int size_px) {
  TestSequence sequence;
  const double half_field_rad = RadFromDeg(90.9);
  const Vec2d centre_px = Vec2d::Constant(0.5 * size_px);
  const double equidistant_px = Lens::FocalFromCirclePx(Equidistant{}, size_px, half_field_rad);
  const double equisolid_px = Lens::FocalFromCirclePx(Equisolid{}, 0.94 * size_px, half_field_rad);
  sequence.rig.width_px = size_px;
  sequence.rig.height_px = size_px;
  sequence.rig.max_distance_m = 500.0;
  sequence.rig.cameras = {{"front", {}},
                          {"rear",
                           {RotationFromXzy({RadFromDeg(-8.0), RadFromDeg(6.0), RadFromDeg(-7.0)}),
                            Vec3d(-2.0, 0.0, 0.0)}}};
  sequence.rig.lenses = {
      {"equidistant",
       Lens(Equidistant{}, Vec2d::Constant(equidistant_px), centre_px, half_field_rad)},
      {"equisolid", Lens(Equisolid{}, Vec2d::Constant(equisolid_px), centre_px, half_field_rad)}};
  for (int frame = 0; frame < 4; ++frame) {
    sequence.poses.push_back(
        {0.25 * frame, PoseFromYaw({0.9 * frame, 0.13 * frame * frame, 1.6}, 0.11 * frame)});
  }
  sequence.scene = YardScene();
  sequence.frames = {1, 3};
  return sequence;
}

void TestSequence::Write(const std::filesystem::path& folder) const {
  WriteFileAtomically(folder / kRigFile, rig.ToYaml());
  WriteFileAtomically(folder / kPosesFile, PosesCsv(poses));
  WriteFileAtomically(folder / kSequenceFile, std::string_view("name: yard\n"));
  WriteFileAtomically(folder / kSceneFile, GlbBytes(*scene));
  for (const RigCamera& camera : rig.cameras) {
    std::vector<StampedPose> world_from_camera = poses;
    for (StampedPose& pose : world_from_camera) {
      pose.world_from_rig = pose.world_from_rig * camera.rig_from_camera;
    }
    WriteFileAtomically(folder / TrajectoryFile(camera.name), TumText(world_from_camera));
  }
  const RayScene ray_scene(scene);
  for (const Named<Lens>& lens : rig.lenses) {
    for (const RigCamera& camera : rig.cameras) {
      for (const int frame : frames) {
        WriteView(folder, ray_scene, camera, lens, frame);
      }
    }
  }
  RenewManifest(folder);
}

void TestSequence::WriteView(const std::filesystem::path& folder,
                             const RayScene& ray_scene,
                             const RigCamera& camera,
                             const Named<Lens>& lens,
                             int frame) const {
  const RigidTransform world_from_camera =
      poses[static_cast<size_t>(frame)].world_from_rig * camera.rig_from_camera;
  Image<uint8_t> clean(rig.width_px, rig.height_px, 3);
  Image<float> distance_m(rig.width_px, rig.height_px, 1);
  Image<uint8_t> sky(rig.width_px, rig.height_px, 1);
  for (int y = 0; y < rig.height_px; ++y) {
    for (int x = 0; x < rig.width_px; ++x) {
      if (!lens.value.Unproject(Vec2d(x + 0.5, y + 0.5))) {
        continue;
      }
      const std::optional<Vec3d> direction_camera = lens.value.Unproject(Vec2d(x, y) + sample_px);
      const Vec3d direction =
          world_from_camera.Direction(direction_camera.value_or(Vec3d(Vec3d::UnitZ())));
      const std::optional<RayHit> hit =
          ray_scene.Intersect(world_from_camera.translation_m, direction);
      const double distance = hit ? hit->distance_m : kInfinity;
      distance_m.At(x, y) =
          static_cast<float>(distance <= rig.max_distance_m ? distance : kInfinity);
      sky.At(x, y) = hit ? 0 : 255;
      const double grey =
          hit ? SurfaceTexture(world_from_camera.translation_m + distance * direction) : 0.95;
      for (int channel = 0; channel < 3; ++channel) {
        clean.At(x, y, channel) = static_cast<uint8_t>(std::lround(255.0 * grey));
      }
    }
  }
  const auto path = [&](Output output) {
    return ViewPath(folder, lens.name, camera.name, output, frame);
  };
  WriteBytes(path(Output::kClean), EncodePng(clean));
  WriteBytes(path(Output::kDistance), EncodeExrFloat(distance_m));
  WriteBytes(path(Output::kSky), EncodePng(sky));
}

void RenewManifest(const std::filesystem::path& folder) {
  Manifest::OfFolder(folder, 1).Write(folder);
}

std::filesystem::path ViewPath(const std::filesystem::path& folder,
                               const std::string& lens,
                               const std::string& camera,
                               Output output,
                               int frame) {
  return folder / FrameFile{lens, camera, output, frame}.RelativePath();
}

void EditLines(const std::filesystem::path& path,
               const std::function<void(std::vector<std::string>& lines)>& change) {
  std::istringstream stream(ReadFile(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  change(lines);
  std::string text;
  for (const std::string& line : lines) {
    text += line + "\n";
  }
  WriteFileAtomically(path, std::string_view(text));
}

void SwapFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::filesystem::path aside = a.string() + ".aside";
  std::filesystem::rename(a, aside);
  std::filesystem::rename(b, a);
  std::filesystem::rename(aside, b);
}

}  // namespace pfseq
