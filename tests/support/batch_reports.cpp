// SPDX-License-Identifier: Apache-2.0
#include "batch_reports.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>

namespace spa::test {

namespace {

using Json = nlohmann::ordered_json;

Json asset(const std::string& source, const std::string& status) {
    const bool done = status == "baked" || status == "up_to_date";
    return {
        {"source", source},
        {"path", "assets/" + source},
        {"output", "maps/" + source + ".spa"},
        {"status", status},
        {"reason", status == "baked" ? Json("new") : Json(nullptr)},
        {"exit_code", status == "failed" ? Json(3)
                      : done             ? Json(0)
                                         : Json(nullptr)},
        {"signal", nullptr},
        {"error", status == "failed" ? Json(source + ": is broken") : Json(nullptr)},
        {"diagnostics", ""},
        {"warnings", Json::array()},
        {"seconds", done ? Json(0.5) : Json(nullptr)},
        {"peak_memory_bytes", status == "baked" ? Json(64 << 20) : Json(nullptr)},
        {"source_bytes", done ? Json(1000) : Json(nullptr)},
        {"triangles", done ? Json(12) : Json(nullptr)},
        {"output_bytes", done ? Json(500) : Json(nullptr)},
        {"size", done ? Json("256") : Json(nullptr)},
        {"layers", done ? Json(2) : Json(nullptr)},
        {"node", nullptr},
        {"figures", nullptr},
    };
}

Json distribution(double p95) {
    return {{"count", 10}, {"max", 2 * p95}, {"mean", p95 / 2}, {"rms", p95 / 2}, {"p95", p95}};
}

Json ray_distribution(double p95) {
    return {{"count", 10}, {"median", p95 / 2}, {"p95", p95}, {"p99", p95}, {"max", p95}, {"mean", p95 / 2}};
}

Json hits(double share) { return {{"share", share}, {"band", 1}, {"interior", 2}, {"star", 1}}; }

// What --measure gives; rays: with those of rays.
Json figures(double distance, double captured, bool rays) {
    Json of_rays = nullptr;
    if (rays)
        of_rays = {{"count", 1000},
                   {"band_width", 0.01},
                   {"hit", 400},
                   {"passed", 590},
                   {"false_hits", hits(distance * 2)},
                   {"missed_hits", hits(distance * 3)},
                   {"distance", ray_distribution(0.1)},
                   {"interior_distance", ray_distribution(0.1)},
                   {"normal_angle", ray_distribution(1)},
                   {"color_difference", ray_distribution(1)}};
    return {{"source_radius", 1.5},
            {"texel_distance", distribution(1e-5)},
            {"surface_distance", distribution(distance)},
            {"hausdorff", 2 * distance},
            {"captured_area", captured},
            {"normal_angle", distribution(0.1)},
            {"color_difference", distribution(0)},
            {"alpha_difference", distribution(0)},
            {"coverage", {{"share", 1}, {"texels", 100}, {"missing", 0}, {"extra", 0}, {"ties", 0}}},
            {"quantization", {{"bound", 1e-5}, {"holds", true}, {"above", 0}}},
            {"shell_ends", 0},
            {"normals_above", 0},
            {"error_parts",
             {{"star", distribution(0)},
              {"resolution", distribution(distance)},
              {"quantization", distribution(1e-6)}}},
            {"rays", of_rays}};
}

Json report(Json assets, double seconds) {
    Json counts{{"baked", 0}, {"up_to_date", 0}, {"failed", 0}, {"not_started", 0}};
    for (const Json& each : assets) {
        Json& count = counts[each["status"].get<std::string>()];
        count = count.get<int>() + 1;
    }
    return {{"generator", {{"name", "spa"}, {"version", "0.1.0"}}},
            {"inputs", {"assets"}},
            {"plan", nullptr},
            {"output", "maps"},
            {"shard", nullptr},
            {"jobs", 2},
            {"memory_bytes", nullptr},
            {"timeout_seconds", nullptr},
            {"dry_run", false},
            {"stopped_by", nullptr},
            {"seconds", seconds},
            {"warnings", Json::array()},
            {"counts", counts},
            {"assets", std::move(assets)}};
}

} // namespace

Json hostile_batch_report() {
    Json assets = Json::array();
    const auto add = [&](const std::string& source, const std::string& status) -> Json& {
        return assets.emplace_back(asset(source, status));
    };
    // Sorted as bytes.
    Json& quotes = add("\"quotes\" & 'more'\\<!--.obj", "baked");
    quotes["figures"] = figures(0.01, 0.99, true);
    quotes["triangles"] = 7;
    quotes["layers"] = 8;
    quotes["warnings"] = {"a <b class=\"injected\">bold</b> warning", "another one"};

    Json& script = add("</script><b class=\"injected\">.glb", "failed");
    script["error"] = "</script><script>window.injected = 1</script>";
    script["diagnostics"] =
        "<img class=\"injected\" src=\"x\" onerror=\"window.injected = 2\">\n\tsecond line\n";
    script["seconds"] = 3.25;

    Json& image = add("<img class=\"injected\" src=\"x\" onerror=\"window.injected = 3\">.ply", "baked");
    image["seconds"] = 120.5;
    image["triangles"] = 7;
    image["warnings"] = {"the only warning"};
    image["reason"] = "options";

    Json& lines = add("a\nb\tc\r.stl", "up_to_date");
    lines["figures"] = figures(0.002, 0.5, false);
    lines["source_bytes"] = 5'000'000'000;

    Json& bidi = add("bidi/\xE2\x80\xAE"
                     "gpj.exe\xE2\x80\x8B.obj",
                     "not_started");
    bidi["error"] = nullptr;

    Json& large = add("sub/folder/Large.glb", "baked");
    large["figures"] = figures(0.05, 1, true);
    large["triangles"] = 1'234'567;
    large["size"] = "640x480";
    large["layers"] = 1;
    large["output_bytes"] = 2'000'000;
    large["diagnostics"] = "libpng warning: iCCP: known incorrect sRGB profile";

    Json& crash = add("sub/folder/crash.off", "failed");
    crash["signal"] = "SIGSEGV";
    crash["exit_code"] = nullptr;

    Json& umlaut = add("\xC3\xBC/\xE5\x9C\xB0\xE7\x90\x83.obj", "up_to_date");
    umlaut["triangles"] = 0;
    umlaut["size"] = "512";
    umlaut["layers"] = 1;

    add("\xFF\xFE latin.obj", "baked");
    Json result = report(std::move(assets), 124.5);
    result["shard"] = {{"index", 2}, {"count", 3}};
    return result;
}

Json large_batch_report(std::size_t count) {
    Json assets = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<char, 64> name{};
        std::snprintf(name.data(), name.size(), "part%02zu/asset%05zu.glb", i / 1000, i);
        Json& each = assets.emplace_back(asset(name.data(), i % 100 == 99 ? "failed" : "baked"));
        if (i % 100 == 99) continue;
        each["triangles"] = i * 7919 % 100'003;
        each["seconds"] = double(i * 104'729 % 10'007) / 1000;
        each["figures"] = figures(double(i * 31 % 1009) / 1e5, 0.99, true);
    }
    return report(std::move(assets), 5000);
}

} // namespace spa::test
