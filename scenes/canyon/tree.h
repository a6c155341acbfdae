// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"

namespace pfseq {

struct TreeDesign {
  double height_m = 9.0;
  /// Of the crown, across and along the street.
  double crown_radius_m = 2.0;
  /// Height of the crown's foot; the lowest leaves may hang 0.3 crown radii below it.
  double clear_m = 3.0;
  int num_leaves = 1200;
  int leaf = 0;
};

/// A trunk, boughs and leaves: each leaf is one rhombus, seen from both sides. Leaves stay within
/// `crown_radius_m` of the trunk's axis.
void BuildTree(const BuildContext& context,
               const TreeDesign& design,
               const Vec3d& foot_m,
               RandomStream& random);

}  // namespace pfseq
