// SPDX-License-Identifier: Apache-2.0
// The directions of `spa render`'s secondary rays (libspa/render/shaders/path.glsl), so that a plan looks at
// rays that a picture will be made of.
#pragma once

#include "../core/vector.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace spa::plan {

// PCG (O'Neill 2014) as a hash (Jarzynski and Olano 2020).
constexpr std::uint32_t hashed(std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

struct SampleShift {
    std::uint32_t x = 0, y = 0;
};

// Of the first primary ray of the pixel with this index.
constexpr SampleShift sample_shift(std::uint32_t pixel, std::uint32_t seed) {
    const std::uint32_t x = hashed(pixel ^ hashed(seed ^ hashed(0)));
    return {x, hashed(x)};
}

// Point `index` of the R2 sequence (Roberts 2018), moved.
constexpr Vec2f r2_point(std::uint32_t index, SampleShift shift) {
    const std::uint32_t x = index * 3242174889U + shift.x, y = index * 2447445414U + shift.y;
    return {float(x >> 8U) * (1.0F / 16777216.0F), float(y >> 8U) * (1.0F / 16777216.0F)};
}

// Cosine-weighted about `normal`, by the basis of Duff et al. 2017.
inline Vec3f diffuse_direction(Vec3f normal, Vec2f point) {
    const float s = normal.z >= 0 ? 1.0F : -1.0F;
    const float a = -1 / (s + normal.z);
    const float b = normal.x * normal.y * a;
    const Vec3f tangent{1 + s * normal.x * normal.x * a, s * b, -s * normal.x};
    const Vec3f bitangent{b, s + normal.y * normal.y * a, -normal.y};
    const float radius = std::sqrt(point.x);
    const float angle = 2 * std::numbers::pi_v<float> * point.y;
    return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) +
           normal * std::sqrt(std::fmax(0.0F, 1 - point.x));
}

} // namespace spa::plan
