// SPDX-License-Identifier: Apache-2.0
#include "heat.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spa::tools {

namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

} // namespace

Rgb heat_color(const HeatScale& scale, double value) {
    if (value == 0) return equal_color;
    return viridis(std::clamp(std::log(value / scale.low) / std::log(scale.high / scale.low), 0.0, 1.0));
}

SheetLegend heat_legend(const std::string& missing, const std::string& extra,
                        std::span<const HeatScale> scales) {
    SheetLegend legend;
    for (const HeatScale& scale : scales)
        legend.text(std::string(scale.what) + " " + number(scale.low) + " ")
            .bar(viridis)
            .text(" " + number(scale.high) + " " + scale.unit + "   ");
    const auto mark = [&](Rgb color, const std::string& text) {
        legend.bar([color](double) { return color; }, 2).text(" " + text + "   ");
    };
    legend.new_line();
    mark(equal_color, "equal");
    mark(missing_color, missing);
    mark(extra_color, extra);
    mark(no_surface_color, "no surface");
    return legend;
}

} // namespace spa::tools
