// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/ray_sets.h"

#include "../../samples/samples.h"

#include <gtest/gtest.h>

#include <cstring>

namespace spa::measure {
namespace {

class RaysOf : public testing::TestWithParam<RaySet> {
protected:
    static std::vector<trace::Ray> make(std::uint32_t count, std::uint64_t seed) {
        static const Model ball = samples::make_sample("sphere", 2);
        return make_rays(GetParam(), count, seed, ball.positions, ball.triangles);
    }
};

INSTANTIATE_TEST_SUITE_P(Sets, RaysOf, testing::ValuesIn(ray_sets()),
                         [](const auto& instance) { return name(instance.param); });

bool same(const std::vector<trace::Ray>& a, const std::vector<trace::Ray>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST_P(RaysOf, AreAsManyAsAskedForAndTheSameEveryTime) {
    for (const std::uint32_t count : {1U, 1000U}) EXPECT_EQ(make(count, 1).size(), count);
    EXPECT_TRUE(same(make(1000, 1), make(1000, 1)));
    EXPECT_EQ(same(make(1000, 1), make(1000, 2)), GetParam() == RaySet::primary);
}

TEST_P(RaysOf, HaveUnitDirectionsOrEndAtTheLamp) {
    for (const trace::Ray& ray : make(1000, 1)) {
        EXPECT_EQ(ray.t_min, 0);
        if (asks_occlusion(GetParam())) {
            EXPECT_EQ(ray.t_max, 1);
            EXPECT_NEAR((ray.origin + ray.direction).y, 2.8, 1e-5);
        } else {
            EXPECT_NEAR(length(to_double(ray.direction)), 1, 1e-6);
        }
    }
}

TEST_P(RaysOf, StartWhereTheSetSays) {
    for (const trace::Ray& ray : make(1000, 1)) {
        const Vec3d o = to_double(ray.origin);
        const double widest = std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)});
        switch (GetParam()) {
        case RaySet::primary: EXPECT_NEAR(length(o), 3, 1e-6); break;
        case RaySet::bounce: EXPECT_NEAR(widest, 1.5, 1e-6); break;
        case RaySet::chords: EXPECT_NEAR(length(o), 1, 1e-6); break;
        case RaySet::shadow: EXPECT_NEAR(o.y, -1.02, 1e-6); break;
        case RaySet::leaving: // of a ball of triangles with 4 % of sagitta at most
            EXPECT_GT(length(o), 0.97);
            EXPECT_LT(length(o), 1.11);
        }
    }
}

// Even sets have no mean direction; a camera looks forward and walls look inward.
TEST_P(RaysOf, GoWhereTheSetSays) {
    Vec3d sum{};
    double inward = 0;
    constexpr std::uint32_t count = 20000;
    for (const trace::Ray& ray : make(count, 1)) {
        const Vec3d d = normalize(to_double(ray.direction));
        sum = sum + d * (1.0 / count);
        inward -= dot(d, normalize(to_double(ray.origin))) / count;
    }
    switch (GetParam()) {
    case RaySet::primary: EXPECT_GT(inward, 0.95); break;
    case RaySet::bounce: EXPECT_LT(length(sum), 0.02); break;
    case RaySet::chords:
        EXPECT_LT(length(sum), 0.02);
        EXPECT_NEAR(inward, 2.0 / 3, 0.01); // half the mean distance of two points of the unit sphere, 4/3
        break;
    case RaySet::shadow: EXPECT_GT(sum.y, 0.5); break;
    case RaySet::leaving: EXPECT_LT(length(sum), 0.02); EXPECT_NEAR(inward, 0, 0.02);
    }
}

TEST(LeavingRays, OfNothingAreNone) { EXPECT_TRUE(make_rays(RaySet::leaving, 10, 1, {}, {}).empty()); }

} // namespace
} // namespace spa::measure
