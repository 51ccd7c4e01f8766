// SPDX-License-Identifier: Apache-2.0
// Which triangles between samples must not be interpolated over. Source: ../../docs/baking.md, "Mixed
// triangles".
#pragma once

#include "intervals.h"

#include <cstddef>
#include <vector>

namespace spa::bake {

// In units of h Wm of an edge between two samples, h its length in the octant's coordinates (a cell is 2/N
// wide) and Wm the mean of W = |g|_2 / r at its ends, g = sample_direction, r = normalized depth.
//
// The steepest change of W along an edge that counts as one surface.
constexpr double mixed_slope = 4;
// How far the change may be off what the tangent planes at the two ends say.
constexpr double mixed_slack = 0.5;

// Below this sine of the angle between a line of sight and the surface it meets, the tangent plane says
// nothing about the neighbours: any slope may follow.
constexpr double mixed_grazing = 1e-6;

// One bit a triangle of an octahedral grid, 1 = mixed, in the layout of ../core/cell_triangles.h. A triangle
// is pure if its three corners have the same number of intervals, the same of these reach the centre, and on
// each of its edges each end of an interval continues to that of the other corner: W changes by no more than
// mixed_slope, and by something between what the tangent planes at the two ends say, give or take
// mixed_slack. A triangle whose corners see nothing is pure. Decided from exact depths and normals, not their
// codes. O(samples). Deterministic; parallel over rows in the caller's arena.
std::vector<std::byte> mixed_triangles(const SurfaceGrid& surfaces);

} // namespace spa::bake
