// SPDX-License-Identifier: Apache-2.0
// Centering a model, and the search for the centre that sees most of it.
#pragma once

#include "crossings.h"

#include "../mesh/part_frame.h"

namespace spa::bake {

// The model in the normalised space of a part (crossings.h). O(vertices).
CenteredModel center_model(const Model& model, const PartFrame& part);

// A point near `center`, which lies on the surface, but clear of it. From a point of the surface half of the
// directions leave at radius 0 and rounding decides which; whether the solid holds it is undecided too. Moves
// against the mean normal of the triangles around it, so into a solid, or else along it, by 1/16, 1/32 or
// 1/64 of the farthest vertex's distance: the first from which no triangle is nearer than a quarter of that.
// Deterministic; `center` itself if there is none. O(triangles).
Vec3d center_off_surface(const Model& model, Vec3d center);

// Share of the model's surface area that is outermost seen from `center`, estimated from the outermost
// crossings over a coarse octahedral map: each stands for solid angle * r^2 / cos of its triangle's plane.
double captured_area(const Model& model, Vec3d center);

// The centre with the largest captured area found by a pattern search (Hooke & Jeeves 1961) that starts at
// `start` and at the area centroid, with steps from 1/4 to 1/64 of the bounding box's half diagonal.
// Deterministic. At most 2 + 6 * 24 evaluations of captured_area.
Vec3d captured_center(const Model& model, Vec3d start);

} // namespace spa::bake
