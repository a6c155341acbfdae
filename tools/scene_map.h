// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/image.h"
#include "renderer/core/vector.h"
#include "renderer/trace/ray_scene.h"

#include <vector>

namespace pfseq {

/// The scene from straight above, north (+Y) up and east (+X) to the right: colours of materials,
/// shaded by slope, darker the lower; over it the way of the rig, a dot for each frame, the first
/// one larger. 8-bit sRGB; the longer side has `size_px` pixels.
Image<uint8_t> DrawSceneMap(const RayScene& rays,
                            const std::vector<Vec3d>& way_m,
                            int size_px,
                            int num_threads);

}  // namespace pfseq
