// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "compare_limits.h"
#include "difference_sheet.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "text.h"
#include "verb.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string first, second;
    std::vector<Limit> warn, fail;
    std::filesystem::path sheet;
    ReportFormat format = ReportFormat::text;
};

// Without any limit, whatever differs fails.
std::vector<Limit> no_difference() {
    std::vector<Limit> limits;
    for (const ComparedFigure& figure : compared_figures()) limits.push_back({&figure, 0});
    return limits;
}

std::string sentence(const Limit& limit, const measure::MapDifference& difference) {
    return std::string(limit.figure->name) + " is " + significant(worst(*limit.figure, difference), 4) +
           ", above " + significant(limit.value, 4) + " (" + limit.figure->description + ")";
}

Json limits_json(const std::vector<Limit>& limits, const measure::MapDifference& difference) {
    Json json = Json::array();
    for (const Limit& limit : limits) {
        const double value = worst(*limit.figure, difference);
        const bool comparable = !difference.structure.has_value();
        json.push_back({{"figure", limit.figure->name},
                        {"limit", limit.value},
                        {"value", comparable ? Json(value) : Json(nullptr)},
                        {"met", comparable && value <= limit.value}});
    }
    return json;
}

Json surface_json(const measure::SurfaceDifference& surface) {
    Json figures = Json::object();
    for (const ComparedFigure& figure : compared_figures())
        if (figure.of_surface != nullptr) figures[figure.name] = figure.of_surface(surface);
    return {{"part", surface.part},       {"layer", surface.layer}, {"side", measure::name(surface.side)},
            {"samples", surface.samples}, {"common", surface.both}, {"figures", figures}};
}

Json report_json(const Arguments& arguments, const measure::MapDifference& difference, bool differs) {
    Json figures = Json::object();
    for (const ComparedFigure& figure : compared_figures()) figures[figure.name] = worst(figure, difference);
    Json surfaces = Json::array();
    for (const measure::SurfaceDifference& surface : difference.surfaces)
        surfaces.push_back(surface_json(surface));
    return {
        {"first", arguments.first},
        {"second", arguments.second},
        {"comparable", !difference.structure.has_value()},
        {"reason", difference.structure ? Json(*difference.structure) : Json(nullptr)},
        {"figures", difference.structure ? Json(nullptr) : figures},
        {"surfaces", surfaces},
        {"warn", limits_json(arguments.warn, difference)},
        {"fail", limits_json(arguments.fail, difference)},
        {"result", differs                                        ? "fail"
                   : exceeded(arguments.warn, difference).empty() ? "match"
                                                                  : "warn"},
    };
}

std::string report_text(const Arguments& arguments, const measure::MapDifference& difference) {
    std::string text = arguments.first + " and " + arguments.second + "\n";
    if (difference.structure) return text + "  not comparable: " + *difference.structure + "\n";
    for (const ComparedFigure& figure : compared_figures())
        text += "  " + pad_right(figure.name, 15) + pad_left(significant(worst(figure, difference), 4), 10) +
                "  " + figure.description + "\n";
    return text;
}

void write_sheet(const Arguments& arguments, const SphericalMap& first, const SphericalMap& second) {
    const std::string title = std::filesystem::path(arguments.first).filename().string() + " and " +
                              std::filesystem::path(arguments.second).filename().string();
    const InterruptGuard guard;
    StagedFile staged(arguments.sheet);
    staged.write(encode_png(difference_sheet(first, second, title)));
    InterruptGuard::check();
    staged.commit();
}

void compare(Arguments arguments) {
    if (arguments.first == "-" && arguments.second == "-")
        throw Error(ExitCode::usage, "A and B are both -: standard input holds one file only");
    if (arguments.warn.empty() && arguments.fail.empty()) arguments.fail = no_difference();
    if (!arguments.sheet.empty()) {
        const std::filesystem::path inputs[] = {arguments.first, arguments.second};
        check_output_file(arguments.sheet, inputs);
    }
    const MapFile first = open_map(arguments.first);
    const MapFile second = open_map(arguments.second);
    const measure::MapDifference difference = measure::compare(first.map(), second.map());
    const std::vector<Limit> warned = exceeded(arguments.warn, difference);
    const std::vector<Limit> failed = exceeded(arguments.fail, difference);
    const bool differs = difference.structure.has_value() || !failed.empty();
    if (!arguments.sheet.empty() && !difference.structure && (differs || !warned.empty()))
        write_sheet(arguments, first.map(), second.map());
    print(arguments.format == ReportFormat::json ? json_text(report_json(arguments, difference, differs))
                                                 : report_text(arguments, difference));
    for (const Limit& limit : warned) std::cerr << "spa: warning: " << sentence(limit, difference) << '\n';
    if (!differs) return;
    const std::string files = arguments.first + " and " + arguments.second;
    throw Error(ExitCode::limits,
                files + (difference.structure ? " cannot be compared: " + *difference.structure
                                              : " differ: " + sentence(failed.front(), difference)));
}

} // namespace

Verb compare_verb() {
    return {
        .name = "compare",
        .summary = "compare two .spa files sample by sample",
        .description =
            "Checks both files in full, compares them sample by sample and prints the worst figure over all "
            "surfaces. Element formats may differ, since decoded values are compared; parts, mappings and "
            "sizes must be the same. Metadata and error figures are not compared.\n\n"
            "The figures: center, in R, radius, relative, and frame, the largest difference of two elements; "
            "coverage, the share of samples with a surface in one map alone; where both have one, "
            "depth_differs, the share of samples more than 2 codes of u16 apart, depth_mean and depth_max in "
            "R, "
            "normal_mean and normal_max in degrees; where both have colour, color_mean and color_max of red, "
            "green and blue in codes of 255; alpha_mean of the colours' coverage, in codes of 255.\n\n"
            "Without --warn and --fail any difference ends with exit status 6. With them only the figures "
            "named are judged: what exceeds a --warn limit is a warning, what exceeds a --fail limit ends "
            "with "
            "status 6. Files that cannot be compared always do.\n\n"
            "--sheet writes a picture when a limit is exceeded: for every surface both colours, and the "
            "differences of depth, normals and colour on logarithmic scales.",
        .examples = "$ spa compare a.spa b.spa\n"
                    "$ spa compare a.spa b.spa --fail coverage=0.001,depth_differs=0.001\n"
                    "$ spa compare a.spa b.spa --warn depth_max=1e-4 --fail depth_max=1e-3\n"
                    "$ spa compare a.spa b.spa --fail color_mean=1 --sheet difference.png\n"
                    "$ spa compare a.spa b.spa --format json | jq .figures",
        .see_also = "spa validate, spa bake",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "A", "A", "The first .spa file; - reads standard input",
                     [arguments](const std::string& text) { arguments->first = text; })
                ->required();
            add_text(app, "B", "B", "The second .spa file", [arguments](const std::string& text) {
                arguments->second = text;
            })->required();
            add_text(
                app, "--warn", "NAME=VALUE,...", "Warn where a figure is above its value",
                [arguments](const std::string& text) { arguments->warn = parse_limits("--warn", text); });
            add_text(
                app, "--fail", "NAME=VALUE,...", "End with status 6 where a figure is above its value",
                [arguments](const std::string& text) { arguments->fail = parse_limits("--fail", text); });
            add_path(app, "--sheet", "OUT.png", "Draw the differences into this file if a limit is exceeded",
                     arguments->sheet);
            add_report_format(app, arguments->format);
            return [arguments] { compare(*arguments); };
        },
    };
}

} // namespace spa::tools
