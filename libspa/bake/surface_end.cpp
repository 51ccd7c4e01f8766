// SPDX-License-Identifier: Apache-2.0
#include "surface_end.h"

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

struct Expected {
    double low = 0, high = 0;
};

// The changes of W along an edge that one end's plane allows. Beyond the steepest slope it makes no
// difference what the plane says.
Expected expected_change(bool bounded, double change, double steepest) {
    if (!bounded) return {-steepest, steepest};
    const double clamped = std::clamp(change, -steepest, steepest);
    return {clamped, clamped};
}

// What either of the two ends allows.
Expected expected_change(const SurfaceEnd& a, Vec3d direction_a, const SurfaceEnd& b, Vec3d direction_b,
                         double steepest) {
    const Expected by_a = expected_change(a.bounded, dot(a.plane, direction_b) - a.w, steepest);
    const Expected by_b = expected_change(b.bounded, b.w - dot(b.plane, direction_a), steepest);
    return {std::min(by_a.low, by_b.low), std::max(by_a.high, by_b.high)};
}

double unit_of(const SurfaceEnd& a, const SurfaceEnd& b, double edge) { return edge * (a.w + b.w) / 2; }

} // namespace

FaceNormal face_normals(const CenteredModel& model) {
    return [&model](std::uint32_t triangle) {
        const auto& vertex = model.model->triangles[triangle].vertex;
        const Vec3d a = to_double(model.positions[vertex[0]]);
        return cross(to_double(model.positions[vertex[1]]) - a, to_double(model.positions[vertex[2]]) - a);
    };
}

SurfaceEnd make_end(double radius, std::uint32_t triangle, Vec3d g, const FaceNormal& face_normal) {
    SurfaceEnd end;
    if (!(radius > 0)) return end;
    const double size = length(g);
    const Vec3d normal = face_normal(triangle);
    const double along = dot(normal, g) / size;
    end.w = size / radius;
    end.bounded = std::abs(along) > mixed_grazing * length(normal);
    if (end.bounded) end.plane = normal * (1 / (along * radius));
    return end;
}

bool ends_match(const SurfaceEnd& a, Vec3d direction_a, const SurfaceEnd& b, Vec3d direction_b, double edge) {
    if (a.w == 0 || b.w == 0) return a.w == b.w;
    const double unit = unit_of(a, b, edge);
    const double change = b.w - a.w;
    const double slack = mixed_slack * unit;
    const double by_a = dot(a.plane, direction_b) - a.w;
    const double by_b = b.w - dot(b.plane, direction_a);
    const double off = std::max(std::abs(by_a - change), std::abs(by_b - change));
    if (a.bounded && b.bounded && off <= std::max(slack, mixed_share_of_change * std::abs(change)))
        return true;
    const double steepest = mixed_slope * unit;
    if (std::abs(change) > steepest) return false;
    const Expected expected = expected_change(a, direction_a, b, direction_b, steepest);
    return change >= expected.low - slack && change <= expected.high + slack;
}

double ends_differ(const SurfaceEnd& a, Vec3d direction_a, const SurfaceEnd& b, Vec3d direction_b,
                   double edge) {
    const double change = b.w - a.w;
    const Expected expected =
        expected_change(a, direction_a, b, direction_b, mixed_slope * unit_of(a, b, edge));
    return std::max({0.0, expected.low - change, change - expected.high});
}

} // namespace spa::bake
