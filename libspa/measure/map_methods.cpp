// SPDX-License-Identifier: Apache-2.0
#include "trace_methods.h"

#include "../core/error.h"
#include "../trace/trace.h"

namespace spa::measure {
namespace {

class ProjectiveMethod final : public TraceMethod {
public:
    ProjectiveMethod(const Part& part, std::uint32_t most_layers) : map_(part, {most_layers, true}) {
        bytes = map_.projective_bytes();
    }

    [[nodiscard]] bool has_stream() const override { return true; }
    [[nodiscard]] std::string call_name(RaySet set, CallKind kind) const override {
        if (asks_occlusion(set)) return "occluded";
        return kind == CallKind::single ? "closest_hit" : "closest_hits";
    }

    void trace(RayBatch& batch, CallKind kind, std::size_t begin, std::size_t end) const override {
        const auto rays = batch.rays().subspan(begin, end - begin);
        const std::span hits = std::span(batch.hits).subspan(begin, end - begin);
        const std::span blocked = std::span(batch.blocked).subspan(begin, end - begin);
        if (kind == CallKind::stream) {
            if (batch.occlusion())
                trace::occluded(map_, rays, trace::no_flags, blocked);
            else
                trace::closest_hits(map_, rays, trace::no_flags, hits);
        } else if (batch.occlusion()) {
            for (std::size_t i = 0; i < rays.size(); ++i)
                blocked[i] = trace::occluded(map_, rays[i], trace::no_flags) ? 1 : 0;
        } else {
            for (std::size_t i = 0; i < rays.size(); ++i)
                trace::closest_hit(map_, rays[i], trace::no_flags, hits[i]);
        }
    }

    [[nodiscard]] std::vector<RayAnswer> answers(RayBatch& batch, CallKind) const override {
        std::vector<RayAnswer> answers;
        answers.reserve(batch.hits.size());
        for (const trace::Hit& hit : batch.hits) answers.push_back(answer_of(hit));
        return answers;
    }

private:
    trace::TraceMap map_;
};

} // namespace

const char* name(Family family) {
    switch (family) {
    case Family::fan: return "fan";
    case Family::march: return "march";
    case Family::projective: return "projective";
    case Family::mesh: return "mesh";
    case Family::lod: return "lod";
    case Family::surface: break;
    }
    return "surface";
}

RayBatch::RayBatch(RaySet set, std::vector<trace::Ray> rays)
    : hits(rays.size()), blocked(rays.size()), set_(set), rays_(std::move(rays)) {}

trace::EmbreeRays& RayBatch::embree(trace::EmbreeCall call) {
    const auto found = embree_.find(call);
    if (found != embree_.end()) return found->second;
    return embree_.emplace(call, trace::EmbreeRays(call, rays_)).first->second;
}

std::unique_ptr<TraceMethod> map_method(Family family, const Part& part, std::uint32_t layers,
                                        std::uint32_t tests) {
    std::unique_ptr<TraceMethod> method;
    if (family == Family::projective)
        method = std::make_unique<ProjectiveMethod>(part, layers);
    else
        throw Error(ExitCode::internal, "there is no such tracer");
    method->family = family;
    method->cells = part.layers.front().outer.depth.width - 1;
    method->layers = layers;
    method->tests = tests;
    return method;
}

} // namespace spa::measure
