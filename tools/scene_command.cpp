// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/trace/ray_scene.h"
#include "scenes/canyon/canyon.h"
#include "scenes/canyon/canyon_stats.h"
#include "scenes/catalog.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/lambertian.h"
#include "tools/commands.h"
#include "tools/common_options.h"
#include "tools/scene_map.h"

#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
Examples:
  pfseq scene data/sequences/pfseq.yaml --stats
  pfseq scene data/sequences/pfseq.yaml --set scene.canyon.seed=7 --out city.glb
  pfseq scene data/sequences/pfseq.yaml --map map.png
  pfseq scene data/sequences/pfseq.yaml --out city.gltf          separate .bin and textures
  pfseq scene data/sequences/pfseq.yaml --materials lambertian --out matt.glb)";

constexpr const char* kAllMaterials = "all";
constexpr const char* kLambertianMaterials = "lambertian";
constexpr const char* kUntexturedMaterials = "untextured";

struct SceneFlags {
  DescriptionFlags description;
  std::filesystem::path out;
  std::filesystem::path map;
  int map_size_px = 1200;
  std::string materials = kAllMaterials;
  bool stats = false;
  RunFlags run;
};

constexpr double kMebi = 1024.0 * 1024.0;

void PrintSceneStats(const Scene& scene) {
  std::map<std::string, size_t> triangles_by_material;
  Vec3f low_m = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f high_m = -low_m;
  for (const Mesh& mesh : scene.meshes) {
    triangles_by_material[scene.materials[static_cast<size_t>(mesh.material_idx)].name] +=
        mesh.triangles.size();
    for (const Vec3f& position_m : mesh.positions_m) {
      low_m = low_m.cwiseMin(position_m);
      high_m = high_m.cwiseMax(position_m);
    }
  }
  size_t texture_bytes = 0;
  for (const Texture& texture : scene.textures) {
    texture_bytes += texture.texels.Values().size();
  }
  fmt::print("triangles: {}\nmeshes: {}\nmaterials: {}\ntextures: {} ({:.1f} MiB)\n",
             scene.NumTriangles(),
             scene.meshes.size(),
             scene.materials.size(),
             scene.textures.size(),
             static_cast<double>(texture_bytes) / kMebi);
  fmt::print("extent_m: x {:.1f} to {:.1f}, y {:.1f} to {:.1f}, z {:.1f} to {:.1f}\n",
             low_m.x(),
             high_m.x(),
             low_m.y(),
             high_m.y(),
             low_m.z(),
             high_m.z());
  for (const auto& [name, count] : triangles_by_material) {
    fmt::print("  {:>9} triangles  {}\n", count, name.empty() ? "(no name)" : name);
  }
}

void PrintStats(const SequenceInput& input) {
  if (input.spec.scene.gltf.empty()) {
    const Canyon canyon =
        BuildCanyonWithStats(input.spec.scene.canyon, input.spec.trajectory.drive);
    fmt::print("{}", DescribeCanyon(canyon.stats, canyon.scene));
  } else {
    PrintSceneStats(*input.scene);
  }
  const RayScene rays(input.scene);
  fmt::print("ray tracing memory: {:.1f} MiB\n", static_cast<double>(rays.MemoryBytes()) / kMebi);
}

/// The scene with its materials reduced as --materials tells.
Scene SceneToWrite(const Scene& scene, const std::string& materials) {
  if (materials == kLambertianMaterials) {
    return LambertianScene(scene);
  }
  return materials == kUntexturedMaterials ? UntexturedScene(scene) : scene;
}

void WriteMap(const SceneFlags& flags, const SequenceInput& input) {
  std::vector<Vec3d> way_m;
  for (const StampedPose& pose : FramePoses(input.spec.trajectory)) {
    way_m.push_back(pose.world_from_rig.translation_m);
  }
  const RayScene rays(input.scene);
  const Image<uint8_t> map = DrawSceneMap(rays, way_m, flags.map_size_px, flags.run.num_threads);
  WriteFileAtomically(flags.map, EncodePng(map));
}

void RunScene(const SceneFlags& flags) {
  if (flags.out.empty() && flags.map.empty() && !flags.stats) {
    throw InputError("scene: expected --out FILE.glb, --out FILE.gltf, --map FILE.png or --stats");
  }
  if (!flags.map.empty() && flags.map.extension() != ".png") {
    throw InputError("--map {}: expected a name that ends with .png", flags.map.string());
  }
  const std::string extension = flags.out.extension().string();
  if (!flags.out.empty() && extension != ".glb" && extension != ".gltf") {
    throw InputError("--out {}: expected a name that ends with .glb or .gltf", flags.out.string());
  }
  const SequenceInput input = LoadSequenceInput(flags.description);
  if (extension == ".glb") {
    WriteFileAtomically(
        flags.out,
        GlbBytes(SceneToWrite(*input.scene, flags.materials), SceneCredits(input.spec, "")));
  } else if (extension == ".gltf") {
    WriteGltf(SceneToWrite(*input.scene, flags.materials), flags.out, SceneCredits(input.spec, ""));
  }
  if (!flags.map.empty()) {
    WriteMap(flags, input);
  }
  if (flags.stats) {
    PrintStats(input);
  }
}

}  // namespace

void AddSceneCommand(CLI::App& app) {
  auto flags = std::make_shared<SceneFlags>();
  CLI::App* command = app.add_subcommand("scene", "Writes or describes the scene of a sequence");
  command->footer(kFooter);
  AddDescriptionFlags(*command, flags->description);
  command->add_option("--out", flags->out, "File to write: .glb, or .gltf with separate files");
  command
      ->add_option("--materials",
                   flags->materials,
                   "Materials of the file: all, as they are; lambertian, without gloss, metal, "
                   "normal maps and emission; untextured, lambertian and of one colour each")
      ->check(CLI::IsMember({kAllMaterials, kLambertianMaterials, kUntexturedMaterials}))
      ->capture_default_str();
  command->add_option("--map", flags->map, "PNG of the scene from above with the rig's way");
  command->add_option("--map-size", flags->map_size_px, "Longer side of the map in pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  command->add_flag("--stats", flags->stats, "Print what is in the scene");
  AddRunFlags(*command, flags->run);
  command->callback([flags] { RunScene(*flags); });
}

}  // namespace pfseq
