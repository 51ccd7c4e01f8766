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
    void widen(double x, double y) {
        x0 -= x;
        x1 += x;
        y0 -= y;
        y1 += y;
    }
    void extend(double x, double y) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
    }
};

// Rounding without the library calls that std::ceil and std::floor are on x86-64 before SSE 4.1.
std::int64_t ceil_int(double v) {
    const auto i = std::int64_t(v);
    return i + (v > double(i) ? 1 : 0);
}
std::int64_t floor_int(double v) {
    const auto i = std::int64_t(v);
    return i - (v < double(i) ? 1 : 0);
}

// Of three mapped vertices.
template <class Mapped>
[[gnu::always_inline]] inline Bounds box_of(const Mapped& a, const Mapped& b, const Mapped& c) {
    return {std::min(std::min(a.x, b.x), c.x), std::min(std::min(a.y, b.y), c.y),
            std::max(std::max(a.x, b.x), c.x), std::max(std::max(a.y, b.y), c.y)};
}

// The samples in a box, cut to [0, width) x [0, height); false if there are none. Most boxes of a dense mesh
// lie between two columns or two rows: that is found first.
[[gnu::always_inline]] inline bool to_rect(const Bounds& box, const Grid& grid, SampleRect& rect) {
    const std::int64_t first_x = ceil_int(box.x0);
    const std::int64_t last_x = floor_int(box.x1);
    if (first_x > last_x) return false;
    const std::int64_t first_y = ceil_int(box.y0);
    const std::int64_t last_y = floor_int(box.y1);
    if (first_y > last_y) return false;
    const auto x0 = std::max<std::int64_t>(0, first_x);
    const auto x1 = std::min<std::int64_t>(std::int64_t(grid.width) - 1, last_x);
    const auto y0 = std::max<std::int64_t>(0, first_y);
    const auto y1 = std::min<std::int64_t>(std::int64_t(grid.height) - 1, last_y);
    if (x0 > x1 || y0 > y1) return false;
    rect = {std::uint32_t(x0), std::uint32_t(y0), std::uint32_t(x1), std::uint32_t(y1)};
    return true;
}

// atan(x) for 0 <= x <= 1 (Abramowitz & Stegun, 4.4.49).
constexpr double atan_error = 1e-5;
double fast_atan(double x) {
    const double q = x * x;
    return x * (0.9998660 + q * (-0.3302995 + q * (0.1801410 + q * (-0.0851330 + q * 0.0208351))));
}

// Within atan_error of std::atan2. (0, 0) gives 0.
double fast_atan2(double y, double x) {
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    const double most = std::max(ax, ay);
    const double octant = fast_atan(most > 0 ? std::min(ax, ay) / most : 0);
    const double quadrant = ay > ax ? std::numbers::pi / 2 - octant : octant;
    const double half = x < 0 ? std::numbers::pi - quadrant : quadrant;
    return y < 0 ? -half : half;
}

// spa::position_of, within atan_error where the map is lat-long.
Vec2d roughly_position_of(const Grid& grid, Vec3d p) {
    if (grid.mapping == Mapping::octahedral) return position_of(grid, p);
    const double phi = fast_atan2(p.x, p.z);
    const double theta = fast_atan2(std::sqrt(p.x * p.x + p.z * p.z), p.y);
    return {(phi / (2 * std::numbers::pi) + 0.5) * grid.width - 0.5,
            theta / std::numbers::pi * grid.height - 0.5};
}

} // namespace

Candidates::Candidates(const Grid& grid, const std::vector<Vec3f>& positions)
    : grid_(grid), positions_(&positions), mapped_(positions.size()),
      pad_(1e-3 + 2.5e-7 * std::max(grid.width, grid.height)) {
    // An angle is half a turn over the height, a whole one over the width.
    if (grid.mapping == Mapping::latlong)
        pad_ += atan_error / std::numbers::pi * std::max(0.5 * grid.width, 1.0 * grid.height);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            // Adding 0 turns -0 into 0: the octant and the side of the fold must not depend on the sign of
            // zero.
            const Vec3d p = to_double(positions[v]) + Vec3d{};
            const bool polar = grid_.mapping == Mapping::latlong && p.x == 0 && p.z == 0;
            const Vec2d xy = roughly_position_of(grid_, p);
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
    Bounds box = box_of(a, b, c);
    box.widen(pad_, pad_);
    return to_rect(box, grid_, rects[0]) ? 1 : 0;
}

std::size_t Candidates::find_clipped(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const {
    Polygon whole;
    for (const std::uint32_t v : triangle.vertex) whole.push(to_double((*positions_)[v]));
    const double half = (double(grid_.width) - 1) / 2;
    std::size_t count = 0;
    std::uint32_t some_positive = 0; // per axis: a corner with p[axis] >= 0, or <= 0
    std::uint32_t some_negative = 0;
    for (unsigned k = 0; k < whole.count; ++k) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            const double p = component(whole.corner[k], axis);
            some_positive |= (p >= 0 ? 1U : 0U) << axis;
            some_negative |= (p <= 0 ? 1U : 0U) << axis;
        }
    }
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        if ((octant & ~some_negative) != 0 || (~octant & 7U & ~some_positive) != 0) continue;
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
        box.widen(pad_, pad_);
        if (to_rect(box, grid_, rects[count])) ++count;
    }
    return count;
}

// Longitudes of a spherical triangle without a pole span less than half a turn, and are extreme at its
// corners.
std::size_t Candidates::find_latlong(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const {
    const Mapped& a = mapped_[triangle.vertex[0]];
    const Mapped& b = mapped_[triangle.vertex[1]];
    const Mapped& c = mapped_[triangle.vertex[2]];
    const double width = grid_.width;
    const bool regular = ((a.octant | b.octant | c.octant) & irregular) == 0;
    Bounds box = box_of(a, b, c);
    const double span = box.x1 - box.x0;
    if (regular && span < width / 2 - 2 * pad_ && box.x0 >= pad_ && box.x1 <= width - 1 - pad_) {
        // Away from seam and poles.
        box.widen(pad_, bulge(triangle, false, half_angle(span)) + pad_);
        return to_rect(box, grid_, rects[0]) ? 1 : 0;
    }

    double low = 0;
    double high = 0;
    for (const Mapped* m : {&b, &c}) {
        double d = double(m->x) - a.x;
        if (d > width / 2) d -= width;
        if (d < -width / 2) d += width;
        low = std::min(low, d);
        high = std::max(high, d);
    }
    const bool full = !regular || high - low >= width / 2 - 2 * pad_;
    const auto first = double(ceil_int(a.x + low - pad_));
    const auto last = double(floor_int(a.x + high + pad_));
    if (!full && first > last) return 0;

    box.widen(0, bulge(triangle, full, half_angle(high - low)) + pad_);
    if (full || last - first + 1 >= width) {
        box.x0 = 0;
        box.x1 = width - 1;
        return to_rect(box, grid_, rects[0]) ? 1 : 0;
    }
    std::size_t count = 0;
    for (const double shift : {0.0, -width, width}) {
        box.x0 = first + shift;
        box.x1 = last + shift;
        if (to_rect(box, grid_, rects[count])) ++count;
    }
    return count;
}

// How many rows a triangle on the lat-long map may reach past its corners. An edge does so where its great
// circle comes closest to the pole within the edge. Then the corner nearer to that point has at most half of
// the edge's longitudes to it, h, and by tan(latitude of the corner) = tan(latitude of the point) cos(their
// longitudes' difference) the bulge is at most (1/cos h - 1)/2 <= 0.32 h^2 for h <= 1/2.
inline double Candidates::bulge(const Triangle& triangle, bool full, double half_longitudes) const {
    if (!full && half_longitudes <= 0.5)
        return 0.32 * half_longitudes * half_longitudes / std::numbers::pi * grid_.height;
    return wide_bulge(triangle, full);
}

// Half of so many columns, as an angle of longitude.
inline double Candidates::half_angle(double columns) const {
    return (columns + 2 * pad_) / grid_.width * std::numbers::pi;
}

double Candidates::wide_bulge(const Triangle& triangle, bool full) const {
    // Wide ones: less than half the longest edge; around a pole all of it, because the triangle reaches the
    // pole, and no corner is farther from it than the longest edge.
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
    return longest / std::numbers::pi * grid_.height * (full ? 1.0 : 0.5);
}

} // namespace spa::bake
