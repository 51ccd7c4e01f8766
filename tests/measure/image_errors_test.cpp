// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/image_errors.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace spa::measure {
namespace {

// Never mind the size of the numbers: some below 0, some far above what a display shows.
std::vector<Vec3f> random_picture(std::size_t pixels, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-0.1F, 2);
    std::vector<Vec3f> picture(pixels);
    for (Vec3f& pixel : picture) pixel = {value(random), value(random), value(random)};
    return picture;
}

std::vector<double> random_channel(std::size_t pixels, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    std::vector<double> channel(pixels);
    for (double& v : channel) v = value(random);
    return channel;
}

double part(Vec3f pixel, int channel) {
    return double(channel == 0 ? pixel.x : channel == 1 ? pixel.y : pixel.z);
}

// The inverse of display_value without exposure, as the standard prints it.
float linear_of_code(double code) {
    return float(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
}

TEST(ImageErrors, RelativeErrorByHand) {
    // One channel alone differs, by 0.5 from 1.5 (error 0.25) and by 0.1 from 0 (error 0.01).
    const std::vector<Vec3f> picture{{2, 1, 1}, {1, 0.1F, 3}}, reference{{1.5F, 1, 1}, {1, 0, 3}};
    const ImageErrors errors = image_errors({2, 1, picture}, {2, 1, reference}, {.epsilon = 1e-2});
    EXPECT_NEAR(errors.rel_mse, (0.25 / (2.25 + 0.01) + 0.01 / 0.01) / 6, 1e-8);
    EXPECT_NEAR(errors.mse, (0.25 + 0.01) / 6, 1e-8);
    EXPECT_NEAR(errors.rmse, std::sqrt((0.25 + 0.01) / 6), 1e-8);
    EXPECT_EQ(errors.pixels, 2U);
    const ImageErrors blunter = image_errors({2, 1, picture}, {2, 1, reference}, {.epsilon = 1});
    EXPECT_NEAR(blunter.rel_mse, (0.25 / 3.25 + 0.01) / 6, 1e-8);
}

TEST(ImageErrors, TheReferenceIsTheSecond) {
    const std::vector<Vec3f> dark{{0.1F, 0.1F, 0.1F}}, bright{{1, 1, 1}};
    const double under = image_errors({1, 1, dark}, {1, 1, bright}).rel_mse;
    const double over = image_errors({1, 1, bright}, {1, 1, dark}).rel_mse;
    EXPECT_NEAR(under, 0.81 / 1.01, 1e-6);
    EXPECT_NEAR(over, 0.81 / 0.02, 1e-4);
}

TEST(ImageErrors, AgreeWithTheFormulas) {
    constexpr std::uint32_t width = 37, height = 23;
    const std::vector<Vec3f> a = random_picture(width * height, 1), b = random_picture(width * height, 2);
    const ImageErrors errors = image_errors({width, height, a}, {width, height, b});
    long double squares = 0, relative = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = part(a[i], c) - part(b[i], c);
            squares += d * d;
            relative += d * d / (part(b[i], c) * part(b[i], c) + 0.01);
        }
    EXPECT_NEAR(errors.mse, double(squares) / (3 * width * height), 1e-12);
    EXPECT_NEAR(errors.rel_mse, double(relative) / (3 * width * height), 1e-12);
}

TEST(ImageErrors, EqualPicturesHaveNoError) {
    const std::vector<Vec3f> picture = random_picture(16 * 12, 3);
    const ImageErrors errors = image_errors({16, 12, picture}, {16, 12, picture});
    EXPECT_EQ(errors.mse, 0);
    EXPECT_EQ(errors.rel_mse, 0);
    EXPECT_EQ(errors.psnr, std::numeric_limits<double>::infinity());
    ASSERT_TRUE(errors.ssim.has_value());
    EXPECT_EQ(*errors.ssim, 1);
}

TEST(ImageErrors, PeakSignalToNoiseOfAConstantOffset) {
    // Codes that differ by a tenth everywhere: 20 dB.
    const std::vector<Vec3f> a(4, Vec3f{linear_of_code(0.5), linear_of_code(0.02), linear_of_code(0.9)});
    const std::vector<Vec3f> b(4, Vec3f{linear_of_code(0.6), linear_of_code(0.12), linear_of_code(0.8)});
    EXPECT_NEAR(image_errors({2, 2, a}, {2, 2, b}).psnr, 20, 1e-4);
}

TEST(ImageErrors, WhatADisplayCannotShowIsNoDifferenceToTheEye) {
    const std::vector<Vec3f> a(1, Vec3f{1, 3, -1}), b(1, Vec3f{2, 1, 0});
    const ImageErrors errors = image_errors({1, 1, a}, {1, 1, b});
    EXPECT_EQ(errors.psnr, std::numeric_limits<double>::infinity());
    EXPECT_GT(errors.mse, 0);
    EXPECT_LT(image_errors({1, 1, a}, {1, 1, b}, {.exposure = -2}).psnr, 20) << "two stops darker it is";
}

TEST(ImageErrors, DisplayValuesFollowTheStandard) {
    EXPECT_DOUBLE_EQ(display_value(0, 0), 0);
    EXPECT_DOUBLE_EQ(display_value(1, 0), 1);
    EXPECT_NEAR(display_value(0.0031308, 0), 0.04045, 1e-5);
    EXPECT_NEAR(display_value(double(linear_of_code(0.3)), 0), 0.3, 1e-6);
    EXPECT_NEAR(display_value(double(linear_of_code(0.3)) / 8, 3), 0.3, 1e-6);
    EXPECT_EQ(display_value(-1, 0), 0);
    EXPECT_EQ(display_value(7, 0), 1);
}

// The definition, window by window: weights of two dimensions, variances about the mean.
double naive_similarity(int width, int height, const std::vector<double>& a, const std::vector<double>& b) {
    double weights[11][11];
    double all = 0;
    for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 11; ++i)
            all += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
    double sum = 0;
    for (int y = 0; y + 11 <= height; ++y)
        for (int x = 0; x + 11 <= width; ++x) {
            const auto mean = [&](auto value) {
                double total = 0;
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 11; ++i)
                        total += weights[j][i] / all * value(std::size_t((y + j) * width + x + i));
                return total;
            };
            const double ma = mean([&](std::size_t k) { return a[k]; });
            const double mb = mean([&](std::size_t k) { return b[k]; });
            const double va = mean([&](std::size_t k) { return (a[k] - ma) * (a[k] - ma); });
            const double vb = mean([&](std::size_t k) { return (b[k] - mb) * (b[k] - mb); });
            const double cov = mean([&](std::size_t k) { return (a[k] - ma) * (b[k] - mb); });
            sum += (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
        }
    return sum / ((width - 10) * (height - 10));
}

TEST(StructuralSimilarity, AgreesWithTheDefinition) {
    for (const auto& [width, height] : {std::pair{11, 11}, {30, 17}, {13, 40}}) {
        const std::vector<double> a = random_channel(std::size_t(width * height), 5);
        std::vector<double> b = random_channel(std::size_t(width * height), 6);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] = 0.7 * a[i] + 0.3 * b[i];
        const std::optional<double> similarity =
            structural_similarity(std::uint32_t(width), std::uint32_t(height), a, b);
        ASSERT_TRUE(similarity.has_value());
        EXPECT_NEAR(*similarity, naive_similarity(width, height, a, b), 1e-10);
        EXPECT_GT(*similarity, 0.5);
        EXPECT_LT(*similarity, 0.99);
    }
}

TEST(StructuralSimilarity, KnownValues) {
    const std::vector<double> a = random_channel(20 * 15, 7), b = random_channel(20 * 15, 8);
    EXPECT_EQ(structural_similarity(20, 15, a, a), 1);
    EXPECT_EQ(structural_similarity(20, 15, a, b), structural_similarity(20, 15, b, a));
    // Flat pictures differ in luminance alone.
    const std::vector<double> dark(20 * 15, 0.25), bright(20 * 15, 0.75);
    EXPECT_NEAR(*structural_similarity(20, 15, dark, bright),
                (2 * 0.25 * 0.75 + 1e-4) / (0.25 * 0.25 + 0.75 * 0.75 + 1e-4), 1e-9);
    std::vector<double> negative(a);
    for (double& value : negative) value = 1 - value;
    EXPECT_LT(*structural_similarity(20, 15, a, negative), -0.7);
}

TEST(StructuralSimilarity, NeedsAWholeWindow) {
    const std::vector<double> channel(10 * 20, 0.5);
    EXPECT_FALSE(structural_similarity(10, 20, channel, channel).has_value());
    EXPECT_FALSE(structural_similarity(20, 10, channel, channel).has_value());
    const std::vector<Vec3f> small(4, Vec3f{1, 1, 1});
    EXPECT_FALSE(image_errors({2, 2, small}, {2, 2, small}).ssim.has_value());
}

TEST(StructuralSimilarity, IsOfTheLumaOfDisplayValues) {
    constexpr std::uint32_t width = 16, height = 14;
    const std::vector<Vec3f> a = random_picture(width * height, 9), b = random_picture(width * height, 10);
    const auto luma = [](const std::vector<Vec3f>& picture) {
        std::vector<double> channel;
        for (const Vec3f pixel : picture)
            channel.push_back(0.2126 * display_value(double(pixel.x), -1) +
                              0.7152 * display_value(double(pixel.y), -1) +
                              0.0722 * display_value(double(pixel.z), -1));
        return channel;
    };
    EXPECT_NEAR(*image_errors({width, height, a}, {width, height, b}, {.exposure = -1}).ssim,
                naive_similarity(width, height, luma(a), luma(b)), 1e-10);
}

// The message of the error that comparing throws; empty if it throws none.
std::string refusal(const ImageRef& picture, const ImageRef& reference) {
    try {
        static_cast<void>(image_errors(picture, reference));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        return error.what();
    }
    return {};
}

TEST(ImageErrors, PixelsThatAreNotFiniteAreCountedAndRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const std::vector<Vec3f> good(4, Vec3f{1, 1, 1});
    const std::vector<Vec3f> bad{{1, 1, 1}, {nan, nan, 0}, {0, 0, -inf}, {1, 1, 1}};
    EXPECT_EQ(non_finite_pixels({2, 2, good}), 0U);
    EXPECT_EQ(non_finite_pixels({2, 2, bad}), 2U);
    EXPECT_NE(refusal({2, 2, bad}, {2, 2, good}).find("the picture has 2 pixels"), std::string::npos);
    EXPECT_NE(refusal({2, 2, good}, {2, 2, bad}).find("the reference has 2 pixels"), std::string::npos);
}

TEST(ImageErrors, SizesMustAgree) {
    const std::vector<Vec3f> pixels(6, Vec3f{1, 1, 1});
    const std::string message = refusal({3, 2, pixels}, {2, 3, pixels});
    EXPECT_NE(message.find("3 x 2"), std::string::npos);
    EXPECT_NE(message.find("2 x 3"), std::string::npos);
    EXPECT_NE(refusal({}, {}), "");
}

} // namespace
} // namespace spa::measure
