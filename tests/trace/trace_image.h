// SPDX-License-Identifier: Apache-2.0
// Trace images made by hand: header, depths and images alone, as fan, march and shade read them.
#pragma once

#include "../../libspa/core/direction_map.h"
#include "../../shaders/spa_map.h"

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace spa::test {

class TraceImage {
public:
    // depth: r/R of a sample, 0 = none. surfaces: 1, or 2 for each layer.
    TraceImage(const Grid& grid, const std::function<double(TexelIndex)>& depth, std::uint32_t surfaces = 1)
        : grid_(grid) {
        using namespace shader;
        words_.resize(SPA_HEADER_WORDS);
        words_[SPA_HEADER_MAGIC] = SPA_MAGIC;
        words_[SPA_HEADER_MAPPING] = std::uint32_t(grid.mapping);
        words_[SPA_HEADER_WIDTH] = grid.width;
        words_[SPA_HEADER_HEIGHT] = grid.height;
        words_[SPA_HEADER_SURFACES] = surfaces;
        words_[SPA_HEADER_RADIUS] = std::bit_cast<std::uint32_t>(1.0F);
        words_[SPA_HEADER_IMAGES] = std::uint32_t(words_.size());
        words_.resize(words_.size() + SPA_IMAGE_WORDS * surfaces);
        words_[SPA_HEADER_DEPTHS] = std::uint32_t(words_.size());
        for (std::uint32_t y = 0; y < grid.height; ++y)
            for (std::uint32_t x = 0; x < grid.width; ++x)
                words_.push_back(std::bit_cast<std::uint32_t>(float(depth(canonical(grid, {x, y})))));
    }

    // element: the word of each texel.
    void set_colors(std::uint32_t surface, std::uint32_t width, std::uint32_t height,
                    const std::function<std::uint32_t(TexelIndex)>& element) {
        set_image(surface, 0, width, height, element);
    }
    void set_normals(std::uint32_t surface, std::uint32_t width, std::uint32_t height,
                     const std::function<std::uint32_t(TexelIndex)>& element) {
        set_image(surface, 3, width, height, element);
    }

    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] double depth(TexelIndex texel) const {
        const std::size_t index = words_[SPA_HEADER_DEPTHS] + std::size_t(texel.y) * grid_.width + texel.x;
        return double(std::bit_cast<float>(words_[index]));
    }
    // Valid while the image lives and nothing is added.
    [[nodiscard]] shader::SpaMap open() { // NOLINT(readability-make-member-function-const)
        words_[SPA_HEADER_LENGTH] = std::uint32_t(words_.size());
        return shader::spa_open({words_.data()});
    }

private:
    void set_image(std::uint32_t surface, std::uint32_t kind, std::uint32_t width, std::uint32_t height,
                   const std::function<std::uint32_t(TexelIndex)>& element) {
        const std::size_t entry = words_[SPA_HEADER_IMAGES] + surface * SPA_IMAGE_WORDS + kind;
        words_[entry] = std::uint32_t(words_.size());
        words_[entry + 1] = width;
        words_[entry + 2] = height;
        const Grid grid{grid_.mapping, width, height};
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) words_.push_back(element(canonical(grid, {x, y})));
    }

    Grid grid_;
    std::vector<std::uint32_t> words_;
};

inline const std::array<Grid, 6> all_grids{{{Mapping::latlong, 64, 48},
                                            {Mapping::latlong, 7, 5},
                                            {Mapping::latlong, 1, 1},
                                            {Mapping::octahedral, 65, 65},
                                            {Mapping::octahedral, 7, 7},
                                            {Mapping::octahedral, 3, 3}}};

} // namespace spa::test
