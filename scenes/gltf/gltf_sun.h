// SPDX-License-Identifier: Apache-2.0
// The scene's sun as a directional light of KHR_lights_punctual: it shines along -Z of its node,
// with an illuminance (lux) of intensity * color on a surface that faces it. Our unit of irradiance
// is the kilolux.
#pragma once

#include "renderer/trace/scene.h"
#include "scenes/gltf/gltf_document.h"

#include <vector>

#include <Eigen/Core>

namespace pfseq {

/// The index of a node's light, or -1.
int LightOfNode(const tinygltf::Node& node);

/// A directional light under a node's linear transform (in the axes of glTF). The exact direction
/// is taken from the light's extras where this program wrote it and it still agrees with the node.
/// InputError that starts with `where` when the transform leaves no direction.
Sun SunFromLight(const tinygltf::Light& light,
                 const Eigen::Matrix3d& linear_gltf,
                 const std::string& where);

/// Adds the light and its node to the model; returns the node's index.
int AddSun(const Sun& sun, tinygltf::Model& model);

}  // namespace pfseq
