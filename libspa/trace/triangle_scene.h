// SPDX-License-Identifier: Apache-2.0
// The triangle reference: rays and closest points against the triangles themselves, by Embree in its robust
// mode. What every measure of a map is judged against.
#pragma once

#include "../core/vector.h"
#include "../mesh/model.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace spa::trace {

struct TriangleHit {
    float t = 0;                // along the direction as given
    std::uint32_t triangle = 0; // index into the triangles
    bool front_facing = true;   // the ray comes from the triangle's front
};

struct ClosestPoint {
    Vec3d point;
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_index; // no_index: none within the given distance
};

// An immutable scene; queries are thread-safe. Embree computes in float, so the space of `positions` should
// be of the order of 1 around the origin.
class TriangleScene {
public:
    // `positions` and `triangles` outlive the scene. Builds on the threads of the caller's TBB arena.
    // O(n log n) time, about 100 bytes a triangle. Throws Error{internal} if Embree fails, as for lack of
    // memory.
    TriangleScene(std::span<const Vec3f> positions, std::span<const Triangle> triangles);
    ~TriangleScene();
    TriangleScene(TriangleScene&&) noexcept;
    TriangleScene& operator=(TriangleScene&&) noexcept;

    // The nearest hit with 0 < t < max_t; nothing is culled. False if there is none.
    bool closest_hit(Vec3f origin, Vec3f direction, float max_t, TriangleHit& hit) const;

    // Every hit with 0 < t < max_t, in no particular order; a ray through a shared edge may report each of
    // its triangles. Replaces the content of `hits`.
    void all_hits(Vec3f origin, Vec3f direction, float max_t, std::vector<TriangleHit>& hits) const;

    // The closest point on any triangle within max_distance, evaluated in double precision (closest_point.h:
    // triangles of no area count too). A good bound saves time.
    [[nodiscard]] ClosestPoint
    closest_point(Vec3d query, double max_distance = std::numeric_limits<double>::infinity()) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spa::trace
