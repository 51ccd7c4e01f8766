// SPDX-License-Identifier: Apache-2.0
#include "ray_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace spa::test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float& coordinate(Vec3f& v, std::uint32_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

} // namespace

const char* name(RayClass kind) {
    constexpr std::array<const char*, ray_class_count> names{
        "center",     "sample", "axis",  "plane",   "diagonal", "octant border",
        "map border", "corner", "chord", "tangent", "limits",   "fold"};
    return names[std::size_t(kind)];
}

Vec3d RayMaker::direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_);
    const double y = normal(random_);
    return normalize(Vec3d{x, y, normal(random_)});
}

std::uint32_t RayMaker::flags() {
    const std::uint32_t kind = below(8);
    return kind == 0 ? trace::cull_back : kind == 1 ? trace::cull_front : trace::no_flags;
}

Vec3d RayMaker::stored_point(TexelIndex at) {
    const auto& intervals = samples_.intervals(at);
    const Vec3d g = samples_.direction(at);
    if (intervals.empty()) return g * uniform(0.01, 1);
    const StoredInterval& interval = intervals[below(std::uint32_t(intervals.size()))];
    return g * (1 / (interval.inner > 0 && chance(0.3) ? interval.inner : interval.outer));
}

trace::Ray RayMaker::through(Vec3d from, Vec3d target) {
    Vec3d d = target - from;
    if (chance(0.25)) d = d * std::pow(10.0, uniform(-6, 6));
    return {to_float(from), 0, to_float(d), infinity};
}

// Through two random points of the plane that two directions span with the centre.
trace::Ray RayMaker::in_plane(Vec3d a, Vec3d b) {
    const double turn = uniform(0, 6.2831853);
    const Vec3d along = normalize(a + b);
    const Vec3d across = normalize(a - b);
    const Vec3d from = (along * std::cos(turn) + across * std::sin(turn)) * uniform(1.1, 3);
    const double to = uniform(0, 6.2831853);
    return through(from, (along * std::cos(to) + across * std::sin(to)) * uniform(0, 0.9));
}

trace::Ray RayMaker::diagonal() {
    if (chance(0.4)) {
        // Coordinates that are equal to the bit, but for the sign.
        trace::Ray ray = through(outside(), direction() * uniform(0, 0.7));
        const std::uint32_t from = below(3);
        const std::uint32_t to = (from + 1 + below(2)) % 3;
        const float sign = chance(0.5) ? 1.0F : -1.0F;
        coordinate(ray.origin, to) = sign * coordinate(ray.origin, from);
        coordinate(ray.direction, to) = sign * coordinate(ray.direction, from);
        return ray;
    }
    // The plane through a side or the diagonal of a cell.
    const std::uint32_t n = samples_.cells();
    const std::uint32_t x = below(n);
    const std::uint32_t y = below(n);
    const GridTriangle triangle = grid_triangle(n, x, y, below(2));
    const std::uint32_t side = below(3);
    return in_plane(samples_.direction(triangle.corners[side]),
                    samples_.direction(triangle.corners[(side + 1) % 3]));
}

Vec3d RayMaker::between(TexelIndex at, std::uint32_t dx, std::uint32_t dy) {
    const TexelIndex next{at.x + dx, at.y + dy};
    const double share = chance(0.3) ? 0.5 : uniform(0, 1);
    const double w0 = samples_.intervals(at).empty() ? 2 : samples_.intervals(at)[0].outer;
    const double w1 = samples_.intervals(next).empty() ? 2 : samples_.intervals(next)[0].outer;
    const Vec3d g = samples_.direction(at) * (1 - share) + samples_.direction(next) * share;
    return g * (1 / (w0 * (1 - share) + w1 * share));
}

trace::Ray RayMaker::tangent() {
    if (chance(0.4)) {
        const Vec3d at = direction();
        const Vec3d along = normalize(cross(at, direction()));
        return through(at + along * uniform(0.5, 2), at);
    }
    const TexelIndex sample = any_sample();
    const auto& intervals = samples_.intervals(sample);
    const Vec3d at = stored_point(sample);
    Vec3d normal = intervals.empty() ? normalize(at) : intervals[0].outer_normal;
    if (length(normal) < 0.5) normal = normalize(at);
    const Vec3d along = normalize(cross(normal, direction()));
    return through(at + along * uniform(0.5, 2), at);
}

Vec3d RayMaker::cut_point(const FoldRecord& record) {
    const std::array<TexelIndex, 2> ends = edge_ends(samples_.cells(), record.edge);
    const double f = fold_position(record.place);
    const Vec3d g =
        samples_.direction(ends[record.end]) * (1 - f) + samples_.direction(ends[1U - record.end]) * f;
    return normalize(g) * (record.cut[record.pair ? below(2) : 0] / 65535.0);
}

trace::Ray RayMaker::fold() {
    if (folds_.empty()) return make(RayClass::chord);
    const std::uint32_t i = below(std::uint32_t(folds_.size()));
    const Vec3d at = cut_point(folds_[i]);
    if (chance(0.7)) return through(outside(), at);
    // Of the records next to it one is often of the same triangle.
    const Vec3d other = cut_point(folds_[std::min<std::size_t>(i + 1, folds_.size() - 1)]);
    if (length(cross(at, other)) < 1e-9) return through(outside(), at);
    return in_plane(normalize(at), normalize(other));
}

trace::Ray RayMaker::make(RayClass kind) {
    const std::uint32_t n = samples_.cells();
    const std::uint32_t middle = n / 2;
    switch (kind) {
    case RayClass::center: {
        trace::Ray ray = through(outside(), {});
        ray.direction = ray.origin * (chance(0.5) ? -1.0F : -float(std::pow(10.0, uniform(-6, 6))));
        if (chance(0.3)) ray.origin = ray.origin + to_float(direction() * std::pow(10.0, uniform(-9, -2)));
        return ray;
    }
    case RayClass::sample: return through(outside(), stored_point(any_sample()));
    case RayClass::axis: {
        const std::uint32_t axis = below(3);
        const float sign = chance(0.5) ? 1.0F : -1.0F;
        trace::Ray ray{{0, 0, 0}, 0, {0, 0, 0}, infinity};
        const Vec3f aim = to_float(chance(0.5) ? stored_point(any_sample()) : direction() * uniform(0, 1));
        ray.origin = aim;
        ray.direction = {chance(0.5) ? 0.0F : -0.0F, chance(0.5) ? 0.0F : -0.0F, chance(0.5) ? 0.0F : -0.0F};
        coordinate(ray.origin, axis) = -sign * 2;
        coordinate(ray.direction, axis) = sign * float(std::pow(10.0, chance(0.25) ? uniform(-6, 6) : 0));
        const std::uint32_t other = (axis + 1 + below(2)) % 3;
        if (chance(0.3)) coordinate(ray.origin, other) = chance(0.5) ? 0.0F : -0.0F;
        if (chance(0.1)) coordinate(ray.origin, 3 - axis - other) = 0.0F;
        return ray;
    }
    case RayClass::plane: {
        trace::Ray ray =
            through(outside(), chance(0.5) ? stored_point(any_sample()) : direction() * uniform(0, 0.9));
        const std::uint32_t axis = below(3);
        coordinate(ray.origin, axis) = chance(0.5) ? 0.0F : -0.0F;
        coordinate(ray.direction, axis) = chance(0.5) ? 0.0F : -0.0F;
        return ray;
    }
    case RayClass::diagonal: return diagonal();
    case RayClass::octant_border:
        switch (below(3)) {
        case 0: return through(outside(), between({middle, below(n)}, 0, 1));
        case 1: return through(outside(), between({below(n), middle}, 1, 0));
        default: {
            // z = 0: the diagonals of the quadrants.
            const std::uint32_t i = below(middle);
            const bool left = chance(0.5);
            const bool low = chance(0.5);
            const TexelIndex at{left ? middle - i - 1 : middle + i, low ? n - i - 1 : i};
            return through(outside(),
                           left == low ? between(at, 1, 1) : between({at.x, at.y + 1}, 1, 0xFFFFFFFFU));
        }
        }
    case RayClass::map_border: {
        const std::uint32_t far = chance(0.5) ? n : 0;
        return through(outside(),
                       chance(0.5) ? between({far, below(n)}, 0, 1) : between({below(n), far}, 1, 0));
    }
    case RayClass::corner: {
        const std::array<TexelIndex, 9> corners{{{middle, middle},
                                                 {0, middle},
                                                 {n, middle},
                                                 {middle, 0},
                                                 {middle, n},
                                                 {0, 0},
                                                 {n, 0},
                                                 {0, n},
                                                 {n, n}}};
        return through(outside(), stored_point(corners[below(9)]));
    }
    case RayClass::chord: return through(outside(), direction() * std::sqrt(uniform(0, 1)));
    case RayClass::tangent: return tangent();
    case RayClass::limits: {
        trace::Ray ray = through(chance(0.6) ? direction() * uniform(0, 1) : outside(),
                                 chance(0.5) ? stored_point(any_sample()) : direction() * uniform(0, 1));
        const double size = 1 / length(to_double(ray.direction));
        if (chance(0.5)) ray.t_min = float(uniform(chance(0.3) ? -2 : 0, 1.5) * size);
        if (chance(0.5)) ray.t_max = ray.t_min + float(uniform(0, 2) * size);
        return ray;
    }
    case RayClass::fold: return fold();
    }
    return {};
}

} // namespace spa::test
