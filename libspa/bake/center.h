// SPDX-License-Identifier: Apache-2.0
// Centering a model, and the search for the centre that sees most of it.
#pragma once

#include "crossings.h"

#include "../mesh/part_frame.h"

namespace spa::bake {

// The model in the normalised space of a part (crossings.h). O(vertices).
CenteredModel center_model(const Model& model, const PartFrame& part);

// Share of the model's surface area that is outermost seen from `center`, estimated from the outermost
// crossings over a coarse octahedral map: each stands for solid angle * r^2 / cos of its triangle's plane.
double captured_area(const Model& model, Vec3d center);

// The centre with the largest captured area found by a pattern search (Hooke & Jeeves 1961) that starts at
// `start` and at the area centroid, with steps from 1/4 to 1/64 of the bounding box's half diagonal.
// Deterministic. At most 2 + 6 * 24 evaluations of captured_area.
Vec3d captured_center(const Model& model, Vec3d start);

} // namespace spa::bake
