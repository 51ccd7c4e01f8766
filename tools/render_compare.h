// SPDX-License-Identifier: Apache-2.0
// A rendered frame beside a reference picture: figures, limits, and a sheet for people.
#pragma once

#include "picture.h"
#include "render_limits.h"

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

// One row a layer: the picture, the reference, and where they differ.
Picture comparison_sheet(const ImageComparison& comparison, const std::string& title);

// Of each layer, by name.
nlohmann::ordered_json figures_json(const ImageComparison& comparison);
// One line, without the layer.
std::string figures_text(const measure::ImageErrors& errors);

nlohmann::ordered_json comparison_json(const ImageComparison& comparison, const std::string& reference);
// Lines for people; label_width: of the report's first column.
std::string comparison_text(const ImageComparison& comparison, const std::string& reference,
                            std::size_t label_width);
// "indirect.relmse is 0.02, above 0.01 (what it is)"
std::string limit_sentence(const ImageComparison& comparison, const ImageLimit& limit);

} // namespace spa::tools
