// SPDX-License-Identifier: Apache-2.0
// The limits that `spa compare` judges by: figures of a comparison, by name.
#pragma once

#include "../libspa/measure/compare.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

struct ComparedFigure {
    const char* name;                                        // as on the command line and in the report
    const char* description;                                 // one line
    double (*of_surface)(const measure::SurfaceDifference&); // null: a figure of the part
    double (*of_part)(const measure::PartDifference&);       // null: a figure of the surface
};

// Everything that is compared. 0 means no difference.
std::span<const ComparedFigure> compared_figures();

// The worst value over all parts and surfaces.
double worst(const ComparedFigure& figure, const measure::MapDifference& difference);

struct Limit {
    const ComparedFigure* figure;
    double value;
};

// text: "NAME=VALUE[,NAME=VALUE...]". Throws Error{usage} whose message starts with `option`.
std::vector<Limit> parse_limits(const std::string& option, const std::string& text);

// Those that the difference exceeds.
std::vector<Limit> exceeded(const std::vector<Limit>& limits, const measure::MapDifference& difference);

} // namespace spa::tools
