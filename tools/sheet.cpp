// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include "label.h"
#include "surface_view.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace spa::tools {

namespace {

constexpr std::uint32_t margin = 16;
constexpr std::uint32_t columns = 4;
constexpr Rgb background{30, 30, 34}, text_color{225, 225, 225}, dim_color{150, 150, 150};

// The widest that an image may be drawn, and how large the text is. A character with a part for each of 60
// bones is to stay a picture that can be opened.
struct Scale {
    std::uint32_t cell_width, text;
    explicit Scale(std::size_t surfaces)
        : cell_width(surfaces > 24 ? 136 : 376), text(surfaces > 24 ? 1 : 2) {}
    [[nodiscard]] std::uint32_t line() const { return (label_height + 3) * text; }
};

struct Cell {
    std::string label;
    Picture picture;
};

struct Row {
    std::string heading;
    std::array<Cell, columns> cells;
};

Cell make_cell(const char* what, const ImageView& image, const Picture& picture, const Scale& scale) {
    return {std::string(what) + " " + std::to_string(image.width) + "x" + std::to_string(image.height) + " " +
                name(image.format),
            scale_to_fit(picture, scale.cell_width)};
}

Row make_row(const Surface& surface, Mapping mapping, std::string heading, const Scale& scale) {
    const double coverage = depth_statistics(surface.depth, mapping).coverage;
    Row row{std::move(heading) + "  " + percent(coverage) + " of all directions", {}};
    std::size_t column = 0;
    const auto add = [&](const char* what, const ImageView& image, auto draw) {
        row.cells[column++] =
            image.empty() ? Cell{std::string(what) + " absent", {}} : make_cell(what, image, draw(), scale);
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

std::vector<Row> make_rows(const SphericalMap& map, const Scale& scale) {
    std::vector<Row> rows;
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

std::uint32_t picture_height(const Row& row) {
    std::uint32_t height = 0;
    for (const Cell& cell : row.cells) height = std::max(height, cell.picture.height);
    return height;
}

// As wide as the widest picture and label in it.
std::array<std::uint32_t, columns> column_widths(const std::vector<Row>& rows, const Scale& scale) {
    std::array<std::uint32_t, columns> widths{};
    for (const Row& row : rows)
        for (std::size_t c = 0; c < columns; ++c) {
            const auto label = std::uint32_t(row.cells[c].label.size()) * label_advance * scale.text;
            widths[c] = std::max({widths[c], row.cells[c].picture.width, std::min(label, scale.cell_width)});
        }
    return widths;
}

std::string title(const SphericalMap& map, const std::string& file_name) {
    const Part& part = map.parts.front();
    const ImageView& depth = part.layers.front().outer.depth;
    return file_name + "   " + std::to_string(map.parts.size()) +
           (map.parts.size() == 1 ? " part   " : " parts   ") + name(part.mapping) + "   " +
           std::to_string(depth.width) + "x" + std::to_string(depth.height) + " samples";
}

void draw_legend(Picture& sheet, std::uint32_t y, const Scale& scale) {
    const std::uint32_t advance = label_advance * scale.text, bar = 16 * advance;
    std::uint32_t x = margin;
    const auto write = [&](std::string_view text) {
        draw_label(sheet, x, y, text, dim_color, scale.text);
        x += std::uint32_t(text.size()) * advance;
    };
    write("depth r/R 0 ");
    for (std::uint32_t i = 0; i < bar && x + i < sheet.width; ++i)
        for (std::uint32_t v = 0; v < 7 * scale.text; ++v)
            sheet.at(x + i, y + v) = viridis((double(i) + 0.5) / bar);
    x += bar;
    write(" 1   black: no surface   normal xyz as rgb");
}

} // namespace

Picture contact_sheet(const SphericalMap& map, const std::string& file_name) {
    const Scale scale(surface_count(map));
    const std::vector<Row> rows = make_rows(map, scale);
    const std::array<std::uint32_t, columns> widths = column_widths(rows, scale);
    std::uint32_t width = margin;
    for (const std::uint32_t column : widths) width += column + margin;
    std::uint32_t height = 2 * margin + 2 * scale.line();
    for (const Row& row : rows) height += margin + 2 * scale.line() + picture_height(row);
    Picture sheet(width, height, background);

    draw_label(sheet, margin, margin, title(map, file_name), text_color, scale.text);
    draw_legend(sheet, margin + scale.line(), scale);
    std::uint32_t y = margin + 2 * scale.line();
    for (const Row& row : rows) {
        y += margin;
        draw_label(sheet, margin, y, row.heading, text_color, scale.text);
        y += scale.line();
        std::uint32_t x = margin;
        for (std::size_t c = 0; c < columns; ++c) {
            draw_label(sheet, x, y, row.cells[c].label, dim_color, scale.text);
            paste(sheet, row.cells[c].picture, x, y + scale.line());
            x += widths[c] + margin;
        }
        y += scale.line() + picture_height(row);
    }
    return sheet;
}

} // namespace spa::tools
