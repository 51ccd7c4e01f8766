// SPDX-License-Identifier: Apache-2.0
// Errors as colours: a logarithmic scale, and marks for samples that only one side has.
#pragma once

#include "picture.h"
#include "sheet_layout.h"

#include <array>
#include <span>
#include <string>

namespace spa::tools {

// Values at or below `low` are darkest, at or above `high` brightest.
struct HeatScale {
    const char* what;
    double low, high;
    const char* unit;
};

constexpr HeatScale depth_heat{"distance", 1e-6, 1, "R"};
constexpr HeatScale normal_heat{"angle", 1e-2, 90, "deg"};
constexpr HeatScale color_heat{"colour", 1, 255, "codes"};
inline constexpr std::array heat_scales{depth_heat, normal_heat, color_heat};

// unknown_color is that of the sheet behind.
constexpr Rgb no_surface_color{0, 0, 0}, unknown_color{30, 30, 34}, equal_color{70, 70, 76},
    missing_color{255, 60, 60}, extra_color{255, 60, 255};

// viridis of log(value) between the ends of the scale; equal_color for 0.
Rgb heat_color(const HeatScale& scale, double value);

// The scales and what the marks mean. missing, extra: texts for the two marks.
SheetLegend heat_legend(const std::string& missing, const std::string& extra,
                        std::span<const HeatScale> scales = heat_scales);

} // namespace spa::tools
