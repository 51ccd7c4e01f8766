// SPDX-License-Identifier: Apache-2.0
#include "bench_arguments.h"
#include "bench_models.h"
#include "bench_trace_plots.h"
#include "bench_trace_report.h"
#include "gnuplot.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "progress.h"

#include "../formats/container/writer.h"
#include "../libspa/measure/stopwatch.h"
#include "../libspa/trace/trace.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace spa::tools {

namespace {

constexpr std::uint32_t max_rays = 100000000;
constexpr std::uint32_t max_layers = 8;

struct Arguments {
    std::vector<std::string> models{"boot:6", "smooth:6", "torus", "spiky", "cube"};
    measure::TraceBenchOptions bench;
};

// Values of an enumeration by their names.
template <class T>
std::vector<T> parse_names(const std::string& option, const std::string& text, std::span<const T> values) {
    std::vector<T> chosen;
    for (const std::string& given : split(text, ',')) {
        const auto found = std::find_if(values.begin(), values.end(),
                                        [&](T value) { return given == measure::name(value); });
        if (found == values.end()) {
            std::string names;
            for (const T value : values)
                names += (names.empty() ? "" : ", ") + std::string(measure::name(value));
            throw Error(ExitCode::usage, option + ": '" + given + "' is not one of " + names);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

// What takes a moment and still has one of everything.
void make_quick(Arguments& arguments) {
    arguments.models = {"boot:2", "smooth:2"};
    measure::TraceBenchOptions& bench = arguments.bench;
    bench.cells = {32, 128};
    bench.tests = {1, 10};
    bench.lod_errors = {0.03, 0.003, 0.0003};
    bench.rays = 2000;
    bench.runs = 1;
}

Arguments complete(const BenchArguments& given) {
    refuse_paper_options("trace", given);
    refuse_layers_options("trace", given);
    refuse("trace", "--levels", given.levels.has_value());
    Arguments arguments;
    measure::TraceBenchOptions& bench = arguments.bench;
    if (given.quick) make_quick(arguments);
    if (given.models) arguments.models = split(*given.models, ',');
    if (given.sizes) bench.cells = parse_cells("--sizes", *given.sizes);
    if (given.layers) bench.layers = parse_numbers("--layers", *given.layers, 1, max_layers);
    if (given.rays) bench.rays = parse_number("--rays", *given.rays, 1, max_rays);
    if (given.runs) bench.runs = parse_number("--runs", *given.runs, 1, max_runs);
    if (given.threads) bench.threads = parse_numbers("--threads", *given.threads, 1, max_threads);
    if (given.sets) bench.sets = parse_names("--sets", *given.sets, measure::ray_sets());
    if (given.only) {
        const std::vector<measure::Family> all = bench.families;
        bench.families = parse_names("--only", *given.only, std::span<const measure::Family>(all));
    }
    return arguments;
}

measure::FileTrip through_file(const SphericalMap& map, const trace::Ray& ray, unsigned runs) {
    std::vector<std::byte> bytes;
    require(container::write(map, {}, bytes), "benchmark");
    std::vector<double> seconds;
    trace::Hit hit;
    for (unsigned run = 0; run < runs; ++run) {
        seconds.push_back(measure::thread_seconds_of([&] {
            container::File file;
            require(container::open(bytes, file), "benchmark");
            const trace::TraceMap traced(file.map().parts.front());
            trace::closest_hit(traced, ray, trace::no_flags, hit);
        }));
    }
    return {bytes.size(), measure::spread_of(seconds)};
}

void write_file(const std::filesystem::path& path, const std::string& text) {
    StagedFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

// The lines, the pictures and the scripts that drew them.
void write_plots(const std::filesystem::path& path, const TraceReport& report) {
    StagedFolder folder(path);
    const auto write = [&](const std::string& name, const std::string& text) {
        folder.write(name, std::as_bytes(std::span(text)));
    };
    write("trace.csv", report_csv(report));
    for (const Plot& plot : trace_plots(report)) {
        write(plot.name + ".gnuplot", plot.script);
        folder.write(plot.name + ".png", run_gnuplot(plot.script));
    }
    folder.commit();
}

// What can go wrong at the end is found at the beginning.
void check_outputs(const BenchArguments& given) {
    if (!given.csv.empty()) check_output_file(given.csv);
    if (given.plots.empty()) return;
    check_output_folder(given.plots);
    require_gnuplot();
}

TraceModel measure_model(const std::string& name, measure::TraceBenchOptions options, bool quiet) {
    ProgressReport progress("benchmark of " + name, quiet);
    options.through_file = through_file;
    options.progress = [&](double share, const std::string&) {
        progress.update(share);
        return interrupt_signal() == 0;
    };
    TraceModel result{name, measure::bench_trace(load_bench_model("--models", name), options), {}};
    result.bars = measure::trace_bars(name, result.benchmark);
    return result;
}

} // namespace

void bench_trace(const BenchArguments& given) {
    const Arguments arguments = complete(given);
    check_outputs(given);
    TraceReport report;
    report.rays = arguments.bench.rays;
    report.runs = arguments.bench.runs;
    report.threads = arguments.bench.threads;
    report.target = trace::stream_target();
    {
        const InterruptGuard guard;
        for (const std::string& model : arguments.models)
            report.models.push_back(measure_model(model, arguments.bench, given.quiet));
        if (!given.csv.empty()) write_file(given.csv, report_csv(report));
        if (!given.plots.empty()) write_plots(given.plots, report);
    }
    print(given.format == ReportFormat::json ? json_text(report_json(report)) : report_text(report));
}

} // namespace spa::tools
