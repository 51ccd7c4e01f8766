// SPDX-License-Identifier: Apache-2.0
// How far what rays meet in a stand-in (a map, a simplified mesh) is from what they meet in the model itself.
// Nothing here traces: whoever traced gives the answers, ray_truth.h the model's. What the figures mean:
// ../../docs/measures.md, "Rays".
#pragma once

#include "statistics.h"

#include "../core/vector.h"
#include "../trace/ray.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace spa::measure {

// What one ray meets first.
struct RayAnswer {
    float t = std::numeric_limits<float>::infinity(); // of the ray as given; infinity: nothing
    Vec3f normal;                                     // out of the solid, of any length; zero: not known
    std::array<std::uint8_t, 4> color{};              // sRGB, straight alpha; alpha 0: not known

    [[nodiscard]] bool hits() const { return t < std::numeric_limits<float>::infinity(); }
};

// A tracer's own record as an answer, without a colour.
inline RayAnswer answer_of(const trace::Hit& hit) { return {hit.t, hit.normal, {}}; }

// Rays by what the model and the stand-in say.
struct Confusion {
    std::uint64_t both = 0;    // both are hit
    std::uint64_t neither = 0; // none is
    std::uint64_t missed = 0;  // the model alone is hit
    std::uint64_t extra = 0;   // the stand-in alone is

    [[nodiscard]] std::uint64_t rays() const { return both + neither + missed + extra; }
};

struct RayErrors {
    Confusion band;        // rays that pass a silhouette (ray_truth.h, silhouette_band)
    Confusion interior;    // all others
    Distribution distance; // |dt| along rays that hit both, in units of length of the rays' space
    // The same of rays that pass no silhouette.
    Distribution interior_distance;
    Distribution normal; // angle between normals that are both known, degrees
    Distribution color;  // mean |difference| of red, green and blue where both are known, codes of 255

    [[nodiscard]] std::uint64_t rays() const { return band.rays() + interior.rays(); }
};

// One entry a ray in each. All in one space: the distances are in its unit, and normals are compared as they
// are. in_band: not 0 for rays that pass a silhouette; empty: none does. O(rays).
RayErrors compare_answers(std::span<const trace::Ray> rays, std::span<const RayAnswer> truth,
                          std::span<const RayAnswer> answers, std::span<const std::uint8_t> in_band);

// Hit or miss alone, as shadow rays ask: blocked[i] is not 0 where ray i meets something.
RayErrors compare_occlusion(std::span<const RayAnswer> truth, std::span<const std::uint8_t> blocked,
                            std::span<const std::uint8_t> in_band);

} // namespace spa::measure
