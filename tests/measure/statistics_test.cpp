// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spa::measure {
namespace {

TEST(Distribution, OfNothingIsZero) {
    const Distribution d = distribution({});
    EXPECT_EQ(d.count, 0U);
    EXPECT_EQ(d.max, 0);
    EXPECT_EQ(d.p95, 0);
}

TEST(Distribution, OfOneValueIsThatValue) {
    const Distribution d = distribution({3});
    EXPECT_EQ(d.max, 3);
    EXPECT_EQ(d.mean, 3);
    EXPECT_EQ(d.rms, 3);
    EXPECT_EQ(d.p95, 3);
}

TEST(Distribution, OfOneToHundred) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    const Distribution d = distribution(values);
    EXPECT_EQ(d.count, 100U);
    EXPECT_EQ(d.max, 100);
    EXPECT_DOUBLE_EQ(d.mean, 50.5);
    EXPECT_DOUBLE_EQ(d.rms, std::sqrt(338350.0 / 100)); // n (n + 1) (2 n + 1) / 6
    EXPECT_EQ(d.p95, 95);
    EXPECT_EQ(d.median, 50);
    EXPECT_EQ(d.p99, 99);
}

// 95 % of 21 values are 19.95 of them, so the 20th smallest is the first that so many do not exceed.
TEST(Distribution, ThePercentileIsRoundedUp) {
    std::vector<double> values;
    for (int i = 1; i <= 21; ++i) values.push_back(i);
    EXPECT_EQ(distribution(values).p95, 20);
}

} // namespace
} // namespace spa::measure
