// SPDX-License-Identifier: Apache-2.0
#include "bake_arguments.h"
#include "bench_arguments.h"
#include "bench_report.h"
#include "output.h"
#include "progress.h"

#include "../samples/samples.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace spa::tools {

namespace {

struct Arguments {
    std::uint32_t first_level = 0, last_level = samples::max_level;
    std::vector<Grid> grids{{Mapping::latlong, 640, 480}, {Mapping::octahedral, 257, 257}};
    measure::BenchOptions bench;
    bool casters_given = false;
};

void set_levels(Arguments& arguments, const std::string& text) {
    const std::vector<int> levels = parse_levels(text);
    arguments.first_level = std::uint32_t(levels.front());
    arguments.last_level = std::uint32_t(levels.back());
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

Arguments complete(const BenchArguments& given) {
    for (const auto& [option, is_given] : {std::pair{"--models", given.models.has_value()},
                                           {"--layers", given.layers.has_value()},
                                           {"--rays", given.rays.has_value()},
                                           {"--sets", given.sets.has_value()},
                                           {"--csv", !given.csv.empty()},
                                           {"--plots", !given.plots.empty()},
                                           {"--quick", given.quick}})
        refuse("bake", option, is_given);
    refuse_paper_options("bake", given);
    refuse_layers_options("bake", given);
    Arguments arguments;
    if (given.levels) set_levels(arguments, *given.levels);
    if (given.sizes) set_sizes(arguments, *given.sizes);
    if (given.threads) arguments.bench.threads = parse_numbers("--threads", *given.threads, 1, max_threads);
    if (given.runs) arguments.bench.runs = parse_number("--runs", *given.runs, 1, max_runs);
    if (given.only) set_casters(arguments, *given.only);
    return arguments;
}

} // namespace

void bench_bake(const BenchArguments& given) {
    Arguments arguments = complete(given);
    BenchReport report;
    report.gl = describe_gl(arguments);
    report.runs = arguments.bench.runs;
    ProgressReport progress("benchmark", given.quiet);
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
    print(given.format == ReportFormat::json ? json_text(report_json(report)) : report_text(report));
}

} // namespace spa::tools
