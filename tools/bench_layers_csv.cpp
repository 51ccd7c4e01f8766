// SPDX-License-Identifier: Apache-2.0
#include "bench_layers_report.h"

#include "csv.h"

namespace spa::tools {

namespace {

using measure::LayerFigures;

constexpr const char* titles =
    "mesh,closed,reconstruction,layers,cells,false_hits,missed_hits,interior_false,interior_missed,"
    "distance_mean,distance_p95,distance_p99,normal_mean,ns,time_ratio,file_bytes,fold_bytes,fold_share,"
    "mixed_triangles,tangent_triangles\n";

std::string line_of(const std::string& mesh, bool closed, const LayerFigures& row) {
    std::string line;
    append_field(line, mesh);
    append_field(line, std::string(closed ? "true" : "false"));
    append_field(line, std::string(measure::name(row.reconstruction)));
    append_field(line, std::uint64_t(row.layers));
    append_field(line, std::uint64_t(row.cells));
    for (const double value :
         {row.false_hits, row.missed_hits, row.interior_false, row.interior_missed, row.distance_mean,
          row.distance_p95, row.distance_p99, row.normal_mean, row.ns})
        append_field(line, value);
    if (row.time_ratio)
        append_field(line, *row.time_ratio);
    else
        append_field(line, std::string());
    for (const double value :
         {row.file_bytes, row.fold_bytes, row.fold_share, row.mixed_triangles, row.tangent_triangles})
        append_field(line, value);
    return line + "\n";
}

} // namespace

std::string report_csv(const LayersReport& report) {
    std::string text = titles;
    for (const measure::LayersMesh& mesh : report.meshes)
        for (const measure::LayerRow& row : mesh.benchmark.rows)
            text += line_of(mesh.name, mesh.benchmark.closed(), figures_of(row));
    for (const LayerFigures& row : report.mean) text += line_of("closed mean", true, row);
    return text;
}

} // namespace spa::tools
