// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include "sheet_layout.h"
#include "surface_view.h"
#include "text.h"

#include <utility>
#include <vector>

namespace spa::tools {

namespace {

SheetRow make_row(const Surface& surface, Mapping mapping, std::string heading, const SheetScale& scale) {
    const double coverage = depth_statistics(surface.depth, mapping).coverage;
    SheetRow row{std::move(heading) + "  " + percent(coverage) + " of all directions", {}};
    const auto add = [&](const char* what, const ImageView& image, auto draw) {
        if (image.empty()) {
            row.cells.push_back({std::string(what) + " absent", {}});
            return;
        }
        row.cells.push_back(make_cell(std::string(what) + " " + std::to_string(image.width) + "x" +
                                          std::to_string(image.height) + " " + name(image.format),
                                      draw(), scale));
    };
    add("colour", surface.color, [&] { return color_picture(surface.color); });
    add("depth", surface.depth, [&] { return depth_picture(surface.depth); });
    add("normal", surface.normal, [&] { return normal_picture(surface.normal, surface.depth, mapping); });
    add("coverage", surface.color, [&] { return coverage_picture(surface.color); });
    return row;
}

std::size_t surface_count(const SphericalMap& map) {
    std::size_t count = 0;
    for (const Part& part : map.parts)
        for (const Layer& layer : part.layers) count += 1 + (layer.inner.empty() ? 0 : 1);
    return count;
}

std::vector<SheetRow> make_rows(const SphericalMap& map, const SheetScale& scale) {
    std::vector<SheetRow> rows;
    for (std::size_t p = 0; p < map.parts.size(); ++p) {
        const Part& part = map.parts[p];
        for (std::size_t l = 0; l < part.layers.size(); ++l) {
            const Layer& layer = part.layers[l];
            const std::string heading = "part " + std::to_string(p) + "  layer " + std::to_string(l);
            rows.push_back(
                make_row(layer.outer, part.mapping,
                         heading + "  outer" + (layer.inner.empty() ? ", solid to the centre" : ""), scale));
            if (!layer.inner.empty())
                rows.push_back(make_row(layer.inner, part.mapping, heading + "  inner", scale));
        }
    }
    return rows;
}

std::string title(const SphericalMap& map, const std::string& file_name) {
    const Part& part = map.parts.front();
    const ImageView& depth = part.layers.front().outer.depth;
    return file_name + "   " + std::to_string(map.parts.size()) +
           (map.parts.size() == 1 ? " part   " : " parts   ") + name(part.mapping) + "   " +
           std::to_string(depth.width) + "x" + std::to_string(depth.height) + " samples";
}

} // namespace

Picture contact_sheet(const SphericalMap& map, const std::string& file_name) {
    const SheetScale scale(surface_count(map));
    SheetLegend legend;
    legend.text("depth r/R 0 ").bar(viridis).text(" 1   black: no surface   normal xyz as rgb");
    return lay_out_sheet(title(map, file_name), legend, make_rows(map, scale), scale);
}

} // namespace spa::tools
