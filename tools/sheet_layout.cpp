// SPDX-License-Identifier: Apache-2.0
#include "sheet_layout.h"

#include "label.h"

#include <algorithm>
#include <utility>

namespace spa::tools {

namespace {

constexpr std::uint32_t margin = 16;
constexpr Rgb background{30, 30, 34}, text_color{225, 225, 225}, dim_color{150, 150, 150};

std::uint32_t line_height(const SheetScale& scale) { return (label_height + 3) * scale.text; }

std::uint32_t picture_height(const SheetRow& row) {
    std::uint32_t height = 0;
    for (const SheetCell& cell : row.cells) height = std::max(height, cell.picture.height);
    return height;
}

// As wide as the widest picture and label in it.
std::vector<std::uint32_t> column_widths(const std::vector<SheetRow>& rows, const SheetScale& scale) {
    std::vector<std::uint32_t> widths;
    for (const SheetRow& row : rows) {
        widths.resize(std::max(widths.size(), row.cells.size()), 0);
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            const auto label = std::uint32_t(row.cells[c].label.size()) * label_advance * scale.text;
            widths[c] = std::max({widths[c], row.cells[c].picture.width, std::min(label, scale.cell_width)});
        }
    }
    return widths;
}

} // namespace

SheetCell make_cell(std::string label, const Picture& picture, const SheetScale& scale) {
    return {std::move(label), scale_to_fit(picture, scale.cell_width)};
}

SheetLegend& SheetLegend::text(std::string text) {
    const auto width = std::uint32_t(text.size());
    lines_.back().push_back({std::move(text), {}, width});
    return *this;
}

SheetLegend& SheetLegend::new_line() {
    lines_.emplace_back();
    return *this;
}

SheetLegend& SheetLegend::bar(std::function<Rgb(double)> color, std::uint32_t width) {
    lines_.back().push_back({{}, std::move(color), width});
    return *this;
}

Picture lay_out_sheet(const std::string& title, const SheetLegend& legend, const std::vector<SheetRow>& rows,
                      const SheetScale& scale) {
    const std::vector<std::uint32_t> widths = column_widths(rows, scale);
    const std::uint32_t line = line_height(scale);
    std::uint32_t width = margin;
    for (const std::uint32_t column : widths) width += column + margin;
    for (const auto& items : legend.lines_) {
        std::uint32_t characters = 0;
        for (const SheetLegend::Item& item : items) characters += item.width;
        width = std::max(width, 2 * margin + characters * label_advance * scale.text);
    }
    std::uint32_t height = 2 * margin + (1 + std::uint32_t(legend.lines_.size())) * line;
    for (const SheetRow& row : rows) height += margin + 2 * line + picture_height(row);
    Picture sheet(width, height, background);

    draw_label(sheet, margin, margin, title, text_color, scale.text);
    std::uint32_t y = margin + line;
    for (const auto& items : legend.lines_) {
        std::uint32_t x = margin;
        for (const SheetLegend::Item& item : items) {
            const std::uint32_t length = item.width * label_advance * scale.text;
            draw_label(sheet, x, y, item.text, dim_color, scale.text);
            for (std::uint32_t i = 0; item.color && i < length && x + i < sheet.width; ++i)
                for (std::uint32_t v = 0; v < 7 * scale.text; ++v)
                    sheet.at(x + i, y + v) = item.color((double(i) + 0.5) / length);
            x += length;
        }
        y += line;
    }
    for (const SheetRow& row : rows) {
        y += margin;
        draw_label(sheet, margin, y, row.heading, text_color, scale.text);
        y += line;
        std::uint32_t x = margin;
        for (std::size_t c = 0; c < row.cells.size(); ++c) {
            draw_label(sheet, x, y, row.cells[c].label, dim_color, scale.text);
            paste(sheet, row.cells[c].picture, x, y + line);
            x += widths[c] + margin;
        }
        y += line + picture_height(row);
    }
    return sheet;
}

} // namespace spa::tools
