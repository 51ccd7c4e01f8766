// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/element_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace spa {
namespace {

float depth_through(ElementFormat format, double depth) {
    std::array<std::byte, 4> code{};
    encode_depth(format, depth, code.data());
    return decode_depth(format, code.data());
}

TEST(Depth, RoundTripWithinHalfACode) {
    for (const ElementFormat format : {ElementFormat::u8, ElementFormat::u16, ElementFormat::f32}) {
        const double bound = depth_quantum_error(format);
        for (int i = 0; i <= 100000; ++i) {
            const double d = i / 100000.0;
            const double smallest = format == ElementFormat::u8    ? 1 / 255.0
                                    : format == ElementFormat::u16 ? 1 / 65535.0
                                                                   : 0;
            if (d < smallest) continue;
            ASSERT_NEAR(double(depth_through(format, d)), d, bound * (1 + 1e-6) + 6e-8) << name(format);
        }
    }
}

TEST(Depth, ASurfaceIsNeverNoSurface) {
    for (const ElementFormat format : {ElementFormat::u8, ElementFormat::u16, ElementFormat::f32}) {
        EXPECT_GT(depth_through(format, 0), 0);
        EXPECT_GT(depth_through(format, 1e-30), 0);
    }
}

TEST(Depth, FullRadiusIsTheTopCode) {
    EXPECT_EQ(depth_through(ElementFormat::u8, 1), 1.0F);
    EXPECT_EQ(depth_through(ElementFormat::u16, 1), 1.0F);
    EXPECT_EQ(depth_through(ElementFormat::f32, 1), 1.0F);
    EXPECT_EQ(depth_through(ElementFormat::u16, 1.5), 1.0F);
}

TEST(Depth, CodesAreLittleEndian) {
    std::array<std::byte, 4> code{};
    encode_depth(ElementFormat::u16, double(0x1234) / 65535, code.data());
    EXPECT_EQ(code[0], std::byte{0x34});
    EXPECT_EQ(code[1], std::byte{0x12});
}

struct AngleError {
    double mean = 0, max = 0;
};

AngleError normal_error(ElementFormat format) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    AngleError error;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
        const Vec3d n = normalize(Vec3d{normal(random), normal(random), normal(random)});
        std::array<std::byte, 4> code{};
        encode_normal(format, n, code.data());
        const Vec3d m = to_double(decode_normal(format, code.data()));
        const double angle = std::atan2(length(cross(n, m)), dot(n, m)) * 180 / std::numbers::pi;
        error.mean += angle / count;
        error.max = std::max(error.max, angle);
    }
    return error;
}

// Bounds from Cigolle et al. 2014, table 1 (oct16, oct32: plain rounding; ours must not be worse).
TEST(Normal, ErrorStaysBelowThePublishedOne) {
    const AngleError oct8 = normal_error(ElementFormat::oct8);
    EXPECT_LT(oct8.mean, 0.338);
    EXPECT_LT(oct8.max, 0.945);
    const AngleError oct16 = normal_error(ElementFormat::oct16);
    EXPECT_LT(oct16.mean, 0.00135);
    EXPECT_LT(oct16.max, 0.0037);
    const AngleError rgb8 = normal_error(ElementFormat::rgb8);
    EXPECT_LT(rgb8.mean, 0.171);
    EXPECT_LT(rgb8.max, 0.39);
}

TEST(Normal, AxesAreExactInOctahedralFormats) {
    for (const ElementFormat format : {ElementFormat::oct8, ElementFormat::oct16}) {
        for (const Vec3d n : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0},
                              Vec3d{0, 0, 1}, Vec3d{0, 0, -1}}) {
            std::array<std::byte, 4> code{};
            encode_normal(format, n, code.data());
            EXPECT_EQ(decode_normal(format, code.data()), to_float(n)) << name(format);
        }
    }
}

TEST(Normal, ForeignCodesDecodeToUnitVectors) {
    const std::array<std::byte, 4> lowest{std::byte{0}, std::byte{0x80}, std::byte{0}, std::byte{0x80}};
    EXPECT_NEAR(length(decode_normal(ElementFormat::oct16, lowest.data())), 1, 1e-6);
    const std::array<std::byte, 2> lowest8{std::byte{0x80}, std::byte{0x80}};
    EXPECT_NEAR(length(decode_normal(ElementFormat::oct8, lowest8.data())), 1, 1e-6);
}

TEST(Srgb, EveryCodeSurvives) {
    for (unsigned i = 0; i < 256; ++i) {
        EXPECT_EQ(linear_to_srgb(srgb_to_linear(std::uint8_t(i))), i);
    }
    EXPECT_EQ(linear_to_srgb(std::nanf("")), 0);
    EXPECT_EQ(linear_to_srgb(-1), 0);
    EXPECT_EQ(linear_to_srgb(7), 255);
    // IEC 61966-2-1: middle grey.
    EXPECT_NEAR(srgb_to_linear(128), 0.21586F, 1e-5F);
}

} // namespace
} // namespace spa
