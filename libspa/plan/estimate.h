// SPDX-License-Identifier: Apache-2.0
// What a sample of values says about all of them: a figure, and the interval that holds the true one.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace spa::plan {

struct Estimate {
    double low = 0, value = std::numeric_limits<double>::infinity(),
           high = std::numeric_limits<double>::infinity();
    std::uint64_t samples = 0; // rays or points that it is made from
};

// Half the width of the intervals in standard errors: 99 of 100 hold the true figure.
constexpr double confidence = 2.576;

// The share `q` in (0,1) of all values is at most this. The interval runs between two of the values, as the
// binomial distribution of the rank has it (order statistics). values: >= 0, none: nothing is known. O(n).
Estimate estimate_quantile(std::vector<double> values, double q);

// The mean, with its standard error. O(n).
Estimate estimate_mean(const std::vector<double>& values);

// count of `of`: the score interval (Wilson 1927), which holds at counts of 0 too.
Estimate estimate_share(std::uint64_t count, std::uint64_t of);

} // namespace spa::plan
