// SPDX-License-Identifier: Apache-2.0
// A model divided into pieces, each of which becomes a part of a map with a sphere of its own (the paper,
// section 6: "further divide an object into separate parts"; a sphere for each animation bone).
#pragma once

#include "scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spa {

struct Piece {
    std::vector<std::uint32_t> triangles; // of the whole model, ascending; pieces may share some
    std::string name;                     // of the node or joint; may be empty
    // As in Part (../core/spherical_map.h).
    std::int32_t node = -1, joint = -1;
    Affine to_node;
};

using Partition = std::vector<Piece>;

// Everything in one piece.
Partition whole(const Model& model);

// The connected pieces of the surface (components.h). If there are more than `max_parts`, the one with the
// least area is joined to the one whose area centroid is nearest, until there are not. max_parts >= 1.
// O(n log n + pieces^2); of more than 4096 pieces the smallest are put to their nearest among the 4096
// largest first.
Partition divide_by_components(const Model& model, std::uint32_t max_parts);

// What each node draws, in the order of the nodes; instances belong to their node. Throws Error{unsupported}
// for more than `max_parts` pieces and for a node whose transform cannot be inverted. O(triangles + nodes).
Partition divide_by_nodes(const Scene& scene, std::uint32_t max_parts);

// What follows each joint of a skin, or where there is none, each node. A triangle belongs to the bone with
// the largest weight, summed over its corners, and to every other that has at least `shared_weight` of any
// corner: the triangles of a seam are on both sides of it, so that no gap opens between them. scene.rig is
// not empty. Throws as divide_by_nodes. O(influences).
constexpr float shared_weight = 0.6F;
Partition divide_by_bones(const Scene& scene, std::uint32_t max_parts);

// Adds to every piece the triangles of other pieces that share a welded vertex with it: the cracks that
// sampling leaves along a cut are then covered from both sides. O(n).
void overlap_by_one_ring(const Model& model, Partition& partition);

} // namespace spa
