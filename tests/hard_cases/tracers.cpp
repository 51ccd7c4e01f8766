// SPDX-License-Identifier: Apache-2.0
#include "tracers.h"

#include "../../libspa/trace/fan.h"
#include "../../libspa/trace/march.h"
#include "../../libspa/trace/trace.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <utility>

namespace spa::test {
namespace {

void expect_same_bits(const trace::Hit& a, const trace::Hit& b) {
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    EXPECT_EQ(bits(a.t), bits(b.t));
    EXPECT_EQ(bits(a.normal.x), bits(b.normal.x));
    EXPECT_EQ(bits(a.normal.y), bits(b.normal.y));
    EXPECT_EQ(bits(a.normal.z), bits(b.normal.z));
    EXPECT_EQ(bits(a.map.x), bits(b.map.x));
    EXPECT_EQ(bits(a.map.y), bits(b.map.y));
    EXPECT_EQ(a.layer, b.layer);
    EXPECT_EQ(a.side, b.side);
    EXPECT_EQ(a.front, b.front);
}

trace::Hit checked(const trace::Ray& ray, const trace::Hit& hit) {
    if (!hit.valid()) return hit;
    EXPECT_TRUE(std::isfinite(hit.t) && is_finite(hit.normal));
    EXPECT_GE(hit.t, ray.t_min);
    EXPECT_LE(hit.t, ray.t_max);
    EXPECT_TRUE(hit.map.x >= 0 && hit.map.x <= 1 && hit.map.y >= 0 && hit.map.y <= 1);
    return hit;
}

} // namespace

Subject::Subject(OwnedPart owned) : owned_(std::move(owned)), map_(owned_.part), judge_(owned_.part) {}

trace::Hit Subject::hit(const trace::Ray& ray, std::uint32_t flags) const {
    trace::Hit single;
    const bool found = trace::closest_hit(map_, ray, flags, single);
    EXPECT_EQ(found, single.valid());
    // A stream of more than one vector, all of the same ray.
    const std::vector<trace::Ray> rays(37, ray);
    std::vector<trace::Hit> stream(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    trace::closest_hits(map_, rays, flags, stream);
    trace::occluded(map_, rays, flags, blocked);
    for (std::size_t i : {std::size_t(0), rays.size() - 1}) {
        expect_same_bits(single, stream[i]);
        EXPECT_EQ(blocked[i] != 0, single.valid());
    }
    EXPECT_EQ(trace::occluded(map_, ray, flags), single.valid());
    const Judgement judgement = judge_hit(judge_, ray, flags, single, time_bound(ray));
    EXPECT_TRUE(is_right(judgement.verdict))
        << name(judgement.verdict) << ": " << describe(judge_, ray, flags, single);
    return single;
}

std::vector<trace::Hit> Subject::all_hits(trace::Ray ray) const {
    std::vector<trace::Hit> hits;
    const float step = float(2e-5 / length(to_double(ray.direction)));
    while (hits.size() < 20) {
        const trace::Hit next = hit(ray);
        if (!next.valid()) break;
        hits.push_back(next);
        ray.t_min = next.t + step;
    }
    return hits;
}

trace::Hit fan(const trace::TraceMap& map, const trace::Ray& ray, std::uint32_t flags) {
    shader::SpaFan options = shader::spa_fan_defaults();
    options.count = 200;
    trace::Hit hit;
    const bool found = trace::fan_hit(map, ray, options, flags, hit);
    EXPECT_EQ(found, hit.valid());
    return checked(ray, hit);
}

trace::Hit march(const trace::TraceMap& map, const trace::Ray& ray, std::uint32_t flags) {
    shader::SpaMarch options = shader::spa_march_defaults();
    options.steps = 200;
    options.secants = 5;
    trace::Hit hit;
    const bool found = trace::march_hit(map, ray, options, flags, hit);
    EXPECT_EQ(found, hit.valid());
    return checked(ray, hit);
}

trace::Hit Subject::fan(const trace::Ray& ray, std::uint32_t flags) const {
    return test::fan(map_, ray, flags);
}

trace::Hit Subject::march(const trace::Ray& ray, std::uint32_t flags) const {
    return test::march(map_, ray, flags);
}

OwnedPart star(std::uint32_t cells, double (*radius)(Vec3d u), ElementFormat depth) {
    return make_part({.cells = cells, .depth = depth}, [radius](Vec3d g) {
        const Vec3d u = normalize(g);
        return std::vector<MadeInterval>{{radius(u), 0, u, {}}};
    });
}

double round_radius(Vec3d) { return 0.75; }
double bumpy_radius(Vec3d u) {
    return 0.7 + 0.2 * std::sin(5 * u.x + 1) * std::cos(4 * u.y - 2) * std::sin(3 * u.z + 0.5);
}
double cliff_radius(Vec3d u) { return u.x > 0.1 ? 0.9 : 0.5; }

trace::Ray ray_through(Vec3d from, Vec3d target) {
    return {to_float(from), 0, to_float(target - from), unlimited};
}

std::vector<Vec3d> directions(std::uint32_t count) {
    std::vector<Vec3d> found;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        const double phi = i * 2.399963229728653; // the golden angle
        const double r = std::sqrt(1 - z * z);
        found.push_back({r * std::cos(phi), r * std::sin(phi), z});
    }
    return found;
}

Vec3d point_at(const trace::Ray& ray, const trace::Hit& hit) {
    return to_double(ray.origin) + to_double(ray.direction) * double(hit.t);
}

} // namespace spa::test
