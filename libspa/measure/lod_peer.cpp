// SPDX-License-Identifier: Apache-2.0
#include "lod_peer.h"

#include "bench_trace.h"
#include "ray_truth.h"
#include "trace_methods.h"

#include "../bake/center.h"
#include "../trace/triangle_scene.h"

#include <vector>

namespace spa::measure {
namespace {

constexpr std::uint32_t rays = 20000;
constexpr std::uint64_t seed = 5;

} // namespace

LodPeer lod_peer(const Model& model, const Part& part) {
    const PartFrame frame{part.center, Mat3{}, part.radius};
    const bake::CenteredModel centered = bake::center_model(model, frame);
    const trace::TriangleScene scene(centered.positions, model.triangles);
    RayBatch batch(RaySet::chords,
                   make_rays(RaySet::chords, rays, seed, centered.positions, model.triangles));
    const std::vector<RayAnswer> truth = RayTruth(centered, scene).trace(batch.rays());
    const std::vector<std::uint8_t> no_band(batch.rays().size());
    const auto error_of = [&](TraceMethod& method) {
        method.prepare(batch);
        return compare_answers(batch.rays(), truth, answers_of(method, batch), no_band).distance;
    };

    LodPeer result;
    const Distribution map =
        error_of(*map_method(Family::projective, part, std::uint32_t(part.layers.size()), 0));
    result.map_mean = map.mean;
    result.map_median = map.median;
    std::vector<double> targets = default_lod_errors();
    for (double& target : targets) target *= part.radius;
    for (const Lod& lod : simplify(model.positions, model.normals, model.triangles, targets)) {
        if (lod.triangles.empty() || (result.by_mean && result.by_median)) continue;
        std::vector<Vec3f> positions;
        for (const Vec3f& p : lod.positions)
            positions.push_back(to_float((to_double(p) - part.center) * (1 / part.radius)));
        double build_seconds = 0;
        const auto method = triangle_method(Family::lod, positions, {}, lod.triangles, false, build_seconds);
        const Distribution error = error_of(*method);
        if (!result.by_mean && error.mean <= map.mean)
            result.by_mean = MeasuredLod{lod, error.mean, error.median};
        if (!result.by_median && error.median <= map.median)
            result.by_median = MeasuredLod{lod, error.mean, error.median};
    }
    return result;
}

} // namespace spa::measure
