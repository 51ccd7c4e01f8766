// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/element_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spa {
namespace {

TEST(SrgbEncoder, IsTheFormula) {
    const SrgbEncoder encode;
    // Every 97th float up to 1, and all around each step.
    for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0F); bits += 97) {
        if (bits < 0x38000000U) bits += 50000; // below 2^-15 everything is 0
        const auto linear = std::bit_cast<float>(bits);
        ASSERT_EQ(encode(linear), linear_to_srgb(linear)) << linear;
    }
    for (unsigned code = 0; code < 255; ++code) {
        float low = srgb_to_linear(std::uint8_t(code));
        float high = srgb_to_linear(std::uint8_t(code + 1));
        while (std::nextafter(low, high) < high) {
            const float middle = low + (high - low) / 2;
            (linear_to_srgb(middle) == code ? low : high) = middle;
        }
        EXPECT_EQ(encode(low), code);
        EXPECT_EQ(encode(high), code + 1);
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(encode(-1), 0);
    EXPECT_EQ(encode(-infinity), 0);
    EXPECT_EQ(encode(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(encode(2), 255);
    EXPECT_EQ(encode(infinity), 255);
}

} // namespace
} // namespace spa
