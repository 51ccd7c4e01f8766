// SPDX-License-Identifier: Apache-2.0
#include "render_arguments.h"

#include "../shaders/spa_method.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

namespace spa::render {

const char* name(Geometry geometry) { return geometry == Geometry::maps ? "maps" : "triangles"; }
const char* name(Backend backend) { return backend == Backend::query ? "query" : "pipeline"; }

} // namespace spa::render

namespace spa::tools {

namespace {

using render::Backend;
using render::Geometry;

constexpr std::uint32_t max_side = 16384;
constexpr std::uint32_t max_samples = 1U << 20U;
constexpr std::uint32_t max_antialias = 1024;
constexpr std::uint32_t max_test_rays = 1024; // SPA_FAN_LIMIT, SPA_MARCH_LIMIT
constexpr std::uint32_t max_layers = 64;
constexpr std::uint32_t reference_samples = 1024;
constexpr std::uint32_t paper_test_rays = 50; // the most that the paper's N(d2) gives
constexpr double max_exposure = 64;

// As given; what is absent is decided when all of them are known.
struct Given {
    RenderArguments arguments;
    std::optional<std::uint32_t> samples;
    std::optional<std::string> test_rays;
    std::optional<Geometry> primary, shadow, secondary;
};

void parse_size(const std::string& text, render::Settings& settings) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos)
        throw Error(ExitCode::usage, "--size: '" + text + "' is not WIDTHxHEIGHT in pixels, such as 960x540");
    settings.width = parse_number("--size (width)", text.substr(0, cross), 1, max_side);
    settings.height = parse_number("--size (height)", text.substr(cross + 1), 1, max_side);
    if (settings.height > max_picture_pixels / settings.width)
        throw Error(ExitCode::usage,
                    "--size: '" + text + "' is more than " + std::to_string(max_picture_pixels) + " pixels");
}

double parse_exposure(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stopped != end || !(std::abs(value) <= max_exposure))
        throw Error(ExitCode::usage, "--exposure: '" + text + "' is not a number of stops from -64 to 64");
    return value;
}

// The file is what follows the last '=': names of nodes are the asset's, names of files the user's.
MapArgument parse_map(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos && text.ends_with(".spa")) return {"", text};
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw Error(ExitCode::usage, "--map: '" + text +
                                         "' is not [NODE=]FILE.spa: the name of a node of the scene and the "
                                         "map that takes its place, or a map that takes that of all");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void complete_tracing(Given& given) {
    RenderArguments& arguments = given.arguments;
    vulkan::TraceConstants& tracing = arguments.settings.tracing;
    const bool fan = arguments.method == MapMethod::fan, march = arguments.method == MapMethod::march;
    if (arguments.method == MapMethod::projective) tracing.tracer = SPA_PROJECTIVE;
    if (fan || arguments.method == MapMethod::sphere) tracing.tracer = SPA_FAN;
    if (march) tracing.tracer = SPA_MARCH;
    tracing.count = march ? shader::spa_march_defaults().steps : fan ? shader::spa_fan_defaults().count : 0;
    tracing.count_rule = SPA_FAN_FIXED;
    tracing.fan_start = SPA_FAN_START_LEAVES;
    if (!given.test_rays) return;
    if (!fan && !march)
        throw Error(ExitCode::usage, std::string("--test-rays is for --method fan and march; ") +
                                         name(arguments.method) + " has none");
    if (*given.test_rays != "by-distance") {
        tracing.count = parse_number("--test-rays", *given.test_rays, 1, max_test_rays);
        return;
    }
    if (!fan) throw Error(ExitCode::usage, "--test-rays by-distance is for --method fan");
    arguments.by_distance = true;
    tracing.count = paper_test_rays;
    tracing.count_rule = SPA_FAN_BY_DISTANCE;
}

void complete_geometry(Given& given) {
    RenderArguments& arguments = given.arguments;
    render::Settings& settings = arguments.settings;
    if (arguments.reference) {
        for (const auto& [option, geometry] : {std::pair{"--primary", given.primary},
                                               {"--shadow", given.shadow},
                                               {"--secondary", given.secondary}})
            if (geometry == Geometry::maps)
                throw Error(ExitCode::usage,
                            std::string(option) + " maps contradicts --reference, which traces triangles");
        settings.primary = settings.shadow = settings.secondary = Geometry::triangles;
    } else {
        if (arguments.frames != 0) settings.primary = Geometry::maps;
        settings.primary = given.primary.value_or(settings.primary);
        settings.shadow = given.shadow.value_or(settings.shadow);
        settings.secondary = given.secondary.value_or(settings.secondary);
    }
    arguments.has_samples = given.samples || arguments.reference;
    settings.samples = given.samples.value_or(arguments.reference ? reference_samples : settings.samples);
}

void check_plan(const RenderArguments& arguments) {
    if (arguments.plan.empty()) {
        if (arguments.plan_only || !arguments.plan_maps.empty() || !arguments.plan_sheet.empty())
            throw Error(ExitCode::usage,
                        "--plan-only, --plan-maps and --plan-sheet are for --plan PLAN.json");
        return;
    }
    if (arguments.plan_only && !arguments.plan_sheet.empty())
        throw Error(ExitCode::usage, "--plan-sheet shows what --plan-only leaves out; give one of them");
    if (!arguments.maps.empty())
        throw Error(ExitCode::usage, "--plan: the plan says what is a map; leave --map out");
    if (!arguments.uses_maps())
        throw Error(ExitCode::usage, "--plan: no ray would meet maps; leave out --reference, or let shadow, "
                                     "secondary or primary rays meet maps");
    if (arguments.is_posed())
        throw Error(ExitCode::usage,
                    "--plan: the plan is for the scene at rest; leave --animation, --time and "
                    "--frames out");
}

void check_frames(const RenderArguments& arguments) {
    if (arguments.frames == 0) return;
    const auto refuse = [](const char* option, const char* why) {
        throw Error(ExitCode::usage, std::string("--frames and ") + option + " exclude each other: " + why);
    };
    if (arguments.time) refuse("--time", "the frames' times are spread over the animation");
    if (arguments.reference) refuse("--reference", "each frame has one of its own");
    if (!arguments.compare.empty()) refuse("--compare", "each frame has a reference of its own");
    if (arguments.aovs) refuse("--aovs", "the sheet holds the pictures alone");
    if (arguments.writes_exr()) refuse("OUT.exr", "the sheet is for people; write a PNG");
    if (!arguments.uses_maps())
        throw Error(ExitCode::usage,
                    "--frames sets maps beside triangles, and no ray meets a map; give --map");
}

void check_files(const RenderArguments& arguments) {
    if (arguments.scene == "-")
        throw Error(ExitCode::usage, "a scene is not read from standard input, because it may refer to files "
                                     "beside it; name a file");
    std::string extension = arguments.output.extension().string();
    if (extension != ".exr" && extension != ".png")
        throw Error(ExitCode::usage, "-o: '" + arguments.output.string() +
                                         "' ends in neither .exr nor .png, the formats that are written");
    if (arguments.compare.empty() && !arguments.difference.empty())
        throw Error(ExitCode::usage, "--difference needs --compare REF");
    if (arguments.compare.empty() && !arguments.fail.empty())
        throw Error(ExitCode::usage, "--fail needs --compare REF");
    check_plan(arguments);
    for (std::size_t i = 0; i < arguments.maps.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (arguments.maps[i].node == arguments.maps[j].node)
                throw Error(ExitCode::usage,
                            arguments.maps[i].node.empty()
                                ? "--map: two maps without NODE would take the place of the whole scene"
                                : "--map: '" + arguments.maps[i].node + "' is given twice");
}

void define_scene_options(CLI::App& app, Given& given) {
    RenderArguments& arguments = given.arguments;
    render::Settings& settings = arguments.settings;
    app.add_option_function<std::vector<std::string>>(
           "--map",
           [&arguments](const std::vector<std::string>& texts) {
               std::transform(texts.begin(), texts.end(), std::back_inserter(arguments.maps), parse_map);
           },
           "Replace a node of the scene, and all below it, by a map baked from it; may be given several "
           "times. Of several nodes of one name all are replaced. The map's object space is the node's. "
           "Without NODE the map takes the place of the whole scene")
        ->type_name("[NODE=]FILE.spa")
        ->allow_extra_args(false);
    add_path(app, "--plan-maps", "DIR", "The folder that 'spa batch --from-plan' wrote the maps into",
             arguments.plan_maps)
        ->default_str("that of the plan");
    add_path(app, "--plan-sheet", "SHEET.png",
             "With --plan: draw triangles alone, maps of one size and the plan side by side into this file, "
             "with where their indirect light differs",
             arguments.plan_sheet);
    app.add_flag("--plan-only", arguments.plan_only,
                 "With --plan: do not also render triangles alone and maps of one size to compare with");
    add_text(app, "--layers", "N", "Layers of the maps to use, 1 to 64",
             [&arguments](const std::string& text) {
                 arguments.layers = parse_number("--layers", text, 1, max_layers);
             })
        ->default_str("all");
    add_text(app, "--camera", "NAME|N", "The camera: its name in the scene, or its number from 0",
             [&arguments](const std::string& text) { arguments.camera = text; })
        ->default_str("the first; one that shows everything if there is none");
    add_text(app, "--size", "WxH", "Pixels of the picture", [&settings](const std::string& text) {
        parse_size(text, settings);
    })->default_str(std::to_string(settings.width) + "x" + std::to_string(settings.height));
    add_text(app, "--samples", "N", "Rays for the indirect light of a primary hit, 0 to 1048576",
             [&given](const std::string& text) {
                 given.samples = parse_number("--samples", text, 0, max_samples);
             })
        ->default_str(std::to_string(settings.samples) + "; 1024 with --reference");
    add_text(app, "--antialias", "N", "Primary rays of a pixel, 1 to 1024",
             [&settings](const std::string& text) {
                 settings.antialias = parse_number("--antialias", text, 1, max_antialias);
             })
        ->default_str(std::to_string(settings.antialias));
    add_text(app, "--seed", "N", "Seed of all random numbers", [&settings](const std::string& text) {
        settings.seed = parse_number("--seed", text, 0, 0xFFFFFFFFU);
    })->default_str(std::to_string(settings.seed));
}

void define_animation_options(CLI::App& app, RenderArguments& arguments) {
    add_text(app, "--animation", "NAME|N",
             "The animation of a glTF scene: its name, or its number from 0. Skinned triangles and nodes are "
             "posed, and parts of maps that follow nodes or joints move with these",
             [&arguments](const std::string& text) { arguments.animation = text; })
        ->default_str("the first with --time or --frames, else none");
    add_text(app, "--time", "T", "The moment of the animation, in seconds from its start",
             [&arguments](const std::string& text) { arguments.time = parse_measure("--time", text); })
        ->default_str("0 with --animation");
    add_text(
        app, "--frames", "N",
        "A sheet of 1 to 64 pictures evenly over the animation: above with skinned triangles, below with "
        "maps, for all rays unless --primary, --shadow or --secondary say otherwise, and the errors",
        [&arguments](const std::string& text) {
            arguments.frames = parse_number("--frames", text, 1, max_frames);
        });
}

void define_tracing_options(CLI::App& app, Given& given) {
    RenderArguments& arguments = given.arguments;
    render::Settings& settings = arguments.settings;
    const auto add_geometry = [&app](const char* option, const char* description, Geometry otherwise,
                                     std::optional<Geometry>& geometry) {
        add_choice<Geometry>(app, option, {Geometry::triangles, Geometry::maps}, description,
                             [&geometry](Geometry value) { geometry = value; })
            ->default_str(name(otherwise));
    };
    add_geometry("--primary", "What rays from the camera meet where a node has a map", settings.primary,
                 given.primary);
    add_geometry("--shadow", "What rays to the lights meet", settings.shadow, given.shadow);
    add_geometry("--secondary", "What rays of indirect light meet", settings.secondary, given.secondary);
    add_choice<MapMethod>(
        app, "--method", {MapMethod::projective, MapMethod::fan, MapMethod::march, MapMethod::sphere},
        "How maps are traced: projective, the paper's fan, a march, or the fan without test rays",
        [&arguments](MapMethod method) { arguments.method = method; })
        ->default_str(name(arguments.method));
    add_text(app, "--test-rays", "N|by-distance",
             "Test rays of the fan or steps of the march, 1 to 1024; by-distance: the paper's N(d2), 1 to "
             "50 test rays by how near the ray passes the centre",
             [&given](const std::string& text) { given.test_rays = text; })
        ->default_str(std::to_string(shader::spa_fan_defaults().count) + " for fan, " +
                      std::to_string(shader::spa_march_defaults().steps) + " for march");
    app.add_flag("--reference", arguments.reference,
                 "A picture to compare with: triangles alone, whatever has a map, and many samples");
    add_choice<Backend>(app, "--backend", {Backend::pipeline, Backend::query},
                        "Ray-tracing pipelines or ray queries in a compute shader",
                        [&settings](Backend backend) { settings.backend = backend; })
        ->default_str(name(settings.backend));
    add_text(app, "--device", "NAME|INDEX", "The device: part of its name, or its number in --list-devices",
             [&arguments](const std::string& text) { arguments.device = text; })
        ->default_str("the first that can trace rays, a GPU before software");
}

void define_picture_options(CLI::App& app, RenderArguments& arguments) {
    add_text(app, "--exposure", "EV",
             "Stops by which what is shown is brightened: in PNG, in PSNR and SSIM, in difference pictures. "
             "EXR holds light as it is",
             [&arguments](const std::string& text) { arguments.exposure = parse_exposure(text); })
        ->default_str("0");
    app.add_flag("--aovs", arguments.aovs,
                 "With OUT.png also write OUT.direct.png, OUT.indirect.png, OUT.normal.png, OUT.depth.png "
                 "and OUT.kind.png; an EXR has all of them anyway, as layers");
    add_path(app, "--compare", "REF",
             "Compare with this picture: one that --reference wrote, or any other of the same size",
             arguments.compare);
    add_path(app, "--difference", "DIFF.png",
             "Draw the picture, the reference and where they differ into this file", arguments.difference);
    add_text(app, "--fail", "NAME=VALUE,...",
             "End with status 6 where a figure misses its limit: relmse and rmse at most, psnr and ssim at "
             "least; with direct. or indirect. before the name, of that light alone",
             [&arguments](const std::string& text) { arguments.fail = parse_image_limits("--fail", text); });
}

} // namespace

const char* name(MapMethod method) {
    switch (method) {
    case MapMethod::fan: return "fan";
    case MapMethod::march: return "march";
    case MapMethod::sphere: return "sphere";
    case MapMethod::projective: break;
    }
    return "projective";
}

bool RenderArguments::writes_exr() const { return output.extension() == ".exr"; }

bool RenderArguments::uses_maps() const {
    return (!maps.empty() || !plan.empty()) &&
           (settings.primary == Geometry::maps || settings.shadow == Geometry::maps ||
            settings.secondary == Geometry::maps);
}

bool RenderArguments::uses_replaced_triangles() const {
    return settings.primary == Geometry::triangles || settings.shadow == Geometry::triangles ||
           settings.secondary == Geometry::triangles;
}

std::function<RenderArguments()> define_render_arguments(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    RenderArguments& arguments = given->arguments;
    CLI::Option* const scene =
        add_path(app, "SCENE", "SCENE", "The scene: glTF or GLB; OBJ, PLY, STL or OFF", arguments.scene)
            ->required();
    CLI::Option* const output =
        add_path(app, "-o,--output", "OUT.exr|OUT.png", "The picture to write", arguments.output)->required();
    // The parser asks for what is required after it has run this.
    add_text(
        app, "--plan", "PLAN.json",
        "Show the scene as 'spa plan' decided, with the maps that 'spa batch --from-plan' baked: without "
        "SCENE the scene of the plan, without --camera and --samples those that it was made for. Also "
        "renders "
        "it as triangles alone and with maps of one size, and "
        "reports errors, speed and memory of the three",
        [=, &arguments](const std::string& text) {
            arguments.plan = text;
            scene->required(false);
        });
    define_scene_options(app, *given);
    define_animation_options(app, arguments);
    define_tracing_options(app, *given);
    define_picture_options(app, arguments);
    // Nothing is rendered then. The parser asks for what is required after it has run this.
    app.add_flag_callback(
        "--list-devices",
        [=, &arguments] {
            arguments.list_devices = true;
            scene->required(false);
            output->required(false);
        },
        "List the devices, and what they lack to trace rays, and do nothing else");
    add_report_format(app, arguments.format);
    add_follow_links(app, arguments.follow_links);
    app.add_flag("-q,--quiet", arguments.quiet, "No progress on standard error");
    return [given] {
        if (given->arguments.list_devices) return given->arguments;
        complete_tracing(*given);
        complete_geometry(*given);
        check_files(given->arguments);
        check_frames(given->arguments);
        return given->arguments;
    };
}

} // namespace spa::tools
