// SPDX-License-Identifier: Apache-2.0
#include "statistics.h"

#include <algorithm>
#include <cmath>

namespace spa::measure {

Distribution distribution(std::vector<double> values) {
    Distribution result;
    if (values.empty()) return result;
    result.count = values.size();
    double sum = 0;
    double squares = 0;
    for (const double v : values) {
        result.max = std::max(result.max, v);
        sum += v;
        squares += v * v;
    }
    result.mean = sum / double(values.size());
    result.rms = std::sqrt(squares / double(values.size()));
    const auto at = [&](double share) {
        const auto rank = std::size_t(std::ceil(share * double(values.size()))) - 1;
        std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
        return values[rank];
    };
    result.median = at(0.5);
    result.p95 = at(0.95);
    result.p99 = at(0.99);
    return result;
}

} // namespace spa::measure
