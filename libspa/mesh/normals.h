// SPDX-License-Identifier: Apache-2.0
// Normals for models that come without them.
#pragma once

#include "model.h"

namespace spa {

// The largest angle between two faces that still look like one smooth surface.
constexpr double default_crease_angle_degrees = 40;

// Fills in missing normals: model.normals may be empty (all are missing) or hold zero vectors where one is
// missing; other normals stay as they are. Afterwards every normal is a unit vector.
//
// Two triangles that share an edge (by position: coincident vertices count as one) with at most
// crease_angle_degrees between their normals are smooth neighbours; the corners at one position that are
// connected through smooth neighbours share a normal, the sum of their face normals weighted by the angle at
// the corner (Thuermer and Wuethrich 1998), which does not depend on how the surface is cut into triangles. A
// vertex used by corners of several such groups is split: copies with equal other attributes are appended to
// the vertices. Triangles keep their order. A vertex with triangles of no area only, or with none at all,
// gets (0, 0, 1).
//
// An edge shared by n triangles compares each with the 16 before it only, so that the time stays O(n log n)
// in the size of the model for any input.
void compute_normals(Model& model, double crease_angle_degrees = default_crease_angle_degrees);

} // namespace spa
