// SPDX-License-Identifier: Apache-2.0
// The triangles of an octahedral map, and the bits that say which of them are mixed.
//
// A map of N cells a side has samples at the corners of its cells. Each cell (x, y), x column, y row from
// the top left, 0 <= x, y < N, is cut along the diagonal of its quadrant that is parallel to a + b = const,
// so that no triangle crosses the fold |s| + |t| = 1 and each lies within one octant (algorithm: projective
// trace). Triangle 0 has the corner of the cell that is nearest to the middle of the map (the +Z sample),
// triangle 1 the one that is farthest from it; both have the two ends of the diagonal.
//
// A triangle is mixed if the surfaces seen at its three corners do not all belong together, so that nothing
// may be interpolated between them. One bit a triangle, 1 = mixed; the layout is that of formats/SPA.md,
// "Mixed triangles".
#pragma once

#include "direction_map.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace spa {

// Corner 0 is the nearest (triangle 0) or the farthest (triangle 1) corner, 1 and 2 are the ends of the
// diagonal, first the one in the column of the nearest corner. cells: N, even; x, y < N; triangle: 0 or 1.
constexpr std::array<TexelIndex, 3> triangle_corners(std::uint32_t cells, std::uint32_t x, std::uint32_t y,
                                                     unsigned triangle) {
    const std::uint32_t half = cells / 2;
    const TexelIndex nearest{x < half ? x + 1 : x, y < half ? y + 1 : y};
    const TexelIndex farthest{x < half ? x : x + 1, y < half ? y : y + 1};
    return {triangle == 0 ? nearest : farthest, TexelIndex{nearest.x, farthest.y},
            TexelIndex{farthest.x, nearest.y}};
}

// Bytes of the bits of all triangles. N is even, so there are no bits left over.
constexpr std::uint64_t mixed_bytes(std::uint32_t cells) { return std::uint64_t(cells) * cells / 4; }

// The bit of a triangle; bit i is bit i % 8, from the lowest, of byte i / 8.
constexpr std::uint64_t triangle_bit(std::uint32_t cells, std::uint32_t x, std::uint32_t y,
                                     unsigned triangle) {
    return 2 * (std::uint64_t(y) * cells + x) + triangle;
}

// mixed: mixed_bytes(cells) bytes.
constexpr bool is_mixed(std::span<const std::byte> mixed, std::uint64_t bit) {
    return ((mixed[std::size_t(bit / 8)] >> unsigned(bit % 8)) & std::byte{1}) != std::byte{0};
}

// Share of the triangles that are mixed, each counted once whatever its solid angle; 0 without bits.
// O(bytes).
constexpr double mixed_share(std::span<const std::byte> mixed) {
    std::uint64_t count = 0;
    for (const std::byte b : mixed) count += unsigned(std::popcount(std::to_integer<unsigned>(b)));
    return mixed.empty() ? 0 : double(count) / (8 * double(mixed.size()));
}

} // namespace spa
