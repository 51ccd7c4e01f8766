// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/ray_errors.h"

#include <gtest/gtest.h>

#include <vector>

namespace spa::measure {
namespace {

constexpr float miss = std::numeric_limits<float>::infinity();

RayAnswer at(float t, Vec3f normal = {0, 0, 1}, std::array<std::uint8_t, 4> color = {10, 20, 30, 255}) {
    return {t, normal, color};
}

TEST(RayErrors, CountEveryPairOfAnswersInItsPlace) {
    const std::vector<trace::Ray> rays(8, trace::Ray{{0, 0, 2}, 0, {0, 0, -1}, miss});
    const std::vector<RayAnswer> truth{at(1), at(1), {}, {}, at(1), at(1), {}, {}};
    const std::vector<RayAnswer> answers{at(1), {}, at(1), {}, at(1), {}, at(1), {}};
    const RayErrors errors =
        compare_answers(rays, truth, answers, std::vector<std::uint8_t>{1, 1, 1, 1, 0, 0, 0, 0});
    for (const Confusion& confusion : {errors.band, errors.interior}) {
        EXPECT_EQ(confusion.both, 1U);
        EXPECT_EQ(confusion.missed, 1U);
        EXPECT_EQ(confusion.extra, 1U);
        EXPECT_EQ(confusion.neither, 1U);
    }
    EXPECT_EQ(errors.rays(), 8U);
    EXPECT_EQ(errors.distance.count, 2U);
    EXPECT_EQ(errors.interior_distance.count, 1U);
}

TEST(RayErrors, DistancesAreInTheSpaceNotAlongTheDirection) {
    const std::vector<trace::Ray> rays{{{0, 0, 2}, 0, {0, 0, -4}, miss}};
    const RayErrors errors = compare_answers(rays, std::vector{at(0.25F)}, std::vector{at(0.375F)}, {});
    EXPECT_DOUBLE_EQ(errors.distance.mean, 0.5);
    EXPECT_EQ(errors.interior.both, 1U);
    EXPECT_EQ(errors.band.rays(), 0U);
}

TEST(RayErrors, ComparesNormalsAndColoursThatAreKnown) {
    const std::vector<trace::Ray> rays(3, trace::Ray{{0, 0, 2}, 0, {0, 0, -1}, miss});
    const std::vector<RayAnswer> truth(3, at(1));
    const std::vector<RayAnswer> answers{at(1, {0, 3, 0}, {13, 20, 24, 255}), at(1, {}, {0, 0, 0, 0}),
                                         at(1, {0, 0, 2})};
    const RayErrors errors = compare_answers(rays, truth, answers, {});
    EXPECT_EQ(errors.normal.count, 2U);
    EXPECT_DOUBLE_EQ(errors.normal.max, 90);
    EXPECT_EQ(errors.color.count, 2U);
    EXPECT_DOUBLE_EQ(errors.color.max, 3); // (3 + 0 + 6) / 3
}

TEST(RayErrors, OcclusionIsHitOrMissAlone) {
    const std::vector<RayAnswer> truth{at(1), at(1), {}, {}};
    const RayErrors errors = compare_occlusion(truth, std::vector<std::uint8_t>{1, 0, 1, 0},
                                               std::vector<std::uint8_t>{0, 1, 1, 0});
    EXPECT_EQ(errors.interior.both, 1U);
    EXPECT_EQ(errors.interior.neither, 1U);
    EXPECT_EQ(errors.band.missed, 1U);
    EXPECT_EQ(errors.band.extra, 1U);
    EXPECT_EQ(errors.distance.count, 0U);
}

} // namespace
} // namespace spa::measure
