// SPDX-License-Identifier: Apache-2.0
// From sampled colours to the stored colour image: filtering of sub-texel samples, and dilation.
#pragma once

#include "intervals.h"

#include "../core/direction_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::bake {

using Rgba8 = std::array<std::uint8_t, 4>; // sRGB, straight alpha = coverage

// The grid of samples^2 sub-texel samples a texel of `coarse`. Octahedral: N * samples cells, so that
// vertices of the coarse grid are vertices of the fine one and borders fold alike.
Grid fine_grid(const Grid& coarse, std::uint32_t samples);

// Box filter, one texel wide, over the points of one surface on fine_grid(coarse, samples): colour is the
// mean in linear light weighted by alpha, alpha the share covered. samples = 1 copies. Parallel in the
// caller's arena.
std::vector<Rgba8> filter_color(const std::vector<SurfacePoint>& fine, const Grid& coarse,
                                std::uint32_t samples);

// Gives texels of alpha 0 within `rings` texels of a covered one the mean colour of their nearest covered
// neighbours, ring by ring, over seams and folds; their alpha stays 0. Bilinear and mip-mapped reads at a
// silhouette then find no background.
void dilate_color(std::vector<Rgba8>& image, const Grid& grid, unsigned rings);

} // namespace spa::bake
