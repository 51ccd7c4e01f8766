// SPDX-License-Identifier: Apache-2.0
// What a ray costs through one object: through its map, and through the triangles that it was baked from.
#pragma once

#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <cstdint>

namespace spa::measure {

struct SpeedOptions {
    std::uint32_t rays = 16384; // random chords of the sphere around the object (ray_sets.h)
    unsigned runs = 3;          // of which the fastest counts: what else the machine does only ever adds
};

struct RaySpeed {
    double ns = 0;           // a ray, of one thread's own time (stopwatch.h), by the calls for many rays
    std::uint64_t bytes = 0; // that tracing may touch, as TraceMethod::bytes
};

// The same rays for both: of a map of one part those of the part's normalised space, of several those of a
// sphere around all parts. Rays that meet nothing count too. O(samples) to make the map ready, which is not
// timed. Throws Error{unsupported} for maps that are not octahedral or too large to be traced (trace_map.h).
RaySpeed map_speed(const SphericalMap& map, const SpeedOptions& options);

// The model that the map stands for, by Embree (embree_peer.h), whose hierarchy is built before the clock
// runs.
RaySpeed triangle_speed(const Model& model, const SphericalMap& map, const SpeedOptions& options);

} // namespace spa::measure
