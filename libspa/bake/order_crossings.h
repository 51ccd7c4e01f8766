// SPDX-License-Identifier: Apache-2.0
// The order of one sample's crossings, and which of them are one (crossings.h).
#pragma once

#include "crossings.h"

#include <algorithm>
#include <array>

namespace spa::bake {

// Sorts by radius, outermost first; of equal radii the front face comes first, then the smaller triangle
// index. Those of one facing within merge_distance of the outermost of them become one, that of the smallest
// triangle index. Returns the new end. T has the members radius, triangle and front_facing of Crossing.
template <class T>
T* order_crossings(T* begin, T* end) {
    std::sort(begin, end, [](const T& a, const T& b) {
        if (a.radius != b.radius) return a.radius > b.radius;
        if (a.front_facing != b.front_facing) return a.front_facing;
        return a.triangle < b.triangle;
    });
    T* out = begin;
    std::array<T*, 2> last{};             // of each facing
    std::array<float, 2> outermost{0, 0}; // radius of the first that became part of it
    for (T* in = begin; in != end; ++in) {
        const std::size_t facing = in->front_facing ? 0 : 1;
        if (last[facing] && outermost[facing] - in->radius < merge_distance) {
            if (in->triangle < last[facing]->triangle) *last[facing] = *in;
            continue;
        }
        outermost[facing] = in->radius;
        *out = *in;
        last[facing] = out++;
    }
    return out;
}

} // namespace spa::bake
