// SPDX-License-Identifier: Apache-2.0
// A model's surface with few triangles, for looking at it from many points.
#pragma once

#include "../mesh/model.h"

namespace spa::bake {

// Positions and triangles alone: no normals, colours or textures, and so nothing that alpha makes invisible.
// A model of more than 16384 triangles is reduced by vertex clustering (Rossignac & Borrel 1993): one vertex,
// the mean, for each cell of a grid of 32^3 over the bounding box; triangles whose corners share a cell
// vanish, and of several between the same three cells, wound alike, one is left. What was closed stays
// closed, and what lay behind something thicker than a cell still does.
//
// O(triangles); parallel in the caller's arena, the same result for any number of threads. The order of the
// triangles of a reduced model does not depend on that of the model's.
Model coarse_model(const Model& model);

} // namespace spa::bake
