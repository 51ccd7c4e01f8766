// SPDX-License-Identifier: Apache-2.0
#include "content_folds.h"

#include "../../libspa/core/folds.h"

#include <algorithm>
#include <array>

namespace spa::container {
namespace {

// A valid depth of 0 has no bit set, in any format.
bool has_surface(const ImageView& depth, TexelIndex at) {
    const std::span<const std::byte> code(depth.at(at.x, at.y), element_size(depth.format));
    return std::any_of(code.begin(), code.end(), [](std::byte b) { return b != std::byte{0}; });
}

std::size_t count_crossings(const Part& part, TexelIndex at) {
    std::size_t count = 0;
    for (const Layer& layer : part.layers) {
        if (!has_surface(layer.outer.depth, at)) break;
        ++count;
        if (!layer.inner.empty() && has_surface(layer.inner.depth, at)) ++count;
    }
    return count;
}

bool is_of_triangle(std::uint32_t edge, std::uint32_t cells, TexelIndex cell, unsigned triangle) {
    const std::array<TriangleEdge, 3> edges = triangle_edges(cells, cell.x, cell.y, triangle);
    return std::any_of(edges.begin(), edges.end(), [edge](const TriangleEdge& e) { return e.edge == edge; });
}

// Triangles at an edge lie in the cell that has its number, and beyond an edge of kind 0 or 1 in the cell
// before that one. On the border of the map there is but one triangle.
bool is_between_mixed(std::span<const std::byte> mixed, std::uint32_t cells, std::uint32_t edge) {
    const std::uint32_t kind = edge % 3;
    const TexelIndex cell{edge / 3 % (cells + 1), edge / 3 / (cells + 1)};
    // Left of column 0 and above row 0 the numbers wrap and are no cell's.
    const TexelIndex before{kind == 1 ? cell.x - 1 : cell.x, kind == 0 ? cell.y - 1 : cell.y};
    for (const TexelIndex c : {cell, before}) {
        if (c.x >= cells || c.y >= cells) continue;
        for (const unsigned triangle : {0U, 1U})
            if (is_of_triangle(edge, cells, c, triangle) &&
                !is_mixed(mixed, triangle_bit(cells, c.x, c.y, triangle)))
                return false;
    }
    return true;
}

// Where the members of a record begin, as numbers of planes.
enum class Plane : std::uint8_t { edge = 0, index = 4, cut = 6 };

} // namespace

// Records are looked at where they lie: decoded they would take more memory than the file's limits speak of.
Status check_folds(const Structure& structure, std::uint32_t index, const Part& part) {
    const std::size_t count = part.folds.size() / fold_record_bytes;
    const std::uint32_t cells = part.layers[0].outer.depth.width - 1;
    const auto at = [&](Issue issue, Plane plane, std::size_t i) {
        const std::size_t section = find_image(structure, type_fold, index, 0, Side::outer);
        return in_section(issue, structure, section, std::size_t(plane) * count + i);
    };
    std::uint32_t edge = 0;
    std::array<std::size_t, 2> left{}; // crossings at the ends that no record of the edge has taken out yet
    for (std::size_t i = 0; i < count; ++i) {
        const FoldRecord record = decode_fold_step(part.folds, i);
        const std::uint32_t before = edge;
        edge += record.edge; // a step beyond 32 bits ends before where it began
        if (edge < before || !is_edge(cells, edge)) return at(Issue::fold_edge_not_valid, Plane::edge, i);
        if (i == 0 || edge != before) {
            if (!is_between_mixed(part.mixed, cells, edge))
                return at(Issue::fold_on_pure_triangle, Plane::edge, i);
            const std::array<TexelIndex, 2> ends = edge_ends(cells, edge);
            left = {count_crossings(part, ends[0]), count_crossings(part, ends[1])};
        }
        const std::size_t taken = record.pair ? 2 : 1;
        if (record.index + taken > left[record.end]) return at(Issue::fold_index_not_valid, Plane::index, i);
        left[record.end] -= taken;
        if (record.cut[0] == 0 || (record.cut[1] != 0) != record.pair)
            return at(Issue::fold_cut_not_valid, Plane::cut, i);
    }
    return {};
}

} // namespace spa::container
