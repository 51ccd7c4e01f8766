// SPDX-License-Identifier: Apache-2.0
// Ranges of w in which something is solid, at most two.
#pragma once

#include <algorithm>
#include <array>

namespace spa::trace {

struct Range {
    float low = 0, high = 0;
};

// Up to two disjoint ranges, ascending. They cover everything that was added; where it does not fit into two,
// the smallest gaps are closed.
class Ranges {
public:
    [[nodiscard]] unsigned count() const { return count_; }
    [[nodiscard]] const Range& operator[](unsigned index) const { return ranges_[index]; }

    void add(Range range) {
        // What overlaps becomes part of `range`; what does not stays before or behind it.
        std::array<Range, 3> all{};
        unsigned n = 0;
        bool placed = false;
        for (unsigned i = 0; i < count_; ++i) {
            const Range& old = ranges_[i];
            if (range.low <= old.high && old.low <= range.high) {
                range = {std::min(old.low, range.low), std::max(old.high, range.high)};
                continue;
            }
            if (!placed && range.high < old.low) {
                all[n++] = range;
                placed = true;
            }
            all[n++] = old;
        }
        if (!placed) all[n++] = range;
        if (n == 3) {
            if (all[1].low - all[0].high <= all[2].low - all[1].high) {
                ranges_ = {{{all[0].low, all[1].high}, all[2]}};
            } else {
                ranges_ = {{all[0], {all[1].low, all[2].high}}};
            }
            count_ = 2;
        } else {
            ranges_ = {{all[0], all[1]}};
            count_ = n;
        }
    }
    void add(const Ranges& ranges) {
        for (unsigned i = 0; i < ranges.count(); ++i) add(ranges[i]);
    }

private:
    std::array<Range, 2> ranges_{};
    unsigned count_ = 0;
};

} // namespace spa::trace
