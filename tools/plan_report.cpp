// SPDX-License-Identifier: Apache-2.0
#include "plan_report.h"

#include "bake_settings.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using plan::ObjectPlan;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

// As seen from the plan's folder, or as it was given where no way leads there.
std::string scene_path(const PlanArguments& arguments) {
    std::error_code error;
    const auto folder = std::filesystem::absolute(arguments.output, error).parent_path();
    const auto relative = std::filesystem::absolute(arguments.scene, error)
                              .lexically_normal()
                              .lexically_relative(folder.lexically_normal());
    return error || relative.empty() ? arguments.scene.string() : relative.generic_string();
}

// A plain file name made from a node's.
std::string file_name(const ObjectPlan& object) {
    constexpr std::size_t longest = 80;
    std::string name;
    for (const char c : object.name.substr(0, longest)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '_' || (c == '.' && !name.empty());
        name += plain ? c : '_';
    }
    return name.empty() ? "node" : name;
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

// By node. Names that differ in the case of letters alone are one to some file systems.
std::map<std::uint32_t, std::string> map_paths(const ScenePlanFacts& facts) {
    const std::string folder = facts.arguments.output.stem().string() + ".maps/";
    std::map<std::uint32_t, std::string> paths;
    std::set<std::string> taken;
    for (const ObjectPlan& object : facts.plan.objects) {
        if (object.decision != plan::Decision::map || object.same_as != no_index) continue;
        std::string name = file_name(object);
        if (!taken.insert(lower(name)).second) {
            name += "-" + std::to_string(object.node);
            while (!taken.insert(lower(name)).second) name += "_";
        }
        paths[object.node] = folder + name + ".spa";
    }
    return paths;
}

Json settings_json(const plan::MapSettings& settings) {
    const bake::Options options = settings.options();
    return {{"size", size_text(options.grid)},  {"depth", name(options.depth)},
            {"normals", name(options.normals)}, {"color_size", size_text(options.color_grid)},
            {"layers", options.layers},         {"center", name(options.center)},
            {"frame", name(options.frame)}};
}

Json expected_json(const ObjectPlan& object) {
    if (!object.expected) return nullptr;
    const plan::Expected& expected = *object.expected;
    const bool map = object.decision == plan::Decision::map;
    return {{"bytes", expected.bytes},
            {"ns", map ? Json(expected.nanoseconds) : Json(nullptr)},
            {"error", map ? Json(expected.error) : Json(nullptr)},
            {"image_error", expected.image_error}};
}

Json object_json(const ObjectPlan& object, const std::map<std::uint32_t, std::string>& paths) {
    const plan::ObjectViews& views = object.views;
    const bool seen = views.rays > 0;
    const std::uint32_t owner = object.same_as == no_index ? object.node : object.same_as;
    const auto path = paths.find(owner);
    const bool map = object.decision == plan::Decision::map;
    return {{"node", object.node},
            {"name", object.name},
            {"same_as", object.same_as == no_index ? Json(nullptr) : Json(object.same_as)},
            {"triangles", object.triangles},
            {"bytes_triangles", object.bytes_triangles},
            {"radius", object.radius},
            {"captured", object.captured},
            {"star_shaped", object.star_shaped},
            {"views",
             {{"solid_angle_max", views.solid_angle_max},
              {"solid_angle_mean", views.solid_angle_mean},
              {"ray_share", views.ray_share},
              {"pixel_share", views.pixel_share},
              {"distance_median", seen ? Json(views.distance_median) : Json(nullptr)}}},
            {"tolerance", or_null(object.tolerance)},
            {"decision", name(object.decision)},
            {"settings", object.settings ? settings_json(*object.settings) : Json(nullptr)},
            {"method", "projective"},
            {"map", map && path != paths.end() ? Json(path->second) : Json(nullptr)},
            {"expected", expected_json(object)},
            {"why", object.why}};
}

Json totals_json(const plan::ScenePlan& plan) {
    return {{"bytes", plan.bytes},
            {"bytes_triangles", plan.bytes_triangles},
            {"image_error", plan.image_error},
            {"errors_together", plan.errors_together},
            {"image_error_deviation", plan.image_error_deviation},
            {"bytes_one_size", plan.bytes_one_size},
            {"image_error_one_size", plan.image_error_one_size},
            {"one_size_of_maps", plan.one_size_of_maps},
            {"bytes_one_size_of_maps", plan.bytes_one_size_of_maps},
            {"image_error_one_size_of_maps", plan.image_error_one_size_of_maps}};
}

std::uint64_t count(const plan::ScenePlan& plan, plan::Decision decision) {
    return std::uint64_t(
        std::count_if(plan.objects.begin(), plan.objects.end(),
                      [&](const ObjectPlan& object) { return object.decision == decision; }));
}

// Bytes that the plan spends on an object.
std::uint64_t bytes_of(const ObjectPlan& object) {
    return object.decision == plan::Decision::triangles ? object.bytes_triangles
           : object.expected                            ? object.expected->bytes
                                                        : 0;
}

std::string decision_text(const ObjectPlan& object) {
    if (!object.settings) return name(object.decision);
    return "map " + std::to_string(object.settings->size) + "x" + std::to_string(object.settings->layers);
}

} // namespace

Json scene_plan_json(const ScenePlanFacts& facts) {
    const PlanArguments& arguments = facts.arguments;
    const plan::PlanOptions& options = arguments.options;
    Json files = Json::array();
    for (const import::SourceFile& file : facts.source.files)
        files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"xxh3", hex64(file.xxh3)}});
    const bool by_default = !options.target_image_error && !options.budget_bytes;
    const std::map<std::uint32_t, std::string> paths = map_paths(facts);
    Json objects = Json::array();
    for (const ObjectPlan& object : facts.plan.objects) objects.push_back(object_json(object, paths));
    return {{"generator", {{"name", "spa"}, {"version", SPA_VERSION}}},
            {"scene", {{"path", scene_path(arguments)}, {"files", files}, {"triangles", facts.triangles}}},
            {"request",
             {{"camera", or_null(arguments.camera)},
              {"views", or_null(arguments.views)},
              {"samples", options.paths.samples},
              {"budget_bytes", or_null(options.budget_bytes)},
              {"target_image_error",
               by_default ? Json(plan::default_error) : or_null(options.target_image_error)}}},
            {"one_size", facts.plan.one_size},
            {"objects", objects},
            {"expected", totals_json(facts.plan)}};
}

Json plan_report_json(const ScenePlanFacts& facts) {
    const plan::ScenePlan& plan = facts.plan;
    return {
        {"plan", facts.arguments.output.string()},
        {"objects", plan.objects.size()},
        {"decisions",
         {{"map", count(plan, plan::Decision::map)},
          {"triangles", count(plan, plan::Decision::triangles)},
          {"drop", count(plan, plan::Decision::drop)}}},
        {"one_size", plan.one_size},
        {"expected", totals_json(plan)},
        {"meets", {{"target_image_error", plan.meets_error}, {"budget_bytes", plan.meets_budget}}},
        {"pixels", plan.pixels},
        {"secondary_rays", plan.secondary_rays},
        {"trial_maps", plan.trial_maps},
        {"seconds", {{"trace", plan.trace_seconds}, {"trials", plan.trial_seconds}, {"all", plan.seconds}}}};
}

std::string plan_report_text(const ScenePlanFacts& facts) {
    const plan::ScenePlan& plan = facts.plan;
    std::vector<const ObjectPlan*> order;
    for (const ObjectPlan& object : plan.objects) order.push_back(&object);
    std::stable_sort(order.begin(), order.end(),
                     [](const ObjectPlan* a, const ObjectPlan* b) { return bytes_of(*a) > bytes_of(*b); });
    std::size_t widest = 6;
    for (const ObjectPlan* object : order)
        widest = std::max(widest, std::min<std::size_t>(object->name.size(), 28));
    std::string text = pad_right("object", widest) +
                       "  triangles  rays %  tolerance  plan        bytes      of them as "
                       "triangles  image error  why\n";
    for (const ObjectPlan* object : order) {
        const double error = object->expected ? object->expected->image_error : 0;
        text += pad_right(object->name.substr(0, 28), widest) + "  " +
                pad_left(std::to_string(object->triangles), 9) + "  " +
                pad_left(fixed(object->views.ray_share * 100, 2), 6) + "  " +
                pad_left(object->tolerance ? significant(*object->tolerance, 2) : "-", 9) + "  " +
                pad_right(decision_text(*object), 10) + "  " + pad_left(byte_count(bytes_of(*object)), 10) +
                "  " + pad_left(byte_count(object->bytes_triangles), 20) + "  " +
                pad_left(significant(error, 2), 11) + "  " + object->why + "\n";
    }
    const auto line = [&text](const std::string& label, const std::string& value) {
        text += pad_right(label, 16) + value + "\n";
    };
    text += "\n";
    line("objects", std::to_string(plan.objects.size()) + ": " +
                        std::to_string(count(plan, plan::Decision::map)) + " as maps, " +
                        std::to_string(count(plan, plan::Decision::triangles)) + " as triangles, " +
                        std::to_string(count(plan, plan::Decision::drop)) + " dropped");
    line("the plan", byte_count(plan.bytes) + ", image error " + significant(plan.image_error, 2) + " +- " +
                         significant(plan.image_error_deviation, 1));
    line("all triangles", byte_count(plan.bytes_triangles));
    const auto one_size = [](std::uint32_t size, std::uint64_t bytes, double error) {
        return std::to_string(size) + " cells, " + byte_count(bytes) + ", image error " +
               significant(error, 2);
    };
    line("one size",
         one_size(plan.one_size_of_maps, plan.bytes_one_size_of_maps, plan.image_error_one_size_of_maps) +
             ", for what is a map in the plan");
    line("", one_size(plan.one_size, plan.bytes_one_size, plan.image_error_one_size) + ", for everything");
    line("looked at", std::to_string(plan.pixels) + " pixels, " + std::to_string(plan.secondary_rays) +
                          " secondary rays, " + std::to_string(plan.trial_maps) + " trial maps");
    line("time", fixed(plan.seconds, 1) + " s: rays " + fixed(plan.trace_seconds, 1) + " s, trials " +
                     fixed(plan.trial_seconds, 1) + " s");
    line("written", facts.arguments.output.string());
    return text;
}

} // namespace spa::tools
