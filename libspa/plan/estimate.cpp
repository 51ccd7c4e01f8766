// SPDX-License-Identifier: Apache-2.0
#include "estimate.h"

#include <algorithm>
#include <cmath>

namespace spa::plan {
namespace {

// values[rank]; beyond the last value nothing bounds the figure.
double value_at(std::vector<double>& values, double rank) {
    if (rank >= double(values.size())) return std::numeric_limits<double>::infinity();
    const auto at = values.begin() + std::ptrdiff_t(std::max(rank, 0.0));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace

Estimate estimate_quantile(std::vector<double> values, double q) {
    Estimate estimate;
    const auto n = double(values.size());
    if (values.empty()) return estimate;
    const double width = confidence * std::sqrt(n * q * (1 - q));
    estimate.value = value_at(values, std::ceil(n * q) - 1);
    estimate.low = std::floor(n * q - width) < 1 ? 0 : value_at(values, std::floor(n * q - width) - 1);
    estimate.high = value_at(values, std::ceil(n * q + width) - 1);
    estimate.samples = values.size();
    return estimate;
}

Estimate estimate_mean(const std::vector<double>& values) {
    Estimate estimate;
    if (values.empty()) return estimate;
    const auto n = double(values.size());
    double sum = 0;
    for (const double v : values) sum += v;
    const double mean = sum / n;
    double squares = 0;
    for (const double v : values) squares += (v - mean) * (v - mean);
    const double width = confidence * std::sqrt(squares) / n;
    estimate.value = mean;
    estimate.low = std::max(mean - width, 0.0);
    estimate.high = mean + width;
    estimate.samples = values.size();
    return estimate;
}

Estimate estimate_share(std::uint64_t count, std::uint64_t of) {
    Estimate estimate;
    if (of == 0) return estimate;
    const auto n = double(of);
    const double p = double(count) / n;
    const double zz = confidence * confidence;
    const double middle = (p + zz / (2 * n)) / (1 + zz / n);
    const double width = confidence / (1 + zz / n) * std::sqrt(p * (1 - p) / n + zz / (4 * n * n));
    estimate.value = p;
    estimate.low = count == 0 ? 0 : std::max(middle - width, 0.0); // rounding aside
    estimate.high = std::min(middle + width, 1.0);
    estimate.samples = of;
    return estimate;
}

} // namespace spa::plan
