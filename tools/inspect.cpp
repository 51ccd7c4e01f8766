// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "inspect_report.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "picture.h"
#include "sheet.h"
#include "verb.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <memory>

namespace spa::tools {

namespace {

struct Arguments {
    std::string input;
    std::filesystem::path sheet;
    ReportFormat format = ReportFormat::text;
};

void inspect(const Arguments& arguments) {
    if (!arguments.sheet.empty()) {
        const std::filesystem::path inputs[] = {arguments.input};
        check_output_file(arguments.sheet, inputs);
    }
    const MapFile file = open_map(arguments.input);
    if (!arguments.sheet.empty()) {
        const std::string title = arguments.input == "-"
                                      ? "standard input"
                                      : std::filesystem::path(arguments.input).filename().string();
        const std::vector<std::byte> png = encode_png(contact_sheet(file.map(), title));
        const InterruptGuard guard;
        StagedFile staged(arguments.sheet);
        staged.write(png);
        InterruptGuard::check();
        staged.commit();
    }
    print(arguments.format == ReportFormat::json ? json_text(inspect_json(file)) : inspect_text(file));
}

} // namespace

Verb inspect_verb() {
    return {
        .name = "inspect",
        .summary = "say what a .spa file holds, and draw it",
        .description =
            "Checks the file in full and prints its version and size, its parts with centre, radius and "
            "frame, "
            "and for every surface the share of directions that it covers and how its depths are distributed "
            "(a bar a 1/32 of the radius); then its sections with their sizes in the file and decoded, and "
            "where "
            "it came from.\n\n"
            "--sheet also draws all images as one labelled picture: colour over a checkerboard where it is "
            "transparent, depth from dark (centre) to bright (sphere), normals with x, y, z as red, green, "
            "blue, "
            "and coverage. Black is where there is no surface.\n\n"
            "A damaged file ends with exit status 3 and a sentence that says what is wrong and where.",
        .examples = "$ spa inspect boot.spa\n"
                    "$ spa inspect boot.spa --sheet boot.png\n"
                    "$ spa inspect boot.spa --format json | jq .parts[0].radius\n"
                    "$ zstd -dc boot.spa.zst | spa inspect -",
        .see_also = "spa bake, spa extract",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "FILE", "FILE", "The .spa file; - reads standard input",
                     [arguments](const std::string& text) { arguments->input = text; })
                ->required();
            add_path(app, "--sheet", "OUT.png", "Draw all images into this file", arguments->sheet);
            add_report_format(app, arguments->format);
            return [arguments] { inspect(*arguments); };
        },
    };
}

} // namespace spa::tools
