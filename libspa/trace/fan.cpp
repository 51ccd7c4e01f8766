// SPDX-License-Identifier: Apache-2.0
#include "fan.h"

#include "convert.h"

namespace spa::trace {

bool fan_hit(const TraceMap& map, const Ray& ray, const shader::SpaFan& options, std::uint32_t flags,
             Hit& hit) {
    shader::SpaHit found;
    if (!shader::spa_trace_fan(map.map(), to_shader(ray), options, flags, found)) {
        hit = Hit{};
        return false;
    }
    hit = to_hit(found);
    return true;
}

} // namespace spa::trace
