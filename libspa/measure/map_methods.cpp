// SPDX-License-Identifier: Apache-2.0
#include "trace_methods.h"

#include "../core/element_format.h"
#include "../core/error.h"
#include "../trace/fan.h"
#include "../trace/march.h"
#include "../trace/shade.h"
#include "../trace/trace.h"

#include <cmath>

namespace spa::measure {
namespace {

class MapMethod : public TraceMethod {
public:
    MapMethod(const Part& part, std::uint32_t most_layers) : map_(part, {most_layers, true}) {}

    // Distances, and what is stored at their places.
    [[nodiscard]] std::vector<RayAnswer> answers(RayBatch& batch, CallKind) const override {
        std::vector<RayAnswer> answers;
        answers.reserve(batch.hits.size());
        for (const trace::Hit& hit : batch.hits) {
            RayAnswer answer = answer_of(hit);
            if (hit.valid()) {
                const trace::Shade shade = trace::shade(map_, hit);
                answer.normal = shade.normal;
                if (shade.has_color)
                    answer.color = {srgb_(shade.color.x), srgb_(shade.color.y), srgb_(shade.color.z), 255};
            }
            answers.push_back(answer);
        }
        return answers;
    }

protected:
    [[nodiscard]] const trace::TraceMap& map() const { return map_; }

private:
    trace::TraceMap map_;
    SrgbEncoder srgb_;
};

class ProjectiveMethod final : public MapMethod {
public:
    ProjectiveMethod(const Part& part, std::uint32_t most_layers) : MapMethod(part, most_layers) {
        bytes = map().projective_bytes();
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
                trace::occluded(map(), rays, trace::no_flags, blocked);
            else
                trace::closest_hits(map(), rays, trace::no_flags, hits);
        } else if (batch.occlusion()) {
            for (std::size_t i = 0; i < rays.size(); ++i)
                blocked[i] = trace::occluded(map(), rays[i], trace::no_flags) ? 1 : 0;
        } else {
            for (std::size_t i = 0; i < rays.size(); ++i)
                trace::closest_hit(map(), rays[i], trace::no_flags, hits[i]);
        }
    }
};

// Tracers of the outermost depths, a call a ray.
template <class Options,
          bool (*find)(const trace::TraceMap&, const trace::Ray&, const Options&, std::uint32_t, trace::Hit&)>
class DepthMethod final : public MapMethod {
public:
    DepthMethod(const Part& part, const Options& options, const char* call)
        : MapMethod(part, 1), options_(options), call_(call) {
        bytes = map().depth_bytes();
    }

    [[nodiscard]] bool has_stream() const override { return false; }
    [[nodiscard]] std::string call_name(RaySet, CallKind) const override { return call_; }

    void trace(RayBatch& batch, CallKind, std::size_t begin, std::size_t end) const override {
        for (std::size_t i = begin; i < end; ++i) {
            const bool hit = find(map(), batch.rays()[i], options_, trace::no_flags, batch.hits[i]);
            batch.blocked[i] = hit ? 1 : 0;
        }
    }

private:
    Options options_;
    const char* call_;
};

using FanMethod = DepthMethod<shader::SpaFan, trace::fan_hit>;
using MarchMethod = DepthMethod<shader::SpaMarch, trace::march_hit>;

constexpr std::uint32_t most_tests = 50; // where the distance from the centre says how many

shader::SpaFan fan_options(std::uint32_t tests) {
    shader::SpaFan options = shader::spa_fan_defaults();
    options.count = tests == 0 ? most_tests : tests;
    options.count_rule = tests == 0 ? SPA_FAN_BY_DISTANCE : SPA_FAN_FIXED;
    return options;
}

} // namespace

std::unique_ptr<TraceMethod> map_method(Family family, const Part& part, std::uint32_t layers,
                                        std::uint32_t tests) {
    std::unique_ptr<TraceMethod> method;
    if (family == Family::fan)
        method = std::make_unique<FanMethod>(part, fan_options(tests), "fan_hit");
    else if (family == Family::march)
        method = std::make_unique<MarchMethod>(part, shader::spa_march_defaults(), "march_hit");
    else
        method = std::make_unique<ProjectiveMethod>(part, layers);
    method->family = family;
    method->cells = part.mapping == Mapping::octahedral ? part.layers.front().outer.depth.width - 1 : 0;
    method->layers = layers;
    return method;
}

} // namespace spa::measure
