// SPDX-License-Identifier: Apache-2.0
#include "part_frame.h"

#include "../core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace spa {
namespace {

constexpr double flat_ratio = 0.01;

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void extend(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

template <class Visit>
void each_corner(const Model& model, Visit&& visit) {
    for (const Triangle& triangle : model.triangles) {
        for (const std::uint32_t v : triangle.vertex) visit(to_double(model.positions[v]));
    }
}

Axes box_along(const Model& model, const std::array<Vec3d, 3>& axis) {
    std::array<Interval, 3> range;
    each_corner(model, [&](Vec3d p) {
        for (unsigned k = 0; k < 3; ++k) range[k].extend(dot(axis[k], p));
    });
    std::array<unsigned, 3> order{0, 1, 2};
    const auto half = [&](unsigned k) { return (range[k].high - range[k].low) / 2; };
    std::stable_sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return half(a) > half(b); });
    Axes box;
    for (unsigned k = 0; k < 3; ++k) {
        box.axis[k] = axis[order[k]];
        box.extent[k] = half(order[k]);
        box.center = box.center + axis[k] * ((range[k].low + range[k].high) / 2);
    }
    box.axis[2] = cross(box.axis[0], box.axis[1]);
    return box;
}

// Eigenvectors of a symmetric matrix by cyclic Jacobi rotations (Golub & Van Loan, 8.5).
std::array<Vec3d, 3> eigenvectors(std::array<std::array<double, 3>, 3> a) {
    std::array<std::array<double, 3>, 3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 32; ++sweep) {
        for (const auto& [p, q] : {std::pair{0U, 1U}, std::pair{0U, 2U}, std::pair{1U, 2U}}) {
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
            const double c = 1 / std::hypot(t, 1.0);
            const double s = t * c;
            for (unsigned k = 0; k < 3; ++k) {
                const double kp = a[k][p];
                const double kq = a[k][q];
                a[k][p] = c * kp - s * kq;
                a[k][q] = s * kp + c * kq;
            }
            for (unsigned k = 0; k < 3; ++k) {
                const double pk = a[p][k];
                const double qk = a[q][k];
                a[p][k] = c * pk - s * qk;
                a[q][k] = s * pk + c * qk;
            }
            for (unsigned k = 0; k < 3; ++k) {
                const double kp = v[k][p];
                const double kq = v[k][q];
                v[k][p] = c * kp - s * kq;
                v[k][q] = s * kp + c * kq;
            }
        }
    }
    std::array<Vec3d, 3> axes;
    for (unsigned k = 0; k < 3; ++k) axes[k] = normalize(Vec3d{v[0][k], v[1][k], v[2][k]});
    return axes;
}

// Area-weighted covariance of the triangles' centroids about `origin`: enough to find the axes.
std::array<Vec3d, 3> principal_axes(const Model& model, Vec3d origin) {
    std::array<std::array<double, 3>, 3> m{};
    Vec3d mean;
    double total = 0;
    for (const Triangle& triangle : model.triangles) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]) - origin;
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]) - origin;
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]) - origin;
        const double area = length(cross(b - a, c - a));
        const Vec3d centroid = (a + b + c) * (1.0 / 3);
        const std::array<double, 3> p{centroid.x, centroid.y, centroid.z};
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) m[i][j] += area * p[i] * p[j];
        }
        mean = mean + centroid * area;
        total += area;
    }
    if (!(total > 0)) return {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    const std::array<double, 3> c{mean.x, mean.y, mean.z};
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned j = 0; j < 3; ++j) m[i][j] = m[i][j] / total - c[i] * c[j] / (total * total);
    }
    return eigenvectors(m);
}

bool is_flat(const Axes& box) { return box.extent[2] < flat_ratio * box.extent[0]; }

Vec3d mean_normal(const Model& model) {
    Vec3d sum;
    for (const Triangle& triangle : model.triangles) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]);
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]);
        sum = sum + cross(b - a, c - a);
    }
    return sum;
}

} // namespace

Axes oriented_bounds(const Model& model) {
    const Axes aligned = box_along(model, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const Axes principal = box_along(model, principal_axes(model, aligned.center));
    // The thinnest extent gets a floor, or every flat box would have volume 0.
    const auto volume = [&](const Axes& box) {
        return box.extent[0] * box.extent[1] * (box.extent[2] + 1e-6 * aligned.extent[0]);
    };
    return volume(principal) < 0.95 * volume(aligned) ? principal : aligned;
}

Vec3d bounds_center(const Model& model, bool& moved_off_surface) {
    const Vec3d center = box_along(model, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}).center;
    const Axes box = oriented_bounds(model);
    moved_off_surface = is_flat(box);
    if (!moved_off_surface) return center;
    const double side = dot(mean_normal(model), box.axis[2]) < 0 ? 1.0 : -1.0;
    return center + box.axis[2] * (side * box.extent[0] / 2);
}

PartFrame make_part_frame(const Model& model, Vec3d center, bool affine) {
    PartFrame part;
    part.center = center;
    if (affine) {
        const Axes box = oriented_bounds(model);
        if (box.extent[0] > 0) {
            const double floor = is_flat(box) ? 0.5 : 1e-6;
            Mat3 columns; // rows of its transpose: axis k times its relative size
            for (unsigned k = 0; k < 3; ++k) {
                columns.row[k] = box.axis[k] * std::max(box.extent[k] / box.extent[0], floor);
            }
            part.frame = transpose(columns);
        }
    }
    const Mat3 to_frame = inverse(part.frame);
    double radius2 = 0;
    each_corner(model, [&](Vec3d p) {
        const Vec3d q = to_frame * (p - center);
        radius2 = std::max(radius2, dot(q, q));
    });
    // The farthest vertex stays inside after rounding to float.
    part.radius = std::sqrt(radius2) * (1 + 1e-7);
    if (!(part.radius > 0) || !std::isfinite(part.radius)) {
        throw Error(
            ExitCode::invalid_data,
            "the model has no extent: all its triangles lie in one point, so there is nothing to bake");
    }
    return part;
}

} // namespace spa
