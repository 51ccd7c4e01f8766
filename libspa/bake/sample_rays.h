// SPDX-License-Identifier: Apache-2.0
// The ray of a sample against a triangle, in double precision, and what the crossing looks like: the
// definition in crossings.h as code, shared by all that cast.
#pragma once

#include "crossings.h"
#include "sample_directions.h"
#include "shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::bake {

// A triangle ready to be met by rays g from the origin. Edge function i is the triple product of g with the
// edge opposite to corner i; with D = A.(B x C), g meets the triangle iff all three have the sign of D, zero
// included, and then at t = D/S along g, S their sum, with barycentrics e_i/S. Without contracted
// multiply-adds A x B is exactly -(B x A), so triangles that share two positions agree on the edge between
// them and no direction slips through.
struct RaySetup {
    Vec3d edge[3];
    double d = 0; // > 0
    bool front_facing = true;

    RaySetup(const CenteredModel& model, const Triangle& triangle) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]);
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]);
        const double sign = dot(a, cross(b, c)) < 0 ? -1.0 : 1.0;
        edge[0] = cross(b, c) * sign;
        edge[1] = cross(c, a) * sign;
        edge[2] = cross(a, b) * sign;
        d = std::abs(dot(a, cross(b, c)));
        front_facing = (sign > 0) != model.mirrored;
    }
    // False for a triangle whose plane holds the origin: no direction sees it.
    [[nodiscard]] bool visible() const { return d > 0; }
};

struct RayHit {
    Vec3d barycentric;
    double radius = 0;
};

// sum: of the three edge functions at g, > 0.
inline double hit_radius(double d, double sum, Vec3d g) {
    return std::clamp(d / sum * length(g), double(std::numeric_limits<float>::min()), 1.0);
}

inline bool intersect(const RaySetup& setup, Vec3d g, RayHit& hit) {
    const Vec3d e{dot(setup.edge[0], g), dot(setup.edge[1], g), dot(setup.edge[2], g)};
    if (!(e.x >= 0 && e.y >= 0 && e.z >= 0)) return false;
    const double sum = e.x + e.y + e.z;
    if (!(sum > 0)) return false;
    hit.barycentric = e * (1 / sum);
    hit.radius = hit_radius(setup.d, sum, g);
    return true;
}

// Area in the triangle's plane that a sample stands for (crossings.h): solid angle * r^2 / cos.
inline double footprint(const CenteredModel& model, const Triangle& triangle, double solid_angle, Vec3d g,
                        double radius) {
    const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
    const Vec3d plane = normalize(cross(to_double(model.positions[triangle.vertex[1]]) - a,
                                        to_double(model.positions[triangle.vertex[2]]) - a));
    const double cosine = std::abs(dot(plane, g)) / length(g);
    return solid_angle * radius * radius / std::max(cosine, 0.05);
}

// The rays of all samples of a grid, and the surface where they meet it. Refers to model and grid. Immutable;
// one serves all threads.
struct SampleRays {
    const CenteredModel& model;
    const Grid& grid;
    SampleDirections directions;
    Shader shader;

    SampleRays(const CenteredModel& m, const Grid& g) : model(m), grid(g), directions(g), shader(m) {}

    [[nodiscard]] TexelIndex texel(std::size_t sample) const {
        return {std::uint32_t(sample % grid.width), std::uint32_t(sample / grid.width)};
    }
    // Identified samples have one direction, but a triangle at the border may meet only one of them within
    // its octant: what any of them finds belongs to all.
    [[nodiscard]] std::size_t owner(TexelIndex at) const {
        const bool border = at.x == 0 || at.y == 0 || at.x + 1 == grid.width || at.y + 1 == grid.height;
        const TexelIndex c = border ? canonical(grid, at) : at;
        return std::size_t(c.y) * grid.width + c.x;
    }
    // False where alpha leaves no surface.
    [[nodiscard]] bool visible(std::uint32_t triangle, TexelIndex at, Vec3d g, const RayHit& hit) const {
        if (!shader.needs_alpha(triangle)) return true;
        const double area =
            footprint(model, model.model->triangles[triangle], directions.solid_angle_of(at), g, hit.radius);
        return shader.color(triangle, hit.barycentric, area).visible;
    }
    // Of a ray that meets the triangle.
    [[nodiscard]] bool visible(std::uint32_t triangle, TexelIndex at, const RaySetup& setup) const {
        const Vec3d g = directions(at.x, at.y);
        RayHit hit;
        intersect(setup, g, hit);
        return visible(triangle, at, g, hit);
    }
    [[nodiscard]] Crossing shade(TexelIndex at, Vec3d g, std::uint32_t triangle, const RayHit& hit,
                                 bool front_facing) const {
        const Triangle& t = model.model->triangles[triangle];
        const double area = footprint(model, t, directions.solid_angle_of(at), g, hit.radius);
        return {float(hit.radius), triangle, shader.normal(triangle, hit.barycentric),
                shader.color(triangle, hit.barycentric, area).srgba, front_facing};
    }
    // The ray meets the triangle.
    [[nodiscard]] Crossing shade(TexelIndex at, std::uint32_t triangle) const {
        const RaySetup setup(model, model.model->triangles[triangle]);
        const Vec3d g = directions(at.x, at.y);
        RayHit hit;
        intersect(setup, g, hit);
        return shade(at, g, triangle, hit, setup.front_facing);
    }
};

} // namespace spa::bake
