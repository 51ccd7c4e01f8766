// SPDX-License-Identifier: Apache-2.0
// Pictures in labelled rows and columns: the layout that all sheets share.
#pragma once

#include "picture.h"

#include <functional>
#include <string>
#include <vector>

namespace spa::tools {

struct SheetCell {
    std::string label;
    Picture picture; // as it will appear (make_cell); may be empty
};

struct SheetRow {
    std::string heading;
    std::vector<SheetCell> cells;
};

// The widest that a picture may be drawn, and how large the text is. A character with a part for each of 60
// bones is to stay a picture that can be opened.
struct SheetScale {
    std::uint32_t cell_width, text;
    explicit SheetScale(std::size_t rows) : cell_width(rows > 24 ? 136 : 376), text(rows > 24 ? 1 : 2) {}
};

// The picture scaled to fit a cell.
SheetCell make_cell(std::string label, const Picture& picture, const SheetScale& scale);

// What colours mean, below the title: lines of texts and colour bars.
class SheetLegend {
public:
    SheetLegend& text(std::string text);
    SheetLegend& new_line();
    // color: of [0,1], from left to right. width: in characters.
    SheetLegend& bar(std::function<Rgb(double)> color, std::uint32_t width = 16);

private:
    friend Picture lay_out_sheet(const std::string& title, const SheetLegend& legend,
                                 const std::vector<SheetRow>& rows, const SheetScale& scale);
    struct Item {
        std::string text;
        std::function<Rgb(double)> color; // empty: text
        std::uint32_t width;              // in characters
    };
    std::vector<std::vector<Item>> lines_{1};
};

Picture lay_out_sheet(const std::string& title, const SheetLegend& legend, const std::vector<SheetRow>& rows,
                      const SheetScale& scale);

} // namespace spa::tools
