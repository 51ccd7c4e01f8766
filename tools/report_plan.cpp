// SPDX-License-Identifier: Apache-2.0
#include "report_plan.h"

#include "../formats/container/text.h"
#include "../libspa/core/error.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace spa::tools {

namespace {

using Json = PickedJson;

constexpr std::uintmax_t most_plan_bytes = std::uintmax_t(64) << 20U;
constexpr std::size_t most_objects = 20'000, most_candidates = 1000;

Json expected_json(const Json& json) {
    const Json& expected = pick(json, "expected");
    if (!expected.is_object()) return nullptr;
    return {{"bytes", pick_measure(expected, "bytes")},
            {"ns", pick_measure(expected, "ns")},
            {"error", pick_measure(expected, "error")},
            {"image_error", pick_measure(expected, "image_error")},
            {"bytes_triangles", pick_measure(expected, "bytes_triangles")},
            {"bytes_one_size", pick_measure(expected, "bytes_one_size")}};
}

Json object_json(const Json& object) {
    const Json& views = pick(object, "views");
    return {
        {"node", pick_count(object, "node")},
        {"name", pick_text(object, "name", 200)},
        {"same_as", pick_count(object, "same_as")},
        {"triangles", pick_count(object, "triangles")},
        {"bytes_triangles", pick_measure(object, "bytes_triangles")},
        {"captured", pick_measure(object, "captured", 1)},
        {"star_shaped", pick_flag(object, "star_shaped")},
        {"ray_share", pick_measure(views, "ray_share", 1)},
        {"distance", pick_measure(views, "distance_median")},
        {"tolerance", pick_measure(object, "tolerance")},
        {"decision", pick_text(object, "decision", 20)},
        {"settings", pick_settings(object, "settings")},
        {"map", pick_text(object, "map")},
        {"expected", expected_json(object)},
        {"why", pick_text(object, "why")},
    };
}

// Throws Error.
Json parse_plan(const ReportFile& file) {
    const std::string path = file.path.string();
    std::ifstream in(file.path, std::ios::binary);
    if (!in) throw Error(ExitCode::input_output, path + ": cannot be opened; check the path");
    std::string text;
    for (std::istreambuf_iterator<char> at(in), end; at != end; ++at) {
        if (text.size() == most_plan_bytes)
            throw Error(ExitCode::unsupported, path + ": is longer than 64 MiB; no plan is that long");
        text += *at;
    }
    if (const std::size_t at = container::find_json_error(text); at != container::text_ok)
        throw Error(ExitCode::invalid_data, path + ": is not a plan: no JSON object at byte " +
                                                std::to_string(at) + "; write it anew by 'spa plan'");
    Json plan = Json::parse(text, nullptr, false);
    if (!pick(plan, "objects").is_array())
        throw Error(ExitCode::invalid_data,
                    path + ": is not a plan: it has no list 'objects'; write it anew by 'spa plan'");
    return plan;
}

Json candidate_json(const Json& tried) {
    return {{"settings", pick_settings(tried, "settings")},
            {"bytes", pick_measure(tried, "bytes")},
            {"error", pick_measure(tried, "error")},
            {"met", pick_flag(tried, "met")}};
}

} // namespace

Json plan_json(const ReportFile& file) {
    Json result = {{"name", file.name}, {"path", file.path.string()}, {"error", nullptr}};
    Json plan;
    try {
        plan = parse_plan(file);
    } catch (const Error& error) {
        result["error"] = error.what();
    }
    const Json& scene = pick(plan, "scene");
    const Json& request = pick(plan, "request");
    result["scene"] = pick_text(scene, "path");
    result["triangles"] = pick_count(scene, "triangles");
    result["request"] = {{"camera", pick_text(request, "camera", 200)},
                         {"views", pick_count(request, "views")},
                         {"samples", pick_count(request, "samples")},
                         {"budget_bytes", pick_measure(request, "budget_bytes")},
                         {"target_image_error", pick_measure(request, "target_image_error")}};
    result["one_size"] = pick_count(plan, "one_size");
    result["expected"] = expected_json(plan);
    result["left_out"] = 0;
    Json objects = Json::array();
    const Json& all = pick(plan, "objects");
    if (all.is_array()) {
        for (const Json& object : all) {
            if (objects.size() == most_objects) break;
            objects.push_back(object_json(object));
        }
        result["left_out"] = all.size() - objects.size();
    }
    result["objects"] = std::move(objects);
    return result;
}

Json search_json(const Json& metadata) {
    const Json& search = pick(metadata, "search");
    if (!search.is_object()) return nullptr;
    Json candidates = Json::array();
    const Json& tried = pick(search, "tried");
    if (tried.is_array())
        for (const Json& each : tried) {
            if (candidates.size() == most_candidates) break;
            candidates.push_back(candidate_json(each));
        }
    Json chosen = pick_count(search, "chosen");
    if (chosen.is_number() && chosen.get<std::uint64_t>() >= candidates.size()) chosen = nullptr;
    return {{"target", pick_measure(search, "target")},
            {"metric", pick_text(search, "metric", 40)},
            {"max_bytes", pick_measure(search, "max_bytes")},
            {"stopped_by", pick_text(search, "stopped_by", 200)},
            {"chosen", std::move(chosen)},
            {"candidates", std::move(candidates)}};
}

} // namespace spa::tools
