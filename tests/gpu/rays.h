// SPDX-License-Identifier: Apache-2.0
// Rays that are hard for a tracer, in map space.
#pragma once

#include "../../libspa/core/direction_map.h"
#include "../../shaders/spa_trace.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spa::test {

struct TestRay {
    shader::SpaRay ray;
    std::uint32_t flags;   // SPA_CULL_BACK, ...
    std::uint32_t options; // of fan and march (shaders/trace_ray.h)
};

// Kinds take turns, 64 rays each, for devices that like neighbours to be alike: from outside into the sphere
// and from within it; along axes and in the planes between octants; from the centre, through the centre,
// through samples of `grid`; from far away; with limits of t; and rays that are none. Directions are of any
// length; flags and options are any that a trace
// takes. Same seed, same rays.
std::vector<TestRay> make_rays(const Grid& grid, std::size_t count, std::uint32_t seed);

} // namespace spa::test
