// SPDX-License-Identifier: Apache-2.0
#include "error_parts.h"

#include "outermost_surface.h"

#include "../trace/triangle_scene.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace spa::measure {

bake::OwnedMap bake_octahedral(const Model& model, std::uint32_t cells, std::uint32_t layers,
                               ElementFormat depth) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = layers;
    options.depth = depth;
    return bake::bake_model(model, options).map;
}

std::vector<RayAnswer> ErrorPartsMeter::trace_baked(std::uint32_t cells, std::uint32_t layers,
                                                    ElementFormat depth) const {
    const bake::OwnedMap map = bake_octahedral(model_, cells, layers, depth);
    const auto method = map_method(Family::projective, map.map.parts.front(), layers, 0);
    return answers_of(*method, batch_);
}

// What rays meet on the stored surface itself; empty where that is no mesh.
std::vector<RayAnswer> ErrorPartsMeter::judge(const TraceMethod& method) const {
    if (method.layers != 1) return {};
    const bake::OwnedMap map = bake_octahedral(model_, method.cells, method.layers, ElementFormat::u16);
    const Part& part = map.map.parts.front();
    if (trace::TraceMap(part, {1, false}).map().cells != 0) return {}; // some triangle is mixed
    const MapSurface surface = outermost_surface(part);
    const trace::TriangleScene scene(surface.positions, surface.triangles);
    const std::span<const trace::Ray> rays = batch_.rays();
    Answers answers(rays.size());
    tbb::parallel_for(std::size_t(0), answers.size(), [&](std::size_t i) {
        trace::TriangleHit hit;
        if (scene.closest_hit(rays[i].origin, rays[i].direction, rays[i].t_max, hit)) answers[i].t = hit.t;
    });
    return answers;
}

ErrorParts ErrorPartsMeter::measure(const TraceMethod& method) {
    Answers& ideal = ideal_[method.layers];
    if (ideal.empty()) ideal = trace_baked(ideal_cells, method.layers, ElementFormat::f32);
    const Answers exact = trace_baked(method.cells, method.layers, ElementFormat::f32);
    const Answers traced = answers_of(method, batch_);
    const Answers judged = judge(method);
    ErrorParts parts;
    double count = 0, solver = 0;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
        if (!truth_[i].hits() || !ideal[i].hits() || !exact[i].hits() || !traced[i].hits()) continue;
        if (!judged.empty() && !judged[i].hits()) continue;
        const double unit = length(to_double(batch_.rays()[i].direction));
        const auto distance = [&](const RayAnswer& a, const RayAnswer& b) {
            return std::abs(double(a.t) - double(b.t)) * unit;
        };
        count += 1;
        parts.star += distance(truth_[i], ideal[i]);
        parts.resolution += distance(ideal[i], exact[i]);
        parts.quantization += distance(exact[i], traced[i]);
        parts.total += distance(truth_[i], traced[i]);
        if (!judged.empty()) solver += distance(judged[i], traced[i]);
    }
    if (count == 0) return parts;
    for (double* const part : {&parts.star, &parts.resolution, &parts.quantization, &parts.total})
        *part /= count;
    if (!judged.empty()) parts.solver = solver / count;
    return parts;
}

} // namespace spa::measure
