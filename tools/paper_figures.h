// SPDX-License-Identifier: Apache-2.0
// The paper's pictures: scenes met by triangles, by its fan and by ours, side by side with their errors.
#pragma once

#include "paper_methods.h"
#include "picture.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace spa::tools {

struct PaperFigure {
    std::string file; // name of its picture, without extension
    std::string title;
    std::vector<std::function<PaperScene()>> scenes;
    bool direct = false; // judged by the direct light (shadows), else by the indirect light
};

// relMSE against triangles with the same directions.
struct FigureError {
    std::string figure, scene, method;
    double relmse = 0, psnr = 0; // psnr: of the whole picture, as it is looked at
};

struct FigureOptions {
    std::uint32_t width = 320, height = 240, samples = 32;
    render::Backend backend = render::Backend::pipeline;
    std::function<bool(double share, const std::string& step)> progress; // false: cancels; may be empty
};

// A contact sheet: two rows a scene, the picture and the light it is judged by; a column a method. Throws
// Error, and bake::Cancelled. errors: appended to.
Picture draw_figure(const render::Gpu& gpu, const PaperFigure& figure, const FigureOptions& options,
                    std::vector<FigureError>& errors);

} // namespace spa::tools
