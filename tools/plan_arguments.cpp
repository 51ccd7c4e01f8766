// SPDX-License-Identifier: Apache-2.0
#include "plan_arguments.h"

#include <CLI/App.hpp>

#include <bit>
#include <memory>

namespace spa::tools {

namespace {

constexpr std::uint32_t max_views = 64;
constexpr std::uint32_t max_plan_samples = 4096;
constexpr std::uint32_t max_rays = 1U << 24U;

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
    const double bytes = parse_measure(option, text);
    if (!(bytes >= 1) || bytes > 1e15)
        throw Error(ExitCode::usage, option + ": '" + text + "' is no number of bytes from 1 to 1e15");
    return std::uint64_t(bytes);
}

void define_limits(CLI::App& app, plan::PlanOptions& options) {
    add_text(app, "--target-image-error", "E",
             "The error of the picture's indirect light that is allowed, as relMSE: as few bytes as that "
             "takes. The default without a budget",
             [&options](const std::string& text) {
                 options.target_image_error = parse_measure("--target-image-error", text);
             })
        ->default_str("0.001");
    add_text(
        app, "--budget-bytes", "N",
        "Bytes of memory that all objects may take: as little error as they allow. With a target too, "
        "as few bytes as the target takes, and no more than these",
        [&options](const std::string& text) { options.budget_bytes = parse_bytes("--budget-bytes", text); });
    add_text(
        app, "--drop-below", "SR",
        "Objects of which surfaces see less than this solid angle on average may be left out; 0 drops "
        "none",
        [&options](const std::string& text) { options.drop_below = parse_measure("--drop-below", text); })
        ->default_str("0.02 pi / samples");
    add_text(app, "--largest-size", "N", "Largest map, cells a side: a power of two from 16 to 4096",
             [&options](const std::string& text) {
                 options.largest_size = parse_number("--largest-size", text, 16, 4096);
                 if (!std::has_single_bit(options.largest_size))
                     throw Error(ExitCode::usage, "--largest-size: '" + text + "' is no power of two");
             })
        ->default_str(std::to_string(options.largest_size));
}

void define_picture(CLI::App& app, PlanArguments& arguments) {
    plan::PathOptions& paths = arguments.options.paths;
    add_text(app, "--camera", "NAME", "Plan for this camera alone; otherwise for all of the scene",
             [&arguments](const std::string& text) { arguments.camera = text; });
    add_text(app, "--views", "N", "Plan for this many cameras around the scene instead of its own",
             [&arguments](const std::string& text) {
                 arguments.views = parse_number("--views", text, 1, max_views);
             });
    add_text(app, "--samples", "n", "Secondary rays of a pixel in the pictures that are planned for",
             [&paths](const std::string& text) {
                 paths.samples = parse_number("--samples", text, 1, max_plan_samples);
             })
        ->default_str(std::to_string(paths.samples));
    add_text(
        app, "--rays", "N", "Secondary rays that are looked at, in all",
        [&paths](const std::string& text) { paths.most_rays = parse_number("--rays", text, 1024, max_rays); })
        ->default_str(std::to_string(paths.most_rays));
}

} // namespace

std::function<PlanArguments()> define_plan_arguments(CLI::App& app) {
    const auto arguments = std::make_shared<PlanArguments>();
    add_path(app, "SCENE", "SCENE", "The scene: glTF, GLB, OBJ, PLY, STL or OFF", arguments->scene)
        ->required();
    add_path(app, "-o,--output", "PLAN.json", "The plan to write", arguments->output)->required();
    add_path(app, "--html", "FILE", "The plan as a page for a browser", arguments->html);
    define_picture(app, *arguments);
    define_limits(app, arguments->options);
    add_threads(app, "Threads to use; 0 means one a core", arguments->options.threads);
    add_follow_links(app, arguments->follow_links);
    add_report_format(app, arguments->format);
    app.add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
    return [arguments] {
        if (arguments->camera && arguments->views)
            throw Error(ExitCode::usage, "--camera and --views: a plan is for one or the other");
        return *arguments;
    };
}

} // namespace spa::tools
