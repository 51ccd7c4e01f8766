// SPDX-License-Identifier: Apache-2.0
// From the crossings of one direction to its intervals of solid (intervals.h, pair_intervals).
#pragma once

#include "intervals.h"

#include <span>
#include <vector>

namespace spa::bake {

struct Interval {
    SurfacePoint outer;
    SurfacePoint inner; // radius 0: reaches the centre
};

// For one thread. Refers to components and orientation.
class Pairing {
public:
    Pairing(const Components& components, const Orientation& orientation)
        : components_(components), orientation_(orientation) {}

    // All intervals, outermost first, disjoint. crossings: outermost first. thin: whether a thin shell is
    // among them. Valid until the next call.
    std::span<const Interval> operator()(std::span<const Crossing> crossings, bool& thin);

private:
    // Its front faces into the solid.
    [[nodiscard]] bool is_flipped(const Crossing& crossing) const;
    void unite();

    const Components& components_;
    const Orientation& orientation_;
    std::vector<Interval> intervals_;
    std::vector<const Crossing*> open_;
};

// The crossing as a point of a surface. turn: the normal faces the other way.
SurfacePoint surface_point(const Crossing& crossing, bool turn);

} // namespace spa::bake
