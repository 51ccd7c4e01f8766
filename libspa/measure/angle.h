// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../core/vector.h"

#include <numbers>

namespace spa::measure {

// The angle between two vectors of any length, in degrees, exact for small angles; 0 if one is zero.
inline double angle_degrees(Vec3d a, Vec3d b) {
    return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

} // namespace spa::measure
