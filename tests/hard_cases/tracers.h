// SPDX-License-Identifier: Apache-2.0
// One ray by every tracer, for the named cases.
#pragma once

#include "maps.h"
#include "verdict.h"

#include "../../libspa/trace/trace_map.h"

#include <cstdint>
#include <vector>

namespace spa::test {

// A part made ready for all of them.
class Subject {
public:
    explicit Subject(OwnedPart owned);

    [[nodiscard]] const Part& part() const { return owned_.part; }
    [[nodiscard]] const trace::TraceMap& map() const { return map_; }
    [[nodiscard]] const Judge& judge() const { return judge_; }

    // By the projective trace. Expects of every ray that single and stream are equal to the bit, that
    // occlusion says the same, and that the judge finds nothing wrong.
    [[nodiscard]] trace::Hit hit(const trace::Ray& ray, std::uint32_t flags = 0) const;
    // Every hit along the ray, with t_min moved just past each.
    [[nodiscard]] std::vector<trace::Hit> all_hits(trace::Ray ray) const;
    // By the paper's trace with 200 test rays, and by marching with 200 steps. Expects finite records within
    // the limits of t.
    [[nodiscard]] trace::Hit fan(const trace::Ray& ray, std::uint32_t flags = 0) const;
    [[nodiscard]] trace::Hit march(const trace::Ray& ray, std::uint32_t flags = 0) const;

private:
    OwnedPart owned_;
    trace::TraceMap map_;
    Judge judge_;
};

trace::Hit fan(const trace::TraceMap& map, const trace::Ray& ray, std::uint32_t flags = 0);
trace::Hit march(const trace::TraceMap& map, const trace::Ray& ray, std::uint32_t flags = 0);

// A star-shaped solid r(u); every interval reaches the centre.
OwnedPart star(std::uint32_t cells, double (*radius)(Vec3d u), ElementFormat depth = ElementFormat::f32);
double round_radius(Vec3d u); // 0.75
double bumpy_radius(Vec3d u); // about 0.7, smooth
double cliff_radius(Vec3d u); // 0.9 where x > 0.1, else 0.5

constexpr float unlimited = std::numeric_limits<float>::infinity();
// From `from` towards `target`, t = 1 there.
trace::Ray ray_through(Vec3d from, Vec3d target);
// Directions all over the sphere.
std::vector<Vec3d> directions(std::uint32_t count);
Vec3d point_at(const trace::Ray& ray, const trace::Hit& hit);

} // namespace spa::test
