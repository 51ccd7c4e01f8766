// SPDX-License-Identifier: Apache-2.0
// One surface of a map (surface: spherical_map.h) as pictures and as figures. The view must have passed the
// container's checks: bytes that match size and format.
#pragma once

#include "picture.h"

#include "../libspa/core/spherical_map.h"

#include <array>

namespace spa::tools {

Picture color_picture(const ImageView& color);    // over a checkerboard, by its alpha
Picture coverage_picture(const ImageView& color); // alpha: black = 0, white = 1
Picture depth_picture(const ImageView& depth);    // viridis of r/R; black where there is no surface
// x, y, z of [-1,1] as red, green, blue; black where `depth`, which may have another size, has no surface.
Picture normal_picture(const ImageView& normal, const ImageView& depth, Mapping mapping);

// Calls visit(x, y, has_surface) for every texel of `image`, row by row, looking up the nearest sample of
// `depth`.
template <class Visit>
void for_each_texel(const ImageView& image, const ImageView& depth, Mapping mapping, Visit visit) {
    const Grid grid{mapping, image.width, image.height};
    const Grid depth_grid{mapping, depth.width, depth.height};
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) {
            TexelIndex sample{x, y};
            if (grid != depth_grid) {
                const Vec2d position = position_of(depth_grid, sample_direction(grid, sample));
                sample = wrap(depth_grid, std::llround(position.x), std::llround(position.y));
            }
            visit(x, y, decode_depth(depth.format, depth.at(sample.x, sample.y)) > 0);
        }
}

struct DepthStatistics {
    double coverage = 0;                // share of all directions, by solid angle, with a surface
    std::array<double, 32> histogram{}; // shares of all directions; bin i holds i/32 <= depth < (i+1)/32, the
                                        // last one depth = 1 too; their sum is the coverage
    float min = 0, max = 0;             // of the surface; 0 if there is none
};
DepthStatistics depth_statistics(const ImageView& depth, Mapping mapping);

} // namespace spa::tools
