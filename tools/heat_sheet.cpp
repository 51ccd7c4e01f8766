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
        const auto& [r, g, b, alpha] = errors.color[i];
        if (!std::isnan(alpha))
            picture.pixels[i] =
                heat_color(color_heat, double(std::isnan(r) ? alpha : std::max({r, g, b, alpha})));
    }
    return picture;
}

// The source's surface as the centre sees it, the worst distance to the map in each direction; `captured`:
// only what the layers hold, or only what they do not.
Picture draw_surface(const measure::Measurement& measurement, Mapping mapping, bool captured) {
    // Coarse enough for several points a texel.
    const Grid grid = mapping == Mapping::octahedral ? Grid{mapping, 129, 129} : Grid{mapping, 180, 90};
    std::vector<float> worst(std::size_t(grid.width) * grid.height, std::nanf(""));
    for (const measure::SurfaceError& error : measurement.surface) {
        if (error.captured != captured) continue;
        const Vec2d at = position_of(grid, to_double(error.direction));
        const TexelIndex texel = wrap(grid, std::llround(at.x), std::llround(at.y));
        float& value = worst[std::size_t(texel.y) * grid.width + texel.x];
        value = std::isnan(value) ? error.distance : std::max(value, error.distance);
    }
    Picture picture(grid.width, grid.height, unknown_color); // between the points
    for (std::size_t i = 0; i < worst.size(); ++i)
        if (!std::isnan(worst[i])) picture.pixels[i] = heat_color(depth_heat, double(worst[i]));
    return picture;
}

} // namespace

Picture heat_sheet(const std::vector<Part>& parts, const measure::Measurement& measurement,
                   const std::string& title) {
    const Mapping mapping = parts.front().mapping;
    const SheetScale scale(measurement.texels.size());
    std::vector<SheetRow> rows;
    rows.push_back(
        {"the source",
         {make_cell("captured, to the map", draw_surface(measurement, mapping, true), scale),
          make_cell("not captured, to the map", draw_surface(measurement, mapping, false), scale)}});
    for (const TexelErrors& errors : measurement.texels) {
        const ImageView color = measure::surface_of(parts[errors.part], errors.layer, errors.side).color;
        rows.push_back({(parts.size() > 1 ? "part " + std::to_string(errors.part) + "  " : "") + "layer " +
                            std::to_string(errors.layer) + "  " + measure::name(errors.side),
                        {make_cell("the map", color.empty() ? Picture{} : color_picture(color), scale),
                         make_cell("texel to source", draw(errors, depth_heat, errors.distance), scale),
                         make_cell("normal", draw(errors, normal_heat, errors.normal), scale),
                         make_cell("colour", draw_color(errors), scale)}});
    }
    return lay_out_sheet(title, heat_legend("missing", "extra"), rows, scale);
}

} // namespace spa::tools
