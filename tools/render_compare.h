// SPDX-License-Identifier: Apache-2.0
// A rendered frame beside a reference picture: figures, limits, and a sheet for people.
#pragma once

#include "picture.h"
#include "render_limits.h"
#include "sheet_layout.h"

#include "../formats/import/linear_picture.h"
#include "../libspa/render/render.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace spa::tools {

// Reads --compare REF. Throws Error: as import::read_picture; usage if its size is another than the frame's
// will be, or if it lacks a layer that a limit names.
spa::import::LinearPicture read_reference(const std::filesystem::path& path, const render::Settings& settings,
                                          const std::vector<ImageLimit>& limits);

struct LayerComparison {
    std::string name; // of compared_layers
    std::vector<Vec3f> picture, reference;
    measure::ImageErrors errors;
};

struct ImageComparison {
    std::uint32_t width = 0, height = 0;
    double exposure = 0;
    std::vector<LayerComparison> layers; // the picture itself first
    std::vector<ImageLimit> limits;

    [[nodiscard]] const LayerComparison& layer(const std::string& name) const;
    [[nodiscard]] std::vector<ImageLimit> missed() const;
};

// Of the layers that the reference has. Throws Error{invalid_data} as measure::image_errors, with the name of
// the reference.
ImageComparison compare_with(const render::Frame& frame, const import::LinearPicture& reference,
                             const std::string& reference_name, double exposure,
                             const std::vector<ImageLimit>& limits);

// Where two pictures of linear light differ, as colours: the largest difference of the three channels, as
// exposed. And what the colours mean.
Picture light_difference(std::uint32_t width, std::uint32_t height, const std::vector<Vec3f>& a,
                         const std::vector<Vec3f>& b, double exposure);
SheetLegend light_difference_legend();

// One row a layer: the picture, the reference, and where they differ.
Picture comparison_sheet(const ImageComparison& comparison, const std::string& title);

nlohmann::ordered_json comparison_json(const ImageComparison& comparison, const std::string& reference);
// Lines for people; label_width: of the report's first column.
std::string comparison_text(const ImageComparison& comparison, const std::string& reference,
                            std::size_t label_width);
// The figures of one layer: image_figures() by name, and as a line for people.
nlohmann::ordered_json image_figures_json(const measure::ImageErrors& errors);
std::string image_figures_text(const measure::ImageErrors& errors);
// The figures of each layer, by its name.
nlohmann::ordered_json image_figures_json(const ImageComparison& comparison);
// The frame's layer of a name of compared_layers; the reference's, null if it has none.
std::vector<Vec3f> layer_of(const render::Frame& frame, std::string_view name);
const std::vector<Vec3f>* layer_of(const import::LinearPicture& reference, std::string_view name);
// "indirect.relmse is 0.02, above 0.01 (what it is)"
std::string limit_sentence(const ImageComparison& comparison, const ImageLimit& limit);

} // namespace spa::tools
