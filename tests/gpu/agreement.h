// SPDX-License-Identifier: Apache-2.0
// Two sets of results of the same rays, set side by side.
#pragma once

#include "rays.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace spa::test {

struct Agreement {
    std::size_t rays = 0;
    std::size_t hits = 0;          // of the expected results
    std::size_t differ = 0;        // rays that hit something else than expected
    std::size_t not_identical = 0; // rays with any bit that is not as expected, those above included
    float t_error = 0;             // the largest among rays that hit the same, in R
    float shading_error = 0;       // the same of colours, coverage and normals, in codes of 255
    std::string first_difference;  // in words
};

// results: of shaders/trace_ray.h. Rays hit the same if both or neither hit, on the same layer, side and
// face, with places at most 1e-5 R apart. Rays with SPA_ANY_HIT need only both hit or not.
Agreement agreement_of(std::span<const TestRay> rays, std::span<const std::uint32_t> expected,
                       std::span<const std::uint32_t> results);

// One line.
std::string summary(const Agreement& agreement);

} // namespace spa::test
