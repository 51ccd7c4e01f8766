// SPDX-License-Identifier: Apache-2.0
// Between the library's types and those of the tracing text.
#pragma once

#include "ray.h"

#include "../../shaders/spa_map.h"

namespace spa::trace {

inline shader::float3 to_shader(Vec3f v) { return {v.x, v.y, v.z}; }

inline Vec3f to_vec(shader::float3 v) { return {v.x, v.y, v.z}; }

inline shader::SpaRay to_shader(const Ray& ray) {
    return {to_shader(ray.origin), ray.t_min, to_shader(ray.direction), ray.t_max};
}

inline shader::SpaHit to_shader(const Hit& hit) {
    shader::SpaHit result = shader::spa_no_hit();
    result.t = hit.t;
    result.map = {hit.map.x, hit.map.y};
    result.normal = to_shader(hit.normal);
    result.layer = hit.layer;
    result.side = std::uint32_t(hit.side);
    result.front = hit.front ? 1U : 0U;
    return result;
}

// Of a hit that the text has reported.
inline Hit to_hit(const shader::SpaHit& found) {
    Hit hit;
    hit.t = found.t;
    hit.normal = normalize(to_vec(found.normal));
    hit.map = {found.map.x, found.map.y};
    hit.layer = found.layer;
    hit.side = HitSide(found.side);
    hit.front = found.front != 0;
    return hit;
}

} // namespace spa::trace
