// SPDX-License-Identifier: Apache-2.0
#include "heat_sheet.h"

#include "heat.h"
#include "surface_view.h"

#include <algorithm>
#include <cmath>

namespace spa::tools {

namespace {

using measure::TexelErrors;
using measure::TexelState;

Picture draw(const TexelErrors& errors, const HeatScale& scale, const std::vector<float>& values) {
    Picture picture(errors.grid.width, errors.grid.height, no_surface_color);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (errors.state[i] == TexelState::missing)
            picture.pixels[i] = missing_color;
        else if (errors.state[i] == TexelState::extra)
            picture.pixels[i] = extra_color;
        else if (!std::isnan(values[i]))
            picture.pixels[i] = heat_color(scale, double(values[i]));
    }
    return picture;
}

Picture draw_color(const TexelErrors& errors) {
    Picture picture(errors.color_grid.width, errors.color_grid.height, no_surface_color);
    for (std::size_t i = 0; i < errors.color.size(); ++i) {
        const auto& [r, g, b] = errors.color[i];
        if (!std::isnan(r)) picture.pixels[i] = heat_color(color_heat, double(std::max({r, g, b})));
    }
    return picture;
}

} // namespace

Picture heat_sheet(const Part& part, const measure::Measurement& measurement, const std::string& title) {
    const SheetScale scale(measurement.texels.size());
    std::vector<SheetRow> rows;
    for (const TexelErrors& errors : measurement.texels) {
        const ImageView color = measure::surface_of(part, errors.layer, errors.side).color;
        rows.push_back({"layer " + std::to_string(errors.layer) + "  " + measure::name(errors.side),
                        {make_cell("the map", color.empty() ? Picture{} : color_picture(color), scale),
                         make_cell("texel to source", draw(errors, depth_heat, errors.distance), scale),
                         make_cell("normal", draw(errors, normal_heat, errors.normal), scale),
                         make_cell("colour", draw_color(errors), scale)}});
    }
    return lay_out_sheet(title, heat_legend("missing", "extra"), rows, scale);
}

} // namespace spa::tools
