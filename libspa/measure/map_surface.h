// SPDX-License-Identifier: Apache-2.0
// What a map says the surface is: its samples as points, neighbours joined by triangles.
#pragma once

#include "../core/direction_map.h"
#include "../mesh/model.h"

#include <span>
#include <vector>

namespace spa::measure {

struct MapSurface {
    std::vector<Vec3f> positions; // one a sample of the grid, row-major, in units of R
    std::vector<Triangle> triangles;
};

// Appends the surface that `depth` (r/R, one a sample, row-major, 0 = no surface) describes.
//
// Every cell of four neighbouring samples makes two triangles; octahedral cells are cut along the diagonal
// parallel to a + b = const of their quadrant, so that no triangle crosses a fold (algorithm: projective
// trace); latlong maps close over the seam, and each pole is a fan over its row of samples. A triangle with
// one or two samples without surface shrinks to the edge or the point that is left: a silhouette ends at its
// last sample. Where neighbours see different surfaces the triangle between them is a wall that the object
// does not have; it belongs to the map, which cannot tell.
//
// frame: from the map's frame space to the space of the result. O(samples).
void append_surface(const Grid& grid, std::span<const double> depth, const Mat3& frame, MapSurface& surface);

} // namespace spa::measure
