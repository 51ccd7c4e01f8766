// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "interrupt.h"
#include "output.h"
#include "text.h"
#include "verb.h"

#include "../samples/samples.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace spa::tools {

namespace {

struct Arguments {
    std::string name;
    std::optional<int> level;
    std::filesystem::path output;
    ReportFormat format = ReportFormat::text;
};

std::string name_list() {
    std::string names;
    for (const samples::Sample& sample : samples::list())
        names += (names.empty() ? "" : ", ") + std::string(sample.name);
    return names;
}

void make_sample(const Arguments& arguments) {
    const samples::Sample* sample = samples::find_sample(arguments.name);
    if (sample == nullptr)
        throw Error(ExitCode::usage, "there is no sample '" + arguments.name + "'; there are " + name_list());
    check_output_file(arguments.output);
    const int level = arguments.level.value_or(sample->default_level);
    const Model model = samples::make_sample(sample->name, level);
    const std::vector<std::byte> bytes = samples::to_glb(model);
    {
        const InterruptGuard guard;
        StagedFile file(arguments.output);
        file.write(bytes);
        InterruptGuard::check();
        file.commit();
    }
    if (arguments.format == ReportFormat::json) {
        const nlohmann::ordered_json report = {
            {"sample", sample->name},
            {"level", level},
            {"vertices", model.positions.size()},
            {"triangles", model.triangles.size()},
            {"output", {{"path", arguments.output.string()}, {"bytes", bytes.size()}}},
        };
        print(json_text(report));
        return;
    }
    print(arguments.output.string() + ": " + std::string(sample->name) + ", level " + std::to_string(level) +
          ", " + std::to_string(model.positions.size()) + " vertices, " +
          std::to_string(model.triangles.size()) + " triangles, " + byte_count(bytes.size()) + "\n");
}

// Made once from the table of samples, which outlives it.
const char* description() {
    static const std::string text = [] {
        std::string all =
            "Writes a model made by code as a binary glTF file: something to bake without any asset "
            "at hand. The samples are:\n";
        for (const samples::Sample& sample : samples::list())
            all += "\n" + std::string(sample.name) + ": " + std::string(sample.description) + "\n";
        return all;
    }();
    return text.c_str();
}

} // namespace

Verb sample_verb() {
    return {
        .name = "sample",
        .summary = "write a model made by code",
        .description = description(),
        .examples = "$ spa sample boot --level 4 -o boot.glb\n"
                    "$ spa sample torus -o torus.glb",
        .see_also = "spa bake",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "NAME", "NAME", "Which sample: " + name_list(),
                     [arguments](const std::string& text) { arguments->name = text; })
                ->required();
            add_text(app, "--level", "L",
                     "Times the base mesh is subdivided, 0 to " + std::to_string(samples::max_level) +
                         "; each level has four times the triangles of the one below",
                     [arguments](const std::string& text) {
                         arguments->level = int(parse_number("--level", text, 0, samples::max_level));
                     })
                ->default_str("the sample's own");
            add_path(app, "-o,--output", "F.glb", "The file to write", arguments->output)->required();
            add_report_format(app, arguments->format);
            return [arguments] { make_sample(*arguments); };
        },
    };
}

} // namespace spa::tools
