// SPDX-License-Identifier: Apache-2.0
#include "render_compare.h"

#include "heat.h"
#include "render_arguments.h"
#include "render_pictures.h"
#include "text.h"

#include "../libspa/core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t widest_cell = 640;
constexpr HeatScale light_heat{"difference", 1e-3, 1, "of linear light, as exposed"};

std::string size_of(std::uint32_t width, std::uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

std::string figure_text(const ImageFigure& figure, const measure::ImageErrors& errors) {
    const std::optional<double> value = figure.value(errors);
    return value ? significant(*value, 4) : "none";
}

// JSON has no infinity: null stands for what equal pictures have, and for what cannot be formed.
Json figure_json(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

} // namespace

std::string image_figures_text(const measure::ImageErrors& errors) {
    std::string text;
    for (const ImageFigure& figure : image_figures())
        text += (text.empty() ? "" : "   ") + std::string(figure.label) + " " + figure_text(figure, errors);
    return text;
}

const std::vector<Vec3f>* layer_of(const import::LinearPicture& reference, std::string_view name) {
    const import::PictureLayer* const layer = reference.find(name == compared_layers[0] ? "" : name);
    return layer == nullptr ? nullptr : &layer->pixels;
}

std::vector<Vec3f> layer_of(const render::Frame& frame, std::string_view name) {
    if (name == "direct") return frame.direct;
    if (name == "indirect") return frame.indirect;
    return beauty(frame);
}

Json image_figures_json(const measure::ImageErrors& errors) {
    Json json = Json::object();
    for (const ImageFigure& figure : image_figures()) json[figure.name] = figure_json(figure.value(errors));
    return json;
}

Json image_figures_json(const ImageComparison& comparison) {
    Json layers = Json::object();
    for (const LayerComparison& layer : comparison.layers)
        layers[layer.name] = image_figures_json(layer.errors);
    return layers;
}

// clang-format takes a line that begins with `import::` for one of a module.
spa::import::LinearPicture read_reference(const std::filesystem::path& path, const render::Settings& settings,
                                          const std::vector<ImageLimit>& limits) {
    const std::span<const std::string_view> layers(std::begin(compared_layers) + 1,
                                                   std::end(compared_layers));
    spa::import::Limits most;
    most.texture_pixels = max_picture_pixels;
    spa::import::LinearPicture reference = import::read_picture(path, layers, most);
    if (reference.width != settings.width || reference.height != settings.height)
        throw Error(ExitCode::usage, path.string() + ": has " + size_of(reference.width, reference.height) +
                                         " pixels, the picture to render " +
                                         size_of(settings.width, settings.height) + "; give --size " +
                                         size_of(reference.width, reference.height));
    for (const ImageLimit& limit : limits)
        if (layer_of(reference, limit.layer) == nullptr)
            throw Error(ExitCode::usage, "--fail: " + limit_name(limit) +
                                             " cannot be judged: " + path.string() + " has no layer '" +
                                             limit.layer + "'; compare with an EXR that spa render wrote");
    return reference;
}

const LayerComparison& ImageComparison::layer(const std::string& name) const {
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const LayerComparison& layer) { return layer.name == name; });
    return found == layers.end() ? layers.front() : *found;
}

std::vector<ImageLimit> ImageComparison::missed() const {
    std::vector<ImageLimit> result;
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(result),
                 [&](const ImageLimit& limit) { return !met(limit, layer(limit.layer).errors); });
    return result;
}

ImageComparison compare_with(const render::Frame& frame, const import::LinearPicture& reference,
                             const std::string& reference_name, double exposure,
                             const std::vector<ImageLimit>& limits) {
    ImageComparison comparison{frame.width, frame.height, exposure, {}, limits};
    for (const std::string_view name : compared_layers) {
        const std::vector<Vec3f>* const pixels = layer_of(reference, name);
        if (pixels == nullptr) continue;
        LayerComparison layer{std::string(name), layer_of(frame, name), *pixels, {}};
        try {
            layer.errors =
                measure::image_errors({frame.width, frame.height, layer.picture},
                                      {frame.width, frame.height, layer.reference}, {.exposure = exposure});
        } catch (const Error& error) {
            throw Error(error.code(),
                        "--compare " + reference_name + ": " + layer.name + ": " + error.what());
        }
        comparison.layers.push_back(std::move(layer));
    }
    return comparison;
}

Picture light_difference(std::uint32_t width, std::uint32_t height, const std::vector<Vec3f>& a,
                         const std::vector<Vec3f>& b, double exposure) {
    Picture picture(width, height, {});
    const double scale = std::exp2(exposure);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Vec3d d = (to_double(a[i]) - to_double(b[i])) * scale;
        picture.pixels[i] = heat_color(light_heat, std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    }
    return picture;
}

SheetLegend light_difference_legend() {
    SheetLegend legend;
    legend.text(std::string(light_heat.what) + " " + significant(light_heat.low, 3) + " ")
        .bar(viridis)
        .text(" " + significant(light_heat.high, 3) + "   ")
        .bar([](double) { return equal_color; }, 2)
        .text(" equal   " + std::string(light_heat.unit));
    return legend;
}

Picture comparison_sheet(const ImageComparison& comparison, const std::string& title) {
    SheetScale scale(comparison.layers.size());
    scale.cell_width = std::clamp(comparison.width, scale.cell_width, widest_cell);
    std::vector<SheetRow> rows;
    for (const LayerComparison& layer : comparison.layers) {
        const auto shown = [&](const std::vector<Vec3f>& pixels) {
            return tone_map(comparison.width, comparison.height, pixels, comparison.exposure);
        };
        rows.push_back({layer.name + "   " + image_figures_text(layer.errors),
                        {make_cell("rendered", shown(layer.picture), scale),
                         make_cell("reference", shown(layer.reference), scale),
                         make_cell("difference",
                                   light_difference(comparison.width, comparison.height, layer.picture,
                                                    layer.reference, comparison.exposure),
                                   scale)}});
    }
    return lay_out_sheet(title, light_difference_legend(), rows, scale);
}

Json comparison_json(const ImageComparison& comparison, const std::string& reference) {
    Json limits = Json::array();
    for (const ImageLimit& limit : comparison.limits) {
        const measure::ImageErrors& errors = comparison.layer(limit.layer).errors;
        limits.push_back({{"figure", limit_name(limit)},
                          {"limit", limit.value},
                          {"value", figure_json(limit.figure->value(errors))},
                          {"met", met(limit, errors)}});
    }
    return {{"reference", reference}, {"figures", image_figures_json(comparison)}, {"fail", limits}};
}

std::string comparison_text(const ImageComparison& comparison, const std::string& reference,
                            std::size_t label_width) {
    std::string text = pad_right("compared", label_width) + "with " + reference + "\n";
    for (const LayerComparison& layer : comparison.layers)
        text += pad_right("  " + layer.name, label_width) + image_figures_text(layer.errors) + "\n";
    return text;
}

std::string limit_sentence(const ImageComparison& comparison, const ImageLimit& limit) {
    return limit_name(limit) + " is " + figure_text(*limit.figure, comparison.layer(limit.layer).errors) +
           (limit.figure->larger_is_better ? ", below " : ", above ") + significant(limit.value, 4) + " (" +
           limit.figure->description + ")";
}

} // namespace spa::tools
