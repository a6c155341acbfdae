// SPDX-License-Identifier: Apache-2.0
// Scenes of matt surfaces alone: what two renderers must agree on, whatever their models of shiny
// materials are.
#pragma once

#include "renderer/trace/scene.h"

namespace pfseq {

/// The scene with every material Lambertian: its base colour, with the texture and the holes that
/// it cuts, without metal, gloss, normal map and emission. Textures that nothing uses any more are
/// left out. The scene must be valid (Scene::Validate).
Scene LambertianScene(Scene scene);

/// LambertianScene, and each base colour is one constant: the factor times the mean of the
/// texture's linear values. Holes stay: their texture keeps its alpha under a white colour.
Scene UntexturedScene(Scene scene);

}  // namespace pfseq
