// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/plan/estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace spa::plan {
namespace {

// How many of 400 samples of `count` values have an interval with `truth` in it.
template <class Estimator>
int hits(std::size_t count, double truth, Estimator&& estimate) {
    std::mt19937_64 random(7);
    int found = 0;
    for (int i = 0; i < 400; ++i) {
        std::vector<double> values(count);
        // [0,1), skewed: the square of an even distribution.
        for (double& v : values) v = std::pow(double(random() >> 11U) * 0x1p-53, 2);
        const Estimate e = estimate(values);
        EXPECT_LE(e.low, e.value);
        EXPECT_LE(e.value, e.high);
        EXPECT_EQ(e.samples, count);
        found += int(e.low <= truth && truth <= e.high);
    }
    return found;
}

TEST(Estimate, IntervalsHoldTheTruth99TimesOf100) {
    const auto quantile = [](const std::vector<double>& v) { return estimate_quantile(v, 0.95); };
    EXPECT_GE(hits(1000, 0.95 * 0.95, quantile), 390);
    EXPECT_GE(hits(1000, 1.0 / 3, [](const std::vector<double>& v) { return estimate_mean(v); }), 390);
    const auto share = [](const std::vector<double>& v) {
        const auto count = std::count_if(v.begin(), v.end(), [](double x) { return x < 0.01; });
        return estimate_share(std::uint64_t(count), v.size()); // true share: sqrt(0.01)
    };
    EXPECT_GE(hits(1000, 0.1, share), 390);
}

TEST(Estimate, IntervalsAreNotWiderThanTheyNeedToBe) {
    const auto narrow = [](const std::vector<double>& v) {
        Estimate e = estimate_quantile(v, 0.95);
        e.low = e.value - (e.value - e.low) / 3;
        e.high = e.value + (e.high - e.value) / 3;
        return e;
    };
    EXPECT_LT(hits(1000, 0.95 * 0.95, narrow), 320);
}

TEST(Estimate, OfNothingKnowsNothing) {
    for (const Estimate& e : {estimate_quantile({}, 0.95), estimate_mean({}), estimate_share(0, 0)}) {
        EXPECT_EQ(e.low, 0);
        EXPECT_TRUE(std::isinf(e.high));
        EXPECT_EQ(e.samples, 0U);
    }
    // The largest of few values bounds no quantile.
    EXPECT_TRUE(std::isinf(estimate_quantile({1, 2, 3}, 0.95).high));
}

TEST(Estimate, NoneOfManyMayStillBeAFew) {
    const Estimate e = estimate_share(0, 1000);
    EXPECT_EQ(e.low, 0);
    EXPECT_EQ(e.value, 0);
    EXPECT_GT(e.high, 1e-3);
    EXPECT_LT(e.high, 1e-2);
}

} // namespace
} // namespace spa::plan
