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

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <utility>

namespace spa::tools {
namespace {

constexpr int figure_level = 4;

std::uint32_t node_named(const Scene& scene, const std::string& name) {
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == name) return i;
    throw Error(ExitCode::internal, "a scene without a node '" + name + "'");
}

PaperScene paper_scene(Scene scene, std::size_t camera, const std::string& title) {
    PaperScene result;
    result.object = node_named(scene, "boot");
    result.camera = scene.cameras.at(camera);
    result.scene = std::move(scene);
    result.title = title;
    return result;
}

// A scene of the samples: its name, and how it is called in a figure.
struct SampleScene {
    const char* name;
    std::size_t camera;
    const char* title;
};

PaperFigure sample_figure(const std::string& file, const std::string& title, bool direct,
                          std::initializer_list<SampleScene> scenes) {
    PaperFigure figure{file, title, {}, direct};
    for (const SampleScene& scene : scenes)
        figure.scenes.emplace_back([scene] {
            return paper_scene(samples::make_scene(scene.name, figure_level), scene.camera, scene.title);
        });
    return figure;
}

PaperFigure shadow_figure() {
    return sample_figure("fig4-shadows", "Fig. 4: the boot's shadow on a wall", true,
                         {{"wall", 0, "before a wall"}});
}

PaperFigure bleeding_figure() {
    return sample_figure("fig5-colour-bleeding",
                         "Fig. 5: colour bleeding of the boot in a corner of white walls", false,
                         {{"corner", 0, "(a, b) at a right angle to the left wall"},
                          {"corner-b", 0, "(c, d) tip towards the edge"},
                          {"corner-c", 0, "(e, f) both sides to the walls"},
                          {"corner-d", 0, "(g, h) one side to the walls"}});
}

PaperFigure colonnade_figure() {
    return sample_figure("fig6-colonnade", "Fig. 6: the boot in a colonnade, lit from above", false,
                         {{"colonnade", 0, "(a, b) from the side"},
                          {"colonnade-b", 1, "(c, d) the tip, tilted by 20 degrees"}});
}

PaperFigure sponza_figure(const std::string& file) {
    PaperFigure figure{"fig6-sponza", "Fig. 6: the boot in the Sponza scene, lit from above", {}, false};
    const std::pair<std::size_t, const char*> views[] = {{0, "(a, b) from the side"}, {1, "(c, d) the tip"}};
    for (const auto& [camera, title] : views)
        figure.scenes.emplace_back([file, camera = camera, title = title] {
            return paper_scene(samples::with_boot_in_sponza(import::read_scene(file).scene, figure_level),
                               camera, title);
        });
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
    bool with_tables = false;
};

Arguments complete(const BenchArguments& given) {
    for (const auto& [option, value] :
         {std::pair("--models", given.models), std::pair("--layers", given.layers),
          std::pair("--rays", given.rays), std::pair("--threads", given.threads),
          std::pair("--sets", given.sets), std::pair("--sizes", given.sizes)})
        refuse("paper", option, value.has_value());
    refuse_layers_options("paper", given);
    if (given.out.empty()) throw Error(ExitCode::usage, "'spa bench paper' wants --out DIR");
    Arguments arguments;
    if (given.levels) arguments.tables.levels = parse_levels(*given.levels);
    if (given.runs) arguments.tables.runs = parse_number("--runs", *given.runs, 1, max_runs);
    const std::map<std::string, std::function<PaperFigure()>> figures{
        {"shadows", shadow_figure}, {"bleeding", bleeding_figure}, {"colonnade", colonnade_figure}};
    const std::vector<std::string> words =
        given.only ? split(*given.only, ',')
                   : std::vector<std::string>{"shadows", "bleeding", "colonnade", "tables"};
    for (const std::string& word : words) {
        if (const auto figure = figures.find(word); figure != figures.end())
            arguments.chosen.push_back(figure->second());
        else if (word == "tables")
            arguments.with_tables = true;
        else
            throw Error(ExitCode::usage,
                        "--only: '" + word + "' is not one of tables, shadows, bleeding, colonnade");
    }
    if (!given.sponza.empty()) arguments.chosen.push_back(sponza_figure(given.sponza));
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
            arguments.tables.scene = [](int level) {
                return paper_scene(samples::make_scene("corner", level), 0, "corner");
            };
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
