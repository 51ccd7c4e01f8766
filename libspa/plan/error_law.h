// SPDX-License-Identifier: Apache-2.0
// How error and bytes of a map go with its size, from a few small maps to sizes that nobody wants to bake
// just for asking.
#pragma once

#include <cstdint>
#include <span>

namespace spa::plan {

struct SizedValue {
    std::uint32_t size = 0; // cells a side
    double value = 0;       // >= 0
};

// value = a * size^-b. Errors of maps fall like this: the distance between samples is 1/size, and on smooth
// surfaces the error goes with its square.
class ErrorLaw {
public:
    // Least squares of the logarithms; b is kept in [0, 4]. With a single point b = 1. A value of 0 says that
    // nothing is wrong from that size on, as far as one can tell. points: sizes ascending, at least one.
    static ErrorLaw fit(std::span<const SizedValue> points);

    [[nodiscard]] double at(std::uint32_t size) const;
    [[nodiscard]] double exponent() const { return b_; }

private:
    double log_a_ = 0, b_ = 1;
    std::uint32_t zero_from_ = 0xFFFFFFFFU;
};

// bytes = c2 * size^2 + c1 * size: samples and cells, and what lies along lines on the map, such as fold
// records. Through the two largest points; one point gives c1 = 0. points: sizes ascending, at least one.
class BytesLaw {
public:
    static BytesLaw fit(std::span<const SizedValue> points);

    [[nodiscard]] std::uint64_t at(std::uint32_t size) const;

private:
    double c2_ = 0, c1_ = 0;
};

} // namespace spa::plan
