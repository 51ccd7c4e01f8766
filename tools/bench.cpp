// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "bake_arguments.h"
#include "bench_report.h"
#include "output.h"
#include "progress.h"
#include "verb.h"

#include "../samples/samples.h"

#include <algorithm>
#include <iostream>
#include <memory>

namespace spa::tools {

namespace {

constexpr unsigned max_runs = 1000;
constexpr unsigned max_threads = 1024;
constexpr std::uint32_t max_side = 16384;

struct Arguments {
    std::string what;
    std::uint32_t first_level = 0, last_level = samples::max_level;
    std::vector<Grid> grids{{Mapping::latlong, 640, 480}, {Mapping::octahedral, 257, 257}};
    measure::BenchOptions bench;
    bool casters_given = false;
    ReportFormat format = ReportFormat::text;
    bool quiet = false;
};

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

void set_levels(Arguments& arguments, const std::string& text) {
    const std::size_t dots = text.find("..");
    const std::string last = dots == std::string::npos ? text : text.substr(dots + 2);
    arguments.first_level = parse_number("--levels", text.substr(0, dots), 0, samples::max_level);
    arguments.last_level = parse_number("--levels", last, arguments.first_level, samples::max_level);
}

void set_sizes(Arguments& arguments, const std::string& text) {
    arguments.grids.clear();
    for (const std::string& size : split(text, ',')) {
        const std::size_t cross = size.find('x');
        if (cross != std::string::npos) {
            arguments.grids.push_back({Mapping::latlong,
                                       parse_number("--sizes", size.substr(0, cross), 1, max_side),
                                       parse_number("--sizes", size.substr(cross + 1), 1, max_side)});
            continue;
        }
        const std::uint32_t cells = parse_number("--sizes", size, 2, max_side);
        if (cells % 2 != 0)
            throw Error(ExitCode::usage,
                        "--sizes: '" + size + "' is odd; the cells a side of an octahedral map are even");
        arguments.grids.push_back({Mapping::octahedral, cells + 1, cells + 1});
    }
}

void set_casters(Arguments& arguments, const std::string& text) {
    using measure::Caster;
    arguments.bench.casters.clear();
    arguments.casters_given = true;
    for (const std::string& given : split(text, ',')) {
        bool found = false;
        for (const Caster caster : {Caster::radial, Caster::embree, Caster::orbit, Caster::naive}) {
            if (given != measure::name(caster)) continue;
            arguments.bench.casters.push_back(caster);
            found = true;
        }
        if (!found)
            throw Error(ExitCode::usage,
                        "--only: '" + given + "' is not one of radial, embree, orbit, naive");
    }
}

// What OpenGL there is; leaves the orbit out, and says so, where there is none and nobody insisted on it.
std::string describe_gl(Arguments& arguments) {
    using measure::Caster;
    std::vector<Caster>& casters = arguments.bench.casters;
    const auto needs_gl = [](Caster caster) { return caster == Caster::orbit || caster == Caster::naive; };
    if (std::none_of(casters.begin(), casters.end(), needs_gl)) return {};
    try {
        return bake::make_gl_context(arguments.bench.gl)->description();
    } catch (const Error& error) {
        if (arguments.casters_given) throw;
        std::cerr << "spa: warning: the orbit is left out: " << error.what() << '\n';
        std::erase_if(casters, needs_gl);
        return {};
    }
}

void bench_bake(Arguments arguments) {
    if (arguments.what != "bake")
        throw Error(ExitCode::usage, "'" + arguments.what + "' is not a benchmark; there is: bake");
    BenchReport report;
    report.gl = describe_gl(arguments);
    report.runs = arguments.bench.runs;
    ProgressReport progress("benchmark", arguments.quiet);
    // A level has four times the triangles of the one below, and counts that much.
    const auto weight = [&](std::uint32_t level) {
        return std::uint64_t(1) << (2 * (level - arguments.first_level));
    };
    double total = 0;
    for (std::uint32_t l = arguments.first_level; l <= arguments.last_level; ++l)
        total += double(weight(l) * arguments.grids.size());
    double done = 0;
    for (std::uint32_t l = arguments.first_level; l <= arguments.last_level; ++l) {
        const Model model = samples::make_sample("boot", int(l));
        BenchLevel level{l, model.positions.size(), model.triangles.size(), measure::model_bytes(model), {}};
        for (const Grid& grid : arguments.grids) {
            bake::Options bake;
            bake.grid = bake.color_grid = grid;
            BenchGrid result;
            // First, while the process has held little memory.
            result.peak_bytes = measure::peak_bake_bytes(model, bake);
            measure::BenchOptions options = arguments.bench;
            options.grid = grid;
            options.progress = [&](double share) {
                progress.update((done + share * double(weight(l))) / total);
            };
            result.benchmark = measure::bench_bake(model, options);
            done += double(weight(l));
            level.grids.push_back(std::move(result));
        }
        report.levels.push_back(std::move(level));
    }
    print(arguments.format == ReportFormat::json ? json_text(report_json(report)) : report_text(report));
}

} // namespace

Verb bench_verb() {
    return {
        .name = "bench",
        .summary = "measure how fast baking is",
        .description =
            "Times on this machine, for a model of growing size (the sample 'boot'), the ways to find where "
            "the line from the centre along each direction leaves the surface: the radial baker, the orbit "
            "baker with its views in batches, the orbit baker with one draw of the whole model a view "
            "('naive'), and Embree (a BVH of the model, then one ray a sample from outside to the centre). "
            "All "
            "start from the same centred model and end with the same crossings. 'hits' is the triangle and "
            "the distance; 'crossings' adds normal and colour, which is the same work for all.\n\n"
            "Everything is timed in turns, and the median of all runs is reported. The naive orbit is timed "
            "on a few views, evenly spread, and scaled to all of them; the report says on how many. Making "
            "the OpenGL context is not counted.\n\n"
            "Memory is the peak of the process during a bake with two layers, the model included, without "
            "what the process held before; 'peak' is its share of the model's own size.",
        .examples = "$ spa bench bake\n"
                    "$ spa bench bake --format json > bench.json\n"
                    "$ spa bench bake --levels 6 --only radial,embree --sizes 640x480",
        .see_also = "spa bake, spa sample",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "WHAT", "WHAT", "What to measure: bake", [arguments](const std::string& text) {
                arguments->what = text;
            })->required();
            add_text(app, "--levels", "A..B", "Levels of subdivision of the boot, 0 to 6; or one alone",
                     [arguments](const std::string& text) { set_levels(*arguments, text); })
                ->default_str("0..6");
            add_text(app, "--sizes", "S,...",
                     "Maps, divided by commas: WxH is a latlong map, N an octahedral one of N cells a side",
                     [arguments](const std::string& text) { set_sizes(*arguments, text); })
                ->default_str("640x480,256");
            add_text(app, "--threads", "N,...", "Numbers of threads, divided by commas",
                     [arguments](const std::string& text) {
                         arguments->bench.threads.clear();
                         for (const std::string& number : split(text, ','))
                             arguments->bench.threads.push_back(
                                 parse_number("--threads", number, 1, max_threads));
                     })
                ->default_str("1,2");
            add_text(app, "--runs", "N", "Times that everything is measured",
                     [arguments](const std::string& text) {
                         arguments->bench.runs = parse_number("--runs", text, 1, max_runs);
                     })
                ->default_str(std::to_string(arguments->bench.runs));
            add_text(app, "--only", "METHOD,...", "Some of radial, embree, orbit, naive, divided by commas",
                     [arguments](const std::string& text) { set_casters(*arguments, text); })
                ->default_str("all that this machine can");
            add_report_format(app, arguments->format);
            app.add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
            return [arguments] { bench_bake(*arguments); };
        },
    };
}

} // namespace spa::tools
