// SPDX-License-Identifier: Apache-2.0
// The stored colour and normal at a hit, on the CPU: the text of ../../shaders/spa_shade.h.
#pragma once

#include "ray.h"
#include "trace_map.h"

namespace spa::trace {

struct Shade {
    Vec3f color{1, 1,
                1}; // linear, of what is there, not multiplied by coverage; white if the map has no colours
    float coverage = 1; // share of the neighbourhood that is covered, in [0,1]
    Vec3f normal;       // unit, map space, out of the solid: the stored one, or the hit's if the map has none
    bool has_color = false;  // from an image
    bool has_normal = false; // from an image
};

// Bilinear, over seams and borders, each image in its own size; the outer surface's images where the inner
// one has none. hit: what a trace of this map gave. Never allocates or throws. Time: eight texels.
Shade shade(const TraceMap& map, const Hit& hit);

} // namespace spa::trace
