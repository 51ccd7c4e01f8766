// SPDX-License-Identifier: Apache-2.0
#include "paper_figures.h"

#include "render_pictures.h"
#include "sheet_layout.h"
#include "text.h"

#include "../libspa/bake/crossings.h"
#include "../libspa/measure/image_errors.h"

#include <algorithm>
#include <array>

namespace spa::tools {
namespace {

constexpr std::array<const char*, 6> columns{triangles_name, "fan 1",  "fan 3",
                                             "fan 5",        "fan 10", "projective"};
constexpr std::uint32_t least_cell_width = 320; // what the labels need
constexpr double indirect_exposure = 1;         // stops: it is a fraction of the light

measure::ImageRef picture(const render::Frame& frame, const std::vector<Vec3f>& pixels) {
    return {frame.width, frame.height, pixels};
}

class Figure {
public:
    Figure(const render::Gpu& gpu, const PaperFigure& figure, const FigureOptions& options,
           std::vector<FigureError>& errors)
        : gpu_(gpu), figure_(figure), options_(options), errors_(errors), scale_(2 * figure.scenes.size()) {
        scale_.cell_width = std::max(options.width, least_cell_width);
    }

    Picture draw() {
        for (const auto& scene : figure_.scenes) add_scene(scene());
        SheetLegend legend;
        legend.text("relMSE: of the " + light_name() + " against triangles with the same directions. ");
        legend.text(std::to_string(options_.samples) + " secondary rays a pixel");
        return lay_out_sheet(figure_.title, legend, rows_, scale_);
    }

private:
    [[nodiscard]] std::string light_name() const {
        return figure_.direct ? "direct light" : "indirect light";
    }
    [[nodiscard]] const std::vector<Vec3f>& judged(const render::Frame& frame) const {
        return figure_.direct ? frame.direct : frame.indirect;
    }

    void add_scene(const PaperScene& scene) {
        SheetRow& pictures = rows_.emplace_back(SheetRow{scene.title, {}});
        SheetRow lights{light_name() + " alone" + (figure_.direct ? "" : ", twice as bright"), {}};
        render::Frame truth;
        const Model object = object_model(scene);
        for (const MapKind kind : {MapKind::none, MapKind::paper, MapKind::one_layer}) {
            bake::OwnedMap map;
            if (kind != MapKind::none) map = bake_for(object, kind);
            const auto device_scene =
                on_device(gpu_, scene.scene, scene.object, kind == MapKind::none ? nullptr : &map.map, true);
            for (const char* const name : columns) {
                const PaperMethod& method = paper_method(name);
                if (method.map != kind) continue;
                step(scene.title + ", " + name);
                render::Settings settings =
                    settings_of(method, scene.camera, options_.width, options_.height);
                settings.samples = options_.samples;
                settings.backend = options_.backend;
                const render::Frame frame = render::render(gpu_, *device_scene, settings);
                if (kind == MapKind::none) truth = frame;
                add_cells(scene, method, frame, truth, pictures, lights);
            }
        }
        rows_.push_back(std::move(lights));
    }

    void add_cells(const PaperScene& scene, const PaperMethod& method, const render::Frame& frame,
                   const render::Frame& truth, SheetRow& pictures, SheetRow& lights) {
        const double exposure = figure_.direct ? 0 : indirect_exposure;
        const std::vector<Vec3f> light = judged(frame);
        std::string label = method.name;
        if (method.map != MapKind::none) {
            const std::vector<Vec3f> all = beauty(frame);
            const std::vector<Vec3f> all_truth = beauty(truth);
            const FigureError error{
                figure_.file, scene.title, method.name,
                measure::image_errors(picture(frame, light), picture(truth, judged(truth))).rel_mse,
                measure::image_errors(picture(frame, all), picture(truth, all_truth)).psnr};
            errors_.push_back(error);
            label += ": relMSE " + significant(error.relmse, 2);
        }
        pictures.cells.push_back(
            make_cell(label, tone_map(frame.width, frame.height, beauty(frame), 0), scale_));
        lights.cells.push_back(
            make_cell(method.name, tone_map(frame.width, frame.height, light, exposure), scale_));
    }

    void step(const std::string& what) {
        const double all = double(columns.size() * figure_.scenes.size());
        if (options_.progress && !options_.progress(done_++ / all, what)) throw bake::Cancelled();
    }

    const render::Gpu& gpu_;
    const PaperFigure& figure_;
    const FigureOptions& options_;
    std::vector<FigureError>& errors_;
    SheetScale scale_;
    std::vector<SheetRow> rows_;
    double done_ = 0;
};

} // namespace

Picture draw_figure(const render::Gpu& gpu, const PaperFigure& figure, const FigureOptions& options,
                    std::vector<FigureError>& errors) {
    return Figure(gpu, figure, options, errors).draw();
}

} // namespace spa::tools
