// SPDX-License-Identifier: Apache-2.0
#include "surface_samples.h"

#include <cmath>

namespace spa::measure {
namespace {

// The fractional parts of the powers of 1/p, p the real root of p^3 = p + 1.
constexpr double r2_x = 0.7548776662466927;
constexpr double r2_y = 0.5698402909980532;

double fraction(double v) { return v - std::floor(v); }

// Uniform over the triangle (Osada et al. 2002, 4.2).
Vec3d barycentric(std::uint32_t i) {
    const double root = std::sqrt(fraction(0.5 + r2_x * double(i)));
    const double v = fraction(0.5 + r2_y * double(i));
    return {1 - root, root * (1 - v), root * v};
}

} // namespace

std::vector<SurfaceSample> sample_surface(std::span<const Vec3f> positions,
                                          std::span<const Triangle> triangles, std::uint32_t count) {
    const auto corner = [&](std::uint32_t t, unsigned k) {
        return to_double(positions[triangles[t].vertex[k]]);
    };
    const auto area = [&](std::uint32_t t) {
        return length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0))) / 2;
    };
    double total = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) total += area(t);
    std::vector<SurfaceSample> samples;
    if (!(total > 0)) return samples;
    samples.reserve(count);
    double before = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        before += area(t);
        while (samples.size() < count && (double(samples.size()) + 0.5) / count * total < before) {
            const Vec3d b = barycentric(std::uint32_t(samples.size()));
            samples.push_back({corner(t, 0) * b.x + corner(t, 1) * b.y + corner(t, 2) * b.z, t, b});
        }
    }
    return samples;
}

} // namespace spa::measure
