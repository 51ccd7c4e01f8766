// SPDX-License-Identifier: Apache-2.0
#include "mixed.h"

#include "sample_directions.h"

#include "../core/cell_triangles.h"
#include "../core/folds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <numbers>
#include <utility>

namespace spa::bake {
namespace {

// Two rows of samples at a time: a row belongs to two rows of cells, and nothing is computed twice within a
// run of rows.
class Rows {
public:
    Rows(const SurfaceGrid& surfaces, const FaceNormal& face_normal, const SampleDirections& directions)
        : surfaces_(surfaces), face_normal_(face_normal), directions_(directions),
          cells_(surfaces.grid.width - 1) {}

    // The row of samples `y` becomes the lower one, what was the lower one the upper one.
    void next(std::uint32_t y) {
        std::swap(upper_, lower_);
        const std::size_t count = surfaces_.surfaces.size();
        lower_.direction.resize(cells_ + 1);
        lower_.ends.resize(count * (cells_ + 1));
        for (std::uint32_t x = 0; x <= cells_; ++x) {
            lower_.direction[x] = directions_(x, y);
            const std::size_t sample = std::size_t(y) * (cells_ + 1) + x;
            for (std::size_t k = 0; k < count; ++k) {
                const SurfacePoint& point = surfaces_.surfaces[k][sample];
                lower_.ends[x * count + k] =
                    make_end(double(point.radius), point.triangle, lower_.direction[x], face_normal_);
            }
        }
    }

    // The edges along the lower row, which is row y.
    void match_along(std::uint32_t y, std::vector<std::uint8_t>& edges) const {
        for (std::uint32_t x = 0; x < cells_; ++x)
            edges[edge_number(cells_, {x, y}, 0)] = match(lower_, x, lower_, x + 1, side());
    }

    // The edges of the row of cells `y`, between the two rows of samples.
    void match_between(std::uint32_t y, std::vector<std::uint8_t>& edges) const {
        for (std::uint32_t x = 0; x <= cells_; ++x)
            edges[edge_number(cells_, {x, y}, 1)] = match(upper_, x, lower_, x, side());
        for (std::uint32_t x = 0; x < cells_; ++x) {
            const std::uint32_t edge = edge_number(cells_, {x, y}, 2);
            const auto [first, second] = edge_ends(cells_, edge);
            const auto row = [&](TexelIndex t) -> const Row& { return t.y == y ? upper_ : lower_; };
            edges[edge] = match(row(first), first.x, row(second), second.x, side() * std::numbers::sqrt2);
        }
    }

private:
    struct Row {
        std::vector<Vec3d> direction;
        std::vector<SurfaceEnd> ends; // those of one sample side by side
    };

    [[nodiscard]] double side() const { return 2.0 / cells_; }
    [[nodiscard]] std::uint8_t match(const Row& a, std::uint32_t x, const Row& b, std::uint32_t z,
                                     double edge) const {
        const std::size_t count = surfaces_.surfaces.size();
        for (std::size_t k = 0; k < count; ++k) {
            const SurfaceEnd& p = a.ends[x * count + k];
            const SurfaceEnd& q = b.ends[z * count + k];
            if (!ends_match(p, a.direction[x], q, b.direction[z], edge)) return 0;
        }
        return 1;
    }

    const SurfaceGrid& surfaces_;
    const FaceNormal& face_normal_;
    const SampleDirections& directions_;
    std::uint32_t cells_;
    Row upper_, lower_;
};

} // namespace

std::vector<std::uint8_t> match_edges(const SurfaceGrid& surfaces, const FaceNormal& face_normal) {
    const SampleDirections directions(surfaces.grid);
    const std::uint32_t cells = surfaces.grid.width - 1;
    std::vector<std::uint8_t> edges(edge_count(cells), 1);
    // Rows of samples are read again at the ends of a range.
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, cells, 16), [&](const auto& range) {
        Rows rows(surfaces, face_normal, directions);
        rows.next(range.begin());
        if (range.begin() == 0) rows.match_along(0, edges);
        for (std::uint32_t y = range.begin(); y < range.end(); ++y) {
            rows.next(y + 1);
            rows.match_along(y + 1, edges);
            rows.match_between(y, edges);
        }
    });
    return edges;
}

std::vector<std::byte> mixed_triangles(std::uint32_t cells, const std::vector<std::uint8_t>& matching_edges) {
    std::vector<std::byte> mixed(std::size_t(mixed_bytes(cells)));
    // Two rows of cells fill whole bytes, one need not: N is even.
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, cells / 2, 8), [&](const auto& range) {
        for (std::uint32_t y = 2 * range.begin(); y < 2 * range.end(); ++y) {
            for (std::uint32_t x = 0; x < cells; ++x) {
                for (const unsigned triangle : {0U, 1U}) {
                    bool pure = true;
                    for (const TriangleEdge& e : triangle_edges(cells, x, y, triangle))
                        pure = pure && matching_edges[e.edge] != 0;
                    if (pure) continue;
                    const std::uint64_t bit = triangle_bit(cells, x, y, triangle);
                    mixed[std::size_t(bit / 8)] |= std::byte(1U << unsigned(bit % 8));
                }
            }
        }
    });
    return mixed;
}

std::vector<std::byte> mixed_triangles(const SurfaceGrid& surfaces, const FaceNormal& face_normal) {
    return mixed_triangles(surfaces.grid.width - 1, match_edges(surfaces, face_normal));
}

} // namespace spa::bake
