// SPDX-License-Identifier: Apache-2.0
// Division of a model into as few pieces as its map needs to hold its surface.
#pragma once

#include "bake_options.h"

#include "../mesh/partition.h"

#include <cstdint>

namespace spa::bake {

// Share of the surface that `layers` layers hold around the centre of the model's bounding box
// (View::captured of surface_views.h): the outermost crossing of each line for one layer, 2 * layers for
// more. O(triangles).
double held_share(const Model& model, std::uint32_t layers);

// Begins with everything in one piece. As long as the pieces together hold less than `enough` of the surface,
// and there are less than `max_parts`, the piece that holds the least area is cut in two: by the one of
// twelve planes across the axes of its oriented box after which most is held, which cuts through connected
// surface or puts connected pieces to either side. A cut that brings less than a thousandth of the whole is
// not made. Pieces then overlap by one ring of triangles. Deterministic. O(triangles * (max_parts + 12 log
// max_parts)).
constexpr double enough_held = 0.99;
Partition divide_by_need(const Model& model, std::uint32_t layers, std::uint32_t max_parts,
                         double enough = enough_held);

} // namespace spa::bake
