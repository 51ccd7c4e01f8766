// SPDX-License-Identifier: Apache-2.0
#include "judge_samples.h"

#include <algorithm>
#include <cmath>

namespace spa::test {
namespace {

double stored_w(const ImageView& depth, TexelIndex at, Vec3d g) {
    const double d = double(decode_depth(depth.format, depth.at(at.x, at.y)));
    return d > 0 ? double(std::min(float(length(g) / d), 1e9F)) : 0;
}

Vec3d stored_normal(const ImageView& normal, const Grid& grid, TexelIndex at) {
    if (normal.empty()) return {};
    if (normal.width != grid.width || normal.height != grid.height) {
        const Vec2d place =
            position_of({grid.mapping, normal.width, normal.height}, sample_direction(grid, at));
        at = {std::uint32_t(std::lround(place.x)), std::uint32_t(std::lround(place.y))};
    }
    return to_double(decode_normal(normal.format, normal.at(at.x, at.y)));
}

} // namespace

StoredSamples::StoredSamples(const Part& part, std::uint32_t layers)
    : grid_{part.mapping, part.layers[0].outer.depth.width, part.layers[0].outer.depth.height} {
    intervals_.resize(std::size_t(grid_.width) * grid_.height);
    std::uint32_t left = layers == 0 ? 0xFFFFFFFFU : layers;
    for (const Layer& layer : part.layers) {
        if (left-- == 0) break;
        for (std::uint32_t y = 0; y < grid_.height; ++y) {
            for (std::uint32_t x = 0; x < grid_.width; ++x) {
                const TexelIndex at{x, y};
                StoredInterval interval;
                interval.outer = stored_w(layer.outer.depth, at, direction(at));
                if (interval.outer == 0) continue;
                interval.outer_normal = stored_normal(layer.outer.normal, grid_, at);
                if (!layer.inner.empty()) {
                    interval.inner = stored_w(layer.inner.depth, at, direction(at));
                    interval.inner_normal = stored_normal(layer.inner.normal, grid_, at);
                }
                intervals_[std::size_t(y) * grid_.width + x].push_back(interval);
            }
        }
    }
    mixed_.assign(part.mixed.begin(), part.mixed.end());
    center_inside_ = part.center_inside;
}

bool StoredSamples::marked_mixed(std::uint32_t x, std::uint32_t y, std::uint32_t f) const {
    const std::size_t bit = 2 * (std::size_t(y) * cells() + x) + f;
    return !mixed_.empty() && ((std::to_integer<unsigned>(mixed_[bit / 8]) >> (bit % 8)) & 1U) != 0;
}

GridTriangle grid_triangle(std::uint32_t cells, std::uint32_t x, std::uint32_t y, std::uint32_t f) {
    // The cell's sides towards the middle of the map, and away from it.
    const bool right = x >= cells / 2;
    const bool low = y >= cells / 2;
    const std::uint32_t near_x = right ? x : x + 1;
    const std::uint32_t far_x = right ? x + 1 : x;
    const std::uint32_t near_y = low ? y : y + 1;
    const std::uint32_t far_y = low ? y + 1 : y;
    const TexelIndex own = f == 0 ? TexelIndex{near_x, near_y} : TexelIndex{far_x, far_y};
    return {{own, TexelIndex{near_x, far_y}, TexelIndex{far_x, near_y}}};
}

Barycentric::Barycentric(Vec3d a, Vec3d b, Vec3d c) {
    const double s = 1 / dot(a, cross(b, c));
    form = {cross(b, c) * s, cross(c, a) * s, cross(a, b) * s};
}

} // namespace spa::test
