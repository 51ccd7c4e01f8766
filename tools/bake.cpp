// SPDX-License-Identifier: Apache-2.0
#include "bake_report.h"
#include "inspect_report.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "progress.h"
#include "verb.h"

#include "../formats/container/writer.h"

#include <chrono>
#include <iostream>

namespace spa::tools {

namespace {

// The output must not replace what the model was made from: the asset or a file that it refers to.
void check_inputs(const BakeArguments& arguments, const import::Report& source) {
    std::vector<std::filesystem::path> inputs{arguments.input};
    for (const import::SourceFile& file : source.files)
        inputs.push_back(arguments.input.parent_path() / file.name);
    check_output_file(arguments.output, inputs);
}

spa::import::Result read_asset(const BakeArguments& arguments) {
    const SlowStep step("reading " + arguments.input.filename().string(), arguments.quiet);
    return import::read_model(arguments.input);
}

bake::Result bake_with_progress(const BakeArguments& arguments, const Model& model) {
    ProgressReport progress("baking " + arguments.input.filename().string(), arguments.quiet);
    try {
        return bake::bake_model(model, arguments.options, [&progress](double share) {
            progress.update(share);
            return interrupt_signal() == 0;
        });
    } catch (const Error& error) {
        // The baker knows a model, not the file that it came from.
        if (error.code() != ExitCode::invalid_data) throw;
        throw Error(error.code(), arguments.input.string() + ": " + error.what());
    }
}

measure::Measurement measure_with_progress(const BakeArguments& arguments, const Model& model,
                                           const Part& part) {
    ProgressReport progress("measuring " + arguments.output.filename().string(), arguments.quiet);
    measure::MeasureOptions options;
    options.color_samples = arguments.options.samples;
    options.layers = arguments.options.layers;
    options.threads = arguments.options.threads;
    options.rays = measure::RayOptions{}.rays;
    return measure::measure_map(model, part, options, [&progress](double share) {
        progress.update(share);
        return interrupt_signal() == 0;
    });
}

std::vector<std::byte> encode(const SphericalMap& map, const BakeArguments& arguments) {
    const SlowStep step("writing " + arguments.output.filename().string(), arguments.quiet);
    container::WriteOptions options;
    options.compression = arguments.compress ? container::Compression::zstd : container::Compression::none;
    std::vector<std::byte> bytes;
    require(container::write(map, options, bytes), arguments.output.string());
    return bytes;
}

nlohmann::ordered_json output_json(const BakeArguments& arguments, const std::vector<std::byte>& bytes) {
    container::File file;
    require(container::open(bytes, file, {container::no_limits, container::CheckDepth::structure, false}),
            arguments.output.string());
    return {{"path", arguments.output.string()},
            {"bytes", bytes.size()},
            {"sections", sections_json(file.sections())}};
}

void bake_asset(const BakeArguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    check_inputs(arguments, {});
    const import::Result source = read_asset(arguments);
    check_inputs(arguments, source.report);

    bake::Result result;
    std::optional<measure::Measurement> measurement;
    BakeFacts facts{arguments, source, result.report};
    std::vector<std::byte> bytes;
    {
        const InterruptGuard guard;
        result = bake_with_progress(arguments, source.model);
        Part& part = result.map.map.parts.front();
        if (arguments.measure) {
            measurement = measure_with_progress(arguments, source.model, part);
            part.errors = measure::error_figures(*measurement);
        }
        facts.measurement = measurement ? &*measurement : nullptr;
        result.map.map.metadata = metadata(facts);
        bytes = encode(result.map.map, arguments);
        InterruptGuard::check();
        StagedFile file(arguments.output);
        file.write(bytes);
        InterruptGuard::check();
        file.commit();
    }

    for (const std::string& warning : warnings(facts)) std::cerr << "spa: warning: " << warning << '\n';
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print(arguments.format == ReportFormat::json
              ? json_text(report_json(facts, output_json(arguments, bytes), seconds))
              : report_text(facts, bytes.size(), seconds));
}

} // namespace

Verb bake_verb() {
    return {
        .name = "bake",
        .summary = "turn a mesh into a spherical map",
        .description =
            "Reads an asset, bakes it into one spherical map and writes it as a .spa file. For every "
            "direction "
            "from the centre of the object the map holds the intervals of solid (layers), and at their ends "
            "the "
            "distance from the centre as a share of the radius of the bounding sphere, the colour and the "
            "normal.\n\n"
            "The report on standard output says what was baked and what was not: pieces that no sample met, "
            "surfaces seen edge-on from the centre, open edges, samples with more surfaces than layers. What "
            "deserves a second look is a warning on standard error. The same facts are in the metadata of "
            "the "
            "file ('spa inspect' shows them).\n\n"
            "The same asset and options give the same bytes, whatever the machine's number of cores.",
        .examples = "$ spa bake boot.glb -o boot.spa\n"
                    "$ spa bake boot.glb -o boot.spa --size 512 --color-size 1024 --samples 4\n"
                    "$ spa bake boot.glb -o boot.spa --mapping latlong --size 1024x512\n"
                    "$ spa bake boot.glb -o boot.spa --paper --baker orbit\n"
                    "$ spa bake boot.glb -o boot.spa --measure\n"
                    "$ spa bake boot.glb -o boot.spa --format json | jq .report",
        .see_also = "spa inspect, spa extract, spa sample",
        .define = [](CLI::App& app) -> std::function<void()> {
            return [complete = define_bake_arguments(app)] { bake_asset(complete()); };
        },
    };
}

} // namespace spa::tools
