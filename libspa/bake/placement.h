// SPDX-License-Identifier: Apache-2.0
// Where a part's centre stands and in which frame it is baked. Source: ../../docs/baking.md, "Part frame".
#pragma once

#include "bake_options.h"

#include "../mesh/part_frame.h"

#include <cstdint>
#include <optional>
#include <span>

namespace spa::bake {

struct Placement {
    Vec3d center;
    Mat3 frame;
    Center center_chosen = Center::bounds; // or captured
    bool kernel = false;                   // captured: a point of the star kernel, which needs no search
    bool moved_behind = false;             // bounds: of a flat object (part_frame.h)
    Frame frame_chosen = Frame::sphere;    // or affine
    // Of the oriented bounding box, its longest side to its shortest; at most 1e6. None if Frame::sphere was
    // asked for.
    std::optional<double> elongation;
    // Shares of the surface that the layers can hold from the bounds' centre and from this one, in [0, 1],
    // estimated (surface_views.h). None if Center::bounds was asked for, and nothing was compared.
    std::optional<double> captured_bounds, captured;
};

// As Options::center, ::frame and ::layers ask. turned: of Components. O(triangles), and at most 64 looks at
// a coarse model; parallel in the caller's arena, the same result for any number of threads.
Placement place_part(const Model& model, const Options& options, std::span<const std::uint8_t> turned);

} // namespace spa::bake
