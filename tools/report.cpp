// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "batch_report.h"
#include "interrupt.h"
#include "output.h"
#include "progress.h"
#include "report_files.h"
#include "report_map.h"
#include "report_page.h"
#include "report_plan.h"
#include "report_text.h"
#include "verb.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>
#include <sstream>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

// A sheet is some 50 KiB; a page is to stay one that a browser opens at once.
constexpr std::size_t most_sheets = 100;

struct Arguments {
    std::vector<std::string> inputs;
    std::filesystem::path output;
    MapReportOptions maps;
    bool no_speed = false, no_sheets = false, quiet = false;
    ReportFormat format = ReportFormat::text;
};

struct Report { // NOLINT(bugprone-exception-escape): of moving a Json, which is noexcept
    Json json;
    std::vector<MapPictures> pictures; // of each map
    std::size_t unread = 0;
    ExitCode failure = ExitCode::ok; // of the first file that could not be read
};

void note_failure(Report& report, ExitCode code, const Json& entry) {
    if (report.unread++ == 0) report.failure = code;
    std::cerr << "spa: " << one_line(entry["error"].get_ref<const std::string&>()) << '\n';
}

Report make_report(const Arguments& arguments, const ReportFiles& found) {
    MapReportOptions options = arguments.maps;
    if (arguments.no_speed) options.rays = 0;
    options.pictures = !arguments.output.empty();
    options.sheets = !arguments.no_sheets && found.files.size() <= most_sheets;

    Report report;
    report.json = {{"generator", {{"name", "spa"}, {"version", SPA_VERSION}}},
                   {"inputs", arguments.inputs},
                   {"rays", options.rays == 0 ? Json(nullptr) : Json(options.rays)},
                   {"warnings", found.warnings},
                   {"maps", Json::array()},
                   {"plans", Json::array()}};
    ProgressReport progress("reading " + std::to_string(found.files.size()) + " files", arguments.quiet);
    std::size_t done = 0;
    for (const ReportFile& file : found.files) {
        progress.update(double(done++) / double(found.files.size()));
        InterruptGuard::check();
        if (file.kind == ReportFileKind::plan) {
            Json plan = plan_json(file);
            if (!plan["error"].is_null()) note_failure(report, ExitCode::invalid_data, plan);
            report.json["plans"].push_back(std::move(plan));
            continue;
        }
        MapReport map = report_map(file, options, [] { return interrupt_signal() == 0; });
        if (map.failure) note_failure(report, *map.failure, map.json);
        report.json["maps"].push_back(std::move(map.json));
        report.pictures.push_back(std::move(map.pictures));
    }
    return report;
}

void report(const Arguments& arguments) {
    const ReportFiles found = find_report_files(arguments.inputs);
    if (!arguments.output.empty()) {
        std::vector<std::filesystem::path> inputs;
        for (const ReportFile& file : found.files) inputs.push_back(file.path);
        check_output_file(arguments.output, inputs);
    }
    for (const std::string& warning : found.warnings)
        std::cerr << "spa: warning: " << one_line(warning) << '\n';
    Report made;
    {
        const InterruptGuard guard;
        made = make_report(arguments, found);
        if (!arguments.output.empty()) {
            std::ostringstream page;
            write_report_page(page, made.json, made.pictures);
            StagedFile staged(arguments.output);
            staged.write(std::as_bytes(std::span(page.view())));
            InterruptGuard::check();
            staged.commit();
        }
    }
    print(arguments.format == ReportFormat::json ? json_text(made.json) : report_text(made.json));
    if (made.unread > 0)
        throw Error(made.failure, std::to_string(made.unread) + " of " + std::to_string(found.files.size()) +
                                      " files could not be read; the report says why");
}

} // namespace

Verb report_verb() {
    return {
        .name = "report",
        .summary = "compare many maps on one page: speed, error, bytes",
        .description =
            "Reads .spa files, and all of them below folders, and says of each what a ray through it costs, "
            "how "
            "wrong it is and how many bytes it takes. -o writes that as one page for a browser that needs "
            "nothing else: plots of error against speed and against bytes, a table that sorts and filters, "
            "the "
            "maps' images, and what was decided and why by searches ('spa bake --target-error') and by plans "
            "of "
            "scenes (PLAN.json files, given by name or found in the folders).\n\n"
            "Speed is measured: random chords of the sphere around each object, on one thread. Where the "
            "asset "
            "that a map was baked from lies beside it, or below --source, the same rays are traced through "
            "its "
            "triangles too. --no-speed leaves that out; then the same files give the same page.\n\n"
            "Errors are those that 'spa bake --measure' left in the file. A map without any is measured by "
            "the "
            "same number of rays if its source is found; else its error is unknown.\n\n"
            "A file that cannot be read has its line in the report, and the exit status is that of the "
            "first.",
        .examples = "$ spa report maps -o report.html\n"
                    "$ spa report maps --source assets -o report.html\n"
                    "$ spa report room.maps PLAN.json -o report.html\n"
                    "$ spa report maps --no-speed --format json | jq .maps[0].errors",
        .see_also = "spa bake, spa batch, spa bench, spa validate",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            app.add_option("PATH", arguments->inputs, "Folders, .spa files, plans (.json)")
                ->required()
                ->type_name("PATH");
            add_path(app, "-o,--output", "OUT.html", "Write the page into this file", arguments->output);
            add_path(
                app, "--source", "DIR",
                "Where the assets lie: a map's in the same folder below DIR as the map below its own, or "
                "in DIR itself",
                arguments->maps.source_folder);
            add_text(app, "--rays", "N", "Rays to time each map and its source with, and to measure it with",
                     [arguments](const std::string& text) {
                         arguments->maps.rays = parse_number("--rays", text, 16, 100'000'000);
                     })
                ->default_str(std::to_string(arguments->maps.rays));
            app.add_flag("--no-speed", arguments->no_speed, "Trace nothing, and look for no sources");
            app.add_flag("--no-sheets", arguments->no_sheets,
                         "Leave the sheets of images out of the page, as is done beyond 100 files");
            add_report_format(app, arguments->format);
            add_follow_links(app, arguments->maps.follow_links);
            app.add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
            return [arguments] { report(*arguments); };
        },
    };
}

} // namespace spa::tools
