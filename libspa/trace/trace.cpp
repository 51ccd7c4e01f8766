// SPDX-License-Identifier: Apache-2.0
#include "trace.h"

#include "convert.h"

#include "../../shaders/spa_trace.h"

namespace spa::trace {

bool closest_hit(const TraceMap& map, const Ray& ray, std::uint32_t flags, Hit& hit) {
    shader::SpaHit found;
    const bool any = shader::spa_trace_projective(map.map(), to_shader(ray),
                                                  flags & (SPA_CULL_BACK | SPA_CULL_FRONT), found);
    hit = any ? to_hit(found) : Hit{};
    return any;
}

bool occluded(const TraceMap& map, const Ray& ray, std::uint32_t flags) {
    shader::SpaHit found;
    return shader::spa_trace_projective(map.map(), to_shader(ray), flags | SPA_ANY_HIT, found);
}

} // namespace spa::trace
