// SPDX-License-Identifier: Apache-2.0
// Figures of a set of measured values.
#pragma once

#include <cstdint>
#include <vector>

namespace spa::measure {

// Of nothing: count 0, the rest 0.
struct Distribution {
    std::uint64_t count = 0;
    double max = 0, mean = 0, rms = 0;
    double p95 = 0;             // the smallest value that at least 95 % of all values do not exceed
    double median = 0, p99 = 0; // likewise
};

// values: >= 0, finite. O(n); the sums run in the order given, so the same values give the same bits.
Distribution distribution(std::vector<double> values);

} // namespace spa::measure
