// SPDX-License-Identifier: Apache-2.0
#include "bake_file.h"
#include "inspect_report.h"
#include "map_file.h"
#include "output.h"
#include "search_report.h"
#include "verb.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace spa::tools {

namespace {

nlohmann::ordered_json output_json(const BakeArguments& arguments, const std::vector<std::byte>& bytes) {
    container::File file;
    require(container::open(bytes, file, {container::no_limits, container::CheckDepth::structure, false}),
            arguments.output.string());
    return {{"path", arguments.output.string()},
            {"bytes", bytes.size()},
            {"sections", sections_json(file.sections())}};
}

void bake_asset(const BakeArguments& arguments) {
    const BakedFile baked = bake_file(arguments);
    const BakeFacts facts = baked.facts(arguments);
    if (!baked.source.node_warning.empty())
        std::cerr << "spa: warning: " << baked.source.node_warning << '\n';
    for (const std::string& warning : warnings(facts)) std::cerr << "spa: warning: " << warning << '\n';
    print(arguments.format == ReportFormat::json
              ? json_text(report_json(facts, output_json(arguments, baked.bytes), baked.seconds))
              : report_text(facts, baked.bytes.size(), baked.seconds));
    if (baked.search && !baked.search->met)
        throw Error(ExitCode::limits,
                    arguments.input.string() + ": " + unmet_text(arguments.settings, *baked.search));
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
                    "$ spa bake boot.glb -o boot.spa --target-error 0.01 --max-bytes 256K\n"
                    "$ spa bake room.glb --node lamp -o lamp.spa\n"
                    "$ spa bake boot.glb -o boot.spa --format json | jq .report",
        .see_also = "spa batch, spa inspect, spa extract, spa sample",
        .define = [](CLI::App& app) -> std::function<void()> {
            return [complete = define_bake_arguments(app)] { bake_asset(complete()); };
        },
    };
}

} // namespace spa::tools
