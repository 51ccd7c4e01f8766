// SPDX-License-Identifier: Apache-2.0
// Rays and hits between the space of an application and the map space of a part: the part's frame, the centre
// at the origin, in units of R (formats/SPA.md, "Parts"). Directions are not normalised, so t is the same in
// both; the mappings may be sheared, scaled differently along each axis, and mirrored.
#pragma once

#include "ray.h"

#include "../core/affine.h"
#include "../core/spherical_map.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace spa::trace {

// Where a part's map space lies in another space: p = origin + to_world * q, q = to_map * (p - origin).
struct MapSpace {
    Mat3 to_world;
    Mat3 to_map; // the inverse of to_world
    Vec3d origin;
};

// In object space, or in the space that object_to_world leads to. object_to_world.linear has to have an
// inverse; the part's frame has one.
constexpr MapSpace map_space(const Part& part, const Affine& object_to_world = {}) {
    MapSpace space;
    space.to_world = object_to_world.linear * part.frame;
    for (Vec3d& row : space.to_world.row) row = row * part.radius;
    space.to_map = inverse(space.to_world);
    space.origin = transform_point(object_to_world, part.center);
    return space;
}

// Rows of the matrix map space -> world, as instances of ray-tracing interfaces have it; rounded to float.
inline std::array<std::array<float, 4>, 3> instance_rows(const MapSpace& space) {
    const std::array<double, 3> origin{space.origin.x, space.origin.y, space.origin.z};
    std::array<std::array<float, 4>, 3> rows{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& row = space.to_world.row[i];
        rows[i] = {float(row.x), float(row.y), float(row.z), float(origin[i])};
    }
    return rows;
}

inline Ray to_map(const MapSpace& space, const Ray& ray) {
    return {to_float(space.to_map * (to_double(ray.origin) - space.origin)), ray.t_min,
            to_float(space.to_map * to_double(ray.direction)), ray.t_max};
}

inline Vec3d to_world(const MapSpace& space, Vec3d point) { return space.origin + space.to_world * point; }

// A normal, by the inverse transpose: unit, and on the same side of the surface. Zero stays zero.
inline Vec3f normal_to_world(const MapSpace& space, Vec3f normal) {
    const Vec3d world = transpose(space.to_map) * to_double(normal);
    // Its square may be too small for a double's exponent where the map is far from the size of 1.
    const double size = std::abs(world.x) + std::abs(world.y) + std::abs(world.z);
    return size > 0 ? to_float(normalize(world * (1 / size))) : Vec3f{};
}

// The same for all of a hit that map space and world tell apart.
inline Hit to_world(const MapSpace& space, Hit hit) {
    hit.normal = normal_to_world(space, hit.normal);
    return hit;
}

} // namespace spa::trace
