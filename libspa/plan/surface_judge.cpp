// SPDX-License-Identifier: Apache-2.0
#include "surface_judge.h"

#include "../bake/center.h"
#include "../bake/shading.h"
#include "../measure/map_surface.h"
#include "../measure/source_radius.h"
#include "../measure/surface_samples.h"
#include "../trace/triangle_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace spa::plan {
namespace {

constexpr std::size_t first_points = 2'500; // of the first stage; each stage takes four times as many

measure::MapSurface surface_of_map(const Part& part) {
    measure::MapSurface result;
    std::vector<double> depth;
    for (const Layer& layer : part.layers) {
        for (const Surface* s : {&layer.outer, &layer.inner}) {
            if (s->empty()) continue;
            depth.clear();
            for (std::uint32_t y = 0; y < s->depth.height; ++y)
                for (std::uint32_t x = 0; x < s->depth.width; ++x)
                    depth.push_back(double(decode_depth(s->depth.format, s->depth.at(x, y))));
            measure::append_surface({part.mapping, s->depth.width, s->depth.height}, depth, part.frame,
                                    result);
        }
    }
    return result;
}

// Neighbours in the list are neighbours on the surface: steps of a share of the list, prime to its length,
// make its first points stand for all of it.
std::vector<std::size_t> spread_order(std::size_t count) {
    auto step = std::size_t(double(count) * 0.6180339887498949);
    while (step > 1 && std::gcd(step, count) != 1) --step;
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i * std::max<std::size_t>(step, 1) % count;
    return order;
}

} // namespace

SurfaceJudge::SurfaceJudge(const Model& model, const SurfaceJudgeOptions& options) : options_(options) {
    const std::vector<measure::SurfaceSample> samples =
        measure::sample_surface(model.positions, model.triangles, options.points);
    // Where alpha leaves nothing there is no surface; the shader asks for some centre.
    const bake::CenteredModel centered =
        bake::center_model(model, {Vec3d{}, Mat3{}, measure::radius_about(model, Vec3d{}, Mat3{})});
    const bake::Shader shader(centered);
    points_.reserve(samples.size());
    for (const std::size_t i : spread_order(samples.size())) {
        const measure::SurfaceSample& s = samples[i];
        if (!shader.needs_alpha(s.triangle) || shader.color(s.triangle, s.barycentric, 0).visible)
            points_.push_back(s.position);
    }
}

Estimate SurfaceJudge::judge(const Part& part, double target) const {
    const measure::MapSurface surface = surface_of_map(part);
    const trace::TriangleScene scene(surface.positions, surface.triangles);
    const double scale = options_.unit > 0 ? part.radius / options_.unit : 1;
    const double quantum = depth_quantum_error(part.layers.front().outer.depth.format) * scale;
    std::vector<double> distances;
    Estimate estimate;
    for (std::size_t end = first_points; distances.size() < points_.size(); end *= 4) {
        const std::size_t begin = distances.size();
        distances.resize(std::min(end, points_.size()));
        tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, distances.size(), 256),
                          [&](const auto& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  const Vec3d p = (points_[i] - part.center) * (1 / part.radius);
                                  distances[i] = scene.closest_point(p).distance * scale;
                              }
                          });
        if (options_.metric == Metric::p95_surface) {
            estimate = estimate_quantile(distances, 0.95);
            if (estimate.high <= target) break;
        } else {
            // Every further point can only be worse.
            estimate.low = estimate.value = *std::max_element(distances.begin(), distances.end());
            estimate.high = distances.size() == points_.size() ? estimate.value : estimate.high;
        }
        if (estimate.low > target) break;
    }
    estimate.samples = distances.size();
    estimate.value = std::max(estimate.value, quantum);
    estimate.high = std::max(estimate.high, quantum);
    return estimate;
}

} // namespace spa::plan
