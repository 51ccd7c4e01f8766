// SPDX-License-Identifier: Apache-2.0
// Says how far a candidate's map is from the model, from samples, as few as will do.
#pragma once

#include "estimate.h"

#include "../core/spherical_map.h"

#include <limits>

namespace spa::plan {

class Judge {
public:
    virtual ~Judge() = default;
    // A target that no interval lies clear of.
    static constexpr double never_clear = std::numeric_limits<double>::quiet_NaN();

    // The metric of a part of the model, in the judge's unit. Takes more and more samples until the interval
    // lies clear of `target`, or there are no more: met if high <= target, else missed. Deterministic;
    // parallel in the caller's arena.
    [[nodiscard]] virtual Estimate judge(const Part& part, double target) const = 0;
};

} // namespace spa::plan
