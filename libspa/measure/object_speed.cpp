// SPDX-License-Identifier: Apache-2.0
#include "object_speed.h"

#include "method_set.h"
#include "stopwatch.h"
#include "trace_methods.h"

#include "../bake/center.h"
#include "../core/error.h"
#include "../trace/scene.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace spa::measure {
namespace {

RayBatch chords(std::uint32_t rays) {
    return {RaySet::chords, make_rays(RaySet::chords, rays, bench_seed, {}, {})};
}

RaySpeed fastest(TraceMethod& method, const SpeedOptions& options) {
    RayBatch batch = chords(options.rays);
    method.prepare(batch);
    RaySpeed speed{std::numeric_limits<double>::infinity(), method.bytes};
    for (unsigned run = 0; run < std::max(1U, options.runs); ++run)
        speed.ns = std::min(speed.ns, one_thread_ns(method, batch, usual_kind(method)));
    return speed;
}

// A sphere around all parts, in object space.
PartFrame around(const SphericalMap& map) {
    if (map.parts.size() == 1) return {map.parts[0].center, map.parts[0].frame, map.parts[0].radius};
    Vec3d center;
    for (const Part& part : map.parts) center = center + part.center * (1 / double(map.parts.size()));
    double radius = 0;
    for (const Part& part : map.parts) {
        // The columns' lengths bound what the frame does to a vector.
        double norm = 0;
        for (const Vec3d& row : part.frame.row) norm += dot(row, row);
        radius = std::max(radius, length(part.center - center) + part.radius * std::sqrt(norm));
    }
    return {center, Mat3{}, radius};
}

RaySpeed parts_speed(const SphericalMap& map, const SpeedOptions& options) {
    const PartFrame sphere = around(map);
    const double scale = 1 / sphere.radius;
    const Affine placed{{{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}}}, sphere.center * -scale};
    std::vector<trace::TraceMap> maps;
    maps.reserve(map.parts.size());
    trace::Scene scene;
    RaySpeed speed{std::numeric_limits<double>::infinity(), 0};
    for (const Part& part : map.parts) {
        maps.emplace_back(part, trace::CompileOptions{.layers = 0, .images = false});
        scene.add(maps.back(), part, placed);
        speed.bytes += maps.back().projective_bytes();
    }
    RayBatch batch = chords(options.rays);
    tbb::task_arena one_thread(1);
    one_thread.execute([&] {
        for (unsigned run = 0; run < std::max(1U, options.runs); ++run) {
            const double seconds =
                thread_seconds_of([&] { scene.closest_hits(batch.rays(), trace::no_flags, batch.hits); });
            speed.ns = std::min(speed.ns, seconds * 1e9 / double(options.rays));
        }
    });
    return speed;
}

} // namespace

RaySpeed map_speed(const SphericalMap& map, const SpeedOptions& options) {
    for (const Part& part : map.parts)
        if (part.mapping != Mapping::octahedral)
            throw Error(ExitCode::unsupported,
                        std::string("rays are traced through octahedral maps; this one is ") +
                            name(part.mapping));
    if (map.parts.size() > 1) return parts_speed(map, options);
    const Part& part = map.parts.front();
    return fastest(*map_method(Family::projective, part, std::uint32_t(part.layers.size()), 0), options);
}

RaySpeed triangle_speed(const Model& model, const SphericalMap& map, const SpeedOptions& options) {
    const bake::CenteredModel centered = bake::center_model(model, around(map));
    double build_seconds = 0;
    return fastest(
        *triangle_method(Family::mesh, centered.positions, {}, model.triangles, true, build_seconds),
        options);
}

} // namespace spa::measure
