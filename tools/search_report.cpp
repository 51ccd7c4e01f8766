// SPDX-License-Identifier: Apache-2.0
#include "search_report.h"

#include "text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using plan::SearchRequest;
using plan::SearchResult;
using plan::Tried;

// JSON has no infinity, which stands for what nothing tells.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json candidate_json(const SearchRequest& request, const plan::Candidate& candidate) {
    const bake::Options options = plan::options_of(candidate, request.options);
    return {
        {"size", size_text(options.grid)}, {"color_size", size_text(options.color_grid)},
        {"depth", name(options.depth)},    {"layers", options.layers},
        {"frame", name(options.frame)},    {"center", name(options.center)},
    };
}

Json verdict_json(const SearchRequest& request, const SearchResult& search) {
    return {
        {"target", request.target},
        {"metric", plan::name(request.metric)},
        {"footprint", request.footprint > 0 ? Json(request.footprint) : Json(nullptr)},
        {"max_bytes",
         request.max_bytes == SearchRequest{}.max_bytes ? Json(nullptr) : Json(request.max_bytes)},
        {"met", search.met},
        {"error", number(search.error)},
        {"stopped_by", plan::name(search.stopped_by)},
        {"refused", search.refused},
    };
}

std::string candidate_text(const SearchRequest& request, const plan::Candidate& candidate) {
    const bake::Options options = plan::options_of(candidate, request.options);
    return size_text(options.grid) + ", colour " + size_text(options.color_grid) + ", " +
           std::to_string(options.layers) + (options.layers == 1 ? " layer, " : " layers, ") +
           name(options.depth) + ", " + name(options.frame) + ", " + name(options.center);
}

std::string target_text(const SearchRequest& request) {
    return std::string(plan::name(request.metric)) + " of at most " + significant(request.target, 3);
}

} // namespace

BakeSettings decided(const BakeSettings& settings, const SearchResult& search) {
    BakeSettings result = settings;
    result.options = plan::options_of(*search.chosen, settings.options);
    return result;
}

Json search_metadata(const BakeSettings& settings, const SearchResult& search) {
    Json json = verdict_json(*settings.search, search);
    json["tried"] = search.tried.size();
    return json;
}

Json search_json(const BakeSettings& settings, const SearchResult& search) {
    const SearchRequest& request = *settings.search;
    Json json = verdict_json(request, search);
    json["chosen"] = candidate_json(request, *search.chosen);
    Json tried = Json::array();
    for (const Tried& entry : search.tried) {
        tried.push_back({
            {"settings", candidate_json(request, entry.candidate)},
            {"estimated_bytes", entry.bytes},
            {"error", number(entry.error.value)},
            {"low", number(entry.error.low)},
            {"high", number(entry.error.high)},
            {"samples", entry.error.samples},
            {"met", entry.met},
            {"ms", 1000 * entry.seconds},
        });
    }
    json["tried"] = tried;
    Json colors = Json::array();
    for (const plan::TriedColor& entry : search.colors)
        colors.push_back({{"color_size", size_text(plan::grid_of(request.options.grid.mapping, entry.cells))},
                          {"error", entry.error}});
    json["colors"] = colors;
    json["search_seconds"] = search.search_seconds;
    json["final_seconds"] = search.final_seconds;
    return json;
}

std::string search_text(const BakeSettings& settings, const SearchResult& search) {
    const SearchRequest& request = *settings.search;
    std::string text = pad_right("search", 10) + target_text(request) +
                       (search.met ? ": met, " : ": not met, ") + significant(search.error, 3) + " after " +
                       std::to_string(search.tried.size()) + " tried in " + fixed(search.search_seconds, 1) +
                       " s\n";
    for (const Tried& entry : search.tried) {
        const std::string error = entry.error.samples == 0 ? "too large" : significant(entry.error.value, 3);
        text += pad_right("", 10) + pad_right(candidate_text(request, entry.candidate), 54) +
                pad_left(byte_count(entry.bytes), 11) + pad_left(error, 11) +
                (entry.candidate == *search.chosen ? (entry.met ? "  chosen" : "  nearest")
                 : entry.met                       ? "  meets it"
                                                   : "") +
                "\n";
    }
    return text;
}

std::string unmet_text(const BakeSettings& settings, const SearchResult& search) {
    const SearchRequest& request = *settings.search;
    const Tried* nearest = nullptr;
    for (const Tried& entry : search.tried)
        if (entry.error.samples > 0 && (nearest == nullptr || entry.error.value < nearest->error.value))
            nearest = &entry;
    std::string text = "no map has a " + target_text(request);
    if (nearest != nullptr)
        text += "; nearest came " + candidate_text(request, nearest->candidate) + " with " +
                significant(nearest->error.value, 3);
    switch (search.stopped_by) {
    case plan::Limit::shape:
        return text +
               "; more samples stopped helping: some surface is in no layer, or hidden from the centre "
               "(star error); allow more --layers, --parts auto or a larger error";
    case plan::Limit::max_bytes: return text + "; --max-bytes stopped it; allow more bytes or a larger error";
    default:
        return text + "; more samples would help, but " +
               size_text(plan::grid_of(request.options.grid.mapping, request.cells.back())) +
               " is the largest size that was to be tried; allow a larger error";
    }
}

} // namespace spa::tools
