// SPDX-License-Identifier: Apache-2.0
#include "center.h"

#include "../mesh/closest_point.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::bake {
namespace {

Vec3d plane_normal(const Model& model, const Triangle& triangle) {
    const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
    return cross(to_double(model.positions[triangle.vertex[1]]) - a,
                 to_double(model.positions[triangle.vertex[2]]) - a);
}

template <class Visit>
void each_distance(const Model& model, Vec3d from, const Visit& visit) {
    for (const Triangle& triangle : model.triangles) {
        const auto corner = [&](unsigned k) { return to_double(model.positions[triangle.vertex[k]]); };
        visit(triangle, length(closest_point_on_triangle(from, corner(0), corner(1), corner(2)) - from));
    }
}

double distance_to_surface(const Model& model, Vec3d from) {
    double least = std::numeric_limits<double>::infinity();
    each_distance(model, from, [&](const Triangle&, double d) { least = std::min(least, d); });
    return least;
}

// Of the triangles around a point of the surface. Where they cancel, as on a double sheet: of the first.
Vec3d normal_around(const Model& model, Vec3d point, double radius) {
    Vec3d sum;
    Vec3d first;
    each_distance(model, point, [&](const Triangle& triangle, double d) {
        if (!(d < radius)) return;
        const Vec3d n = normalize(plane_normal(model, triangle));
        if (first == Vec3d{}) first = n;
        sum = sum + n;
    });
    return length(sum) > 0.1 ? normalize(sum) : first;
}

// The finest step of a float in [1/2, 1]: below it, positions at one place differ by how they were computed,
// as where the two ends of a seam come from sin(2 pi) and sin(0). Rays would see through the crack between
// them.
double snap(double v) {
    constexpr double steps_of_2_to_minus_24 = 0x1.8p28; // the sum's last bit is worth that much
    return (v + steps_of_2_to_minus_24) - steps_of_2_to_minus_24;
}

} // namespace

CenteredModel center_model(const Model& model, const PartFrame& part) {
    CenteredModel centered;
    centered.model = &model;
    centered.mirrored = determinant(part.frame) < 0;
    centered.positions.resize(model.positions.size());
    const Mat3 to_frame = inverse(part.frame);
    const Mat3 normal_to_frame = transpose(part.frame);
    const bool identity = part.frame == Mat3{};
    if (identity)
        centered.normals = model.normals;
    else
        centered.normals.resize(model.normals.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, model.positions.size(), 4096), [&](const auto& range) {
            for (std::size_t v = range.begin(); v < range.end(); ++v) {
                const Vec3d q = to_double(model.positions[v]) - part.center;
                const Vec3d p = (identity ? q : to_frame * q) * (1 / part.radius);
                centered.positions[v] = to_float({snap(p.x), snap(p.y), snap(p.z)});
                if (!identity)
                    centered.normals[v] = to_float(normalize(normal_to_frame * to_double(model.normals[v])));
            }
        });
    return centered;
}

Vec3d center_off_surface(const Model& model, Vec3d center) {
    double radius = 0;
    for (const Triangle& triangle : model.triangles) {
        for (const std::uint32_t v : triangle.vertex) {
            radius = std::max(radius, length(to_double(model.positions[v]) - center));
        }
    }
    const Vec3d normal = normal_around(model, center, radius / 1024);
    for (const double step : {radius / 16, radius / 32, radius / 64}) {
        for (const double side : {-step, step}) {
            const Vec3d moved = center + normal * side;
            if (distance_to_surface(model, moved) >= step / 4) return moved;
        }
    }
    return center;
}

} // namespace spa::bake
