// SPDX-License-Identifier: Apache-2.0
// Between the library's types and those of the tracing text.
#pragma once

#include "ray.h"

#include "../../shaders/spa_map.h"

namespace spa::trace {

inline shader::float3 to_shader(Vec3f v) { return {v.x, v.y, v.z}; }

inline shader::SpaRay to_shader(const Ray& ray) {
    return {to_shader(ray.origin), ray.t_min, to_shader(ray.direction), ray.t_max};
}

// Of a hit that the text has reported.
inline Hit to_hit(const shader::SpaHit& found) {
    Hit hit;
    hit.t = found.t;
    hit.normal = normalize(Vec3f{found.normal.x, found.normal.y, found.normal.z});
    hit.map = {found.map.x, found.map.y};
    hit.layer = found.layer;
    hit.side = HitSide(found.side);
    hit.front = found.front != 0;
    return hit;
}

} // namespace spa::trace
