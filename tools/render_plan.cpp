// SPDX-License-Identifier: Apache-2.0
#include "render_plan.h"

#include "map_source.h"
#include "one_size_maps.h"
#include "render_compare.h"
#include "render_pictures.h"

#include "../libspa/core/error.h"
#include "../libspa/mesh/node_model.h"

#include <algorithm>
#include <map>
#include <utility>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const Plan& plan, std::size_t object, const std::string& what) {
    throw Error(ExitCode::invalid_data,
                plan.path.string() + ": /objects/" + std::to_string(object) + " " + what);
}

void check_nodes(const Scene& scene, const RenderArguments& arguments, const Plan& plan) {
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        const PlanObject& object = plan.objects[i];
        const bool is_there = object.node < scene.nodes.size();
        if (!is_there || scene.nodes[object.node].name != object.name)
            refuse(plan, i,
                   "is node " + std::to_string(object.node) + " '" + object.name + "', and " +
                       arguments.scene.string() + " has " +
                       (is_there ? node_text(scene, object.node)
                                 : "only " + std::to_string(scene.nodes.size()) + " nodes") +
                       ": the plan was made for another scene; make it anew with spa plan");
        for (std::uint32_t at = scene.nodes[object.node].parent; at != no_index; at = scene.nodes[at].parent)
            if (plan.by_node.contains(at))
                refuse(plan, i,
                       "is " + node_text(scene, object.node) + ", which lies below " + node_text(scene, at) +
                           ", an object of its own");
    }
}

MapFile open_planned_map(const Scene& scene, const RenderArguments& arguments, const Plan& plan,
                         const PlanObject& object) {
    const fs::path folder = arguments.plan_maps.empty() ? folder_of_plan(plan.path) : arguments.plan_maps;
    const fs::path path = map_path(plan, object, folder, arguments.follow_links);
    std::error_code error;
    if (!fs::exists(path, error))
        throw Error(ExitCode::input_output,
                    path.string() + ": the map of " + node_text(scene, object.node) +
                        " is not there; run spa batch --from-plan " + plan.path.string() +
                        (arguments.plan_maps.empty() ? "" : " -o " + arguments.plan_maps.string()));
    MapFile file = open_map(path.string());
    const std::optional<std::uint32_t> node = source_node(file);
    if (node != object.node)
        throw Error(ExitCode::invalid_data, path.string() + ": was baked from " +
                                                (node ? "node " + std::to_string(*node) : "a whole asset") +
                                                ", and the plan has it for " + node_text(scene, object.node) +
                                                "; run spa batch --from-plan " + plan.path.string());
    return file;
}

// Of the nodes of those objects, and of nodes below them.
template <class Condition>
std::uint64_t count_triangles(const Scene& scene, const Plan& plan, const Condition& condition) {
    std::vector<bool> counts(scene.nodes.size()); // a node comes behind its parent
    for (const PlanObject& object : plan.objects) counts[object.node] = condition(object);
    for (std::size_t node = 0; node < counts.size(); ++node)
        if (scene.nodes[node].parent != no_index && counts[scene.nodes[node].parent]) counts[node] = true;
    return std::uint64_t(std::count_if(scene.triangle_nodes.begin(), scene.triangle_nodes.end(),
                                       [&](std::uint32_t node) { return counts[node]; }));
}

render::Settings with_triangles(render::Settings settings) {
    settings.primary = settings.shadow = settings.secondary = render::Geometry::triangles;
    return settings;
}

// The parts of a comparison that are the same for every variant.
class Comparison {
public:
    Comparison(const RenderArguments& arguments, const import::LinearPicture* reference)
        : exposure_(arguments.exposure),
          reference_(reference == nullptr ? nullptr : layer_of(*reference, "indirect")) {}

    // Triangles alone come first.
    void judge(const render::Frame& frame, PlanVariant& variant) {
        if (triangles_.empty())
            triangles_ = frame.indirect;
        else
            variant.to_triangles = errors(frame, triangles_);
        if (reference_ != nullptr) variant.to_reference = errors(frame, *reference_);
        variant.picture = beauty(frame);
        variant.indirect = frame.indirect;
    }

private:
    [[nodiscard]] measure::ImageErrors errors(const render::Frame& frame,
                                              const std::vector<Vec3f>& to) const {
        return measure::image_errors({frame.width, frame.height, frame.indirect},
                                     {frame.width, frame.height, to}, {.exposure = exposure_});
    }

    double exposure_;
    const std::vector<Vec3f>* reference_;
    std::vector<Vec3f> triangles_;
};

} // namespace

PlacedPlan place_plan(const Scene& scene, const RenderArguments& arguments, Plan plan) {
    PlacedPlan placed;
    placed.plan = std::move(plan);
    check_nodes(scene, arguments, placed.plan);
    placed.dropped_triangles = count_triangles(
        scene, placed.plan, [](const PlanObject& object) { return object.decision == PlanDecision::drop; });
    placed.unique_triangles =
        scene.model.triangles.size() - count_triangles(scene, placed.plan, [](const PlanObject& object) {
            return object.same_as.has_value();
        });
    std::map<std::uint32_t, std::size_t> map_of; // by the node that has it for its own
    for (const PlanObject& object : placed.plan.objects) {
        if (object.decision == PlanDecision::drop) placed.dropped.push_back(object.node);
        if (object.decision != PlanDecision::map) continue;
        const PlanObject& owner = placed.plan.owner_of_map(object);
        const auto [at, is_new] = map_of.emplace(owner.node, placed.maps.size());
        if (is_new) {
            placed.maps.push_back({owner.name, open_planned_map(scene, arguments, placed.plan, owner), {}});
            std::error_code ignored;
            placed.file_bytes += fs::file_size(placed.maps.back().file.name, ignored);
        }
        placed.maps[at->second].nodes.push_back(object.node);
    }
    return placed;
}

std::vector<std::string> plan_warnings(const PlacedPlan& placed, const RenderArguments& arguments) {
    std::vector<std::string> sentences = changed_sources(placed.plan, arguments.scene);
    const auto others =
        std::count_if(placed.plan.objects.begin(), placed.plan.objects.end(), [&](const PlanObject& object) {
            return object.decision == PlanDecision::map && object.method != name(arguments.method);
        });
    if (others > 0)
        sentences.push_back(placed.plan.path.string() + ": " + std::to_string(others) +
                            " objects are planned for another --method than " + name(arguments.method));
    return sentences;
}

void compare_plan(PlanFacts& facts, const RenderArguments& arguments, const render::Gpu& gpu,
                  const Scene& scene, const render::Settings& settings, const render::Frame& frame,
                  const import::LinearPicture* reference, const RenderVariant& draw) {
    const Plan& plan = facts.placed.plan;
    Comparison comparison(arguments, reference);
    PlanVariant& triangles = facts.triangles.emplace();
    {
        const render::DeviceScene on_device(gpu, scene, {}, true);
        const render::Frame alone =
            draw("triangles alone", on_device, with_triangles(settings), triangles.times);
        triangles.memory = on_device.memory();
        comparison.judge(alone, triangles);
    }
    comparison.judge(frame, facts.plan);

    const OneSizeMaps maps = bake_one_size(scene, plan, arguments.quiet);
    facts.bake_seconds = maps.seconds;
    facts.not_baked = maps.not_baked;
    PlanVariant& one_size = facts.one_size.emplace();
    std::vector<render::MapPlacement> all;
    for (const OneSizeMap& map : maps.maps) {
        one_size.file_bytes += map.file_bytes;
        for (const std::uint32_t node : map.nodes) all.push_back(placement(node, &map.map.map, arguments));
    }
    one_size.maps = maps.maps.size();
    for (const std::uint32_t node : facts.placed.dropped) all.push_back(placement(node, nullptr, arguments));
    const render::DeviceScene on_device(gpu, scene, all, arguments.uses_replaced_triangles());
    const render::Frame shown = draw("maps of one size", on_device, settings, one_size.times);
    one_size.memory = on_device.memory();
    comparison.judge(shown, one_size);
}

} // namespace spa::tools
