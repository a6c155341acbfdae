// SPDX-License-Identifier: Apache-2.0
// A scene as glTF 2.0. What ReadGltf makes of it is the scene again, bit for bit, but for what
// glTF cannot hold: meshes without a triangle are left out, and so is a normal_scale without its
// texture.
#pragma once

#include "renderer/trace/scene.h"

#include <filesystem>
#include <string>

namespace pfseq {

/// The bytes of a .glb file: textures inside as PNG, a node for each mesh under one root, the sun
/// as a directional light; no node moves its mesh. The same scene gives the same bytes. The scene
/// must be valid (Scene::Validate); SystemError beyond the 4 GiB that a GLB file can hold. A
/// `copyright` becomes the asset's.
std::string GlbBytes(const Scene& scene, const std::string& copyright = {});

/// Writes NAME.gltf, beside it NAME.bin and the textures NAME_0.png, NAME_1.png, ... SystemError
/// when the disk refuses.
void WriteGltf(const Scene& scene,
               const std::filesystem::path& path,
               const std::string& copyright = {});

}  // namespace pfseq
