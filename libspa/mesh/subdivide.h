// SPDX-License-Identifier: Apache-2.0
// Loop subdivision (Loop 1987) of a manifold triangle mesh with one texture coordinate a vertex.
#pragma once

#include "model.h"

#include <vector>

namespace spa {

// An indexed triangle mesh: edge-manifold, consistently oriented, open borders allowed.
struct ControlMesh {
    std::vector<Vec3d> positions;
    std::vector<Vec2d> uvs; // as long as positions, or empty
    std::vector<Triangle> triangles;
};

// Subdivides `levels` times. Interior vertices and edges get Loop's weights, border ones those of the cubic
// B-spline curve; uvs are treated as positions in a plane, so they follow the same weights. A level maps
// (V, E, F) to (V + E, 2 E + 3 F, 4 F) and twice as many border edges; the old vertices come first and keep
// their order. A mirror-symmetric mesh stays so up to rounding.
// Throws Error(internal) if the mesh is not manifold or an index is out of range, or uvs has another length
// than positions.
// Deterministic; time and memory O(F 4^levels).
ControlMesh subdivide_loop(const ControlMesh& mesh, unsigned levels);

} // namespace spa
