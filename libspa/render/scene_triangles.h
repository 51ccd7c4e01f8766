// SPDX-License-Identifier: Apache-2.0
// A scene's triangles in the order of the device: group by group, each with vertices of its own, so that what
// no ray needs is not there at all.
#pragma once

#include "render.h"

#include <span>
#include <vector>

namespace spa::render {

struct TriangleGroup {        // one bottom level
    std::uint32_t object = 0; // 1 + number of the placement that replaces it; 0: none
    bool alpha = false;       // some of it may be transparent
    std::uint32_t first_triangle = 0, triangle_count = 0;
    std::uint32_t first_vertex = 0, vertex_count = 0;
};

struct SceneTriangles {
    // As in Model; triangles' corners count from the first of all vertices.
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<Vec4f> colors;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> materials;
    std::vector<TriangleGroup> groups; // none without triangles; those of object 0 come first
};

// For each node 1 + the number of the placement that replaces it, or 0. Throws Error{usage} for a placement
// without node, without map unless it is dropped, or in the subtree of another.
std::vector<std::uint32_t> objects_of_nodes(const Scene& scene, std::span<const MapPlacement> maps);

SceneTriangles group_triangles(const Scene& scene, std::span<const std::uint32_t> objects_of_nodes,
                               std::size_t placements, bool keep_replaced);

} // namespace spa::render
