// SPDX-License-Identifier: Apache-2.0
#include "candidates.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spa::bake {
namespace {

constexpr std::uint32_t irregular = 8;

std::uint32_t octant_of(Vec3d p) { return (p.x < 0 ? 1U : 0U) | (p.y < 0 ? 2U : 0U) | (p.z < 0 ? 4U : 0U); }

// Map coordinates (s, t) of a point of one octant, in the chart of that octant: on its borders this is the
// limit from inside, whatever the signs of zeros.
Vec2d octant_chart(std::uint32_t octant, Vec3d p) {
    const double l = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
    const double a = std::abs(p.x) / l;
    const double b = std::abs(p.y) / l;
    const bool front = (octant & 4U) == 0;
    const double s = front ? a : 1 - b;
    const double t = front ? b : 1 - a;
    return {(octant & 1U) != 0 ? -s : s, (octant & 2U) != 0 ? -t : t};
}

// A triangle cut by three planes has at most six corners.
struct Polygon {
    std::array<Vec3d, 8> corner;
    unsigned count = 0;
    void push(Vec3d p) { corner[count++] = p; }
};

double component(Vec3d p, unsigned axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// The part of a convex polygon with sign * p[axis] >= 0 (Sutherland & Hodgman 1974).
Polygon clip(const Polygon& in, unsigned axis, double sign) {
    Polygon out;
    for (unsigned k = 0; k < in.count; ++k) {
        const Vec3d p = in.corner[k];
        const Vec3d q = in.corner[(k + 1) % in.count];
        const double dp = sign * component(p, axis);
        const double dq = sign * component(q, axis);
        if (dp >= 0) out.push(p);
        if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) out.push(p + (q - p) * (dp / (dp - dq)));
    }
    return out;
}

struct Bounds {
    double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
    void extend(double x, double y) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
    }
};

// The samples in a padded box, cut to [0, width) x [0, height); false if there are none.
bool to_rect(const Bounds& box, double pad, const Grid& grid, SampleRect& rect) {
    const double x0 = std::max(0.0, std::ceil(box.x0 - pad));
    const double y0 = std::max(0.0, std::ceil(box.y0 - pad));
    const double x1 = std::min(double(grid.width) - 1, std::floor(box.x1 + pad));
    const double y1 = std::min(double(grid.height) - 1, std::floor(box.y1 + pad));
    if (x0 > x1 || y0 > y1) return false;
    rect = {std::uint32_t(x0), std::uint32_t(y0), std::uint32_t(x1), std::uint32_t(y1)};
    return true;
}

} // namespace

Candidates::Candidates(const Grid& grid, const std::vector<Vec3f>& positions)
    : grid_(grid), positions_(&positions), mapped_(positions.size()),
      pad_(1e-3 + 2.5e-7 * std::max(grid.width, grid.height)) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            // Adding 0 turns -0 into 0: the octant and the side of the fold must not depend on the sign of
            // zero.
            const Vec3d p = to_double(positions[v]) + Vec3d{};
            const bool polar = grid_.mapping == Mapping::latlong && p.x == 0 && p.z == 0;
            const Vec2d xy = position_of(grid_, p);
            mapped_[v] = {float(xy.x), float(xy.y), p == Vec3d{} || polar ? irregular : octant_of(p)};
        }
    });
}

std::size_t Candidates::find(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const {
    return grid_.mapping == Mapping::octahedral ? find_octahedral(triangle, rects)
                                                : find_latlong(triangle, rects);
}

// Within one octant the octahedral map is projective, so straight edges stay straight and the box of the
// corners holds the triangle.
std::size_t Candidates::find_octahedral(const Triangle& triangle,
                                        std::span<SampleRect, max_rects> rects) const {
    const Mapped& a = mapped_[triangle.vertex[0]];
    const Mapped& b = mapped_[triangle.vertex[1]];
    const Mapped& c = mapped_[triangle.vertex[2]];
    if (a.octant != b.octant || a.octant != c.octant || a.octant == irregular)
        return find_clipped(triangle, rects);
    Bounds box;
    for (const Mapped* m : {&a, &b, &c}) box.extend(m->x, m->y);
    return to_rect(box, pad_, grid_, rects[0]) ? 1 : 0;
}

std::size_t Candidates::find_clipped(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const {
    Polygon whole;
    for (const std::uint32_t v : triangle.vertex) whole.push(to_double((*positions_)[v]));
    const double half = (double(grid_.width) - 1) / 2;
    std::size_t count = 0;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        Polygon piece = whole;
        for (unsigned axis = 0; axis < 3 && piece.count > 0; ++axis) {
            piece = clip(piece, axis, (octant >> axis & 1U) != 0 ? -1.0 : 1.0);
        }
        if (piece.count == 0) continue;
        Bounds box;
        for (unsigned k = 0; k < piece.count; ++k) {
            const Vec3d p = piece.corner[k];
            if (dot(p, p) < 1e-24) { // no direction: the piece may cover the whole octant
                box.extend((octant & 1U) != 0 ? 0 : half, (octant & 2U) != 0 ? half : 0);
                box.extend((octant & 1U) != 0 ? half : 2 * half, (octant & 2U) != 0 ? 2 * half : half);
                continue;
            }
            const Vec2d st = octant_chart(octant, p);
            box.extend((st.x + 1) * half, (1 - st.y) * half);
        }
        if (to_rect(box, pad_, grid_, rects[count])) ++count;
    }
    return count;
}

// Longitudes of a spherical triangle without a pole span less than half a turn, and are extreme at its
// corners. Latitudes may bulge past the corners, by less than half the longest edge; a triangle around a pole
// reaches it, and no corner is farther from it than the longest edge.
std::size_t Candidates::find_latlong(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const {
    const Mapped& a = mapped_[triangle.vertex[0]];
    const Mapped& b = mapped_[triangle.vertex[1]];
    const Mapped& c = mapped_[triangle.vertex[2]];
    const double width = grid_.width;
    double low = 0;
    double high = 0;
    for (const Mapped* m : {&b, &c}) {
        double d = double(m->x) - a.x;
        if (d > width / 2) d -= width;
        if (d < -width / 2) d += width;
        low = std::min(low, d);
        high = std::max(high, d);
    }
    const bool full = high - low >= width / 2 - pad_ || a.octant == irregular || b.octant == irregular ||
                      c.octant == irregular;
    const double first = std::ceil(a.x + low - pad_);
    const double last = std::floor(a.x + high + pad_);
    if (!full && first > last) return 0;

    double longest = 0; // an upper bound of the longest edge as an angle
    for (unsigned k = 0; k < 3; ++k) {
        const Vec3d p = to_double((*positions_)[triangle.vertex[k]]);
        const Vec3d q = to_double((*positions_)[triangle.vertex[(k + 1) % 3]]);
        const Vec3d d = q - p;
        const double far2 = std::max(dot(p, p), dot(q, q));
        // Law of sines: sin(angle) <= |q - p| / max(|p|, |q|).
        const double angle = dot(p, q) > 0 && dot(d, d) < far2
                                 ? std::numbers::pi / 2 * std::sqrt(dot(d, d) / far2)
                                 : std::numbers::pi;
        longest = std::max(longest, angle);
    }
    const double rows = longest / std::numbers::pi * grid_.height * (full ? 1.0 : 0.5);
    Bounds box;
    for (const Mapped* m : {&a, &b, &c}) box.extend(m->x, m->y);
    box.y0 -= rows + pad_;
    box.y1 += rows + pad_;
    if (full || last - first + 1 >= width) {
        box.x0 = 0;
        box.x1 = width - 1;
        return to_rect(box, 0, grid_, rects[0]) ? 1 : 0;
    }
    std::size_t count = 0;
    for (const double shift : {0.0, -width, width}) {
        box.x0 = first + shift;
        box.x1 = last + shift;
        if (to_rect(box, 0, grid_, rects[count])) ++count;
    }
    return count;
}

} // namespace spa::bake
