// SPDX-License-Identifier: Apache-2.0
#include "render_frames.h"

#include "render_pictures.h"
#include "sheet_layout.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t frames_a_row = 8;
constexpr Rgb nothing_color{70, 74, 82};
constexpr std::uint32_t narrowest_cell = 96, widest_cell = 376;

// clang-format takes a line that begins with `import::` for one of a module.
spa::import::LinearPicture picture_of(const render::Frame& frame) {
    return {frame.width,
            frame.height,
            {{"", beauty(frame)}, {"direct", frame.direct}, {"indirect", frame.indirect}}};
}

render::Settings triangles_alone(render::Settings settings) {
    settings.primary = settings.shadow = settings.secondary = render::Geometry::triangles;
    return settings;
}

void add(render::FrameTimes& sum, const render::FrameTimes& times) {
    sum.compile += times.compile;
    sum.primary += times.primary;
    sum.secondary += times.secondary;
    sum.primary_rays += times.primary_rays;
    sum.secondary_rays += times.secondary_rays;
    sum.shadow_rays += times.shadow_rays;
}

std::vector<bool> seen(const render::Frame& frame) { return {frame.kind.begin(), frame.kind.end()}; }

// What nothing is seen at is grey, so that a dark side has an outline.
Picture shown(const ImageComparison& comparison, const std::vector<Vec3f>& pixels,
              const std::vector<bool>& is_seen) {
    Picture picture = tone_map(comparison.width, comparison.height, pixels, comparison.exposure);
    for (std::size_t i = 0; i < is_seen.size(); ++i)
        if (!is_seen[i] && picture.pixels[i] == Rgb{}) picture.pixels[i] = nothing_color;
    return picture;
}

// The two figures of a label under a picture.
std::string figures_label(const AnimationFrame& frame) {
    const measure::ImageErrors& errors = frame.comparison.layers.front().errors;
    return "relMSE " + significant(errors.rel_mse, 2) + "  " + fixed(errors.psnr, 1) + " dB";
}

} // namespace

std::vector<AnimationFrame> render_frames(const RenderArguments& arguments, const render::Gpu& gpu,
                                          Scene& scene, const std::vector<PlacedMap>& maps,
                                          const render::Settings& settings, std::size_t animation,
                                          const std::vector<double>& times, render::DeviceScene& device_scene,
                                          render::FrameTimes& frame_times,
                                          const std::function<bool(double)>& progress) {
    render::DeviceScene triangles(gpu, scene, {}, true);
    std::vector<AnimationFrame> frames;
    bool goes_on = true;
    // Two pictures a frame.
    const auto part_of_all = [&](std::size_t picture) {
        return [&, picture](double share) {
            return goes_on = progress((double(picture) + share) / double(2 * times.size()));
        };
    };
    for (std::size_t i = 0; i < times.size(); ++i) {
        pose_scene(scene, animation, times[i]);
        triangles.pose(gpu, scene, {});
        const render::Frame reference =
            render::render(gpu, triangles, triangles_alone(settings), nullptr, part_of_all(2 * i));
        if (!goes_on) return frames;
        device_scene.pose(gpu, scene, placements(scene, maps, {}, arguments));
        render::FrameTimes own;
        const render::Frame frame = render::render(gpu, device_scene, settings, &own, part_of_all(2 * i + 1));
        if (!goes_on) return frames;
        add(frame_times, own);
        frames.push_back({times[i], device_scene.times().top_level,
                          compare_with(frame, picture_of(reference), "the triangles", arguments.exposure, {}),
                          seen(reference), seen(frame)});
    }
    return frames;
}

Picture frames_sheet(const std::vector<AnimationFrame>& frames, const std::string& title) {
    SheetScale scale(2);
    scale.text = 1;
    scale.cell_width = std::clamp(frames.front().comparison.width, narrowest_cell, widest_cell);
    std::vector<SheetRow> rows;
    for (std::size_t first = 0; first < frames.size(); first += frames_a_row) {
        SheetRow top{"triangles, skinned", {}}, below{"maps", {}};
        for (std::size_t i = first; i < std::min(first + frames_a_row, frames.size()); ++i) {
            const ImageComparison& comparison = frames[i].comparison;
            const LayerComparison& picture = comparison.layers.front();
            top.cells.push_back(make_cell(fixed(frames[i].time, 3) + " s",
                                          shown(comparison, picture.reference, frames[i].triangles_seen),
                                          scale));
            below.cells.push_back(make_cell(figures_label(frames[i]),
                                            shown(comparison, picture.picture, frames[i].maps_seen), scale));
        }
        rows.push_back(std::move(top));
        rows.push_back(std::move(below));
    }
    SheetLegend legend;
    legend.text("error of each picture by maps against the one above it");
    return lay_out_sheet(title, legend, rows, scale);
}

Json frames_json(const std::vector<AnimationFrame>& frames) {
    Json json = Json::array();
    for (const AnimationFrame& frame : frames)
        json.push_back({{"time", frame.time},
                        {"pose_seconds", frame.pose_seconds},
                        {"figures", image_figures_json(frame.comparison)}});
    return json;
}

std::string frames_text(const std::vector<AnimationFrame>& frames, std::size_t label_width) {
    std::string text;
    for (std::size_t i = 0; i < frames.size(); ++i)
        text += pad_right(i == 0 ? "frames" : "", label_width) + fixed(frames[i].time, 3) + " s   " +
                image_figures_text(frames[i].comparison.layers.front().errors) + "\n";
    return text;
}

} // namespace spa::tools
