// SPDX-License-Identifier: Apache-2.0
// Walls between neighbours. Houses stand wall to wall: of two that touch, only the part of a side
// that rises above or beside the other is built, so that no two faces lie on one another and
// nothing is left open.
#pragma once

#include "scenes/canyon/building.h"
#include "scenes/canyon/mesh_builder.h"

#include <span>
#include <vector>

namespace pfseq {

/// The upper outline of a house over one of its axis-aligned edges: points (s, z), s ascending
/// along the edge's axis.
using Outline = std::vector<Vec2d>;

Outline OutlineOf(const Building& building, size_t edge);

/// Builds the blank parts of all edges of houses[house]: party sides as far as they show, and on
/// streets and courts what lies above the eave.
void BuildBlankWalls(std::span<const Building> houses, size_t house, MeshBuilder& builder);

}  // namespace pfseq
