// SPDX-License-Identifier: Apache-2.0
#include "bench_layers_report.h"

#include "bake_settings.h"
#include "bench_json.h"

#include <nlohmann/json.hpp>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using measure::LayerFigures;
using measure::LayerRow;
using measure::LayersBar;
using measure::LayersMesh;

Json figures_json(const LayerFigures& row) {
    Json json = {{"reconstruction", measure::name(row.reconstruction)},
                 {"layers", row.layers},
                 {"cells", row.cells},
                 {"false_hits", row.false_hits},
                 {"missed_hits", row.missed_hits},
                 {"interior_false", row.interior_false},
                 {"interior_missed", row.interior_missed},
                 {"distance_mean", row.distance_mean},
                 {"distance_p95", row.distance_p95},
                 {"distance_p99", row.distance_p99},
                 {"normal_mean", row.normal_mean},
                 {"ns", row.ns}};
    if (row.time_ratio) json["time_ratio"] = *row.time_ratio;
    json["file_bytes"] = row.file_bytes;
    json["fold_bytes"] = row.fold_bytes;
    json["fold_share"] = row.fold_share;
    json["mixed_triangles"] = row.mixed_triangles;
    json["tangent_triangles"] = row.tangent_triangles;
    return json;
}

Json row_json(const LayerRow& row) {
    Json json = figures_json(figures_of(row));
    json["file_bytes"] = row.file_bytes;
    json["fold_bytes"] = row.fold_bytes;
    json["fold_records"] = row.fold_records;
    json["band_width"] = row.band_width;
    json["band"] = confusion_json(row.errors.band);
    json["interior"] = confusion_json(row.errors.interior);
    json["distance"] = full_distribution_json(row.errors.distance);
    json["interior_distance"] = full_distribution_json(row.errors.interior_distance);
    if (row.errors.normal.count > 0) json["normal_angle"] = full_distribution_json(row.errors.normal);
    json["times"] = spread_json(row.ns);
    json["truncated_samples"] = row.bake.truncated_samples;
    json["thin_samples"] = row.bake.thin_samples;
    json["unseen_components"] = row.bake.unseen_components;
    json["bake_seconds"] = row.bake.seconds;
    return json;
}

Json mesh_json(const LayersMesh& mesh, const std::string& source) {
    const measure::LayersBenchmark& b = mesh.benchmark;
    Json json = {{"mesh", mesh.name},          {"source", source},
                 {"vertices", b.vertices},     {"triangles", b.triangles},
                 {"components", b.components}, {"open_edges", b.open_edges},
                 {"closed", b.closed()},       {"center", {b.center.x, b.center.y, b.center.z}},
                 {"radius", b.radius}};
    if (!b.closed()) json["losses"] = losses_text(b);
    Json rows = Json::array();
    for (const LayerRow& row : b.rows) rows.push_back(row_json(row));
    json["rows"] = std::move(rows);
    return json;
}

Json bar_json(const LayersBar& bar) {
    Json json = {{"bar", bar.name},    {"cells", bar.cells},      {"worst_size", bar.worst_size},
                 {"value", bar.value}, {"limit", bar.limit},      {"at_least", bar.at_least},
                 {"unit", bar.unit},   {"reached", bar.reached()}};
    if (!bar.mesh.empty())
        json["mesh"] = bar.mesh;
    else
        json["worst"] = {{"mesh", bar.worst_mesh}, {"value", bar.worst}};
    return json;
}

} // namespace

Json report_json(const LayersReport& report) {
    Json json = {{"rays", report.rays},
                 {"seed", report.seed},
                 {"runs", report.runs},
                 {"center", name(report.center)},
                 {"stream_target", report.target}};
    Json meshes = Json::array();
    for (std::size_t i = 0; i < report.meshes.size(); ++i)
        meshes.push_back(mesh_json(report.meshes[i], report.sources[i]));
    json["meshes"] = std::move(meshes);
    Json rows = Json::array();
    for (const LayerFigures& row : report.mean) rows.push_back(figures_json(row));
    json["closed_mean"] = {{"meshes", measure::closed_count(report.meshes)}, {"rows", std::move(rows)}};
    Json bars = Json::array();
    for (const LayersBar& bar : report.bars) bars.push_back(bar_json(bar));
    json["bars"] = std::move(bars);
    return json;
}

} // namespace spa::tools
