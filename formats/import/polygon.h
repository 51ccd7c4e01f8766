// SPDX-License-Identifier: Apache-2.0
// Cuts a polygon of any shape into triangles.
#pragma once

#include "../../libspa/core/vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::import {

// Appends the n - 2 triangles of a polygon with n >= 3 finite corners, as indices into `corners`, with the
// polygon's winding. A polygon that is star-shaped from its first corner (every convex one) becomes a fan;
// any other simple polygon, seen along its area vector, is cut by ear clipping (Meisters 1975), so that
// concave ones, and those with a hole joined to the border by a double edge, are covered exactly once.
// Returns false if ear clipping found no ear because the polygon crosses itself or has no area, or gave up
// after 10^6 + 1000 n comparisons; what was left is then cut as a fan: nothing is lost, but some of the
// triangles may overlap.
// Time O(n + n r) with r reflex corners, bounded as said; memory O(n).
bool triangulate_polygon(std::span<const Vec3f> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace spa::import
