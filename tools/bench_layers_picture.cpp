// SPDX-License-Identifier: Apache-2.0
#include "bench_layers_picture.h"

#include "heat.h"
#include "sheet_layout.h"
#include "text.h"
#include "thumbnail.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spa::tools {

namespace {

using measure::LayerView;
using measure::RayAnswer;
using measure::Reconstruction;

// From over the viewer's left shoulder. eye: towards the viewer, unit.
Vec3f light_for(Vec3d eye) {
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, eye));
    const Vec3d up = cross(eye, right);
    return to_float(normalize(eye + up * 0.5 - right * 0.5));
}

Picture draw(const LayerView& view, const std::vector<RayAnswer>& answers) {
    Picture picture(view.side, view.side, thumbnail_background);
    const Vec3f light = light_for(normalize(to_double(view.rays.front().origin)));
    const SrgbEncoder encode;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const RayAnswer& answer = answers[i];
        if (!answer.hits()) continue;
        constexpr Vec3f clay{0.6F, 0.6F, 0.6F};
        const Vec3f color = answer.color[3] == 0
                                ? clay
                                : Vec3f{srgb_to_linear(answer.color[0]), srgb_to_linear(answer.color[1]),
                                        srgb_to_linear(answer.color[2])};
        // The backs of open meshes are seen too.
        const bool back = dot(answer.normal, view.rays[i].direction) > 0;
        const float cosine = dot(back ? -answer.normal : answer.normal, light);
        const float length = std::sqrt(dot(answer.normal, answer.normal));
        const float lit = length > 0 ? std::max(cosine / length, 0.0F) : 0;
        const Vec3f seen = color * (0.1F + 0.75F * lit);
        picture.pixels[i] = {encode(seen.x), encode(seen.y), encode(seen.z)};
    }
    return picture;
}

Picture draw_errors(const LayerView& view, const std::vector<RayAnswer>& answers) {
    Picture picture(view.side, view.side, no_surface_color);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const bool expected = view.source[i].hits(), hit = answers[i].hits();
        if (expected && hit)
            picture.pixels[i] =
                heat_color(depth_heat, std::abs(double(answers[i].t) - double(view.source[i].t)) *
                                           length(to_double(view.rays[i].direction)));
        else if (expected || hit)
            picture.pixels[i] = expected ? missing_color : extra_color;
    }
    return picture;
}

std::string error_label(const measure::LayersMesh& mesh, Reconstruction kind, std::uint32_t layers) {
    const measure::LayerRow* const row = mesh.benchmark.find(kind, layers, mesh.benchmark.view.cells);
    if (row == nullptr) return "error";
    const measure::LayerFigures figures = figures_of(*row);
    return "error: " + fixed(100 * figures.false_hits, 2) + "% false, " +
           fixed(100 * figures.missed_hits, 2) + "% miss";
}

} // namespace

Picture layers_sheet(const measure::LayersMesh& mesh) {
    const LayerView& view = mesh.benchmark.view;
    const SheetScale scale(1);
    const std::string layers =
        view.layers == 1 ? "one interval"
                         : (view.layers == 2 ? "two" : std::to_string(view.layers)) + std::string(" layers");
    const SheetRow row{
        "as a camera sees them; the percentages are of random chords",
        {make_cell("source", draw(view, view.source), scale),
         make_cell("one depth", draw(view, view.one_depth), scale),
         make_cell(error_label(mesh, Reconstruction::one_depth, 1), draw_errors(view, view.one_depth), scale),
         make_cell(layers + ", folds", draw(view, view.folds), scale),
         make_cell(error_label(mesh, Reconstruction::folds, view.layers), draw_errors(view, view.folds),
                   scale)}};
    return lay_out_sheet(mesh.name + ", N=" + std::to_string(view.cells),
                         heat_legend("missed", "false", {&depth_heat, 1}), {row}, scale);
}

} // namespace spa::tools
