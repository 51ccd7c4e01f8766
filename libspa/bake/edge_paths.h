// SPDX-License-Identifier: Apache-2.0
// What becomes of the crossings at the two ends of an edge on the way along it. Source: ../../docs/layers.md,
// "Matching".
#pragma once

#include "surface_end.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::bake {

// A crossing at a point of an edge.
struct EdgeCrossing {
    SurfaceEnd end;
    bool inner = false; // of its interval: the solid lies outside of it
};

struct EdgePoint {
    double position = 0;                 // 0 and 1 are the ends
    Vec3d direction;                     // |g|_1 = 1
    std::vector<EdgeCrossing> crossings; // outermost first
};

// Both points have as many crossings, of the same sides, and each matches (ends_match). length: of the piece
// of the edge between them, in the octant's coordinates.
bool points_match(const EdgePoint& a, const EdgePoint& b, double length);

// Where a crossing of an end comes to.
struct EdgePath {
    enum class To : std::uint8_t {
        other_end, // a crossing of the other end
        same_end,  // back: it runs into another one of its own end
        nowhere,   // it ends alone
    };
    To to = To::nowhere;
    std::uint32_t index = 0; // of the crossing there
    // same_end: the farthest of the folds on the way; nowhere: where it ends.
    double position = 0;
    double w = 0; // there
};

// The paths of the crossings at end 0 and at end 1 of an edge with the given points in order, the ends among
// them. Between neighbouring points crossings are matched one to one where points_match says so, and else in
// order so that the sum is least of: by how much matches are off the planes (ends_differ); for two neighbours
// of opposite sides that run into each other, their distance in W; for one that ends alone, 20 W. A path
// follows matches, turns round where two crossings meet, and so on.
class EdgePaths {
public:
    // length: of the edge, in the octant's coordinates.
    EdgePaths(std::span<const EdgePoint> points, double length);

    // end: 0 or 1; one path a crossing.
    [[nodiscard]] const std::vector<EdgePath>& from(unsigned end) const { return paths_[end]; }

private:
    struct Link {
        EdgePath::To to = EdgePath::To::nowhere; // other_end: the next point; same_end: this point
        std::uint32_t index = 0;
    };
    using Links = std::vector<Link>; // of the crossings of one point, towards one side

    void align(const EdgePoint& a, const EdgePoint& b, double length, Links& from_a, Links& from_b);
    [[nodiscard]] EdgePath follow(unsigned end, std::uint32_t crossing) const;

    std::span<const EdgePoint> points_;
    std::array<std::vector<Links>, 2> links_; // of each point: towards end 1, towards end 0
    std::array<std::vector<EdgePath>, 2> paths_;
};

} // namespace spa::bake
