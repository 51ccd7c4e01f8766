// SPDX-License-Identifier: Apache-2.0
// Rays that are hard to trace, by class, at random.
#pragma once

#include "judge_samples.h"

#include "../../libspa/core/folds.h"
#include "../../libspa/trace/ray.h"

#include <cstdint>
#include <random>
#include <vector>

namespace spa::test {

enum class RayClass : unsigned {
    center,        // through the centre, exactly or nearly
    sample,        // through a stored sample's point
    axis,          // along an axis, with zeros of both signs
    plane,         // in a coordinate plane
    diagonal,      // in the planes x = y, ..., in those of the cells' borders and diagonals
    octant_border, // through a point of the surface on a coordinate plane
    map_border,    // ... where the map's border is identified with itself
    corner,        // through a corner of the octahedron
    chord,         // from anywhere to anywhere
    tangent,       // touching the sphere, or the surface at a sample
    limits,        // with limits of t that cut the solid, and origins within it
    fold,          // through a point where a fold record ends a surface, or in the plane of two; else a chord
};
constexpr unsigned ray_class_count = 12;
const char* name(RayClass kind);

class RayMaker {
public:
    RayMaker(const Part& part, std::uint64_t seed)
        : samples_(part, 0), folds_(decode_folds(part.folds)), random_(seed) {}

    // The direction's length is between 1e-6 and 1e6.
    trace::Ray make(RayClass kind);
    // TraceFlags, mostly none.
    std::uint32_t flags();

private:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    std::uint32_t below(std::uint32_t count) {
        return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
    }
    bool chance(double share) { return uniform(0, 1) < share; }
    Vec3d direction();
    Vec3d outside() { return direction() * uniform(1.01, chance(0.2) ? 4 : 2); }
    // A point on one of the ends at a sample; anywhere on its line if there is no interval.
    Vec3d stored_point(TexelIndex at);
    TexelIndex any_sample() { return {below(samples_.cells() + 1), below(samples_.cells() + 1)}; }
    // Between two neighbouring samples, which differ by (dx, dy).
    Vec3d between(TexelIndex at, std::uint32_t dx, std::uint32_t dy);
    trace::Ray through(Vec3d from, Vec3d target);
    trace::Ray in_plane(Vec3d a, Vec3d b);
    trace::Ray diagonal();
    trace::Ray tangent();
    // Where a record ends a surface.
    Vec3d cut_point(const FoldRecord& record);
    trace::Ray fold();

    StoredSamples samples_;
    std::vector<FoldRecord> folds_;
    std::mt19937_64 random_;
};

} // namespace spa::test
