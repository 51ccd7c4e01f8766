// SPDX-License-Identifier: Apache-2.0
// What the tracing text takes for granted: every single operation rounds on this device as it does on the
// CPU. If this test fails too, a difference between traces is the device's and not the text's.
#include "gpu_test.h"

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace spa::test {
namespace {

constexpr std::uint32_t count = 1U << 18;
constexpr std::array<const char*, 8> operations = {"a + b",    "a * b",     "a / b", "sqrt(|a|)",
                                                   "floor(a)", "a * b + c", "dot",   "a * b + a * c"};

std::array<float, operations.size()> expected(float a, float b, float c) {
    return {
        a + b,        a * b, a / b, std::sqrt(std::fabs(a)), std::floor(a), a * b + c, a * b + b * c + c * a,
        a * b + a * c};
}

// Of magnitudes from 2^-30 to 2^31, and some that are special.
std::vector<float> make_operands() {
    constexpr std::array<float, 8> special = {0.0F, -0.0F, 1.0F, -1.0F, INFINITY, -INFINITY, 1e-40F, 3.4e38F};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> mantissa(-2.0F, 2.0F);
    std::vector<float> operands(3U * count);
    for (float& operand : operands)
        operand = random() % 16 == 0 ? special[random() % special.size()]
                                     : std::ldexp(mantissa(random), int(random() % 61) - 30);
    return operands;
}

bool same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

class Arithmetic : public GpuTest, public testing::WithParamInterface<const char*> {};

TEST_P(Arithmetic, RoundsAsOnTheCpu) {
    const std::vector<float> operands = make_operands();
    Buffer in(*device, operands.size());
    const Buffer out(*device, std::size_t(count) * operations.size());
    for (std::size_t i = 0; i < operands.size(); ++i)
        in.words()[i] = std::bit_cast<std::uint32_t>(operands[i]);
    const ComputePipeline pipeline(*device, shader(GetParam()), 2, sizeof(count));
    const std::array<const Buffer*, 2> buffers = {&in, &out};
    pipeline.run(buffers, std::as_bytes(std::span(&count, 1)), (count + 63) / 64);

    std::array<std::uint32_t, operations.size()> differ{};
    for (std::uint32_t i = 0; i < count; ++i) {
        const float* const operand = &operands[3U * i];
        const auto results = expected(operand[0], operand[1], operand[2]);
        for (std::size_t k = 0; k < results.size(); ++k)
            if (!same(results[k], std::bit_cast<float>(out.words()[i * results.size() + k]))) ++differ[k];
    }
    for (std::size_t k = 0; k < differ.size(); ++k)
        EXPECT_EQ(differ[k], 0U) << operations[k] << ", of " << count << " triples; "
                                 << device->description();
}

INSTANTIATE_TEST_SUITE_P(Languages, Arithmetic, testing::Values("arithmetic.comp", "arithmetic.hlsl"),
                         [](const auto& name) { return name.index == 0 ? "Glsl" : "Hlsl"; });

} // namespace
} // namespace spa::test
