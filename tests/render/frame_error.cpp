// SPDX-License-Identifier: Apache-2.0
#include "frame_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace spa::test {
namespace {

std::array<float, 3> channels(Vec3f v) { return {v.x, v.y, v.z}; }

} // namespace

std::size_t differing(std::span<const Vec3f> a, std::span<const Vec3f> b, float share, float least) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto x = channels(a[i]);
        const auto y = channels(b[i]);
        bool differs = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const float limit = std::max(share * std::max(std::abs(x[k]), std::abs(y[k])), least);
            differs = differs || !(std::abs(x[k] - y[k]) <= limit);
        }
        count += differs ? 1 : 0;
    }
    return count;
}

double mean(std::span<const Vec3f> picture) {
    double sum = 0;
    for (const Vec3f& v : picture) sum += double(v.x) + double(v.y) + double(v.z);
    return sum / double(3 * picture.size());
}

double root_mean_square(std::span<const Vec3f> a, std::span<const Vec3f> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3d d = to_double(a[i]) - to_double(b[i]);
        sum += dot(d, d);
    }
    return std::sqrt(sum / double(3 * a.size()));
}

bool same_bits(std::span<const Vec3f> a, std::span<const Vec3f> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

} // namespace spa::test
