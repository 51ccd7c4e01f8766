// SPDX-License-Identifier: Apache-2.0
// Our own instead of mapbox/earcut: that one removes collinear corners first, which leaves corners of the
// neighbouring faces in the middle of our edges.
#include "polygon.h"

#include <algorithm>
#include <cmath>

namespace spa::import {
namespace {

// Newell's method: twice the area vector. Relative to the first corner, to keep the digits of small polygons
// far from the origin.
Vec3d area_vector(std::span<const Vec3f> corners) {
    const Vec3d origin = to_double(corners[0]);
    Vec3d sum{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum = sum + cross(to_double(corners[i]) - origin, to_double(corners[i + 1]) - origin);
    return sum;
}

// Twice the signed area of a, b, c.
double orientation(Vec2d a, Vec2d b, Vec2d c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Drops the coordinate in which the area vector is longest, so that the 2D coordinates are those of the file,
// without rounding; the others are ordered so that the polygon turns counter-clockwise.
std::vector<Vec2d> project(std::span<const Vec3f> corners, Vec3d normal) {
    const double x = std::abs(normal.x);
    const double y = std::abs(normal.y);
    const double z = std::abs(normal.z);
    const bool drop_x = x >= y && x >= z;
    const bool drop_y = !drop_x && y >= z;
    double towards_viewer = normal.z;
    if (drop_x) towards_viewer = normal.x;
    if (drop_y) towards_viewer = normal.y;
    std::vector<Vec2d> points;
    points.reserve(corners.size());
    for (const Vec3f& corner : corners) {
        const Vec3d p = to_double(corner);
        Vec2d q{p.x, p.y};
        if (drop_x) q = {p.y, p.z};
        if (drop_y) q = {p.z, p.x};
        points.push_back(towards_viewer < 0 ? Vec2d{q.y, q.x} : q);
    }
    return points;
}

class EarClipper {
public:
    explicit EarClipper(std::vector<Vec2d> points)
        : points_(std::move(points)), count_(std::uint32_t(points_.size())), next_(count_), previous_(count_),
          is_reflex_(count_), budget_(1'000'000 + 1000 * std::uint64_t{count_}) {
        for (std::uint32_t i = 0; i < count_; ++i) {
            next_[i] = i + 1 < count_ ? i + 1 : 0;
            previous_[next_[i]] = i;
        }
        for (std::uint32_t i = 0; i < count_; ++i) {
            if (turn(i) < 0) {
                is_reflex_[i] = true;
                reflex_.push_back(i);
            }
        }
    }

    bool clip(std::vector<std::array<std::uint32_t, 3>>& triangles) {
        std::uint32_t left = count_;
        std::uint32_t current = 0;
        while (left > 3) {
            const std::uint32_t ear = find_ear(current, left);
            if (ear == count_) break;
            triangles.push_back({previous_[ear], ear, next_[ear]});
            next_[previous_[ear]] = next_[ear];
            previous_[next_[ear]] = previous_[ear];
            // Going on after the next corner gives fewer slivers than clipping around one corner.
            current = next_[next_[ear]];
            --left;
            settle(previous_[ear]);
            settle(next_[ear]);
        }
        const bool complete = left == 3;
        const std::uint32_t apex = current;
        for (std::uint32_t i = next_[apex]; next_[i] != apex; i = next_[i])
            triangles.push_back({apex, i, next_[i]});
        return complete;
    }

private:
    double turn(std::uint32_t i) const {
        return orientation(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    // A corner can stop being reflex when its neighbour is cut off, but never become so. Such corners leave
    // the list when they are half of it.
    void settle(std::uint32_t i) {
        if (!is_reflex_[i] || turn(i) < 0) return;
        is_reflex_[i] = false;
        if (++settled_ * 2 <= reflex_.size()) return;
        std::erase_if(reflex_, [&](std::uint32_t r) { return !is_reflex_[r]; });
        settled_ = 0;
    }

    // The next corner that can be cut off: an ear, or for want of one a corner on a straight line, which
    // takes no area with it. count_ if there is neither.
    std::uint32_t find_ear(std::uint32_t current, std::uint32_t left) {
        std::uint32_t straight = count_;
        for (std::uint32_t k = 0; k < left; ++k, current = next_[current]) {
            if (budget_ == 0) return count_;
            --budget_;
            const double t = turn(current);
            if (t == 0 && straight == count_) straight = current;
            if (t > 0 && is_empty(current)) return current;
        }
        return straight;
    }

    bool is_empty(std::uint32_t ear) {
        const Vec2d a = points_[previous_[ear]];
        const Vec2d b = points_[ear];
        const Vec2d c = points_[next_[ear]];
        for (const std::uint32_t i : reflex_) {
            if (budget_ == 0) return false;
            --budget_;
            if (!is_reflex_[i]) continue;
            const Vec2d p = points_[i];
            if (p == a || p == b || p == c) continue;
            if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0)
                return false;
        }
        return true;
    }

    std::vector<Vec2d> points_;
    std::uint32_t count_;
    std::vector<std::uint32_t> next_, previous_;
    std::vector<std::uint32_t> reflex_; // corners that turn the wrong way; only they can lie in an ear
    std::vector<bool> is_reflex_;       // false for those in reflex_ that no longer do
    std::size_t settled_ = 0;           // how many those are
    std::uint64_t budget_;
};

bool is_fan(const std::vector<Vec2d>& points) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        if (orientation(points[0], points[i], points[i + 1]) < 0) return false;
    }
    return true;
}

void append_fan(std::uint32_t count, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

} // namespace

bool triangulate_polygon(std::span<const Vec3f> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto count = std::uint32_t(corners.size());
    if (count == 3) {
        triangles.push_back({0, 1, 2});
        return true;
    }
    const Vec3d normal = area_vector(corners);
    if (normal == Vec3d{}) {
        append_fan(count, triangles);
        return false;
    }
    std::vector<Vec2d> points = project(corners, normal);
    if (is_fan(points)) {
        append_fan(count, triangles);
        return true;
    }
    return EarClipper(std::move(points)).clip(triangles);
}

} // namespace spa::import
