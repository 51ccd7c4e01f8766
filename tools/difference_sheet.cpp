// SPDX-License-Identifier: Apache-2.0
#include "difference_sheet.h"

#include "heat.h"
#include "surface_view.h"

#include "../libspa/measure/angle.h"
#include "../libspa/measure/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace spa::tools {

namespace {

// Draws color(x, y) where both images have something, marks where one alone has.
template <class Has, class Color>
Picture draw(const ImageView& a, const ImageView& b, Has has, Color color) {
    const ImageView& size = a.empty() ? b : a;
    Picture picture(size.width, size.height, no_surface_color);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const bool in_a = !a.empty() && has(a, x, y);
            const bool in_b = !b.empty() && has(b, x, y);
            if (in_a && in_b)
                picture.at(x, y) = color(x, y);
            else if (in_a || in_b)
                picture.at(x, y) = in_a ? missing_color : extra_color;
        }
    return picture;
}

double depth_at(const ImageView& image, std::uint32_t x, std::uint32_t y) {
    return double(decode_depth(image.format, image.at(x, y)));
}
bool has_depth(const ImageView& image, std::uint32_t x, std::uint32_t y) { return depth_at(image, x, y) > 0; }
bool has_color(const ImageView& image, std::uint32_t x, std::uint32_t y) {
    return image.at(x, y)[3] != std::byte{0};
}

Picture depth_difference(const Surface& a, const Surface& b) {
    return draw(a.depth, b.depth, has_depth, [&](std::uint32_t x, std::uint32_t y) {
        return heat_color(depth_heat, std::abs(depth_at(a.depth, x, y) - depth_at(b.depth, x, y)));
    });
}

Picture normal_difference(const Surface& a, const Surface& b, Mapping mapping) {
    if (a.normal.empty() || b.normal.empty()) return {};
    const Grid grid{mapping, a.depth.width, a.depth.height};
    const auto normal = [&](const Surface& s, std::uint32_t x, std::uint32_t y) {
        return to_double(decode_normal(s.normal.format, measure::nearest_element(s.normal, grid, {x, y})));
    };
    return draw(a.depth, b.depth, has_depth, [&](std::uint32_t x, std::uint32_t y) {
        return heat_color(normal_heat, measure::angle_degrees(normal(a, x, y), normal(b, x, y)));
    });
}

Picture color_difference(const Surface& a, const Surface& b) {
    return draw(a.color, b.color, has_color, [&](std::uint32_t x, std::uint32_t y) {
        int largest = 0;
        for (unsigned c = 0; c < 3; ++c) {
            const int difference =
                std::to_integer<int>(a.color.at(x, y)[c]) - std::to_integer<int>(b.color.at(x, y)[c]);
            largest = std::max(largest, std::abs(difference));
        }
        return heat_color(color_heat, largest);
    });
}

Picture color(const Surface& surface) {
    return surface.color.empty() ? Picture{} : color_picture(surface.color);
}

} // namespace

Picture difference_sheet(const SphericalMap& a, const SphericalMap& b, const std::string& title) {
    const measure::MapDifference difference = measure::compare(a, b);
    const SheetScale scale(difference.surfaces.size());
    std::vector<SheetRow> rows;
    for (const measure::SurfaceDifference& d : difference.surfaces) {
        const Surface sa = measure::surface_of(a.parts[d.part], d.layer, d.side);
        const Surface sb = measure::surface_of(b.parts[d.part], d.layer, d.side);
        rows.push_back({"part " + std::to_string(d.part) + "  layer " + std::to_string(d.layer) + "  " +
                            measure::name(d.side),
                        {make_cell("first", color(sa), scale), make_cell("second", color(sb), scale),
                         make_cell("depth", depth_difference(sa, sb), scale),
                         make_cell("normal", normal_difference(sa, sb, a.parts[d.part].mapping), scale),
                         make_cell("colour", color_difference(sa, sb), scale)}});
    }
    return lay_out_sheet(title, heat_legend("first only", "second only"), rows, scale);
}

} // namespace spa::tools
