// SPDX-License-Identifier: Apache-2.0
#include "render_limits.h"

#include "arguments.h"

#include <algorithm>
#include <array>

namespace spa::tools {

namespace {

using measure::ImageErrors;

constexpr std::array<ImageFigure, 4> figures{{
    {"relmse", "relMSE", "mean squared error of linear light, relative to the reference", false,
     [](const ImageErrors& e) { return std::optional(e.rel_mse); }},
    {"rmse", "RMSE", "root of the mean squared error of linear light", false,
     [](const ImageErrors& e) { return std::optional(e.rmse); }},
    {"psnr", "PSNR", "peak signal to noise of the pictures as they are looked at, dB", true,
     [](const ImageErrors& e) { return std::optional(e.psnr); }},
    {"ssim", "SSIM", "structural similarity of the pictures as they are looked at", true,
     [](const ImageErrors& e) { return e.ssim; }},
}};

ImageLimit parse_limit(const std::string& option, std::string_view item) {
    const std::size_t equals = item.find('=');
    const std::string_view name = item.substr(0, equals);
    const std::size_t dot = name.find('.');
    const std::string_view layer = dot == std::string_view::npos ? compared_layers[0] : name.substr(0, dot);
    const std::string_view figure_name = dot == std::string_view::npos ? name : name.substr(dot + 1);
    const auto* const figure = std::find_if(figures.begin(), figures.end(),
                                            [&](const ImageFigure& f) { return f.name == figure_name; });
    const auto* const known = std::find(std::begin(compared_layers), std::end(compared_layers), layer);
    if (figure == figures.end() || known == std::end(compared_layers) || equals == std::string_view::npos) {
        std::string message = option + ": '" + std::string(item) + "' is not NAME=VALUE with a NAME out of ";
        for (const ImageFigure& f : figures)
            message += std::string(&f == figures.data() ? "" : ", ") + f.name;
        throw Error(ExitCode::usage,
                    message + ", of the picture, or with direct. or indirect. before it, of that light");
    }
    return {figure, std::string(layer), parse_measure(option, std::string(item.substr(equals + 1)))};
}

} // namespace

std::span<const ImageFigure> image_figures() { return figures; }

std::string limit_name(const ImageLimit& limit) {
    return (limit.layer == compared_layers[0] ? "" : limit.layer + ".") + limit.figure->name;
}

bool met(const ImageLimit& limit, const measure::ImageErrors& errors) {
    const std::optional<double> value = limit.figure->value(errors);
    if (!value) return false;
    return limit.figure->larger_is_better ? *value >= limit.value : *value <= limit.value;
}

std::vector<ImageLimit> parse_image_limits(const std::string& option, const std::string& text) {
    std::vector<ImageLimit> limits;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        limits.push_back(parse_limit(option, std::string_view(text).substr(begin, end - begin)));
        begin = end + 1;
    }
    return limits;
}

} // namespace spa::tools
