// SPDX-License-Identifier: Apache-2.0
#include "render_report.h"

#include "render_plan_report.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>
#include <utility>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t label_width = 12;

std::string line(const std::string& label, const std::string& text) {
    return pad_right(label, label_width) + text + "\n";
}

struct Counts {
    std::uint64_t triangles = 0, replaced = 0; // all; those that maps take the place of
};

Counts count_triangles(const RenderFacts& facts) {
    const Scene& scene = facts.scene;
    std::vector<bool> replaced(scene.nodes.size(), false);
    for (const PlacedMap& map : facts.maps) {
        if (map.replaces_scene())
            replaced.assign(replaced.size(), true);
        else
            for (const std::uint32_t node : map.nodes) replaced[node] = true;
    }
    // Whether a map takes the place of a node or of one above it.
    const auto is_replaced = [&](std::uint32_t node) {
        for (; node != no_index; node = scene.nodes[node].parent)
            if (replaced[node]) return true;
        return false;
    };
    std::vector<bool> below(scene.nodes.size());
    for (std::uint32_t node = 0; node < scene.nodes.size(); ++node) below[node] = is_replaced(node);
    return {scene.triangle_nodes.size(),
            std::uint64_t(std::count_if(scene.triangle_nodes.begin(), scene.triangle_nodes.end(),
                                        [&](std::uint32_t node) { return below[node]; }))};
}

double rate(std::uint64_t rays, double seconds) { return seconds > 0 ? double(rays) / seconds : 0; }

Json settings_json(const RenderFacts& facts) {
    const render::Settings& settings = facts.settings;
    Json test_rays = settings.tracing.count;
    if (facts.arguments.by_distance) test_rays = "by-distance";
    return {
        {"width", settings.width},
        {"height", settings.height},
        {"camera", settings.camera.name},
        {"vertical_fov", settings.camera.vertical_fov * 180 / std::numbers::pi},
        {"samples", settings.samples},
        {"antialias", settings.antialias},
        {"seed", settings.seed},
        {"reference", facts.arguments.reference},
        {"primary", name(settings.primary)},
        {"shadow", name(settings.shadow)},
        {"secondary", name(settings.secondary)},
        {"method", name(facts.arguments.method)},
        {"test_rays", test_rays},
        {"layers", facts.arguments.layers == 0 ? Json(nullptr) : Json(facts.arguments.layers)},
        {"backend", name(settings.backend)},
        {"exposure", facts.arguments.exposure},
    };
}

Json scene_json(const RenderFacts& facts) {
    const Counts counts = count_triangles(facts);
    Json maps = Json::array();
    for (const PlacedMap& map : facts.maps)
        maps.push_back({{"node", map.replaces_scene() ? Json(nullptr) : Json(map.node)},
                        {"file", map.file.name},
                        {"parts", map.file.map().parts.size()},
                        {"places", map.nodes.size()}});
    return {{"path", facts.arguments.scene.string()},
            {"triangles", counts.triangles},
            {"replaced_triangles", counts.replaced},
            {"nodes", facts.scene.nodes.size()},
            {"cameras", facts.scene.cameras.size()},
            {"lights", facts.scene.lights.size()},
            {"maps", maps}};
}

Json animation_json(const RenderFacts& facts) {
    if (!facts.animation) return nullptr;
    const Animation& animation = facts.scene.rig.animations[*facts.animation];
    return {{"index", *facts.animation},
            {"name", animation.name},
            {"seconds", animation.seconds},
            {"time", facts.arguments.frames == 0 ? Json(facts.arguments.time.value_or(0)) : Json(nullptr)},
            {"frames", frames_json(facts.frames)}};
}

std::string animation_text(const RenderFacts& facts) {
    if (!facts.animation) return "";
    const Animation& animation = facts.scene.rig.animations[*facts.animation];
    std::string text = (animation.name.empty() ? std::to_string(*facts.animation) : animation.name) + ", " +
                       significant(animation.seconds, 4) + " s";
    text += facts.arguments.frames == 0
                ? ", at " + significant(facts.arguments.time.value_or(0), 4) + " s"
                : ", " + std::to_string(facts.arguments.frames) + " frames evenly over it";
    return line("animation", text) + frames_text(facts.frames, label_width);
}

Json rays_json(const render::FrameTimes& times) {
    const std::uint64_t all = times.primary_rays + times.secondary_rays + times.shadow_rays;
    const auto figures = [](std::uint64_t count, double seconds) {
        return Json{{"count", count}, {"per_second", rate(count, seconds)}};
    };
    return {{"primary", figures(times.primary_rays, times.primary)},
            {"secondary", figures(times.secondary_rays, times.secondary)},
            {"shadow", {{"count", times.shadow_rays}}},
            {"all", figures(all, times.primary + times.secondary)}};
}

std::string seconds_text(double seconds) { return significant(seconds, 3) + " s"; }

std::string rays_text(const char* what, std::uint64_t rays, double seconds) {
    return std::to_string(rays) + " " + what + " in " + seconds_text(seconds) + ", " +
           significant(rate(rays, seconds) / 1e6, 3) + " million a second";
}

std::string geometry_text(const RenderFacts& facts) {
    const render::Settings& settings = facts.settings;
    if (facts.maps.empty() && facts.arguments.plan.empty()) return "triangles";
    std::string text = std::string("primary ") + name(settings.primary) + ", shadow " +
                       name(settings.shadow) + ", secondary " + name(settings.secondary) + "; maps by " +
                       name(facts.arguments.method);
    if (facts.arguments.by_distance) return text + ", test rays by distance";
    if (facts.arguments.method == MapMethod::fan)
        return text + ", " + std::to_string(settings.tracing.count) + " test rays";
    if (facts.arguments.method == MapMethod::march)
        return text + ", " + std::to_string(settings.tracing.count) + " steps";
    return text;
}

std::string memory_text(const RenderFacts& facts) {
    const render::SceneMemory& m = facts.memory;
    std::string text =
        line("memory", byte_count(m.triangles) + " triangles, " + byte_count(m.triangle_structures) +
                           " their acceleration structures");
    if (m.replaced_triangles != 0)
        text += line("", byte_count(m.replaced_triangles) + " triangles that maps replace, " +
                             byte_count(m.replaced_structures) + " their acceleration structures");
    if (m.maps != 0)
        text += line("", byte_count(m.maps) + " maps, " + byte_count(m.map_structures) +
                             " their acceleration structures");
    return text;
}

std::string times_text(const RenderFacts& facts) {
    const render::SceneTimes& times = facts.scene_times;
    std::string text = line(
        "time", seconds_text(facts.seconds) + ": reading " + seconds_text(facts.read_seconds) + ", upload " +
                    seconds_text(times.upload) + ", pipelines " + seconds_text(facts.frame_times.compile));
    return text + line("", "acceleration structures: triangles " + seconds_text(times.triangle_build) +
                               ", replaced " + seconds_text(times.replaced_build) + ", maps and their load " +
                               seconds_text(times.map_load) + ", top " + seconds_text(times.top_level));
}

} // namespace

Json report_json(const RenderFacts& facts) {
    const render::SceneMemory& memory = facts.memory;
    const render::SceneTimes& times = facts.scene_times;
    Json files = Json::array();
    for (const WrittenFile& file : facts.files) files.push_back({{"path", file.path}, {"bytes", file.bytes}});
    return {
        {"files", files},
        {"device",
         {{"name", facts.device.name}, {"driver", facts.device.driver}, {"software", facts.device.software}}},
        {"scene", scene_json(facts)},
        {"settings", settings_json(facts)},
        {"memory",
         {{"triangles", memory.triangles},
          {"triangle_structures", memory.triangle_structures},
          {"replaced_triangles", memory.replaced_triangles},
          {"replaced_structures", memory.replaced_structures},
          {"maps", memory.maps},
          {"map_structures", memory.map_structures},
          {"top_level", memory.top_level}}},
        {"times",
         {{"read", facts.read_seconds},
          {"upload", times.upload},
          {"triangle_build", times.triangle_build},
          {"replaced_build", times.replaced_build},
          {"map_load", times.map_load},
          {"top_level", times.top_level},
          {"compile", facts.frame_times.compile},
          {"primary", facts.frame_times.primary},
          {"secondary", facts.frame_times.secondary},
          {"all", facts.seconds}}},
        {"rays", rays_json(facts.frame_times)},
        {"animation", animation_json(facts)},
        {"comparison", facts.comparison ? comparison_json(*facts.comparison, facts.arguments.compare.string())
                                        : Json(nullptr)},
        {"plan", facts.plan ? plan_json(*facts.plan) : Json(nullptr)},
    };
}

std::string report_text(const RenderFacts& facts) {
    const render::Settings& settings = facts.settings;
    const render::FrameTimes& times = facts.frame_times;
    const Counts counts = count_triangles(facts);
    std::string text = facts.files.front().path + "\n";
    text += line("device", facts.device.name + ", " + facts.device.driver);
    text += line("scene", facts.arguments.scene.string() + ", " + std::to_string(counts.triangles) +
                              " triangles, " + std::to_string(facts.scene.lights.size()) +
                              (facts.scene.lights.size() == 1 ? " light" : " lights"));
    for (const PlacedMap& map : facts.maps)
        text += line("map",
                     map.file.name + " for " + (map.node.empty() ? "the whole scene" : map.node) +
                         (map.nodes.size() == 1 ? "" : ", " + std::to_string(map.nodes.size()) + " times"));
    if (counts.replaced != 0) text += line("", std::to_string(counts.replaced) + " triangles replaced");
    text +=
        line("picture", std::to_string(settings.width) + "x" + std::to_string(settings.height) + ", camera " +
                            (settings.camera.name.empty() ? "0" : settings.camera.name) + ", " +
                            std::to_string(settings.antialias) + " x " + std::to_string(settings.samples) +
                            " samples, seed " + std::to_string(settings.seed));
    text += line("rays meet", geometry_text(facts));
    text += line("rays", rays_text("primary", times.primary_rays, times.primary));
    text += line("", rays_text("secondary", times.secondary_rays, times.secondary));
    text += line("", std::to_string(times.shadow_rays) + " shadow, in the same times");
    text += memory_text(facts) + times_text(facts);
    text += animation_text(facts);
    if (facts.comparison)
        text += comparison_text(*facts.comparison, facts.arguments.compare.string(), label_width);
    if (facts.plan) text += plan_text(*facts.plan, label_width);
    for (std::size_t i = 0; i < facts.files.size(); ++i)
        text += line(i == 0 ? "wrote" : "", facts.files[i].path + ", " + byte_count(facts.files[i].bytes));
    return text;
}

Json devices_json(std::span<const render::DeviceEntry> devices) {
    Json list = Json::array();
    for (std::size_t i = 0; i < devices.size(); ++i)
        list.push_back({{"index", i},
                        {"name", devices[i].name},
                        {"driver", devices[i].driver},
                        {"software", devices[i].software},
                        {"missing", devices[i].missing}});
    return {{"devices", list}};
}

std::string devices_text(std::span<const render::DeviceEntry> devices) {
    std::string text;
    for (std::size_t i = 0; i < devices.size(); ++i)
        text +=
            std::to_string(i) + "  " + devices[i].name + ", " + devices[i].driver +
            (devices[i].software ? ", software" : "") + "\n   " +
            (devices[i].missing.empty() ? "traces rays" : "cannot trace rays: lacks " + devices[i].missing) +
            "\n";
    return text;
}

} // namespace spa::tools
