// SPDX-License-Identifier: Apache-2.0
// Between the axes of glTF (right-handed, Y up; glTF 2.0, section 3.4) and those of the world
// (right-handed, Z up): a quarter turn about X, which only moves and negates numbers and so is
// exact.
#pragma once

#include <Eigen/Core>

namespace pfseq {

/// (x, y, z) of the world is (x, -z, y) of glTF.
template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> WorldFromGltf(const Eigen::Matrix<Scalar, 3, 1>& gltf) {
  return {gltf.x(), -gltf.z(), gltf.y()};
}

/// The inverse of WorldFromGltf.
template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> GltfFromWorld(const Eigen::Matrix<Scalar, 3, 1>& world) {
  return {world.x(), world.z(), -world.y()};
}

}  // namespace pfseq
