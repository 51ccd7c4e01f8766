// SPDX-License-Identifier: Apache-2.0
#include "image_errors.h"

#include <array>
#include <cmath>

namespace spa::measure {

namespace {

using Window = std::array<double, ssim_window>;

// One axis of the window, which is a product of two; sums to 1.
Window gaussian() {
    constexpr double sigma = 1.5;
    constexpr int middle = int(ssim_window) / 2;
    Window window{};
    double sum = 0;
    for (int i = 0; i < int(ssim_window); ++i) {
        const double x = (i - middle) / sigma;
        window[std::size_t(i)] = std::exp(-0.5 * x * x);
        sum += window[std::size_t(i)];
    }
    for (double& weight : window) weight /= sum;
    return window;
}

// What the window sees at one place: weighted means of a, b, a^2, b^2 and ab.
struct Moments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

    void add(double weight, const Moments& m) {
        a += weight * m.a;
        b += weight * m.b;
        aa += weight * m.aa;
        bb += weight * m.bb;
        ab += weight * m.ab;
    }
};

double similarity(const Moments& m) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03; // of values in [0,1]
    const double variance_a = m.aa - m.a * m.a, variance_b = m.bb - m.b * m.b;
    const double covariance = m.ab - m.a * m.b;
    return (2 * m.a * m.b + c1) * (2 * covariance + c2) /
           ((m.a * m.a + m.b * m.b + c1) * (variance_a + variance_b + c2));
}

} // namespace

std::optional<double> structural_similarity(std::uint32_t width, std::uint32_t height,
                                            std::span<const double> a, std::span<const double> b) {
    if (width < ssim_window || height < ssim_window) return std::nullopt;
    const Window window = gaussian();
    const std::size_t places_x = width - ssim_window + 1, places_y = height - ssim_window + 1;
    // One row of windows at a time: first down the columns, then along the row.
    std::vector<Moments> columns(width);
    double sum = 0;
    for (std::size_t y = 0; y < places_y; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            columns[x] = {};
            for (std::size_t k = 0; k < ssim_window; ++k) {
                const double va = a[(y + k) * width + x], vb = b[(y + k) * width + x];
                columns[x].add(window[k], {va, vb, va * va, vb * vb, va * vb});
            }
        }
        for (std::size_t x = 0; x < places_x; ++x) {
            Moments moments;
            for (std::size_t k = 0; k < ssim_window; ++k) moments.add(window[k], columns[x + k]);
            sum += similarity(moments);
        }
    }
    return sum / (double(places_x) * double(places_y));
}

} // namespace spa::measure
