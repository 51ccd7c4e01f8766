// SPDX-License-Identifier: Apache-2.0
#include "pairing.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace spa::bake {
namespace {

// The shell's normals face away from it on both sides, whichever way the triangle is wound.
Interval thin_shell(const Crossing& crossing) {
    Interval shell;
    shell.outer = surface_point(crossing, !crossing.front_facing);
    shell.inner = surface_point(crossing, crossing.front_facing);
    shell.inner.placed = true;
    // Half the radius if the shell is at the centre: the inner end must stay a surface.
    shell.inner.radius = std::max(crossing.radius - shell_thickness, crossing.radius / 2);
    return shell;
}

} // namespace

SurfacePoint surface_point(const Crossing& crossing, bool turn) {
    return {crossing.radius, crossing.triangle, turn ? -crossing.normal : crossing.normal, crossing.color,
            false};
}

std::span<const Interval> Pairing::operator()(std::span<const Crossing> crossings, bool& thin) {
    intervals_.clear();
    open_.clear();
    thin = false;
    std::array<float, 2> last{2, 2}; // radius of what entered last, and of what left
    for (const Crossing& crossing : crossings) {
        const std::uint32_t component = components_.of_triangle[crossing.triangle];
        const bool enters = crossing.front_facing != is_flipped(crossing);
        // Through an edge between faces that are wound against each other.
        if (!components_.turned.empty() && last[enters ? 0 : 1] - crossing.radius < merge_distance) continue;
        last[enters ? 0 : 1] = crossing.radius;
        if (enters) {
            open_.push_back(&crossing);
            continue;
        }
        const auto entry = std::find_if(open_.rbegin(), open_.rend(), [&](const Crossing* c) {
            return components_.of_triangle[c->triangle] == component;
        });
        if (entry == open_.rend()) {
            intervals_.push_back(thin_shell(crossing));
            thin = true;
        } else {
            intervals_.push_back(
                {surface_point(**entry, is_flipped(**entry)), surface_point(crossing, is_flipped(crossing))});
            open_.erase(std::next(entry).base());
        }
    }
    for (const Crossing* crossing : open_) {
        const std::uint32_t component = components_.of_triangle[crossing->triangle];
        if (orientation_.solid[component]) {
            intervals_.push_back({surface_point(*crossing, is_flipped(*crossing)), {}});
        } else {
            intervals_.push_back(thin_shell(*crossing));
            thin = true;
        }
    }
    unite();
    return intervals_;
}

bool Pairing::is_flipped(const Crossing& crossing) const {
    return orientation_.flipped[components_.of_triangle[crossing.triangle]] !=
           components_.is_turned(crossing.triangle);
}

void Pairing::unite() {
    std::stable_sort(intervals_.begin(), intervals_.end(),
                     [](const Interval& a, const Interval& b) { return a.outer.radius > b.outer.radius; });
    std::size_t count = 0;
    for (const Interval& next : intervals_) {
        if (count == 0 || next.outer.radius < intervals_[count - 1].inner.radius - merge_distance) {
            intervals_[count++] = next;
        } else if (next.inner.radius < intervals_[count - 1].inner.radius) {
            intervals_[count - 1].inner = next.inner;
        }
    }
    intervals_.resize(count);
}

} // namespace spa::bake
