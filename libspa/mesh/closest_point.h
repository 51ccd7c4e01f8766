// SPDX-License-Identifier: Apache-2.0
// Distances between points and triangles, in double precision.
#pragma once

#include "../core/vector.h"

namespace spa {

// The point of the segment a b closest to p; a zero-length segment is its end.
Vec3d closest_point_on_segment(Vec3d p, Vec3d a, Vec3d b);

// The point of the triangle a b c closest to p (Ericson, Real-Time Collision Detection, 5.1.5). Triangles of
// no area count as the segments or points that they are. Finite for finite input.
Vec3d closest_point_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

} // namespace spa
