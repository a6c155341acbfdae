// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 as a scene.
//
// Read: the default scene (else the first, else all root nodes) with its node hierarchy; triangles,
// strips and fans; metallic-roughness materials with their textures; the first directional light as
// the sun; and the extensions KHR_lights_punctual, KHR_materials_emissive_strength,
// KHR_materials_ior, KHR_materials_unlit (as a Lambertian surface), KHR_mesh_quantization and
// KHR_texture_transform (carried out on the texture coordinates). A file that requires another
// extension is refused.
//
// Simplified: alphaMode BLEND is MASK at 0.5; each surface has two sides; textures repeat whatever
// their sampler says; all textures of a material must share their texture coordinates.
//
// Left out: points and lines, vertex colours, occlusion maps, cameras, animations, morph targets
// and skins (a skinned mesh stands as it is stored), lights other than the sun.
#pragma once

#include "renderer/trace/scene.h"

#include <filesystem>
#include <string>

namespace pfseq {

/// Reads a .glb file, or a .gltf file with its buffers and images. One mesh for each primitive of
/// each node that shows it, in the order of the hierarchy; vertices in world coordinates (Z up),
/// bit for bit those of the file where no node moves them. InputError, one line of file, place and
/// fault, for anything missing, damaged, out of range or not supported.
Scene ReadGltf(const std::filesystem::path& path);

/// The copyright that the file's asset names, or nothing; InputError as above.
std::string ReadGltfCopyright(const std::filesystem::path& path);

}  // namespace pfseq
