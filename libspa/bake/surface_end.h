// SPDX-License-Identifier: Apache-2.0
// Whether the surface at one end of an edge between two directions is that at its other end. Source:
// ../../docs/baking.md, "Mixed triangles".
#pragma once

#include "intervals.h"

#include <functional>
#include <utility>

namespace spa::bake {

// In units of h Wm of an edge between two directions g of one octant with |g|_1 = 1: h is its length in the
// octant's coordinates (a cell is 2/N wide) and Wm the mean of W = |g|_2 / r at its ends.
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

// Of the triangles as the baker has them; `model` outlives it.
FaceNormal face_normals(const CenteredModel& model);

// One end of an interval at one direction. In an octant W is linear over a plane: W(g) = plane . g.
struct SurfaceEnd {
    double w = 0;         // 0: no surface
    Vec3d plane;          // of the triangle's plane
    bool bounded = false; // the plane says something about the neighbours
};

// radius: r/R, 0 = no surface; triangle: that is met there.
SurfaceEnd make_end(double radius, std::uint32_t triangle, Vec3d g, const FaceNormal& face_normal);

// a at direction_a and b at direction_b belong to one surface: the planes at both ends say by how much W
// changes, give or take mixed_slack or mixed_share_of_change; or W changes by no more than mixed_slope, and
// by something between what the two planes say, give or take mixed_slack. Two ends without surface do match.
bool ends_match(const SurfaceEnd& a, Vec3d direction_a, const SurfaceEnd& b, Vec3d direction_b, double edge);

// By how much W changes otherwise than the planes say, mixed_slope at most; >= 0. Both have a surface.
double ends_differ(const SurfaceEnd& a, Vec3d direction_a, const SurfaceEnd& b, Vec3d direction_b,
                   double edge);

} // namespace spa::bake
