// SPDX-License-Identifier: Apache-2.0
// Which choice for which object: as few bytes as an error allows, or as little error as bytes allow, when
// errors and bytes of objects add up. The multiple-choice knapsack problem, by its linear relaxation: always
// the step next that saves most error a byte (Lagrange multipliers; Sinha and Zoltners 1979). The result is
// off the optimum by less than one step of one object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace spa::plan {

struct Choice {
    std::uint64_t bytes = 0;
    double error = 0;
};
// Of one object; at least one choice, in any order.
using Menu = std::vector<Choice>;

struct Limits {
    std::optional<double> error;
    std::optional<std::uint64_t> bytes;
};

struct Allocation {
    std::vector<std::size_t> chosen; // one a menu: index into it
    std::uint64_t bytes = 0;
    double error = 0;
    bool meets_error = true, meets_bytes = true; // limits that are there
};

// With both limits: as few bytes as the error allows, and if those are too many, as little error as the bytes
// allow. With none: the least error. Deterministic: ties go to the earlier menu. O(n log n) of all choices.
Allocation allocate(std::span<const Menu> menus, const Limits& limits);

} // namespace spa::plan
