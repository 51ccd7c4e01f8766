// SPDX-License-Identifier: Apache-2.0
// `spa bench paper`: the experiments of "Real-Time Ray Tracing with Spherically Projected Object Data" on
// this machine's Vulkan device.
#include "bench_arguments.h"
#include "gnuplot.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "paper_printed.h"
#include "paper_report.h"
#include "progress.h"
#include "render_arguments.h"

#include "../formats/container/writer.h"
#include "../formats/import/import.h"
#include "../libspa/core/error.h"
#include "../libspa/measure/stopwatch.h"
#include "../samples/scenes.h"

#include <fstream>

namespace spa::tools {
namespace {

constexpr int figure_level = 4;

std::uint32_t node_named(const Scene& scene, const std::string& name) {
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == name) return i;
    throw Error(ExitCode::internal, "a scene without a node '" + name + "'");
}

PaperScene sample_scene(const std::string& name, int level, std::size_t camera = 0,
                        const std::string& title = "") {
    PaperScene result;
    result.scene = samples::make_scene(name, level);
    result.title = title.empty() ? name : title;
    result.object = node_named(result.scene, "boot");
    result.camera = result.scene.cameras.at(camera);
    return result;
}

PaperFigure corner_figure() {
    PaperFigure figure{
        "fig5-colour-bleeding", "Fig. 5: colour bleeding of the boot in a corner of white walls", {}, false};
    for (const char* const name : {"corner", "corner-b", "corner-c", "corner-d"})
        figure.scenes.emplace_back([name] { return sample_scene(name, figure_level); });
    return figure;
}

PaperFigure colonnade_figure() {
    PaperFigure figure{"fig6-colonnade", "Fig. 6: the boot in a colonnade, lit from above", {}, false};
    figure.scenes.emplace_back(
        [] { return sample_scene("colonnade", figure_level, 0, "colonnade, from the side"); });
    figure.scenes.emplace_back(
        [] { return sample_scene("colonnade-b", figure_level, 1, "colonnade, the tip"); });
    return figure;
}

PaperFigure shadow_figure() {
    PaperFigure figure{"fig4-shadows", "Fig. 4: the boot's shadow on a wall", {}, true};
    figure.scenes.emplace_back([] { return sample_scene("wall", figure_level); });
    return figure;
}

// How long a file takes to become what a renderer loads.
class Files {
public:
    explicit Files(std::filesystem::path folder) : folder_(std::move(folder)) {}

    PaperTableOptions::Files operator()(const Model& object, const SphericalMap& map) {
        PaperTableOptions::Files files;
        const std::filesystem::path glb = folder_ / "object.glb";
        const std::filesystem::path spa = folder_ / "object.spa";
        samples::write_glb(object, glb);
        std::vector<std::byte> bytes;
        require(container::write(map, {}, bytes), spa.string());
        StagedFile file(spa);
        file.write(bytes);
        file.commit();
        files.glb_bytes = std::filesystem::file_size(glb);
        files.spa_bytes = bytes.size();
        files.read_glb = measure::seconds_of([&] { static_cast<void>(import::read_model(glb)); });
        files.read_spa = measure::seconds_of([&] { static_cast<void>(open_map(spa.string())); });
        std::filesystem::remove(glb);
        std::filesystem::remove(spa);
        return files;
    }

private:
    std::filesystem::path folder_;
};

struct Arguments {
    PaperTableOptions tables;
    FigureOptions figures;
    std::vector<PaperFigure> chosen;
    bool with_tables = true;
};

Arguments complete(const BenchArguments& given) {
    for (const auto& [option, value] :
         {std::pair("--models", given.models), std::pair("--layers", given.layers),
          std::pair("--rays", given.rays), std::pair("--threads", given.threads),
          std::pair("--sets", given.sets), std::pair("--sizes", given.sizes)})
        refuse("paper", option, value.has_value());
    if (given.out.empty()) throw Error(ExitCode::usage, "'spa bench paper' wants --out DIR");
    Arguments arguments;
    if (given.levels) arguments.tables.levels = parse_levels(*given.levels);
    if (given.runs) arguments.tables.runs = parse_number("--runs", *given.runs, 1, max_runs);
    arguments.chosen = {shadow_figure(), corner_figure(), colonnade_figure()};
    if (given.only) {
        std::vector<PaperFigure> chosen;
        arguments.with_tables = false;
        for (const std::string& word : split(*given.only, ',')) {
            if (word == "tables")
                arguments.with_tables = true;
            else if (word == "shadows")
                chosen.push_back(shadow_figure());
            else if (word == "bleeding")
                chosen.push_back(corner_figure());
            else if (word == "colonnade")
                chosen.push_back(colonnade_figure());
            else
                throw Error(ExitCode::usage,
                            "--only: '" + word + "' is not one of tables, shadows, bleeding, colonnade");
        }
        arguments.chosen = std::move(chosen);
    }
    if (given.quick) {
        if (!given.levels) arguments.tables.levels = {0, 2};
        arguments.tables.samples = {8, 32};
        arguments.tables.width = 64;
        arguments.tables.height = 48;
        arguments.tables.reference_samples = 64;
        arguments.figures.width = 96;
        arguments.figures.height = 72;
        arguments.figures.samples = 8;
    }
    return arguments;
}

} // namespace

void bench_paper(const BenchArguments& given) {
    Arguments arguments = complete(given);
    check_output_folder(given.out);
    if (arguments.with_tables) require_gnuplot();
    render::GpuOptions gpu_options;
    gpu_options.device = given.device;
    const render::Gpu gpu(gpu_options);
    PaperReport report;
    report.device = gpu.entry().name;
    report.driver = gpu.entry().driver;
    report.backend = render::name(arguments.tables.backend);
    report.figure_options = arguments.figures;
    {
        const InterruptGuard guard;
        StagedFolder folder(given.out);
        for (const PaperFigure& figure : arguments.chosen) {
            ProgressReport progress(figure.title, given.quiet);
            arguments.figures.progress = [&](double share, const std::string&) {
                progress.update(share);
                return interrupt_signal() == 0;
            };
            folder.write(figure.file + ".png",
                         encode_png(draw_figure(gpu, figure, arguments.figures, report.figures)));
        }
        if (arguments.with_tables) {
            ProgressReport progress("Tables 1 to 7", given.quiet);
            arguments.tables.scene = [](int level) { return sample_scene("corner", level); };
            arguments.tables.files = Files(folder.temporary_path());
            arguments.tables.progress = [&](double share, const std::string&) {
                progress.update(share);
                return interrupt_signal() == 0;
            };
            report.tables = run_paper_tables(gpu, arguments.tables);
            report.bars = paper_bars(report.tables);
        }
        const auto write = [&](const std::string& name, const std::string& text) {
            folder.write(name, std::as_bytes(std::span(text)));
        };
        for (const PaperPlot& plot : paper_plots(report)) {
            write(plot.name + ".gnuplot", plot.script);
            folder.write(plot.name + ".png", run_gnuplot(plot.script));
        }
        if (arguments.with_tables) write("tables.csv", report_csv(report));
        write("report.json", json_text(report_json(report)));
        write("report.txt", report_text(report));
        folder.commit();
    }
    print(given.format == ReportFormat::json ? json_text(report_json(report)) : report_text(report));
}

} // namespace spa::tools
