// SPDX-License-Identifier: Apache-2.0
#include "rays.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace spa::test {
namespace {

using shader::float3;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class Maker {
public:
    Maker(const Grid& grid, std::uint32_t seed) : grid_(grid), random_(seed) {}

    TestRay make(std::size_t kind) {
        switch (kind) {
        case 0: return towards(outside(1.5F), in_ball());
        case 1: return along(in_ball(), on_sphere());
        case 2: return axis();
        case 3: return octant_plane();
        case 4: return through_center();
        case 5: return from_center();
        case 6: return through_sample();
        case 7: return towards(outside(std::ldexp(1.0F, 4 + int(below(14)))), in_ball());
        case 8: return limited();
        default: return none();
        }
    }
    static constexpr std::size_t kinds = 10;

    std::uint32_t word() { return std::uint32_t(random_()); }

private:
    std::uint32_t below(std::uint32_t end) { return std::uint32_t(random_() % end); }
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    // A multiple of 1/16 in [-1,1]: such origins lie on many planes of a grid at once.
    float round_number() { return float(int(below(33)) - 16) / 16.0F; }

    float3 in_ball() {
        while (true) {
            const float3 p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (dot(p, p) <= 1) return p;
        }
    }
    float3 on_sphere() {
        while (true) {
            const float3 p = in_ball();
            if (dot(p, p) > 0.01F) return p * (1 / std::sqrt(dot(p, p)));
        }
    }
    // Up to three times `distance` away from the centre.
    float3 outside(float distance) { return on_sphere() * (distance * uniform(1, 3)); }

    float3 sample() {
        const TexelIndex texel{below(grid_.width), below(grid_.height)};
        const Vec3d u = normalize(sample_direction(grid_, texel));
        return {float(u.x), float(u.y), float(u.z)};
    }

    TestRay along(float3 origin, float3 direction) {
        static constexpr std::array<std::uint32_t, 8> flags = {0,
                                                               0,
                                                               SPA_CULL_BACK,
                                                               SPA_CULL_FRONT,
                                                               SPA_CULL_BACK | SPA_CULL_FRONT,
                                                               SPA_ANY_HIT,
                                                               SPA_ANY_HIT | SPA_CULL_BACK,
                                                               SPA_ANY_HIT | SPA_CULL_FRONT};
        const float length = below(2) == 0 ? 1.0F : std::ldexp(uniform(1, 2), int(below(17)) - 8);
        TestRay ray{};
        ray.ray.origin = origin;
        ray.ray.direction = direction * length;
        ray.ray.t_min = 0;
        ray.ray.t_max = infinity;
        ray.flags = flags[below(flags.size())];
        return ray;
    }
    TestRay towards(float3 origin, float3 target) { return along(origin, target - origin); }

    static float& component(float3& v, std::uint32_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

    TestRay axis() {
        const std::uint32_t i = below(3);
        const float sign = below(2) == 0 ? 1.0F : -1.0F;
        float3 direction, origin = in_ball();
        component(direction, i) = sign;
        if (below(2) == 0) origin = {round_number(), round_number(), round_number()};
        if (below(3) == 0) component(origin, (i + 1) % 3) = 0;
        if (below(3) == 0) component(origin, (i + 2) % 3) = 0;
        if (below(4) != 0) component(origin, i) = -2 * sign;
        return along(origin, direction);
    }

    // In a plane where octants meet, or in one of |x| = |y|, where the map's symmetries are.
    TestRay octant_plane() {
        float3 origin = in_ball() * 2, direction = on_sphere();
        const std::uint32_t i = below(3), j = (i + 1) % 3;
        const bool diagonal = below(2) == 0;
        component(origin, i) = diagonal ? component(origin, j) : 0.0F;
        component(direction, i) = diagonal ? component(direction, j) : 0.0F;
        return along(origin, direction);
    }

    TestRay through_center() {
        const float3 origin = below(2) == 0 ? outside(1) : sample() * 2;
        return along(origin, origin * -1);
    }

    TestRay from_center() { return along({0, 0, 0}, below(2) == 0 ? sample() : on_sphere()); }

    TestRay through_sample() {
        const float3 target = sample() * uniform(0, 1);
        return towards(below(2) == 0 ? outside(1) : sample(), target);
    }

    TestRay limited() {
        TestRay ray = below(2) == 0 ? towards(outside(1), in_ball()) : through_sample();
        const float length = std::sqrt(dot(ray.ray.direction, ray.ray.direction));
        ray.ray.t_min = uniform(-1, 3) / length;
        ray.ray.t_max = ray.ray.t_min + uniform(0, 2) / length;
        return ray;
    }

    TestRay none() {
        static constexpr std::array<float, 6> bad = {nan, infinity, -infinity, 1e38F, 1e-40F, 0};
        TestRay ray = towards(outside(1), in_ball());
        const float value = bad[below(bad.size())];
        switch (below(5)) {
        case 0: component(ray.ray.origin, below(3)) = value; break;
        case 1: component(ray.ray.direction, below(3)) = value; break;
        case 2: ray.ray.direction = {value, value, value}; break;
        case 3: ray.ray.t_min = value; break;
        default: ray.ray.t_max = value; break;
        }
        return ray;
    }

    const Grid& grid_;
    std::mt19937 random_;
};

} // namespace

std::vector<TestRay> make_rays(const Grid& grid, std::size_t count, std::uint32_t seed) {
    Maker maker(grid, seed);
    std::vector<TestRay> rays;
    rays.reserve(count);
    std::uint32_t options = 0;
    while (rays.size() < count) {
        if (rays.size() % 64 == 0) options = maker.word();
        rays.push_back(maker.make(rays.size() / 64 % Maker::kinds));
        rays.back().options = options;
    }
    return rays;
}

} // namespace spa::test
