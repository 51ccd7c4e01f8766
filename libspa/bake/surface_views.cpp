// SPDX-License-Identifier: Apache-2.0
#include "surface_views.h"

#include "center.h"
#include "radial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spa::bake {
namespace {

constexpr Grid view_grid{Mapping::octahedral, 33, 33};
constexpr double most_spacing = 10;
// Grazing crossings would stand for area without bound.
constexpr double least_cosine = 0.05;
constexpr double points_at_least = 4096;
constexpr std::uint32_t most_divisions = 32; // of a triangle's sides

Vec3d area_vector(Vec3d a, Vec3d b, Vec3d c) { return cross(b - a, c - a) * 0.5; }

} // namespace

SurfaceViews::SurfaceViews(const Model& model, std::uint32_t crossings)
    : model_(model), crossings_(crossings) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3d low{infinity, infinity, infinity};
    Vec3d high = -low;
    for (const Triangle& triangle : model.triangles) {
        std::array<Vec3d, 3> corner;
        for (unsigned k = 0; k < 3; ++k) {
            const Vec3d p = corner[k] = to_double(model.positions[triangle.vertex[k]]);
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const double area = length(area_vector(corner[0], corner[1], corner[2]));
        area_ += area;
        centroid_ = centroid_ + (corner[0] + corner[1] + corner[2]) * (area / 3);
    }
    radius_ = length(high - low) / 2;
    centroid_ = area_ > 0 ? centroid_ * (1 / area_) : (low + high) * 0.5;
    spread_points();
}

// The middles of parts of the triangles: each divided into n^2, so that none is much larger than the others.
void SurfaceViews::spread_points() {
    for (const Triangle& triangle : model_.triangles) {
        const auto corner = [&](unsigned k) { return to_double(model_.positions[triangle.vertex[k]]); };
        const Vec3d a = corner(0), u = corner(1) - a, v = corner(2) - a;
        const Vec3d across = cross(u, v) * 0.5;
        const double area = length(across);
        if (!(area > 0)) continue;
        const auto n = std::clamp(std::uint32_t(std::ceil(std::sqrt(area / area_ * points_at_least))), 1U,
                                  most_divisions);
        const double part = area / (double(n) * n);
        const auto add = [&](double x, double y) {
            points_.push_back({a + u * (x / n) + v * (y / n), across * (1 / area), part});
        };
        for (std::uint32_t y = 0; y < n; ++y) {
            for (std::uint32_t x = 0; x + y < n; ++x) {
                add(x + 1.0 / 3, y + 1.0 / 3);
                if (x + y + 1 < n) add(x + 2.0 / 3, y + 2.0 / 3);
            }
        }
    }
}

// Each crossing stands for solid angle * r^2 / cos of its triangle's plane. The same lines are met in every
// frame, so one will do.
double SurfaceViews::captured(Vec3d center) const {
    double farthest2 = 0;
    for (const Vec3f& p : model_.positions)
        farthest2 = std::max(farthest2, dot(to_double(p) - center, to_double(p) - center));
    if (!(farthest2 > 0)) return 0;
    const CenteredModel centered = center_model(model_, {center, Mat3{}, std::sqrt(farthest2) * (1 + 1e-7)});
    const CrossingGrid grid = cast_radial(centered, view_grid, {false, 1, {}});
    double kept = 0, all = 0;
    for (std::size_t s = 0; s + 1 < grid.first.size(); ++s) {
        if (grid.first[s] == grid.first[s + 1]) continue;
        const TexelIndex texel{std::uint32_t(s % view_grid.width), std::uint32_t(s / view_grid.width)};
        const Vec3d u = normalize(sample_direction(view_grid, texel));
        const double angle = solid_angle(view_grid, texel);
        for (std::uint64_t k = grid.first[s]; k < grid.first[s + 1]; ++k) {
            const Crossing& c = grid.crossings[k];
            const auto& vertex = model_.triangles[c.triangle].vertex;
            const auto corner = [&](unsigned i) { return to_double(centered.positions[vertex[i]]); };
            const Vec3d n = normalize(area_vector(corner(0), corner(1), corner(2)));
            const double r = double(c.radius);
            const double area = angle * r * r / std::max(std::abs(dot(u, n)), least_cosine);
            all += area;
            if (k - grid.first[s] < crossings_) kept += area;
        }
    }
    return all > 0 ? kept / all : 0;
}

// With q = inverse(frame) (p - center), the solid angle of an area A with normal n around p is
// A |(p - center) . n| / (|q|^3 det frame) in the space of q.
double SurfaceViews::spacing(const Place& place) const {
    const Mat3 to_frame = inverse(place.frame);
    const double scale = determinant(place.frame);
    double sum = 0;
    for (const Point& point : points_) {
        const Vec3d p = point.position - place.center;
        const Vec3d q = to_frame * p;
        const double squared = dot(q, q);
        const double density = squared * std::sqrt(squared) * scale / std::abs(dot(p, point.normal));
        const double here = std::sqrt(density) / radius_;
        sum += point.area * (here < most_spacing ? here : most_spacing); // NaN at the centre itself
    }
    return area_ > 0 ? sum / area_ : most_spacing;
}

View SurfaceViews::from(const Place& place) const {
    View view;
    view.captured = captured(place.center);
    view.spacing = view.captured * spacing(place) + (1 - view.captured) * most_spacing;
    return view;
}

} // namespace spa::bake
