// SPDX-License-Identifier: Apache-2.0
#include "mixed.h"

#include "sample_directions.h"

#include "../core/cell_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace spa::bake {
namespace {

// One end of an interval at one sample. In an octant W is linear over a plane: W(g) = plane . g.
struct End {
    double w = 0;         // 0: no surface
    Vec3d plane;          // of the triangle's plane
    bool bounded = false; // the plane says something about the neighbours
};

End make_end(const SurfacePoint& point, Vec3d g, const FaceNormal& face_normal) {
    End end;
    if (!(point.radius > 0)) return end;
    const double size = length(g);
    const Vec3d normal = face_normal(point.triangle);
    const double along = dot(normal, g) / size;
    end.w = size / double(point.radius);
    end.bounded = std::abs(along) > mixed_grazing * length(normal);
    if (end.bounded) end.plane = normal * (1 / (along * double(point.radius)));
    return end;
}

// The changes of W along an edge that one end's plane allows. Beyond the steepest slope it makes no
// difference what the plane says.
std::pair<double, double> expected_change(bool bounded, double change, double steepest) {
    if (!bounded) return {-steepest, steepest};
    const double clamped = std::clamp(change, -steepest, steepest);
    return {clamped, clamped};
}

bool ends_match(const End& a, Vec3d direction_a, const End& b, Vec3d direction_b, double edge) {
    if (a.w == 0 || b.w == 0) return a.w == b.w;
    const double unit = edge * (a.w + b.w) / 2;
    const double change = b.w - a.w;
    const double slack = mixed_slack * unit;
    const double by_a = dot(a.plane, direction_b) - a.w;
    const double by_b = b.w - dot(b.plane, direction_a);
    const double off = std::max(std::abs(by_a - change), std::abs(by_b - change));
    if (a.bounded && b.bounded && off <= std::max(slack, mixed_share_of_change * std::abs(change)))
        return true;
    const double steepest = mixed_slope * unit;
    if (std::abs(change) > steepest) return false;
    const auto [low_a, high_a] = expected_change(a.bounded, by_a, steepest);
    const auto [low_b, high_b] = expected_change(b.bounded, by_b, steepest);
    return change >= std::min(low_a, low_b) - slack && change <= std::max(high_a, high_b) + slack;
}

// Two rows of samples at a time, and what is known of the edges between them. An edge belongs to two
// triangles, and a row of samples to two rows of cells: nothing is computed twice within a run of rows.
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
        lower_.matches_right.resize(cells_);
        for (std::uint32_t x = 0; x <= cells_; ++x) {
            lower_.direction[x] = directions_(x, y);
            const std::size_t sample = std::size_t(y) * (cells_ + 1) + x;
            for (std::size_t k = 0; k < count; ++k)
                lower_.ends[x * count + k] =
                    make_end(surfaces_.surfaces[k][sample], lower_.direction[x], face_normal_);
        }
        for (std::uint32_t x = 0; x < cells_; ++x)
            lower_.matches_right[x] = match(lower_, x, lower_, x + 1, side());
    }

    // Sets the bits of the row of cells `y`, between the two rows of samples.
    void mark(std::uint32_t y, std::vector<std::byte>& mixed) const {
        bool left = match(upper_, 0, lower_, 0, side());
        for (std::uint32_t x = 0; x < cells_; ++x) {
            const bool right = match(upper_, x + 1, lower_, x + 1, side());
            const auto [nearest, end, other] = triangle_corners(cells_, x, y, 0);
            const auto row = [&](TexelIndex t) -> const Row& { return t.y == y ? upper_ : lower_; };
            const bool diagonal = match(row(end), end.x, row(other), other.x, side() * std::numbers::sqrt2);
            const bool top = upper_.matches_right[x], bottom = lower_.matches_right[x];
            // The nearest corner lies on two sides of the cell, the farthest one on the other two.
            const bool nearest_right = nearest.x != x, nearest_below = nearest.y != y;
            const bool pure[2] = {
                diagonal && (nearest_right ? right : left) && (nearest_below ? bottom : top),
                diagonal && (nearest_right ? left : right) && (nearest_below ? top : bottom)};
            for (const unsigned triangle : {0U, 1U}) {
                if (pure[triangle]) continue;
                const std::uint64_t bit = triangle_bit(cells_, x, y, triangle);
                mixed[std::size_t(bit / 8)] |= std::byte(1U << unsigned(bit % 8));
            }
            left = right;
        }
    }

private:
    struct Row {
        std::vector<Vec3d> direction;
        std::vector<End> ends; // those of one sample side by side
        std::vector<char> matches_right;
    };

    [[nodiscard]] double side() const { return 2.0 / cells_; }
    [[nodiscard]] bool match(const Row& a, std::uint32_t x, const Row& b, std::uint32_t z,
                             double edge) const {
        const std::size_t count = surfaces_.surfaces.size();
        for (std::size_t k = 0; k < count; ++k) {
            const End& p = a.ends[x * count + k];
            const End& q = b.ends[z * count + k];
            if (!ends_match(p, a.direction[x], q, b.direction[z], edge)) return false;
        }
        return true;
    }

    const SurfaceGrid& surfaces_;
    const FaceNormal& face_normal_;
    const SampleDirections& directions_;
    std::uint32_t cells_;
    Row upper_, lower_;
};

} // namespace

FaceNormal face_normals(const CenteredModel& model) {
    return [&model](std::uint32_t triangle) {
        const auto& vertex = model.model->triangles[triangle].vertex;
        const Vec3d a = to_double(model.positions[vertex[0]]);
        return cross(to_double(model.positions[vertex[1]]) - a, to_double(model.positions[vertex[2]]) - a);
    };
}

std::vector<std::byte> mixed_triangles(const SurfaceGrid& surfaces, const FaceNormal& face_normal) {
    const SampleDirections directions(surfaces.grid);
    const std::uint32_t cells = surfaces.grid.width - 1;
    std::vector<std::byte> mixed(std::size_t(mixed_bytes(cells)));
    // Two rows of cells fill whole bytes, one need not: N is even. Rows of samples are read again at the ends
    // of a range.
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, cells / 2, 8), [&](const auto& range) {
        Rows rows(surfaces, face_normal, directions);
        rows.next(2 * range.begin());
        for (std::uint32_t y = 2 * range.begin(); y < 2 * range.end(); ++y) {
            rows.next(y + 1);
            rows.mark(y, mixed);
        }
    });
    return mixed;
}

} // namespace spa::bake
