// SPDX-License-Identifier: Apache-2.0
#include "bake_report.h"

#include "bake_key.h"
#include "text.h"
#include "validate_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

Json source_json(const BakeFacts& facts) {
    const import::Report& report = facts.source.report;
    const import::SourceFile& asset = report.files.front();
    return {
        {"name", asset.name},
        {"format", report.format},
        {"xxh3", hex64(asset.xxh3)},
        {"bytes", asset.bytes},
        {"files", files_json(report.files)},
        {"missing", missing_json(report.missing)},
        {"vertices", facts.source.model.positions.size()},
        {"triangles", facts.source.model.triangles.size()},
        {"materials", facts.source.model.materials.size()},
        {"textures", facts.source.model.textures.size()},
    };
}

Json layers_json(const bake::Report& bake) {
    Json layers = Json::array();
    for (const bake::LayerReport& layer : bake.layers)
        layers.push_back(
            {{"outer_coverage", layer.outer_coverage}, {"inner_coverage", layer.inner_coverage}});
    return layers;
}

Json folds_json(const bake::FoldStatistics& folds) {
    return {
        {"edges", folds.edges}, {"searched", folds.searched}, {"directions", folds.directions},
        {"pairs", folds.pairs}, {"singles", folds.singles},   {"unresolved", folds.unresolved},
    };
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json center_json(const bake::Placement& placement) {
    return {
        {"chosen", name(placement.center_chosen)},
        {"kernel", placement.kernel},
        {"captured_bounds", optional_json(placement.captured_bounds)},
        {"captured", optional_json(placement.captured)},
    };
}

Json frame_json(const bake::Placement& placement) {
    return {{"chosen", name(placement.frame_chosen)}, {"elongation", optional_json(placement.elongation)}};
}

// The counts; without what depends on the machine.
Json counts_json(const BakeFacts& facts) {
    const import::Report& source = facts.source.report;
    const bake::Report& bake = facts.bake;
    return {
        {"triangles", bake.triangles},
        {"components", bake.components},
        {"open_edges", bake.open_edges},
        {"turned_triangles", bake.turned_triangles},
        {"flipped_components", bake.flipped_components},
        {"solid_components", bake.solid_components},
        {"edge_on_triangles", bake.edge_on_triangles},
        {"unseen_components", bake.unseen_components},
        {"back_facing_samples", bake.back_facing_samples},
        {"thin_samples", bake.thin_samples},
        {"truncated_samples", bake.truncated_samples},
        {"center", facts.parts.size() == 1 ? center_json(bake.placement) : Json(nullptr)},
        {"frame", facts.parts.size() == 1 ? frame_json(bake.placement) : Json(nullptr)},
        {"center_on_surface", bake.center_on_surface},
        {"center_inside", bake.center_inside},
        {"center_moved", bake.center_moved},
        {"layers", layers_json(bake)},
        {"mixed_triangles", bake.mixed_triangles ? Json(*bake.mixed_triangles) : Json(nullptr)},
        {"folds", bake.folds ? folds_json(*bake.folds) : Json(nullptr)},
        {"dropped_degenerate", source.dropped_degenerate},
        {"dropped_non_finite", source.dropped_non_finite},
        {"ignored_primitives", source.ignored_primitives},
        {"computed_normals", source.computed_normals},
    };
}

Json vector_json(Vec3d v) { return {v.x, v.y, v.z}; }

Json parts_json(const BakeFacts& facts) {
    Json parts = Json::array();
    for (std::size_t i = 0; i < facts.parts.size(); ++i) {
        const Part& part = facts.parts[i];
        const bake::Report& bake = facts.part_reports[i];
        parts.push_back({
            {"name", facts.partition[i].name},
            {"node", part.node},
            {"joint", part.joint},
            {"triangles", bake.triangles},
            {"components", bake.components},
            {"center", vector_json(part.center)},
            {"radius", part.radius},
            {"center_choice", center_json(bake.placement)},
            {"frame_choice", frame_json(bake.placement)},
            {"center_inside", bake.center_inside},
            {"layers", layers_json(bake)},
            {"mixed_triangles", bake.mixed_triangles ? Json(*bake.mixed_triangles) : Json(nullptr)},
        });
    }
    return parts;
}

// Messages begin with the path as it was given; in a file only the name may appear.
std::string without_folder(std::string message, const std::filesystem::path& path) {
    const std::string full = path.string(), name = path.filename().string();
    for (std::size_t at = message.find(full); at != std::string::npos;
         at = message.find(full, at + name.size()))
        message.replace(at, full.size(), name);
    return message;
}

std::string line(const char* label, const std::string& text) { return pad_right(label, 10) + text + "\n"; }

std::string grid_text(const Grid& grid) {
    return std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

std::string options_text(const bake::Options& options) {
    std::string text = std::string(name(options.grid.mapping)) + " " + size_text(options.grid);
    if (options.grid.mapping == Mapping::octahedral) text += " (" + grid_text(options.grid) + " samples)";
    if (options.color_grid != options.grid) text += ", colour " + size_text(options.color_grid);
    text += std::string(", depth ") + name(options.depth) + ", normals " + name(options.normals);
    return text + ", " + name(options.baker) + " baker";
}

std::string mesh_text(const bake::Report& bake) {
    std::string text = std::to_string(bake.components) + (bake.components == 1 ? " piece" : " pieces");
    text += bake.open_edges == 0 ? ", watertight" : ", " + std::to_string(bake.open_edges) + " open edges";
    return text + (bake.center_inside ? ", centre inside the solid" : ", centre outside the solid");
}

std::string parts_text(const BakeFacts& facts) {
    std::uint64_t most = 0, least = UINT64_MAX;
    for (const bake::Report& part : facts.part_reports) {
        most = std::max(most, part.triangles);
        least = std::min(least, part.triangles);
    }
    return std::to_string(facts.parts.size()) + ", by " + name(facts.arguments.settings.parts) + ", of " +
           std::to_string(least) + " to " + std::to_string(most) + " triangles";
}

std::string placement_text(const bake::Placement& placement) {
    std::string text = placement.center_chosen == bake::Center::captured
                           ? (placement.kernel ? "a point that sees all of the surface"
                                               : "the point that holds the surface best")
                           : "that of the bounding box";
    if (placement.captured && placement.center_chosen == bake::Center::captured)
        text += ", " + percent(*placement.captured) + " captured, from that of the bounding box " +
                percent(*placement.captured_bounds);
    else if (placement.captured)
        text += ", " + percent(*placement.captured) + " captured";
    text += std::string("; frame ") + name(placement.frame_chosen);
    if (placement.elongation) text += ", elongation " + significant(*placement.elongation, 2);
    return text;
}

std::string measured_text(const measure::Measurement& m) {
    return "texels to source " + significant(m.texel_distance.max, 3) + " R at most, source to map " +
           significant(m.surface_distance.max, 3) + " R, " + percent(m.captured_area, 2) + " captured" +
           (m.rays ? ", " + percent(m.rays->false_hits(), 2) + " of rays hit falsely, " +
                         percent(m.rays->missed_hits(), 2) + " miss"
                   : "");
}

} // namespace

std::string metadata(const BakeFacts& facts) {
    Json report = counts_json(facts);
    Json messages = Json::array();
    for (const std::string& warning : warnings(facts))
        messages.push_back(without_folder(warning, facts.arguments.input));
    report["warnings"] = messages;
    if (facts.parts.size() > 1) report["parts"] = parts_json(facts);
    Json json = {
        {"generator", {{"name", "spa"}, {"version", SPA_VERSION}}},
        {"key", bake_key(facts)},
        {"source", source_json(facts)},
        {"options", options_json(facts.arguments.settings)},
        {"report", report},
        {"units", "object"},
    };
    if (facts.measurement != nullptr) json["figures"] = figures_json(*facts.measurement);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string bake_key(const BakeFacts& facts) {
    const import::Report& source = facts.source.report;
    return bake_key(files_json(source.files), missing_json(source.missing),
                    options_json(facts.arguments.settings), SPA_VERSION);
}

std::vector<std::string> warnings(const BakeFacts& facts) {
    std::vector<std::string> all = facts.source.report.warnings;
    all.insert(all.end(), facts.bake.warnings.begin(), facts.bake.warnings.end());
    return all;
}

Json report_json(const BakeFacts& facts, Json output, double seconds) {
    Json report = counts_json(facts);
    if (!facts.bake.gl.empty()) report["gl"] = facts.bake.gl;
    report["warnings"] = warnings(facts);
    report["parts"] = parts_json(facts);
    return {
        {"key", bake_key(facts)},
        {"source", source_json(facts)},
        {"options", options_json(facts.arguments.settings)},
        {"report", report},
        {"figures", facts.measurement == nullptr ? Json(nullptr) : figures_json(*facts.measurement)},
        {"output", std::move(output)},
        {"seconds", seconds},
    };
}

std::string report_text(const BakeFacts& facts, std::uint64_t output_bytes, double seconds) {
    const import::Report& source = facts.source.report;
    const bake::Report& bake = facts.bake;
    std::string text = facts.arguments.output.string() + "\n";
    text += line("source", source.files.front().name + ", " + source.format + ", " +
                               std::to_string(facts.source.model.positions.size()) + " vertices, " +
                               std::to_string(bake.triangles) + " triangles");
    text += line("mesh", mesh_text(bake));
    if (facts.parts.size() > 1) text += line("parts", parts_text(facts));
    text += line("map", options_text(facts.arguments.settings.options));
    if (facts.parts.size() == 1) text += line("centre", placement_text(bake.placement));
    if (!bake.gl.empty()) text += line("gl", bake.gl);
    for (std::size_t i = 0; i < bake.layers.size(); ++i)
        text += line(i == 0 ? "layers" : "",
                     std::to_string(i) + ": outer surface in " + percent(bake.layers[i].outer_coverage) +
                         " of all directions, inner in " + percent(bake.layers[i].inner_coverage));
    if (bake.mixed_triangles)
        text += line("mixed", percent(*bake.mixed_triangles) +
                                  " of the triangles between samples: their corners see different surfaces");
    if (bake.folds)
        text += line("folds", std::to_string(bake.folds->pairs) + " pairs of surfaces that meet and " +
                                  std::to_string(bake.folds->singles) + " that end alone, on " +
                                  std::to_string(bake.folds->searched) + " of " +
                                  std::to_string(bake.folds->edges) + " edges");
    if (facts.measurement != nullptr) text += line("measured", measured_text(*facts.measurement));
    text += line("bytes", std::to_string(output_bytes) + " (" + byte_count(output_bytes) + ")");
    return text + line("time", fixed(seconds, 2) + " s");
}

} // namespace spa::tools
