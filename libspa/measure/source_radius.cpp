// SPDX-License-Identifier: Apache-2.0
#include "source_radius.h"

#include "../core/error.h"

#include <algorithm>
#include <cmath>

namespace spa::measure {

double radius_about(const Model& model, Vec3d center, const Mat3& frame) {
    const Mat3 to_frame = inverse(frame);
    double radius = 0;
    for (const Triangle& triangle : model.triangles) {
        for (const std::uint32_t v : triangle.vertex)
            radius = std::max(radius, length(to_frame * (to_double(model.positions[v]) - center)));
    }
    if (!(radius > 0) || !std::isfinite(radius))
        throw Error(ExitCode::invalid_data,
                    "the source model has no extent: there is nothing to measure against");
    return radius * (1 + 1e-7); // as make_part_frame rounds it
}

} // namespace spa::measure
