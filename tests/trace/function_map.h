// SPDX-License-Identifier: Apache-2.0
// Parts made from functions of the direction, with depths in full precision.
#pragma once

#include "../../libspa/core/spherical_map.h"

#include <functional>
#include <memory>
#include <vector>

namespace spa::test {

class FunctionMap {
public:
    // depth: r/R along a unit direction, 0 = none; solid to the centre. One layer of the outer surface alone.
    FunctionMap(const Grid& grid, const std::function<double(Vec3d)>& depth) : grid_(grid) {
        part_.mapping = grid.mapping;
        part_.layers.resize(1);
        part_.layers[0].outer.depth = image(ElementFormat::f32, [&](Vec3d u, std::byte* out) {
            const double d = depth(u);
            if (d > 0) encode_depth(ElementFormat::f32, d, out);
        });
    }

    void set_inner(const std::function<double(Vec3d)>& depth) {
        part_.layers[0].inner.depth = image(ElementFormat::f32, [&](Vec3d u, std::byte* out) {
            const double d = depth(u);
            if (d > 0) encode_depth(ElementFormat::f32, d, out);
        });
    }
    void set_normals(const std::function<Vec3d(Vec3d)>& normal) {
        part_.layers[0].outer.normal = image(ElementFormat::oct16, [&](Vec3d u, std::byte* out) {
            encode_normal(ElementFormat::oct16, normal(u), out);
        });
    }
    // color: sRGB in [0,1].
    void set_colors(const std::function<Vec3d(Vec3d)>& color) {
        part_.layers[0].outer.color = image(ElementFormat::rgba8, [&](Vec3d u, std::byte* out) {
            const Vec3d c = color(u);
            out[0] = std::byte(std::lround(c.x * 255));
            out[1] = std::byte(std::lround(c.y * 255));
            out[2] = std::byte(std::lround(c.z * 255));
            out[3] = std::byte(255);
        });
    }

    Part& part() { return part_; }

private:
    ImageView image(ElementFormat format, const std::function<void(Vec3d, std::byte*)>& write) {
        const std::size_t size = element_size(format);
        const std::size_t count = std::size_t(grid_.width) * grid_.height;
        auto& bytes = *images_.emplace_back(std::make_unique<std::vector<std::byte>>(count * size));
        for (std::uint32_t y = 0; y < grid_.height; ++y)
            for (std::uint32_t x = 0; x < grid_.width; ++x)
                write(normalize(sample_direction(grid_, {x, y})),
                      bytes.data() + (std::size_t(y) * grid_.width + x) * size);
        return {bytes, grid_.width, grid_.height, format};
    }

    Grid grid_;
    Part part_;
    std::vector<std::unique_ptr<std::vector<std::byte>>> images_;
};

} // namespace spa::test
