// SPDX-License-Identifier: Apache-2.0
// What stands on pavements. Frames have their origin on the pavement, `out` towards the street.
#pragma once

#include "renderer/core/random.h"
#include "scenes/canyon/build_context.h"

namespace pfseq {

/// A post with an arm over the street; `height_m` above the pavement.
void BuildLampPost(const BuildContext& context, const SurfaceFrame& frame, double height_m);

/// A mast with signals for cars and for people.
void BuildTrafficLight(const BuildContext& context,
                       const SurfaceFrame& frame,
                       RandomStream& random);

/// One to three plates on a post.
void BuildSignPost(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random);

void BuildBollard(const BuildContext& context, const SurfaceFrame& frame);

/// A person who stands or walks, between 1.55 and 1.9 m tall.
void BuildPerson(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random);

/// A round advertising column of some 3.4 m.
void BuildAdvertisingColumn(const BuildContext& context,
                            const SurfaceFrame& frame,
                            RandomStream& random);

/// A roof on posts with panes and a lit poster, 4 m along the street and 1.4 m deep.
void BuildBusShelter(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random);

/// A cabinet, a bin or a letter box.
void BuildCabinet(const BuildContext& context, const SurfaceFrame& frame, RandomStream& random);

}  // namespace pfseq
