// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/plan/error_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace spa::plan;

TEST(ErrorLaw, FindsAPower) {
    std::array<SizedValue, 3> points{SizedValue{16, 0}, {32, 0}, {64, 0}};
    for (SizedValue& point : points) point.value = 3.5 * std::pow(double(point.size), -1.7);
    const ErrorLaw law = ErrorLaw::fit(points);
    EXPECT_NEAR(law.exponent(), 1.7, 1e-9);
    EXPECT_NEAR(law.at(512), 3.5 * std::pow(512, -1.7), 1e-9);
}

TEST(ErrorLaw, NeverRisesWithTheSize) {
    const std::array<SizedValue, 2> points{SizedValue{16, 0.1}, {32, 0.4}};
    const ErrorLaw law = ErrorLaw::fit(points);
    EXPECT_EQ(law.exponent(), 0);
    EXPECT_NEAR(law.at(512), 0.2, 1e-12); // the geometric mean
}

TEST(ErrorLaw, TakesZeroForNothingWrong) {
    const std::array<SizedValue, 2> points{SizedValue{16, 0.1}, {32, 0}};
    EXPECT_EQ(ErrorLaw::fit(points).at(64), 0);
    EXPECT_GT(ErrorLaw::fit(points).at(16), 0);
    const std::array<SizedValue, 3> luck{SizedValue{16, 0.1}, {32, 0}, {64, 0.02}};
    EXPECT_GT(ErrorLaw::fit(luck).at(128), 0);
    const std::array<SizedValue, 1> nothing{SizedValue{16, 0}};
    EXPECT_EQ(ErrorLaw::fit(nothing).at(16), 0);
}

TEST(ErrorLaw, FromOnePointHalvesWithTheSize) {
    const std::array<SizedValue, 1> point{SizedValue{16, 0.1}};
    EXPECT_NEAR(ErrorLaw::fit(point).at(64), 0.025, 1e-12);
}

TEST(BytesLaw, GoesThroughTheLastTwo) {
    const auto bytes = [](double n) { return 7 * n * n + 50 * n; };
    const std::array<SizedValue, 3> points{SizedValue{16, 1}, {32, bytes(32)}, {64, bytes(64)}};
    const BytesLaw law = BytesLaw::fit(points);
    EXPECT_EQ(law.at(512), std::uint64_t(bytes(512)));
    EXPECT_EQ(law.at(64), std::uint64_t(bytes(64)));
}

} // namespace
