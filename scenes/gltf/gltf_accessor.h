// SPDX-License-Identifier: Apache-2.0
// Typed arrays out of the accessors of a glTF document (glTF 2.0, section 3.6): strides, sparse
// values, normalised and quantised integers.
#pragma once

#include "renderer/core/vector.h"
#include "scenes/gltf/gltf_document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pfseq {

/// The vertex attributes that this program reads; each allows certain component types (glTF 2.0,
/// section 3.7.2.1, and KHR_mesh_quantization where the document uses it).
enum class VertexAttribute { kPosition, kNormal, kTexcoord };

/// The elements of an accessor of three components, in the axes of glTF. The model must come from
/// ReadGltfDocument. InputError that starts with `where` when type or component type do not fit or
/// a number is not finite; so below.
std::vector<Vec3f> ReadVec3Accessor(const tinygltf::Model& model,
                                    int accessor_idx,
                                    VertexAttribute attribute,
                                    const std::string& where);

/// The same for two components.
std::vector<Vec2f> ReadVec2Accessor(const tinygltf::Model& model,
                                    int accessor_idx,
                                    VertexAttribute attribute,
                                    const std::string& where);

/// Vertex indices: an accessor of unsigned 8-, 16- or 32-bit integers.
std::vector<uint32_t> ReadIndexAccessor(const tinygltf::Model& model,
                                        int accessor_idx,
                                        const std::string& where);

}  // namespace pfseq
