// SPDX-License-Identifier: Apache-2.0
#include "ray_sets.h"

#include "surface_samples.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace spa::measure {
namespace {

constexpr double pi = std::numbers::pi;

// Even over [0, 1). std::uniform_real_distribution differs from library to library.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return double(engine_() >> 11U) * 0x1p-53; }
    // Even over the unit sphere (Archimedes).
    Vec3d direction() {
        const double z = 2 * (*this)() - 1;
        const double phi = 2 * pi * (*this)();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 engine_;
};

trace::Ray ray_from(Vec3d origin, Vec3d direction) {
    return {to_float(origin), 0, to_float(normalize(direction)), std::numeric_limits<float>::infinity()};
}

std::vector<trace::Ray> primary_rays(std::uint32_t count) {
    constexpr double distance = 3;
    // A little from the right and from above, so that no row of pixels lies in a plane of symmetry.
    const Vec3d eye = normalize(Vec3d{0.48, 0.37, 0.83}) * distance;
    const Vec3d forward = normalize(-eye);
    const Vec3d right = normalize(cross(forward, Vec3d{0, 1, 0}));
    const Vec3d up = cross(right, forward);
    const double half = 1 / std::sqrt(distance * distance - 1); // tangent of the sphere's half angle
    const auto side = std::uint32_t(std::ceil(std::sqrt(double(count))));
    std::vector<trace::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t row = i / side;
        const double x = (2 * (i % side + 0.5) / side - 1) * half;
        const double y = (1 - 2 * (row + 0.5) / side) * half;
        rays.push_back(ray_from(eye, forward + right * x + up * y));
    }
    return rays;
}

trace::Ray bounce_ray(Random& random) {
    constexpr double half_edge = 1.5;
    const auto wall = unsigned(6 * random());
    const double a = (2 * random() - 1) * half_edge;
    const double b = (2 * random() - 1) * half_edge;
    // A cosine about the normal: an even disc, lifted to the hemisphere (Malley).
    const double r = std::sqrt(random());
    const double phi = 2 * pi * random();
    const double out = wall % 2 == 0 ? 1 : -1;
    const std::array<double, 3> p{out * half_edge, a, b};
    const std::array<double, 3> d{-out * std::sqrt(1 - r * r), r * std::cos(phi), r * std::sin(phi)};
    const auto turned = [&](const std::array<double, 3>& v) {
        const unsigned axis = wall / 2;
        return Vec3d{v[(3 - axis) % 3], v[(4 - axis) % 3], v[(5 - axis) % 3]};
    };
    return ray_from(turned(p), turned(d));
}

trace::Ray chord_ray(Random& random) {
    const Vec3d from = random.direction();
    Vec3d to = random.direction();
    while (!(length(to - from) > 1e-6)) to = random.direction();
    return ray_from(from, to - from);
}

trace::Ray shadow_ray(Random& random) {
    constexpr double floor = -1.02, radius = 2.5;
    const double r = radius * std::sqrt(random());
    const double phi = 2 * pi * random();
    const Vec3f origin = to_float({r * std::cos(phi), floor, r * std::sin(phi)});
    const double a = random() - 0.5, b = random() - 0.5;
    const Vec3f lamp = to_float({1.6 + a, 2.8, 1.1 + b});
    return {origin, 0, lamp - origin, 1};
}

std::vector<trace::Ray> leaving_rays(std::uint32_t count, Random& random, std::span<const Vec3f> positions,
                                     std::span<const Triangle> triangles) {
    std::vector<trace::Ray> rays;
    for (const SurfaceSample& sample : sample_surface(positions, triangles, count)) {
        const auto& v = triangles[sample.triangle].vertex;
        const Vec3d a = to_double(positions[v[0]]);
        const Vec3d normal = normalize(cross(to_double(positions[v[1]]) - a, to_double(positions[v[2]]) - a));
        const double off = 0.01 + 0.09 * random();
        rays.push_back(ray_from(sample.position + normal * off, random.direction()));
    }
    // The samples come in the order of the triangles, which would make the rays coherent.
    for (std::size_t i = rays.size(); i > 1; --i)
        std::swap(rays[i - 1], rays[std::size_t(random() * double(i))]);
    return rays;
}

} // namespace

std::span<const RaySet> ray_sets() {
    static constexpr std::array all{RaySet::primary, RaySet::bounce, RaySet::chords, RaySet::shadow,
                                    RaySet::leaving};
    return all;
}

const char* name(RaySet set) {
    switch (set) {
    case RaySet::primary: return "primary";
    case RaySet::bounce: return "bounce";
    case RaySet::chords: return "chords";
    case RaySet::shadow: return "shadow";
    case RaySet::leaving: break;
    }
    return "leaving";
}

std::vector<trace::Ray> make_rays(RaySet set, std::uint32_t count, std::uint64_t seed,
                                  std::span<const Vec3f> positions, std::span<const Triangle> triangles) {
    if (set == RaySet::primary) return primary_rays(count);
    Random random(seed);
    if (set == RaySet::leaving) return leaving_rays(count, random, positions, triangles);
    std::vector<trace::Ray> rays;
    rays.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        rays.push_back(set == RaySet::bounce   ? bounce_ray(random)
                       : set == RaySet::shadow ? shadow_ray(random)
                                               : chord_ray(random));
    }
    return rays;
}

} // namespace spa::measure
