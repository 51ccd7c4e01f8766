// SPDX-License-Identifier: Apache-2.0
// Which samples a triangle can cover: rectangles of the map that hold every one of them and few others.
// Folds, seams and poles are dealt with here, so that the rasteriser sees only rectangles.
#pragma once

#include "crossings.h"

#include <functional>
#include <span>
#include <vector>

namespace spa::bake {

// Inclusive.
struct SampleRect {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Immutable after construction; one serves all threads. O(vertices) time and memory (12 bytes each).
class Candidates {
public:
    // positions: normalised space, as in CenteredModel; outlives this object. Runs in the caller's arena.
    Candidates(const Grid& grid, const std::vector<Vec3f>& positions);

    static constexpr std::size_t max_rects = 8;
    // Fills rects and returns how many; every sample whose direction meets the triangle is in at least one.
    std::size_t find(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const;

private:
    struct Mapped {
        float x, y;           // position on the map, in samples
        std::uint32_t octant; // octahedral: sign bits x y z; `irregular` where the position has no meaning
    };
    std::size_t find_octahedral(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const;
    std::size_t find_clipped(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const;
    std::size_t find_latlong(const Triangle& triangle, std::span<SampleRect, max_rects> rects) const;
    double half_angle(double columns) const;
    double bulge(const Triangle& triangle, bool full, double half_longitudes) const;
    double wide_bulge(const Triangle& triangle, bool full) const;

    Grid grid_;
    const std::vector<Vec3f>* positions_;
    std::vector<Mapped> mapped_;
    double pad_; // covers the rounding of positions to float, and their error
};

} // namespace spa::bake
