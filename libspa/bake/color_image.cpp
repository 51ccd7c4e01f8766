// SPDX-License-Identifier: Apache-2.0
#include "color_image.h"

#include "../core/element_format.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

struct Taps {
    std::int64_t first; // offset of the first fine sample from samples * texel
    std::vector<float> weight;
};

// One texel wide around the sample. On vertex grids an even count ends in two half weights.
Taps box_taps(Mapping mapping, std::uint32_t samples) {
    if (mapping == Mapping::latlong) return {0, std::vector<float>(samples, 1.0F)};
    const std::int64_t reach = samples / 2;
    Taps taps{-reach, std::vector<float>(std::size_t(2 * reach + 1), 1.0F)};
    if (samples % 2 == 0) taps.weight.front() = taps.weight.back() = 0.5F;
    return taps;
}

// Sums over mirrored neighbourhoods round differently; identified samples must still be equal.
void copy_identified(std::vector<Rgba8>& image, const Grid& grid) {
    if (grid.mapping == Mapping::latlong) return;
    const auto copy = [&](std::uint32_t x, std::uint32_t y) {
        const TexelIndex from = canonical(grid, {x, y});
        image[std::size_t(y) * grid.width + x] = image[std::size_t(from.y) * grid.width + from.x];
    };
    const std::uint32_t n = grid.width - 1;
    for (std::uint32_t i = 0; i <= n; ++i) {
        copy(i, 0);
        copy(i, n);
        copy(0, i);
        copy(n, i);
    }
}

// Marks samples next to one of ring[..] != 0, and those at the border of the image, whose neighbours lie over
// the seam: a few more than those that dilation can reach in one pass, and far fewer than all.
void mark_near(const std::vector<std::uint8_t>& ring, const Grid& grid, std::vector<std::uint8_t>& near) {
    std::fill(near.begin(), near.end(), std::uint8_t(1));
    const std::size_t width = grid.width;
    for (std::size_t y = 1; y + 1 < grid.height; ++y) {
        const std::uint8_t* const above = ring.data() + (y - 1) * width;
        const std::uint8_t* const here = above + width;
        const std::uint8_t* const below = here + width;
        std::uint8_t* const out = near.data() + y * width;
        for (std::size_t x = 1; x + 1 < width; ++x) {
            out[x] = std::uint8_t(above[x - 1] | above[x] | above[x + 1] | here[x - 1] | here[x + 1] |
                                  below[x - 1] | below[x] | below[x + 1]);
        }
    }
}

} // namespace

Grid fine_grid(const Grid& coarse, std::uint32_t samples) {
    if (coarse.mapping == Mapping::latlong)
        return {coarse.mapping, coarse.width * samples, coarse.height * samples};
    const std::uint32_t side = (coarse.width - 1) * samples + 1;
    return {coarse.mapping, side, side};
}

std::vector<Rgba8> filter_color(const std::vector<SurfacePoint>& fine, const Grid& coarse,
                                std::uint32_t samples) {
    std::vector<Rgba8> image(std::size_t(coarse.width) * coarse.height);
    if (samples == 1) {
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = fine[i].color;
        return image;
    }
    std::array<float, 256> linear{};
    for (unsigned i = 0; i < 256; ++i) linear[i] = srgb_to_linear(std::uint8_t(i));
    const Grid grid = fine_grid(coarse, samples);
    const Taps taps = box_taps(coarse.mapping, samples);
    const auto filter = [&](std::uint32_t x, std::uint32_t y) -> Rgba8 {
        std::array<float, 3> sum{};
        float alpha = 0;
        float total = 0;
        for (std::size_t j = 0; j < taps.weight.size(); ++j) {
            for (std::size_t i = 0; i < taps.weight.size(); ++i) {
                const TexelIndex at = wrap(grid, std::int64_t(x) * samples + taps.first + std::int64_t(i),
                                           std::int64_t(y) * samples + taps.first + std::int64_t(j));
                const SurfacePoint& p = fine[std::size_t(at.y) * grid.width + at.x];
                const float w = taps.weight[i] * taps.weight[j];
                const float a = w * float(p.color[3]) / 255.0F;
                total += w;
                alpha += a;
                for (unsigned c = 0; c < 3; ++c) sum[c] += a * linear[p.color[c]];
            }
        }
        if (!(alpha > 0)) return {};
        return {linear_to_srgb(sum[0] / alpha), linear_to_srgb(sum[1] / alpha),
                linear_to_srgb(sum[2] / alpha), std::uint8_t(std::lround(alpha / total * 255))};
    };
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, coarse.height), [&](const auto& rows) {
        for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) {
            for (std::uint32_t x = 0; x < coarse.width; ++x)
                image[std::size_t(y) * coarse.width + x] = filter(x, y);
        }
    });
    copy_identified(image, coarse);
    return image;
}

void dilate_color(std::vector<Rgba8>& image, const Grid& grid, unsigned rings) {
    // 0 = no colour yet, otherwise 1 + the ring that gave it.
    std::vector<std::uint8_t> ring(image.size());
    for (std::size_t i = 0; i < image.size(); ++i) ring[i] = image[i][3] != 0 ? 1 : 0;
    std::vector<std::uint8_t> near(image.size());
    for (unsigned pass = 1; pass <= rings; ++pass) {
        mark_near(ring, grid, near);
        for (std::uint32_t y = 0; y < grid.height; ++y) {
            for (std::uint32_t x = 0; x < grid.width; ++x) {
                const std::size_t index = std::size_t(y) * grid.width + x;
                if (ring[index] != 0 || near[index] == 0) continue;
                std::array<unsigned, 3> sum{};
                unsigned count = 0;
                for (std::int64_t dy = -1; dy <= 1; ++dy) {
                    for (std::int64_t dx = -1; dx <= 1; ++dx) {
                        const TexelIndex at = wrap(grid, std::int64_t(x) + dx, std::int64_t(y) + dy);
                        const std::size_t neighbour = std::size_t(at.y) * grid.width + at.x;
                        if (ring[neighbour] == 0 || ring[neighbour] > pass) continue;
                        for (unsigned c = 0; c < 3; ++c) sum[c] += image[neighbour][c];
                        ++count;
                    }
                }
                if (count == 0) continue;
                for (unsigned c = 0; c < 3; ++c) image[index][c] = std::uint8_t((sum[c] + count / 2) / count);
                ring[index] = std::uint8_t(pass + 1);
            }
        }
    }
    copy_identified(image, grid);
}

} // namespace spa::bake
