// SPDX-License-Identifier: Apache-2.0
// Rays and what they hit.
#pragma once

#include "../core/vector.h"

#include <cstdint>
#include <limits>

namespace spa::trace {

// The points origin + t * direction with t_min <= t <= t_max. The direction may have any length; t is in its
// units, as ray-tracing APIs have it. Whoever calls says in which space.
struct Ray {
    Vec3f origin;
    float t_min = 0;
    Vec3f direction;
    float t_max = std::numeric_limits<float>::infinity();
};

enum class HitSide : std::uint32_t {
    outer, // where an interval of solid begins, seen from outside
    inner, // where it ends
    wall,  // the step between neighbouring samples that see different surfaces
};

// The same values as the SPA_... flags of ../../shaders/spa_map.h; combine with |.
enum TraceFlags : std::uint32_t {
    no_flags = 0,
    cull_back = 1,  // pass over hits from inside the solid
    cull_front = 2, // pass over hits from outside
};

constexpr std::uint32_t no_instance = 0xFFFFFFFFU;

struct Hit {
    float t = std::numeric_limits<float>::infinity(); // infinity: nothing was hit
    Vec3f normal;                                     // geometric, unit, out of the solid
    Vec2f map; // place on the map in [0,1]^2, from the left and the top
    std::uint32_t layer = 0;
    HitSide side = HitSide::outer;
    bool front = true;                    // the ray comes from outside the solid
    std::uint32_t instance = no_instance; // of a scene (scene.h)

    [[nodiscard]] bool valid() const { return t < std::numeric_limits<float>::infinity(); }
};

} // namespace spa::trace
