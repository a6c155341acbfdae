// SPDX-License-Identifier: Apache-2.0
// The procedural city.
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "renderer/trace/scene.h"
#include "scenes/canyon/canyon_stats.h"

namespace pfseq {

struct Canyon {
  /// Without a sun: the caller sets it.
  Scene scene;
  CanyonStats stats;
};

/// The city around the U-shaped drive, with what was counted while building it; deterministic in
/// its arguments. The drive begins at the origin along +X on a carriageway at z = 0. InputError
/// when a figure is out of its range.
Canyon BuildCanyonWithStats(const CanyonSpec& canyon, const DriveSpec& drive);

/// The scene alone.
Scene BuildCanyon(const CanyonSpec& canyon, const DriveSpec& drive);

}  // namespace pfseq
