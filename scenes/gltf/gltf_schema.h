// SPDX-License-Identifier: Apache-2.0
// Whether a glTF document is what the specification allows, asked before anything in it is
// followed. tinygltf takes a value of the wrong type for an absent one, wraps integers and follows
// some indices unchecked; after this check it meets none of these.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace pfseq {

/// Checks, of all that this program reads (glTF 2.0, chapter 5, and the extensions in the list of
/// gltf_reader.h): types, required properties, ranges; that each index has its target; that views
/// lie within buffers and accessors within views; that nodes form trees. `is_glb`: the first buffer
/// may be the file's own binary chunk. InputError "ORIGIN: PLACE: fault", for example "a.gltf:
/// accessors[3].bufferView: 7, expected less than 2".
void CheckGltfJson(const nlohmann::json& root, bool is_glb, const std::string& origin);

/// Bytes of one component of a componentType of glTF (5120 ... 5126), 0 when there is no such type.
size_t ComponentSizeBytes(int component_type);

}  // namespace pfseq
