// SPDX-License-Identifier: Apache-2.0
// The third caster: the crossings of every sample by Embree's rays. It shares with the bakers what a crossing
// looks like, but not how triangles are found, so it tells which of two bakers is wrong.
#pragma once

#include "../bake/crossings.h"
#include "../trace/triangle_scene.h"

#include <span>

namespace spa::measure {

// A ray from the centre. texel: the sample of the grid whose footprint filters the colour.
struct CenterRay {
    TexelIndex texel;
    Vec3d direction; // any length > 0
};

// scene: of model.positions and model.model->triangles. The triangles that Embree reports for the ray of a
// sample, and for four more around it at tie_distance, are intersected again in double precision, where the
// rules of crossings.h are exact: Embree computes in float, and where a ray meets an edge it may report the
// triangle across it, or none at a border. A triangle missed by more than tie_distance counts as met: it
// would be a mistake of Embree's or of the rules, and is the caller's to find. Same result for any number of
// threads. Throws bake::Cancelled.
bake::CrossingGrid cast_embree(const bake::CenteredModel& model, const trace::TriangleScene& scene,
                               const Grid& grid, const bake::CastOptions& options);

// The same along rays of any directions: crossings[first[i]] .. crossings[first[i + 1]) are those of rays[i];
// the grid of the result is one row of them.
bake::CrossingGrid cast_embree(const bake::CenteredModel& model, const trace::TriangleScene& scene,
                               const Grid& grid, std::span<const CenterRay> rays,
                               const bake::CastOptions& options);

// Distance between ray and edge, in units of R, within which float cannot tell inside from outside.
constexpr double tie_distance = 2e-6;

} // namespace spa::measure
