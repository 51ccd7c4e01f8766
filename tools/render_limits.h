// SPDX-License-Identifier: Apache-2.0
// The figures that `spa render --compare` prints, and the limits it judges them by.
#pragma once

#include "../libspa/measure/image_errors.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

struct ImageFigure {
    const char* name; // as on the command line and in the report
    const char* label;
    const char* description; // one line
    bool larger_is_better;
    std::optional<double> (*value)(const measure::ImageErrors&); // none: cannot be formed
};
std::span<const ImageFigure> image_figures();

// What is compared: the picture itself and, where the reference has them, the light that it is the sum of.
inline constexpr std::string_view compared_layers[] = {"beauty", "direct", "indirect"};

struct ImageLimit {
    const ImageFigure* figure;
    std::string layer; // of compared_layers
    double value;      // the figure is at most this, or at least where larger is better
};
// As on the command line: "relmse" of the picture itself, "indirect.relmse".
std::string limit_name(const ImageLimit& limit);
// A figure that cannot be formed meets no limit.
bool met(const ImageLimit& limit, const measure::ImageErrors& errors);

// text: "NAME=VALUE[,NAME=VALUE...]". Throws Error{usage} whose message starts with `option`.
std::vector<ImageLimit> parse_image_limits(const std::string& option, const std::string& text);

} // namespace spa::tools
