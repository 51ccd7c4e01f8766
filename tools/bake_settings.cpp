// SPDX-License-Identifier: Apache-2.0
#include "bake_settings.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace spa::bake {

const char* name(Frame frame) {
    switch (frame) {
    case Frame::sphere: return "sphere";
    case Frame::affine: return "affine";
    case Frame::automatic: break;
    }
    return "auto";
}
const char* name(Center center) {
    switch (center) {
    case Center::bounds: return "bounds";
    case Center::captured: return "captured";
    case Center::automatic: break;
    }
    return "auto";
}
const char* name(Baker baker) { return baker == Baker::orbit ? "orbit" : "radial"; }
const char* name(GlApi gl) {
    switch (gl) {
    case GlApi::egl: return "egl";
    case GlApi::osmesa: return "osmesa";
    case GlApi::automatic: break;
    }
    return "auto";
}

} // namespace spa::bake

namespace spa::tools {

namespace {

// What the container can hold is more; these keep a slip of the finger from asking for terabytes.
constexpr std::uint32_t max_cells = 8192;
constexpr std::uint32_t max_width = 16384;
constexpr std::uint32_t max_height = 8192;
constexpr std::uint32_t max_layers = 64;
constexpr std::uint32_t max_samples = 8;

constexpr std::uint32_t paper_width = 640, paper_height = 480;

// As given; what is absent is decided when all of them are known.
struct Given {
    BakeSettings settings;
    bool paper = false;
    std::optional<Mapping> mapping;
    std::optional<std::string> size, color_size;
    std::optional<ElementFormat> depth, normals;
    std::optional<std::uint32_t> layers;
    std::optional<bake::Frame> frame;
    std::optional<bake::Center> center;
    GivenSearch search;
};

enum class Folds : std::uint8_t { off, on };
const char* name(Folds folds) { return folds == Folds::on ? "on" : "off"; }

Grid octahedral_grid(std::uint32_t cells) { return {Mapping::octahedral, cells + 1, cells + 1}; }

Grid parse_size(const std::string& option, const std::string& text, Mapping mapping) {
    const std::size_t cross = text.find('x');
    if (mapping == Mapping::octahedral) {
        if (cross != std::string::npos)
            throw Error(ExitCode::usage,
                        option + ": '" + text +
                            "' is the size of a latlong map; an octahedral map is square: give the number of "
                            "cells a side, such as " +
                            size_text(bake::Options{}.grid) + ", or add --mapping latlong");
        const std::uint32_t cells = parse_number(option, text, 2, max_cells);
        if (cells % 2 != 0)
            throw Error(ExitCode::usage,
                        option + ": '" + text +
                            "' is odd; the cells a side of an octahedral map are even: give " +
                            std::to_string(cells - 1) + " or " + std::to_string(cells + 1));
        return octahedral_grid(cells);
    }
    if (cross != std::string::npos)
        return {mapping, parse_number(option + " (width)", text.substr(0, cross), 1, max_width),
                parse_number(option + " (height)", text.substr(cross + 1), 1, max_height)};
    const std::uint32_t width = parse_number(option, text, 2, max_width);
    if (width % 2 != 0)
        throw Error(ExitCode::usage, option + ": '" + text +
                                         "' is odd; a latlong map of width N has height " +
                                         "N/2: give an even number or WIDTHxHEIGHT");
    return {mapping, width, width / 2};
}

BakeSettings complete(const Given& given) {
    BakeSettings settings = given.settings;
    bake::Options& options = settings.options;
    const Mapping mapping = given.mapping.value_or(given.paper ? Mapping::latlong : options.grid.mapping);
    if (given.size)
        options.grid = parse_size("--size", *given.size, mapping);
    else if (mapping == Mapping::latlong)
        options.grid = {mapping, paper_width, paper_height};
    options.color_grid =
        given.color_size ? parse_size("--color-size", *given.color_size, mapping) : options.grid;
    options.depth = given.depth.value_or(given.paper ? ElementFormat::u8 : options.depth);
    options.normals = given.normals.value_or(given.paper ? ElementFormat::rgb8 : options.normals);
    options.layers = given.layers.value_or(given.paper ? 1 : options.layers);
    options.frame = given.frame.value_or(given.paper ? bake::Frame::sphere : options.frame);
    options.center = given.center.value_or(given.paper ? bake::Center::bounds : options.center);
    settings.search = complete_search(given.search,
                                      {given.size || given.paper, given.color_size || given.paper,
                                       given.depth || given.paper, given.layers || given.paper,
                                       given.frame.has_value(), given.center.has_value()},
                                      options);
    if (settings.search) {
        settings.search->compress = settings.compress;
        settings.measure = true;
    }
    return settings;
}

void define_map_options(CLI::App& app, Given& given) {
    const bake::Options defaults = BakeSettings{}.options;
    add_choice<Mapping>(app, "--mapping", {Mapping::octahedral, Mapping::latlong},
                        "How directions are laid out in the images",
                        [&given](Mapping mapping) { given.mapping = mapping; })
        ->default_str(name(defaults.grid.mapping));
    add_text(app, "--size", "N|WxH",
             "Resolution of depth and normals. Octahedral: N cells a side, even, 2 to 8192, which makes "
             "(N+1)x(N+1) "
             "samples. Latlong: WxH texels, up to 16384x8192; N alone means N by N/2",
             [&given](const std::string& text) { given.size = text; })
        ->default_str(size_text(defaults.grid) + ", or 640x480 for latlong");
    add_text(app, "--color-size", "N|WxH", "Resolution of colour, which may be finer than that of depth",
             [&given](const std::string& text) { given.color_size = text; })
        ->default_str("that of --size");
    add_choice<ElementFormat>(app, "--depth", {ElementFormat::u8, ElementFormat::u16, ElementFormat::f32},
                              "Number format of depth",
                              [&given](ElementFormat format) { given.depth = format; })
        ->default_str(name(defaults.depth));
    add_choice<ElementFormat>(app, "--normals",
                              {ElementFormat::oct8, ElementFormat::oct16, ElementFormat::rgb8},
                              "Number format of normals: octahedral with 2x8 or 2x16 bits, or three bytes",
                              [&given](ElementFormat format) { given.normals = format; })
        ->default_str(name(defaults.normals));
    add_text(
        app, "--layers", "K",
        "Intervals of solid kept along a direction, 1 to 64. 1 keeps the outermost surface alone and "
        "takes everything behind it as solid; layers with nothing in them are not written",
        [&given](const std::string& text) { given.layers = parse_number("--layers", text, 1, max_layers); })
        ->default_str(std::to_string(defaults.layers));
    add_choice<Folds>(
        app, "--folds", {Folds::on, Folds::off},
        "Whether octahedral maps of two layers and more say where between samples surfaces end "
        "and how they go on: about a tenth of the file, for far fewer wrong hits at silhouettes",
        [&given](Folds folds) { given.settings.options.folds = folds == Folds::on; })
        ->default_str(name(defaults.folds ? Folds::on : Folds::off));
    add_choice<PartsKind>(
        app, "--parts",
        {PartsKind::whole, PartsKind::components, PartsKind::nodes, PartsKind::bones, PartsKind::automatic},
        "What gets a map with a sphere of its own: the whole object; each connected piece of its surface; "
        "what each node of the file draws, or what follows each joint of its skins, so that the parts can be "
        "moved by its animations; or as many pieces as it takes for the layers to hold the surface",
        [&given](PartsKind kind) { given.settings.parts = kind; })
        ->default_str(name(PartsKind::whole));
    add_text(app, "--max-parts", "N",
             "At most so many parts, 1 to 4096. Of components the smallest are put together with their "
             "neighbours; more nodes or joints are an error",
             [&given](const std::string& text) {
                 given.settings.max_parts = parse_number("--max-parts", text, 1, most_parts);
             })
        ->default_str(std::to_string(default_max_parts));
    add_choice<bake::Frame>(app, "--frame",
                            {bake::Frame::automatic, bake::Frame::sphere, bake::Frame::affine},
                            "The space that is baked: object space, or one stretched so that the oriented "
                            "bounding box is a cube, which suits long and flat objects, or which of the two "
                            "samples the surface more finely",
                            [&given](bake::Frame frame) { given.frame = frame; })
        ->default_str(name(defaults.frame));
    add_choice<bake::Center>(
        app, "--center", {bake::Center::automatic, bake::Center::bounds, bake::Center::captured},
        "The point that directions start from: the centre of the bounding box, or the point from which the "
        "layers hold the surface best, or this one only where it is clearly better",
        [&given](bake::Center center) { given.center = center; })
        ->default_str(name(defaults.center));
    app.add_flag("--paper", given.paper,
                 "The layout of the paper: --mapping latlong --size 640x480 --depth u8 --normals rgb8 "
                 "--layers 1 --frame "
                 "sphere --center bounds. "
                 "Of these, options that are given themselves have the last word");
}

void define_baker_options(CLI::App& app, Given& given) {
    const bake::Options defaults;
    bake::Options& options = given.settings.options;
    add_choice<bake::Baker>(
        app, "--baker", {bake::Baker::radial, bake::Baker::orbit},
        "Who bakes: radial rasterises triangles into direction space on the CPU; orbit, the "
        "reference, renders one camera view a sample with OpenGL",
        [&options](bake::Baker baker) { options.baker = baker; })
        ->default_str(name(defaults.baker));
    add_choice<bake::GlApi>(app, "--gl", {bake::GlApi::automatic, bake::GlApi::egl, bake::GlApi::osmesa},
                            "How the orbit baker gets OpenGL. No window is needed either way",
                            [&options](bake::GlApi gl) { options.gl = gl; })
        ->default_str(name(defaults.gl));
    // For measuring the paper's own way; of no use otherwise, so help does not list it.
    app.add_flag("--gl-naive", options.gl_naive, "One draw call a view")->group("");
    add_text(app, "--samples", "S", "SxS samples of colour and coverage a texel, 1 to 8",
             [&options](const std::string& text) {
                 options.samples = parse_number("--samples", text, 1, max_samples);
             })
        ->default_str(std::to_string(defaults.samples));
}

enum class Compression : std::uint8_t { zstd, none };
const char* name(Compression compression) { return compression == Compression::none ? "none" : "zstd"; }

} // namespace

std::function<BakeSettings()> define_bake_settings(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    BakeSettings& settings = given->settings;
    define_map_options(app, *given);
    define_search_options(app, given->search);
    define_baker_options(app, *given);
    add_choice<Compression>(
        app, "--compress", {Compression::zstd, Compression::none},
        "Compression of the sections; without it a file can be mapped into memory as it is",
        [&settings](Compression compression) { settings.compress = compression == Compression::zstd; })
        ->default_str("zstd");
    app.add_flag("--measure", settings.measure,
                 "Measure the map against the asset, as 'spa validate' does, and write the figures into the "
                 "file and the report");
    return [given] { return complete(*given); };
}

std::string size_text(const Grid& grid) {
    if (grid.mapping == Mapping::octahedral) return std::to_string(grid.width - 1);
    return std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

nlohmann::ordered_json options_json(const BakeSettings& settings) {
    const bake::Options& options = settings.options;
    nlohmann::ordered_json json = {
        {"mapping", name(options.grid.mapping)},
        {"size", size_text(options.grid)},
        {"color_size", size_text(options.color_grid)},
        {"depth", name(options.depth)},
        {"normals", name(options.normals)},
        {"layers", options.layers},
        {"folds", name(options.folds ? Folds::on : Folds::off)},
        {"parts", name(settings.parts)},
        {"max_parts", settings.max_parts},
        {"frame", name(options.frame)},
        {"center", name(options.center)},
        {"baker", name(options.baker)},
        {"gl", name(options.gl)},
        {"samples", options.samples},
        {"compress", name(settings.compress ? Compression::zstd : Compression::none)},
        {"measure", settings.measure},
    };
    if (settings.node) json["node"] = *settings.node;
    return json;
}

nlohmann::ordered_json request_json(const BakeSettings& settings) {
    nlohmann::ordered_json options = options_json(settings);
    if (settings.search) add_search_options(*settings.search, options);
    return options;
}

} // namespace spa::tools
