// SPDX-License-Identifier: Apache-2.0
#include "map_reports.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>

namespace spa::test {

namespace {

using Json = nlohmann::ordered_json;

Json unread(const std::string& name, const std::string& error) {
    return {{"name", name},        {"path", "maps/" + name},    {"error", error},      {"version", nullptr},
            {"bytes", nullptr},    {"shape", nullptr},          {"sections", nullptr}, {"source", nullptr},
            {"settings", nullptr}, {"warnings", Json::array()}, {"errors", nullptr},   {"speed", nullptr},
            {"search", nullptr}};
}

Json map(const std::string& name, std::size_t cells, std::size_t bytes) {
    Json result = unread(name, "");
    result["error"] = nullptr;
    result["version"] = "1.2";
    result["bytes"] = bytes;
    const std::string size = std::to_string(cells);
    result["shape"] = {{"parts", 1},
                       {"mapping", "octahedral"},
                       {"layers", 2},
                       {"samples", (cells + 1) * (cells + 1) * 3},
                       {"depth", {{"size", size}, {"format", "unorm16"}}},
                       {"color", {{"size", size}, {"format", "rgba8"}}},
                       {"normals", nullptr}};
    result["sections"] = {
        {{"type", "PART"}, {"count", 1}, {"stored_bytes", 192}, {"raw_bytes", 192}},
        {{"type", "DPTH"}, {"count", 3}, {"stored_bytes", bytes / 2}, {"raw_bytes", bytes * 2}}};
    result["source"] = {{"name", "boot.glb"},
                        {"bytes", bytes * 3},
                        {"triangles", 1000},
                        {"path", nullptr},
                        {"matches", nullptr}};
    result["settings"] = {{"size", size}, {"depth", "u16"}};
    return result;
}

Json errors(double scale) {
    return {{"from", "file"},           {"false_hits", scale / 10},  {"missed_hits", scale / 5},
            {"mean_distance", scale},   {"p95_distance", 4 * scale}, {"hausdorff", 20 * scale},
            {"not_captured", scale / 2}};
}

Json speed(double map_ns, double triangles_ns) {
    return {{"rays", 1000},
            {"map", {{"ns", map_ns}, {"bytes", 70'000}}},
            {"triangles", triangles_ns > 0 ? Json{{"ns", triangles_ns}, {"bytes", 400'000}} : Json(nullptr)}};
}

Json search() {
    const auto tried = [](const char* size, double bytes, double error, bool met) {
        return Json{{"settings", {{"size", size}, {"layers", "2"}, {"</td><b class=\"injected\">", size}}},
                    {"bytes", bytes},
                    {"error", error},
                    {"met", met}};
    };
    return {{"target", 0.004},
            {"metric", "mean-dt"},
            {"max_bytes", 100'000},
            {"stopped_by", "<img class=\"injected\" src=x>"},
            {"chosen", 2},
            {"candidates",
             {tried("32", 4000, 0.02, false), tried("64", 9000, 0.008, false),
              tried("128", 30'000, 0.003, true)}}};
}

Json expected(double bytes) {
    return {{"bytes", bytes},
            {"ns", 80.0},
            {"error", 0.003},
            {"image_error", nullptr},
            {"bytes_triangles", nullptr},
            {"bytes_one_size", nullptr}};
}

Json object(std::size_t node, const std::string& name, const char* decision, const std::string& why) {
    const bool mapped = std::string(decision) == "map";
    return {{"node", node},
            {"name", name},
            {"same_as", nullptr},
            {"triangles", 100 * (node + 1)},
            {"bytes_triangles", 10'000 * (node + 1)},
            {"captured", 0.98},
            {"star_shaped", false},
            {"ray_share", 0.03},
            {"distance", 4.0},
            {"tolerance", 0.004},
            {"decision", decision},
            {"settings", mapped ? Json{{"size", "64"}, {"layers", "2"}, {"depth", "u16"}} : Json(nullptr)},
            {"map", mapped ? Json("room.maps/" + name + ".spa") : Json(nullptr)},
            {"expected", mapped ? expected(1000 * double(node + 1)) : Json(nullptr)},
            {"why", why}};
}

Json plan() {
    Json shared = object(3, "again", "map", "the same mesh");
    shared["same_as"] = 1;
    return {{"name", "PLAN.json"},
            {"path", "maps/PLAN.json"},
            {"error", nullptr},
            {"scene", "<i class=\"injected\">room.glb"},
            {"triangles", 12'345},
            {"request",
             {{"camera", "</script><b class=\"injected\">"},
              {"views", nullptr},
              {"samples", 64},
              {"budget_bytes", nullptr},
              {"target_image_error", 0.01}}},
            {"one_size", 256},
            {"expected",
             {{"bytes", 20'000},
              {"ns", nullptr},
              {"error", nullptr},
              {"image_error", 0.008},
              {"bytes_triangles", 1'000'000},
              {"bytes_one_size", 120'000}}},
            {"left_out", 0},
            {"objects",
             {object(0, "wall", "triangles", "12 triangles are cheaper than any map"),
              object(1, "<b class=\"injected\">boot</b>", "map", "</td><script>window.injected = 7</script>"),
              object(2, "pebble", "drop", "nobody sees it"), std::move(shared)}}};
}

Json unread_plan() {
    Json result = plan();
    for (const char* key : {"scene", "triangles", "one_size", "expected"}) result[key] = nullptr;
    for (auto& [key, value] : result["request"].items()) value = nullptr;
    result["objects"] = Json::array();
    result["name"] = "old/PLAN.json";
    result["error"] = "old/PLAN.json: is <b class=\"injected\">no plan</b>";
    return result;
}

Json report(Json maps, Json plans) {
    return {{"generator", {{"name", "spa"}, {"version", "0.1.0"}}},
            {"inputs", {"maps"}},
            {"rays", 1000},
            {"warnings", Json::array()},
            {"maps", std::move(maps)},
            {"plans", std::move(plans)}};
}

} // namespace

Json hostile_map_report() {
    Json maps = Json::array();
    const auto add = [&](Json entry) -> Json& { return maps.emplace_back(std::move(entry)); };
    Json& quotes = add(map("\"quotes\" & 'more'\\<!--.spa", 128, 30'000));
    quotes["errors"] = errors(0.003);
    quotes["speed"] = speed(80, 160);
    quotes["search"] = search();
    quotes["warnings"] = {"a <b class=\"injected\">bold</b> warning", "another one"};

    Json& script = add(map("</script><b class=\"injected\">.spa", 64, 9000));
    script["errors"] = errors(0.02);
    script["speed"] = speed(40, 0);
    script["settings"] = {
        {"<img class=\"injected\" src=x>", "</script><script>window.injected = 1</script>"}};
    script["source"]["name"] = "<b class=\"injected\">boot.glb";

    Json& exact =
        add(map("<img class=\"injected\" src=\"x\" onerror=\"window.injected = 3\">.spa", 256, 90'000));
    exact["errors"] = errors(0);
    exact["speed"] = speed(100, 120);
    exact["warnings"] = {"the only warning"};

    add(unread("a\nb\tc\r.spa", "maps/x.spa: is </p><b class=\"injected\">damaged</b>"));

    Json& bidi = add(map("bidi/\xE2\x80\xAE"
                         "gpj.exe\xE2\x80\x8B.spa",
                         32, 3000));
    bidi["shape"]["parts"] = 3;

    Json& large = add(map("sub/folder/Large.spa", 512, 5'000'000));
    large["errors"] = errors(0.0005);
    large["errors"]["false_hits"] = nullptr;
    large["speed"] = speed(300, 900);
    large["source"]["triangles"] = 1'234'567;

    Json& bare = add(map("\xC3\xBC/\xE5\x9C\xB0\xE7\x90\x83.spa", 64, 8000));
    bare["source"] = nullptr;
    bare["settings"] = nullptr;

    add(map("\xFF\xFE latin.spa", 64, 8000));
    return report(std::move(maps), {plan(), unread_plan()});
}

Json large_map_report(std::size_t count) {
    Json maps = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<char, 64> name{};
        std::snprintf(name.data(), name.size(), "part%02zu/map%05zu.spa", i / 100, i);
        Json& each = maps.emplace_back(map(name.data(), 64, 5000 + i * 7919 % 100'003));
        each["errors"] = errors(double(i * 31 % 1009 + 1) / 1e5);
        each["speed"] = speed(double(i * 104'729 % 997 + 30), double(i * 7919 % 1013 + 60));
    }
    return report(std::move(maps), Json::array());
}

} // namespace spa::test
