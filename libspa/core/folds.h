// SPDX-License-Identifier: Apache-2.0
// Fold records: what tells an octahedral map's mixed triangles which crossings of neighbouring samples belong
// together, and where between them surfaces end. Source: formats/SPA.md, "Folds"; the surface that they
// define is in docs/tracing.md, "Mixed triangles with folds".
//
// The crossings of a sample are the ends of its intervals, from outside in: crossing 2 k is the outer end of
// layer k, 2 k + 1 its inner end, which is not there where the interval reaches the centre.
//
// Edges are those of the grid's triangles (cell_triangles.h), numbered 3 (y (N + 1) + x) + kind:
//   kind 0   from sample (x, y) to (x + 1, y)
//   kind 1   from sample (x, y) to (x, y + 1)
//   kind 2   the diagonal of cell (x, y), from corner 1 to corner 2 of its triangles
// The first sample named is end 0, the other end 1. Where two edges of the map's border are the same edge of
// the object, both have their records.
#pragma once

#include "cell_triangles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa {

// Crossings of one end of an edge that do not reach the other end. Of the crossings at an end, those of its
// earlier records on the same edge are taken out before an index is counted. What all records of an edge
// leave at its two ends matches in order.
struct FoldRecord {
    std::uint32_t edge = 0;
    bool pair = false;      // two neighbours run into each other: a silhouette, or a gap that closes.
                            // false: one crossing ends alone, as at an open border
    std::uint8_t end = 0;   // 0 or 1
    std::uint8_t index = 0; // of the crossing, of a pair the outer one; less than fold_indices
    std::uint8_t place = 0; // the cut lies at fold_position(place) of the edge, counted from `end`
    std::array<std::uint16_t, 2> cut{}; // depths of the crossings at the cut, codes of ElementFormat::u16,
                                        // not 0; cut[1] = 0 unless it is a pair

    friend bool operator==(const FoldRecord&, const FoldRecord&) = default;
};

constexpr unsigned fold_indices = 64;
constexpr std::size_t fold_record_bytes = 10;
// Edges are numbered, and a map may have records, up to so many cells a side: their numbers have 32 bits.
constexpr std::uint32_t most_numbered_cells = 1U << 14U;

// In (0, 1], straight in the octant's coordinates.
constexpr double fold_position(std::uint8_t place) { return (place + 1) / 256.0; }

// Numbers of edges are less than this. cells: N <= most_numbered_cells.
constexpr std::uint32_t edge_count(std::uint32_t cells) { return 3 * (cells + 1) * (cells + 1); }
// A part has no more bytes of records than this, far above what any holds.
constexpr std::uint64_t most_fold_bytes(std::uint32_t cells) {
    return std::uint64_t(edge_count(cells)) * fold_indices * fold_record_bytes;
}
constexpr std::uint32_t edge_number(std::uint32_t cells, TexelIndex at, unsigned kind) {
    return 3 * (at.y * (cells + 1) + at.x) + kind;
}
// False for numbers that belong to no edge, as those to the right of the last column.
constexpr bool is_edge(std::uint32_t cells, std::uint32_t edge) {
    const std::uint32_t sample = edge / 3, kind = edge % 3;
    return edge < edge_count(cells) && (kind == 1 || sample % (cells + 1) < cells) &&
           (kind == 0 || sample / (cells + 1) < cells);
}
// edge: is_edge().
constexpr std::array<TexelIndex, 2> edge_ends(std::uint32_t cells, std::uint32_t edge) {
    const TexelIndex at{edge / 3 % (cells + 1), edge / 3 / (cells + 1)};
    if (edge % 3 == 0) return {at, TexelIndex{at.x + 1, at.y}};
    if (edge % 3 == 1) return {at, TexelIndex{at.x, at.y + 1}};
    const std::array<TexelIndex, 3> corners = triangle_corners(cells, at.x, at.y, 0);
    return {corners[1], corners[2]};
}

// An edge of a triangle: its number, and which of the triangle's corners are its ends 0 and 1.
struct TriangleEdge {
    std::uint32_t edge = 0;
    std::array<unsigned, 2> corner{};
};
// The edges of a triangle as triangle_corners() has them: opposite to corner 0 (the diagonal), 1 and 2.
std::array<TriangleEdge, 3> triangle_edges(std::uint32_t cells, std::uint32_t x, std::uint32_t y,
                                           unsigned triangle);

// The raw bytes of a FOLD section. records: edges ascending, in the order in which they apply. O(records).
std::vector<std::byte> encode_folds(std::span<const FoldRecord> records);
// bytes: a multiple of fold_record_bytes. Of bytes that encode_folds did not make, members may have any value
// in the range of their fields; edges are cut to 32 bits and may fall. O(bytes).
std::vector<FoldRecord> decode_folds(std::span<const std::byte> bytes);
// Record i alone. Its edge is the step from the edge of the record before it, of record 0 the edge itself.
FoldRecord decode_fold_step(std::span<const std::byte> bytes, std::size_t i);

} // namespace spa
