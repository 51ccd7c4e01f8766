// SPDX-License-Identifier: Apache-2.0
// Which triangles between samples must not be interpolated over. Source: ../../docs/baking.md, "Mixed
// triangles".
#pragma once

#include "intervals.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace spa::bake {

// In units of h Wm of an edge between two samples, h its length in the octant's coordinates (a cell is 2/N
// wide) and Wm the mean of W = |g|_2 / r at its ends, g = sample_direction, r = normalized depth.
//
// The steepest change of W along an edge that counts as one surface where the planes at its ends differ.
constexpr double mixed_slope = 4;
// How far the change may be off what the planes at the two ends say.
constexpr double mixed_slack = 0.5;

// The same as a share of the change, if that is more and both planes say it: walls may be as steep as they
// like, and a steep one is never quite flat.
constexpr double mixed_share_of_change = 0.25;

// Below this sine of the angle between a line of sight and the triangle it meets, the plane says nothing
// about the neighbours: any slope may follow.
constexpr double mixed_grazing = 1e-6;

// The plane normal of a triangle of the model, in normalised space: any length, either sign. 0: not known.
using FaceNormal = std::function<Vec3d(std::uint32_t triangle)>;

// Of the triangles as the baker has them.
FaceNormal face_normals(const CenteredModel& model);

// One bit a triangle of an octahedral grid, 1 = mixed, in the layout of ../core/cell_triangles.h. A triangle
// is pure if its three corners have the same number of intervals, the same of these reach the centre, and on
// each of its edges each end of an interval continues to that of the other corner. That is so if the planes
// at both ends (those of the triangles of the model, which shading normals would only blur) say by how much W
// changes, give or take mixed_slack or mixed_share_of_change; or if W changes by no more than mixed_slope,
// and by something between what the two planes say, give or take mixed_slack. A triangle whose corners see
// nothing is pure. Decided from exact depths, not their codes. O(samples). Deterministic; parallel over rows
// in the caller's arena.
std::vector<std::byte> mixed_triangles(const SurfaceGrid& surfaces, const FaceNormal& face_normal);

} // namespace spa::bake
