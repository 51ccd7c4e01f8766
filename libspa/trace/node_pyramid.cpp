// SPDX-License-Identifier: Apache-2.0
#include "node_pyramid.h"

#include "../../shaders/spa_projective.h"

#include <algorithm>
#include <bit>

namespace spa::trace {
namespace {

// What rays and planes evaluated in float may differ from the ends, relative.
constexpr float margin = 4e-6F;
constexpr std::uint32_t last_code = 0xFFFF; // an upper end: beyond any w; a lower end: nothing is here

std::uint32_t pattern(float value) { return std::bit_cast<std::uint32_t>(value); }

struct Codes {
    std::uint32_t base = 0, shift = 0;

    // The last code stands for what no ray reaches; codes are counted down from it, so none is beyond float.
    Codes(float w_min, float w_core) {
        const std::uint32_t top = pattern(w_core * (1 + 2 * margin));
        const std::uint32_t span = top - pattern(w_min * (1 - 2 * margin));
        while ((span >> shift) + 1 >= last_code) ++shift;
        base = top - (last_code << shift);
    }
    [[nodiscard]] std::uint32_t low(float w) const { return (pattern(w * (1 - margin)) - base) >> shift; }
    [[nodiscard]] std::uint32_t high(float w) const {
        if (w >= SPA_FAR) return last_code;
        return ((pattern(w * (1 + margin)) - base) >> shift) + 1;
    }
};

constexpr std::uint32_t empty_range = last_code; // from the last code to code 0

std::uint32_t encode(const Codes& codes, const Range& range) {
    return codes.low(range.low) | codes.high(range.high) << 16U;
}

// The cells' cores and their maxima, level by level as the nodes.
std::vector<float> build_cores(const MapCells& cells, std::size_t total) {
    if (std::all_of(cells.cores.begin(), cells.cores.end(), [](float core) { return core >= SPA_FAR; }))
        return {};
    std::vector<float> cores(total, 0.0F);
    std::size_t first = shader::spa_node(cells.levels, 0, 0);
    for (std::size_t i = 0; i < cells.cores.size(); ++i) cores[first + i] = cells.cores[i] * (1 + margin);
    for (std::uint32_t bits = cells.levels; bits > 0; --bits) {
        const std::size_t above = shader::spa_node(bits - 1, 0, 0);
        const std::size_t row = std::size_t(2) << bits;
        for (std::size_t i = 0; i < row * row; ++i) {
            float& core = cores[above + (i / row / 2) * (row / 2) + i % row / 2];
            core = std::max(core, cores[first + i]);
        }
        first = above;
    }
    return cores;
}

} // namespace

NodePyramid build_pyramid(const MapCells& cells, float w_core, std::uint32_t words) {
    NodePyramid pyramid;
    const Codes codes(cells.w_min, w_core);
    pyramid.words = words;
    pyramid.code_base = codes.base;
    pyramid.code_shift = codes.shift;
    std::size_t total = 0;
    for (std::uint32_t bits = 0; bits <= cells.levels; ++bits) total += std::size_t(4) << (2 * bits);
    pyramid.nodes.assign(words * total, words == 1 ? pattern(SPA_FAR) : empty_range);
    pyramid.cores = build_cores(cells, total);
    std::vector<Ranges> level = cells.ranges;
    for (std::uint32_t bits = cells.levels;; --bits) {
        const std::size_t first = shader::spa_node(bits, 0, 0);
        for (std::size_t i = 0; i < level.size(); ++i) {
            const Ranges& ranges = level[i];
            if (words == 1) {
                if (ranges.count() > 0) pyramid.nodes[first + i] = pattern(ranges[0].low * (1 - margin));
                continue;
            }
            for (unsigned n = 0; n < ranges.count(); ++n)
                pyramid.nodes[2 * (first + i) + n] = encode(codes, ranges[n]);
        }
        if (bits == 0) break;
        std::vector<Ranges> above(level.size() / 4);
        const std::size_t row = std::size_t(2) << bits;
        for (std::size_t i = 0; i < level.size(); ++i)
            above[(i / row / 2) * (row / 2) + i % row / 2].add(level[i]);
        level = std::move(above);
    }
    return pyramid;
}

} // namespace spa::trace
