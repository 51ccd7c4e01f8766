// SPDX-License-Identifier: Apache-2.0
// Many rays against one triangle, several at a time where the processor can.
#pragma once

#include "candidates.h"
#include "outermost_hit.h"
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

// keep_outermost for `count` samples side by side; radius 0: none.
void keep_outermost_row(const double* radius, std::uint32_t count, std::uint32_t triangle,
                        OutermostHit* hits);

// visit(first sample, radii, how many) for the rows of a rectangle of samples, in pieces. The radii may be
// written to.
template <class Visit>
void each_row(const RaySetup& setup, const SampleDirections& directions, const SampleRect& rect,
              Visit&& visit) {
    RadiusBlock block;
    for (std::uint32_t y0 = rect.y0; y0 <= rect.y1; y0 += RadiusBlock::rows) {
        for (std::uint32_t x0 = rect.x0; x0 <= rect.x1; x0 += RadiusBlock::columns) {
            const SampleRect part{x0, y0, std::min(rect.x1, x0 + RadiusBlock::columns - 1),
                                  std::min(rect.y1, y0 + RadiusBlock::rows - 1)};
            intersect_block(setup, directions, part, block);
            double* radius = block.radius.data();
            for (std::uint32_t y = y0; y <= part.y1; ++y, radius += RadiusBlock::columns)
                visit(TexelIndex{x0, y}, radius, part.x1 - x0 + 1);
        }
    }
}

} // namespace spa::bake
