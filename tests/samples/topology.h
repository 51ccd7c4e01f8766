// SPDX-License-Identifier: Apache-2.0
// What a triangle mesh is, counted without any of the project's mesh code.
#pragma once

#include "../../libspa/mesh/model.h"

#include <cstdint>

namespace spa::test {

struct Topology {
    std::uint64_t vertices = 0; // distinct positions
    std::uint64_t edges = 0;    // undirected
    std::uint64_t faces = 0;
    std::uint64_t border_edges = 0;   // with one triangle
    std::uint64_t repeated_edges = 0; // directed edges of more than one triangle: non-manifold or misoriented
    std::uint64_t components = 0;
    double volume = 0; // signed: positive when front faces point out

    [[nodiscard]] std::int64_t euler() const {
        return static_cast<std::int64_t>(vertices + faces) - static_cast<std::int64_t>(edges);
    }
};

// Vertices of bit-equal position count as one.
Topology topology_of(const Model& model);

// Triangles that the ray from the origin crosses.
int crossings(const Model& model, Vec3d origin, Vec3d direction);

} // namespace spa::test
