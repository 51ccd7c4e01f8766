// SPDX-License-Identifier: Apache-2.0
#include "march.h"

#include "convert.h"

namespace spa::trace {

bool march_hit(const TraceMap& map, const Ray& ray, const shader::SpaMarch& options, std::uint32_t flags,
               Hit& hit) {
    shader::SpaHit found;
    if (!shader::spa_trace_march(map.map(), to_shader(ray), options, flags, found)) {
        hit = Hit{};
        return false;
    }
    hit = to_hit(found);
    return true;
}

} // namespace spa::trace
