// SPDX-License-Identifier: Apache-2.0
// A glTF file as tinygltf's model, with all it refers to loaded and checked.
#pragma once

// The library's own decoders and encoders of images are not used: images stay undecoded bytes.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <filesystem>

#include <tiny_gltf.h>

namespace pfseq {

/// Reads a .glb or .gltf file (told apart by their first bytes), its buffers and image files. The
/// model has passed CheckGltfJson; Image::image holds the image's undecoded file bytes, or nothing
/// for an image that no texture uses. InputError when anything is missing, damaged or not
/// supported.
tinygltf::Model ReadGltfDocument(const std::filesystem::path& path);

}  // namespace pfseq
