// SPDX-License-Identifier: Apache-2.0
// The radial baker: direct rasterisation of triangles into direction space.
#pragma once

#include "crossings.h"
#include "outermost_hit.h"

#include <vector>

namespace spa::bake {

// Finds the crossings of every sample by rasterising each triangle over the samples whose directions it
// covers, in double precision, edges inclusive: watertight where triangles share vertices.
// O(triangles + covered samples) time; the result does not depend on options.threads.
// Source: ../../docs/baking.md, "Radial".
CrossingGrid cast_radial(const CenteredModel& model, const Grid& grid, const CastOptions& options);

// The first half of cast_radial with outermost_only, which is always set: where each sample's outermost
// crossing is, one entry a sample, without normals and colours.
std::vector<OutermostHit> find_outermost(const CenteredModel& model, const Grid& grid,
                                         const CastOptions& options);

} // namespace spa::bake
