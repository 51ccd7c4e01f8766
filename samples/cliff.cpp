// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace spa::samples {
namespace {

// Plateaus on a grid of latitude bands and sectors: polar caps of middle height, between them high and low
// ones in turn. A cliff leads from one to the next within `width` radians: it leans just enough to be seen
// from the centre. At 256 octahedral cells a texel is about that wide.
constexpr double width = 0.01;
constexpr std::uint32_t bands = 5, sectors = 8;
constexpr double high = 1.0, low = 0.6, cap = 0.8;

bool is_cap(std::uint32_t band) { return band == 0 || band == bands - 1; }

double plateau_radius(std::uint32_t band, std::uint32_t sector) {
    if (is_cap(band)) return cap;
    return (band + sector) % 2 == 0 ? high : low;
}

Vec4f plateau_color(std::uint32_t band, std::uint32_t sector) {
    if (is_cap(band)) return srgb(130, 80, 170);
    return (band + sector) % 2 == 0 ? srgb(235, 130, 40) : srgb(30, 150, 160);
}

class Builder {
public:
    explicit Builder(std::uint32_t cells) : cells_(cells) {}

    Model build() && {
        const std::uint32_t rows = bands * (cells_ + 1), columns = sectors * (cells_ + 1);
        for (std::uint32_t i = 0; i + 1 < rows; ++i)
            for (std::uint32_t j = 0; j < columns; ++j) add_cell(i, j, (j + 1) % columns);
        set_smooth_normals(model_);
        return std::move(model_);
    }

private:
    std::uint32_t band(std::uint32_t row) const { return row / (cells_ + 1); }
    std::uint32_t sector(std::uint32_t column) const { return column / (cells_ + 1); }
    bool is_pole(std::uint32_t row) const { return row == 0 || row + 1 == bands * (cells_ + 1); }

    // Rows and columns come in runs of cells_ + 1, one run a plateau, half a cliff away from its borders.
    double angle(std::uint32_t index, double run_angle) const {
        const std::uint32_t run = index / (cells_ + 1), step = index % (cells_ + 1);
        return run * run_angle + width / 2 + (run_angle - width) * step / cells_;
    }

    Vec3d position(std::uint32_t row, std::uint32_t column) const {
        const double radius = plateau_radius(band(row), sector(column));
        if (is_pole(row)) return {0, row == 0 ? radius : -radius, 0};
        const double theta = angle(row, std::numbers::pi / bands);
        const double phi = angle(column, 2 * std::numbers::pi / sectors);
        return Vec3d{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)} *
               radius;
    }

    // face: the plateau or cliff facet that the vertex belongs to; others repeat it, for the crease.
    std::uint32_t vertex(std::uint32_t face, std::uint32_t row, std::uint32_t column, Vec4f color) {
        if (is_pole(row)) column = 0;
        const auto [entry, is_new] = vertices_.try_emplace({face, row, column}, 0);
        if (is_new) entry->second = add_vertex(model_, position(row, column), color);
        return entry->second;
    }

    void add_cell(std::uint32_t row, std::uint32_t column, std::uint32_t next_column) {
        const std::uint32_t b = band(row), s = sector(column);
        const bool same_band = b == band(row + 1);
        const bool same_sector = s == sector(next_column) || (is_cap(b) && same_band);
        if (same_band && same_sector)
            add_quad_cell(b * sectors + (is_cap(b) ? 0 : s), row, column, next_column, plateau_color(b, s));
        else if (same_band || same_sector)
            add_quad_cell(bands * sectors + facets_++, row, column, next_column, cliff_color_);
        else
            add_corner(row, column, next_column);
    }

    void add_quad_cell(std::uint32_t face, std::uint32_t row, std::uint32_t column, std::uint32_t next_column,
                       Vec4f color) {
        const Quad quad{vertex(face, row, column, color), vertex(face, row, next_column, color),
                        vertex(face, row + 1, column, color), vertex(face, row + 1, next_column, color)};
        if (quad.top_left == quad.top_right)
            add_triangle(model_, quad.top_left, quad.bottom_left, quad.bottom_right);
        else if (quad.bottom_left == quad.bottom_right)
            add_triangle(model_, quad.top_left, quad.bottom_left, quad.top_right);
        else
            add_quad(model_, quad);
    }

    // Where four plateaus meet: a saddle so steep that its two triangles share no normal.
    void add_corner(std::uint32_t row, std::uint32_t column, std::uint32_t next_column) {
        const std::uint32_t left = bands * sectors + facets_++, right = bands * sectors + facets_++;
        add_triangle(model_, vertex(left, row, column, cliff_color_),
                     vertex(left, row + 1, column, cliff_color_),
                     vertex(left, row + 1, next_column, cliff_color_));
        add_triangle(model_, vertex(right, row, column, cliff_color_),
                     vertex(right, row + 1, next_column, cliff_color_),
                     vertex(right, row, next_column, cliff_color_));
    }

    const Vec4f cliff_color_ = srgb(235, 235, 225);
    std::uint32_t cells_; // a side of a plateau
    std::uint32_t facets_ = 0;
    Model model_ = empty_model("plateaus");
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> vertices_;
};

} // namespace

Model make_cliff(int level) { return Builder(1U << level).build(); }

} // namespace spa::samples
