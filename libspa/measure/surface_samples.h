// SPDX-License-Identifier: Apache-2.0
// Points spread evenly over the area of a triangle soup.
#pragma once

#include "../mesh/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::measure {

struct SurfaceSample {
    Vec3d position;
    std::uint32_t triangle = 0;
    Vec3d barycentric; // of the triangle's corners
};

// `count` points, each standing for the same area: one in each of `count` equal slices of the area in the
// triangles' order, placed in its triangle by a low-discrepancy sequence (R2, Roberts 2018), so that the same
// input gives the same points. Triangles of no area get none; none at all if the whole soup has no area.
// O(triangles + count).
std::vector<SurfaceSample> sample_surface(std::span<const Vec3f> positions,
                                          std::span<const Triangle> triangles, std::uint32_t count);

} // namespace spa::measure
