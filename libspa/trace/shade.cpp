// SPDX-License-Identifier: Apache-2.0
#include "shade.h"

#include "convert.h"

#include "../../shaders/spa_shade.h"

namespace spa::trace {

Shade shade(const TraceMap& map, const Hit& hit) {
    const shader::SpaShade found = shader::spa_shade(map.map(), to_shader(hit));
    Shade result;
    result.color = to_vec(found.color);
    result.coverage = found.coverage;
    result.normal = to_vec(found.normal);
    result.has_color = found.has_color != 0;
    result.has_normal = found.has_normal != 0;
    return result;
}

} // namespace spa::trace
