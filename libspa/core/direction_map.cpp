// SPDX-License-Identifier: Apache-2.0
#include "direction_map.h"

#include <cmath>
#include <numbers>

namespace spa {
namespace {

constexpr double pi = std::numbers::pi;

// s, t in [-1, 1]; |result|_1 = 1. Adding 0.0 turns -0.0 into 0.0, so that identified border points agree
// bit by bit.
Vec3d octahedral_direction(double s, double t) {
    const double z = 1 - (std::abs(s) + std::abs(t));
    if (z >= 0) return {s + 0.0, t + 0.0, z};
    return {std::copysign(1 - std::abs(t), s) + 0.0, std::copysign(1 - std::abs(s), t) + 0.0, z};
}

Vec3d latlong_direction(const Grid& grid, double x, double y) {
    const double phi = 2 * pi * (x + 0.5) / grid.width - pi;
    const double theta = pi * (y + 0.5) / grid.height;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

} // namespace

const char* name(Mapping mapping) {
    switch (mapping) {
    case Mapping::latlong: return "latlong";
    case Mapping::octahedral: return "octahedral";
    }
    return "unknown";
}

Vec3d sample_direction(const Grid& grid, TexelIndex texel) {
    if (grid.mapping == Mapping::latlong) return latlong_direction(grid, texel.x, texel.y);
    // Integer numerators make s and t exactly antisymmetric.
    const auto n = std::int64_t(grid.width) - 1;
    return octahedral_direction(double(2 * std::int64_t(texel.x) - n) / double(n),
                                double(n - 2 * std::int64_t(texel.y)) / double(n));
}

Vec3d direction_at(const Grid& grid, Vec2d position) {
    if (grid.mapping == Mapping::latlong) return latlong_direction(grid, position.x, position.y);
    const double n = double(grid.width) - 1;
    return normalize(octahedral_direction(2 * position.x / n - 1, 1 - 2 * position.y / n));
}

Vec2d position_of(const Grid& grid, Vec3d direction) {
    if (direction == Vec3d{}) direction = {0, 0, 1};
    if (grid.mapping == Mapping::latlong) {
        const double phi = std::atan2(direction.x, direction.z);
        const double theta = std::atan2(std::hypot(direction.x, direction.z), direction.y);
        double x = (phi + pi) / (2 * pi) * grid.width - 0.5;
        if (x >= grid.width - 0.5) x -= grid.width;
        return {x, theta / pi * grid.height - 0.5};
    }
    const double l = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    double s = direction.x / l;
    double t = direction.y / l;
    if (direction.z < 0) {
        const double folded = std::copysign(1 - std::abs(t), s);
        t = std::copysign(1 - std::abs(s), t);
        s = folded;
    }
    const double n = double(grid.width) - 1;
    return {(s + 1) * n / 2, (1 - t) * n / 2};
}

TexelIndex wrap(const Grid& grid, std::int64_t x, std::int64_t y) {
    const std::int64_t w = grid.width;
    const std::int64_t h = grid.height;
    if (grid.mapping == Mapping::latlong) {
        if (y < 0 || y >= h) {
            y = y < 0 ? -1 - y : 2 * h - 1 - y;
            x += w / 2;
        }
        return {std::uint32_t(((x % w) + w) % w), std::uint32_t(y)};
    }
    const std::int64_t n = w - 1;
    if (x < 0 || x > n) {
        x = x < 0 ? -x : 2 * n - x;
        y = n - y;
    }
    if (y < 0 || y > n) {
        y = y < 0 ? -y : 2 * n - y;
        x = n - x;
    }
    return {std::uint32_t(x), std::uint32_t(y)};
}

TexelIndex canonical(const Grid& grid, TexelIndex texel) {
    if (grid.mapping == Mapping::latlong) return texel;
    const std::uint32_t n = grid.width - 1;
    const bool on_x = texel.x == 0 || texel.x == n;
    const bool on_y = texel.y == 0 || texel.y == n;
    if (on_x && on_y) return {0, 0};
    if (on_x && texel.y > n / 2) return {texel.x, n - texel.y};
    if (on_y && texel.x > n / 2) return {n - texel.x, texel.y};
    return texel;
}

double solid_angle(const Grid& grid, TexelIndex texel) {
    if (grid.mapping == Mapping::latlong) {
        const double step = pi / grid.height;
        return 2 * pi / grid.width * (std::cos(step * texel.y) - std::cos(step * (texel.y + 1)));
    }
    // The plane |g|_1 = 1 projects onto the sphere with d(omega) = d(s) d(t) / |g|^3; border samples own half
    // a cell, corners a quarter.
    const std::uint32_t n = grid.width - 1;
    const double cell = 4.0 / (double(n) * n);
    const double share =
        (texel.x == 0 || texel.x == n ? 0.5 : 1.0) * (texel.y == 0 || texel.y == n ? 0.5 : 1.0);
    const double len = length(sample_direction(grid, texel));
    return share * cell / (len * len * len);
}

} // namespace spa
