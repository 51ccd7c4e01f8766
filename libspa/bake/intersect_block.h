// SPDX-License-Identifier: Apache-2.0
// Many rays against one triangle, several at a time where the processor can.
#pragma once

#include "candidates.h"
#include "sample_rays.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace spa::bake {

// RayHit::radius, to the last bit, of the rays of a rectangle of samples, or 0 where they miss.
struct RadiusBlock {
    static constexpr std::uint32_t columns = 32, rows = 16;
    static constexpr std::uint32_t lanes = SampleDirections::column_padding; // rounds rows up

    std::array<double, std::size_t(columns) * rows> radius; // of the sample (x, y) at y * columns + x
};

// size: of the rectangle, at most that of the block. Entries of the block beyond it are left undefined.
void intersect_block(const RaySetup& setup, const SampleDirections& directions, const SampleRect& rect,
                     RadiusBlock& block);

// visit(sample, radius) for every sample of a rectangle whose ray meets the triangle.
template <class Visit>
void each_hit(const RaySetup& setup, const SampleDirections& directions, const SampleRect& rect,
              Visit&& visit) {
    RadiusBlock block;
    for (std::uint32_t y0 = rect.y0; y0 <= rect.y1; y0 += RadiusBlock::rows) {
        for (std::uint32_t x0 = rect.x0; x0 <= rect.x1; x0 += RadiusBlock::columns) {
            const SampleRect part{x0, y0, std::min(rect.x1, x0 + RadiusBlock::columns - 1),
                                  std::min(rect.y1, y0 + RadiusBlock::rows - 1)};
            intersect_block(setup, directions, part, block);
            for (std::uint32_t y = y0; y <= part.y1; ++y) {
                const double* const radius = block.radius.data() + std::size_t(y - y0) * RadiusBlock::columns;
                for (std::uint32_t x = x0; x <= part.x1; ++x) {
                    if (radius[x - x0] > 0) visit(TexelIndex{x, y}, radius[x - x0]);
                }
            }
        }
    }
}

} // namespace spa::bake
