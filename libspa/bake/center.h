// SPDX-License-Identifier: Apache-2.0
// Centering a model.
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

} // namespace spa::bake
