// SPDX-License-Identifier: Apache-2.0
#include "bench_arguments.h"
#include "bench_layers_picture.h"
#include "bench_layers_plots.h"
#include "bench_layers_report.h"
#include "bench_models.h"
#include "gnuplot.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "progress.h"

#include "../formats/container/writer.h"
#include "../libspa/trace/trace.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace spa::tools {

namespace {

constexpr std::uint32_t max_rays = 100000000;
constexpr std::uint32_t max_layers = 8;

// What takes a moment and still has one of everything.
void make_quick(measure::LayersOptions& bench) {
    bench.cells = {32, 128};
    bench.rays = 4000;
    bench.runs = 1;
}

void sort_once(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

measure::LayersOptions complete(const BenchArguments& given) {
    for (const auto& [option, is_given] : {std::pair{"--levels", given.levels.has_value()},
                                           {"--models", given.models.has_value()},
                                           {"--sets", given.sets.has_value()},
                                           {"--only", given.only.has_value()},
                                           {"--csv", !given.csv.empty()},
                                           {"--plots", !given.plots.empty()},
                                           {"--device", !given.device.empty()},
                                           {"--sponza", !given.sponza.empty()}})
        refuse("layers", option, is_given);
    if (given.assets.empty()) throw Error(ExitCode::usage, "'spa bench layers' wants at least one ASSET");
    measure::LayersOptions bench;
    if (given.quick) make_quick(bench);
    if (given.sizes) bench.cells = parse_cells("--size", *given.sizes);
    if (given.layers) bench.layers = parse_numbers("--layers", *given.layers, 1, max_layers);
    sort_once(bench.cells);
    sort_once(bench.layers);
    if (given.rays) bench.rays = parse_number("--rays", *given.rays, 1, max_rays);
    if (given.seed)
        bench.seed = parse_number("--seed", *given.seed, 0, std::numeric_limits<std::uint32_t>::max());
    if (given.runs) bench.runs = parse_number("--runs", *given.runs, 1, max_runs);
    if (given.threads) bench.threads = parse_number("--threads", *given.threads, 0, max_threads);
    if (given.center) bench.center = *given.center;
    bench.file_bytes = [](const SphericalMap& map) {
        std::vector<std::byte> bytes;
        require(container::write(map, {}, bytes), "benchmark");
        return std::uint64_t(bytes.size());
    };
    return bench;
}

// Of several meshes with the same name, those after the first get a number.
std::vector<std::string> names_of(const std::vector<std::string>& assets) {
    std::vector<std::string> names;
    for (const std::string& asset : assets) {
        const std::string plain = bench_file_name(asset);
        std::string name = plain;
        for (int i = 2; std::find(names.begin(), names.end(), name) != names.end(); ++i)
            name = plain + "-" + std::to_string(i);
        names.push_back(name);
    }
    return names;
}

// The folder of --out, or nothing.
class Output {
public:
    explicit Output(const std::filesystem::path& path) {
        if (!path.empty()) folder_.emplace(path);
    }
    [[nodiscard]] explicit operator bool() const { return folder_.has_value(); }
    void write(const std::string& name, std::span<const std::byte> bytes) { folder_->write(name, bytes); }
    void write(const std::string& name, const std::string& text) {
        write(name, std::as_bytes(std::span(text)));
    }
    void commit() { folder_->commit(); }

private:
    std::optional<StagedFolder> folder_;
};

measure::LayersMesh measure_mesh(const std::string& name, const std::string& asset,
                                 measure::LayersOptions options, bool quiet) {
    ProgressReport progress("benchmark of " + name, quiet);
    options.progress = [&](double share, const std::string&) {
        progress.update(share);
        return interrupt_signal() == 0;
    };
    return {name, measure::bench_layers(load_bench_model("ASSET", asset), options)};
}

void write_report(const LayersReport& report, Output& output) {
    output.write("report.json", json_text(report_json(report)));
    output.write("report.txt", report_text(report));
    output.write("layers.csv", report_csv(report));
    for (const Plot& plot : layers_plots(report)) {
        output.write(plot.name + ".gnuplot", plot.script);
        output.write(plot.name + ".png", run_gnuplot(plot.script));
    }
    output.commit();
}

} // namespace

void bench_layers(const BenchArguments& given) {
    measure::LayersOptions options = complete(given);
    if (!given.out.empty()) {
        check_output_folder(given.out);
        require_gnuplot();
        options.view_side = layers_view_side;
    }
    LayersReport report;
    report.rays = options.rays;
    report.seed = options.seed;
    report.runs = options.runs;
    report.center = options.center;
    report.target = trace::stream_target();
    report.sources = given.assets;
    {
        const InterruptGuard guard;
        Output output(given.out);
        const std::vector<std::string> names = names_of(given.assets);
        for (std::size_t i = 0; i < names.size(); ++i) {
            report.meshes.push_back(measure_mesh(names[i], given.assets[i], options, given.quiet));
            if (!output) continue;
            output.write("views-" + names[i] + ".png", encode_png(layers_sheet(report.meshes.back())));
            report.meshes.back().benchmark.view = {};
        }
        report.mean = measure::closed_mean(report.meshes);
        report.bars = measure::layers_bars(report.meshes);
        if (output) write_report(report, output);
    }
    print(given.format == ReportFormat::json ? json_text(report_json(report)) : report_text(report));
}

} // namespace spa::tools
