// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "interrupt.h"
#include "output.h"
#include "text.h"
#include "verb.h"

#include "../samples/scenes.h"

#include <CLI/App.hpp>
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
    for (const auto& list : {samples::list(), samples::list_scenes()})
        for (const samples::Sample& sample : list)
            names += (names.empty() ? "" : ", ") + std::string(sample.name);
    return names;
}

// What is written, and what is said of it.
struct Made {
    std::vector<std::byte> bytes;
    std::size_t vertices = 0, triangles = 0;
};

Made make(const samples::Sample& sample, int level) {
    if (samples::find_sample(sample.name) != nullptr) {
        const Model model = samples::make_sample(sample.name, level);
        return {samples::to_glb(model), model.positions.size(), model.triangles.size()};
    }
    const Scene scene = samples::make_scene(sample.name, level);
    return {samples::to_glb(scene), scene.model.positions.size(), scene.model.triangles.size()};
}

void make_sample(const Arguments& arguments) {
    const samples::Sample* sample = samples::find_sample(arguments.name);
    if (sample == nullptr) sample = samples::find_scene(arguments.name);
    if (sample == nullptr)
        throw Error(ExitCode::usage, "there is no sample '" + arguments.name + "'; there are " + name_list());
    check_output_file(arguments.output);
    const int level = arguments.level.value_or(sample->default_level);
    const auto [bytes, vertices, triangles] = make(*sample, level);
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
            {"vertices", vertices},
            {"triangles", triangles},
            {"output", {{"path", arguments.output.string()}, {"bytes", bytes.size()}}},
        };
        print(json_text(report));
        return;
    }
    print(arguments.output.string() + ": " + std::string(sample->name) + ", level " + std::to_string(level) +
          ", " + std::to_string(vertices) + " vertices, " + std::to_string(triangles) + " triangles, " +
          byte_count(bytes.size()) + "\n");
}

// Made once from the table of samples, which outlives it.
const char* description() {
    static const std::string text = [] {
        std::string all =
            "Writes a model or a scene made by code as a binary glTF file: something to bake and to "
            "render without any asset at hand. The models are:\n";
        const auto add = [&all](std::span<const samples::Sample> list) {
            for (const samples::Sample& sample : list)
                all += "\n" + std::string(sample.name) + ": " + std::string(sample.description) + "\n";
        };
        add(samples::list());
        all += "\nThe scenes, with walls, cameras and a light; the boot is the node \"boot\", which a map "
               "baked from that sample can replace:\n";
        add(samples::list_scenes());
        return all;
    }();
    return text.c_str();
}

} // namespace

Verb sample_verb() {
    return {
        .name = "sample",
        .summary = "write a model or scene made by code",
        .description = description(),
        .examples = "$ spa sample boot --level 4 -o boot.glb\n"
                    "$ spa sample torus -o torus.glb\n"
                    "$ spa sample corner --level 4 -o corner.glb",
        .see_also = "spa bake",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "NAME", "NAME", "Which sample: " + name_list(),
                     [arguments](const std::string& text) { arguments->name = text; })
                ->required();
            add_text(app, "--level", "L",
                     "Times the base mesh is subdivided, 0 to " + std::to_string(samples::max_level) +
                         "; each level has four times the triangles of the one below; of a scene, the boot's",
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
