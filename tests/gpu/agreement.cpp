// SPDX-License-Identifier: Apache-2.0
#include "agreement.h"

#include "trace_on_cpu.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>

namespace spa::test {
namespace {

constexpr float t_tolerance = 1e-5F; // R

using Result = std::span<const std::uint32_t>; // RESULT_WORDS of them

float number(Result result, std::size_t word) { return std::bit_cast<float>(result[word]); }

// In R: t is in units of the direction.
float t_error(const TestRay& ray, Result a, Result b) {
    const float length = std::sqrt(dot(ray.ray.direction, ray.ray.direction));
    return std::fabs(number(a, RESULT_T) - number(b, RESULT_T)) * length;
}

// What a picture would show of a linear colour, and of a number between 0 and 1: codes of 255.
float color_code(float linear) {
    return 255 * (linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F);
}
float share_code(float share) { return 255 * share; }

float shading_error(Result a, Result b) {
    float worst = std::fabs(share_code(number(a, RESULT_COVERAGE)) - share_code(number(b, RESULT_COVERAGE)));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t color = RESULT_COLOR + i, normal = RESULT_SHADING_NORMAL + i;
        worst = std::max({worst, std::fabs(color_code(number(a, color)) - color_code(number(b, color))),
                          std::fabs(share_code(number(a, normal)) - share_code(number(b, normal))) / 2});
    }
    return worst;
}

bool same_hit(const TestRay& ray, Result a, Result b) {
    if (a[RESULT_HIT] != b[RESULT_HIT]) return false;
    if (a[RESULT_HIT] == 0 || (ray.flags & SPA_ANY_HIT) != 0) return true;
    return a[RESULT_LAYER] == b[RESULT_LAYER] && a[RESULT_SIDE] == b[RESULT_SIDE] &&
           a[RESULT_FRONT] == b[RESULT_FRONT] && t_error(ray, a, b) <= t_tolerance;
}

void print(std::ostream& out, const char* whose, Result result) {
    out << "\n  " << whose << ": ";
    if (result[RESULT_HIT] == 0)
        out << "no hit";
    else
        out << "t " << number(result, RESULT_T) << ", layer " << result[RESULT_LAYER] << ", side "
            << result[RESULT_SIDE] << ", front " << result[RESULT_FRONT];
}

std::string in_words(std::size_t index, const TestRay& test, Result expected, Result result) {
    std::ostringstream out;
    const shader::SpaRay& ray = test.ray;
    out << "ray " << index << std::hexfloat << ": origin (" << ray.origin.x << ", " << ray.origin.y << ", "
        << ray.origin.z << "), direction (" << ray.direction.x << ", " << ray.direction.y << ", "
        << ray.direction.z << "), t from " << ray.t_min << " to " << ray.t_max << ", flags " << test.flags
        << std::defaultfloat;
    print(out, "expected", expected);
    print(out, "found", result);
    return out.str();
}

} // namespace

Agreement agreement_of(std::span<const TestRay> rays, std::span<const std::uint32_t> expected,
                       std::span<const std::uint32_t> results) {
    Agreement agreement;
    agreement.rays = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Result a = expected.subspan(i * RESULT_WORDS, RESULT_WORDS);
        const Result b = results.subspan(i * RESULT_WORDS, RESULT_WORDS);
        if (a[RESULT_HIT] != 0) ++agreement.hits;
        if (std::equal(a.begin(), a.end(), b.begin())) continue;
        ++agreement.not_identical;
        if (same_hit(rays[i], a, b)) {
            if ((rays[i].flags & SPA_ANY_HIT) != 0) continue;
            agreement.t_error = std::max(agreement.t_error, t_error(rays[i], a, b));
            agreement.shading_error = std::max(agreement.shading_error, shading_error(a, b));
        } else if (agreement.differ++ == 0) {
            agreement.first_difference = in_words(i, rays[i], a, b);
        }
    }
    return agreement;
}

std::string summary(const Agreement& agreement) {
    std::ostringstream out;
    out << agreement.rays << " rays, " << agreement.hits << " hits; " << agreement.differ
        << " hit something else, " << agreement.not_identical
        << " are not identical to the bit, t differs by " << agreement.t_error << " R and shading by "
        << agreement.shading_error << " of 255 at most";
    return out.str();
}

} // namespace spa::test
