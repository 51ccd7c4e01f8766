// SPDX-License-Identifier: Apache-2.0
#include "heat_sheet.h"
#include "interrupt.h"
#include "map_source.h"
#include "output.h"
#include "progress.h"
#include "source_asset.h"
#include "validate_report.h"
#include "verb.h"

#include "arguments.h"

#include "../libspa/bake/bake_parts.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <iostream>
#include <memory>

namespace spa::tools {

namespace {

using measure::Measurement;
using measure::WorstTexel;

struct Threshold {
    const char* option;
    const char* value_name;
    const char* description;
    double (*value)(const Measurement&);
    std::optional<WorstTexel> (*at)(const Measurement&); // null: a figure without a place
};

constexpr std::array thresholds{
    Threshold{"--max-texel-distance", "R", "Largest distance of a stored point to the source, in radii",
              [](const Measurement& m) { return m.texel_distance.max; },
              [](const Measurement& m) { return m.worst_distance; }},
    Threshold{"--max-surface-distance", "R",
              "Largest distance of the source's surface to the map's, in radii",
              [](const Measurement& m) { return m.surface_distance.max; }, nullptr},
    Threshold{"--max-normal", "DEG", "Largest angle between a stored normal and the source's, in degrees",
              [](const Measurement& m) { return m.normal_angle.max; },
              [](const Measurement& m) { return m.worst_normal; }},
    Threshold{"--max-color", "CODES", "Largest difference of red, green, blue or coverage, in codes of 255",
              [](const Measurement& m) { return std::max(m.color_difference.max, m.alpha_difference.max); },
              [](const Measurement& m) {
                  return m.alpha_difference.max > m.color_difference.max ? m.worst_alpha : m.worst_color;
              }},
    Threshold{"--min-captured", "SHARE", "Smallest share of the source's area that the layers hold, 0 to 1",
              [](const Measurement& m) { return m.captured_area; }, nullptr},
    Threshold{"--min-coverage", "SHARE",
              "Smallest share of texels that have a surface where the source has one, 0 to 1",
              [](const Measurement& m) { return m.coverage.share(); }, nullptr},
    Threshold{"--max-false-hits", "SHARE", "Largest share of rays that hit the map alone, 0 to 1",
              [](const Measurement& m) { return m.rays->false_hits(); }, nullptr},
    Threshold{"--max-missed-hits", "SHARE", "Largest share of rays that hit the source alone, 0 to 1",
              [](const Measurement& m) { return m.rays->missed_hits(); }, nullptr},
};

bool is_of_rays(const Threshold& threshold) { return std::string(threshold.option).ends_with("-hits"); }

bool is_share(const Threshold& threshold) { return std::string(threshold.value_name) == "SHARE"; }

struct Arguments {
    std::string input;
    std::filesystem::path source, heat;
    std::array<std::optional<double>, thresholds.size()> limits;
    std::uint32_t rays = 0;
    std::optional<ReportFormat> format;
    bool follow_links = false;
    bool quiet = false;

    [[nodiscard]] bool needs_source() const {
        return !source.empty() || !heat.empty() || rays > 0 ||
               std::any_of(limits.begin(), limits.end(), [](const auto& limit) { return limit.has_value(); });
    }
    // As given, or the default where a threshold asks for them.
    [[nodiscard]] std::uint32_t needed_rays() const {
        if (rays > 0) return rays;
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            if (limits[i] && is_of_rays(thresholds[i])) return measure::RayOptions{}.rays;
        return 0;
    }
};

std::vector<Judged> judge(const Arguments& arguments, const Measurement& measurement) {
    std::vector<Judged> all;
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
        if (!arguments.limits[i]) continue;
        const Threshold& threshold = thresholds[i];
        Judged judged{threshold.option, *arguments.limits[i], threshold.value(measurement), true, {}};
        const bool at_least = judged.option.starts_with("--min");
        judged.met = at_least ? judged.value >= judged.limit : judged.value <= judged.limit;
        if (threshold.at != nullptr) judged.at = threshold.at(measurement);
        all.push_back(judged);
    }
    return all;
}

// The options of the bake that a measurement depends on; what another program wrote may lack them.
const nlohmann::ordered_json& bake_option(const nlohmann::ordered_json& metadata, const char* name,
                                          const nlohmann::ordered_json& otherwise) {
    if (!metadata.is_object() || !metadata.contains("options")) return otherwise;
    const auto& options = metadata["options"];
    return options.is_object() && options.contains(name) ? options[name] : otherwise;
}

SourceAsset read_source(const Arguments& arguments, const MapFile& file, const std::filesystem::path& path) {
    try {
        return read_source_asset(path, division_of(parse_metadata(file.map())), arguments.follow_links);
    } catch (const Error& error) {
        if (!arguments.source.empty()) throw;
        throw Error(error.code(), std::string(error.what()) + " (the container " + file.name +
                                      " is valid; this file beside it has the name of its source)");
    }
}

std::vector<measure::Finding> find_defects(const std::vector<Part>& parts, const Partition& partition,
                                           const measure::PartsMeasurement& measured,
                                           double color_tolerance) {
    if (parts.size() == 1) return measure::find_defects(parts.front(), measured.whole, color_tolerance);
    std::vector<measure::Finding> all;
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        for (measure::Finding& finding :
             measure::find_defects(parts[i], measured.parts[i], color_tolerance)) {
            finding.message = bake::part_name(partition, i) + ": " + finding.message;
            if (finding.at) finding.at->part = i;
            all.push_back(std::move(finding));
        }
    }
    return all;
}

void measure_source(const Arguments& arguments, const MapFile& file, const std::filesystem::path& path,
                    Validation& validation) {
    const std::string title = std::filesystem::path(file.name).filename().string();
    SourceAsset source;
    {
        const SlowStep step("reading " + path.filename().string(), arguments.quiet);
        source = read_source(arguments, file, path);
    }
    if (!arguments.heat.empty()) {
        std::vector<std::filesystem::path> inputs{file.name, path};
        for (const import::SourceFile& used : source.asset.report.files)
            inputs.push_back(path.parent_path() / used.name);
        check_output_file(arguments.heat, inputs);
    }
    validation.source = {path, differing_files(file, source.asset.report)};
    if (validation.source->differing && !validation.source->differing->empty()) {
        std::string names;
        for (const std::string& name : *validation.source->differing)
            names += (names.empty() ? "" : ", ") + name;
        std::cerr << "spa: warning: " << path.string() << " is not what " << file.name
                  << " was baked from: the hash differs for " << names << '\n';
    }
    const std::vector<Part>& parts = file.map().parts;
    if (parts.size() != source.partition.size())
        throw Error(ExitCode::invalid_data,
                    file.name + ": has " + std::to_string(parts.size()) + " parts, but " + path.string() +
                        " divides into " + std::to_string(source.partition.size()) +
                        " by the options of its bake; is it what the map was baked from?");
    const auto metadata = parse_metadata(file.map());
    const auto samples = bake_option(metadata, "samples", 1);
    const auto layers = bake_option(metadata, "layers", 0);
    const bool orbit = bake_option(metadata, "baker", "") == "orbit";
    measure::MeasureOptions options;
    if (samples.is_number_unsigned() && samples.get<std::uint64_t>() <= 8)
        options.color_samples = std::max(1U, samples.get<std::uint32_t>());
    if (layers.is_number_unsigned() && layers.get<std::uint64_t>() <= 64)
        options.layers = layers.get<std::uint32_t>();
    options.rays = arguments.needed_rays();
    if (const Part& part = parts.front(); options.rays > 0 && part.mapping != Mapping::octahedral)
        throw Error(ExitCode::unsupported, file.name +
                                               ": rays are traced through octahedral maps; this one is " +
                                               name(part.mapping));
    ProgressReport progress("measuring " + title, arguments.quiet);
    const InterruptGuard guard;
    validation.measurement =
        measure::measure_parts(source.asset.model, source.partition, parts, options, [&](double share) {
            progress.update(share);
            return interrupt_signal() == 0;
        });
    const measure::PartsMeasurement& measured = *validation.measurement;
    // Colours filtered by a texture unit may round otherwise; the bakers' agreement allows as much. Of
    // several samples a texel those on edges are not looked at again.
    const double color_tolerance = orbit ? 1.0 : options.color_samples > 1 ? 0.05 : 0.0;
    validation.findings = find_defects(parts, source.partition, measured, color_tolerance);
    validation.thresholds = judge(arguments, measured.whole);
    if (arguments.heat.empty()) return;
    StagedFile staged(arguments.heat);
    staged.write(encode_png(heat_sheet(parts, measured.whole, title)));
    InterruptGuard::check();
    staged.commit();
}

void validate(const Arguments& arguments) {
    if (!arguments.heat.empty()) {
        const std::filesystem::path inputs[] = {arguments.input, arguments.source};
        check_output_file(arguments.heat, inputs);
    }
    const MapFile file = open_map(arguments.input);
    const std::filesystem::path path = arguments.source.empty() ? source_beside(file) : arguments.source;
    Validation validation;
    if (!path.empty()) {
        measure_source(arguments, file, path, validation);
    } else if (arguments.needs_source()) {
        throw Error(ExitCode::input_output,
                    file.name + ": the file it was baked from does not lie beside it; name it with --source");
    }
    if (arguments.format)
        print(*arguments.format == ReportFormat::json ? json_text(validate_json(file, validation))
                                                      : validate_text(file, validation));
    std::string failed;
    for (const Judged& judged : validation.thresholds)
        if (!judged.met) failed += (failed.empty() ? "" : "; ") + judged.sentence();
    for (const measure::Finding& finding : validation.findings)
        std::cerr << "spa: " << file.name << ": " << finding.message << '\n';
    if (!failed.empty()) throw Error(ExitCode::limits, file.name + ": " + failed);
    if (!validation.findings.empty())
        throw Error(ExitCode::limits, file.name + ": is not what a bake of " + path.filename().string() +
                                          " would hold; see above");
}

} // namespace

Verb validate_verb() {
    return {
        .name = "validate",
        .summary = "check a .spa file, and measure it against its source",
        .description =
            "Checks the container in full. If the asset it was baked from lies beside it, under the name "
            "that "
            "the "
            "metadata gives, or is named by --source, every texel is also re-projected to a point in space "
            "and "
            "measured against the asset's triangles, and the asset's surface against the map: distances both "
            "ways, the share of the surface that the layers hold, normals, colours, coverage, and whether "
            "every "
            "depth is as exact as its element format allows. docs/measures.md explains each figure.\n\n"
            "Silent if all is well, unless --format asks for a report (on a terminal a bar shows progress). "
            "A figure beyond a threshold ends with "
            "exit status 6 and so does a finding: something that no correct bake of the source would hold, "
            "such as a "
            "hole, a wrong radius, or a depth off by more than quantization. Each is named with its place. A "
            "damaged file ends with status 3. A source whose hash is not the one in the metadata is measured "
            "all the same, with a warning. A source that is not found is an error if anything was asked of "
            "it: a "
            "threshold, a picture.\n\n"
            "--rays N traces N random rays as renderers send them from diffuse bounces and close surfaces, "
            "through the map and through the asset's triangles: how many hit the map alone or the asset "
            "alone, "
            "in the band of silhouettes and elsewhere, how many of those no resolution would mend (E_star), "
            "and "
            "how far hits, normals and colours are apart.\n\n"
            "--heat draws for every surface where it is wrong and by how much.",
        .examples = "$ spa validate boot.spa\n"
                    "$ spa validate boot.spa --format text\n"
                    "$ spa validate boot.spa --source models/boot.glb --heat heat.png\n"
                    "$ spa validate boot.spa --rays 100000 --format text\n"
                    "$ spa validate boot.spa --max-surface-distance 0.01 --min-captured 0.99\n"
                    "$ spa validate boot.spa --format json | jq .figures.hausdorff",
        .see_also = "spa bake, spa compare, spa inspect",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "FILE", "FILE", "The .spa file; - reads standard input",
                     [arguments](const std::string& text) { arguments->input = text; })
                ->required();
            add_path(app, "--source", "MESH", "The asset to measure against", arguments->source);
            add_path(app, "--heat", "OUT.png", "Draw the errors of every texel into this file",
                     arguments->heat);
            add_text(
                app, "--rays", "N",
                "Trace N secondary rays through the map and through the source, and report how they differ",
                [arguments](const std::string& text) {
                    arguments->rays = parse_number("--rays", text, 1, 100'000'000);
                });
            for (std::size_t i = 0; i < thresholds.size(); ++i)
                add_text(app, thresholds[i].option, thresholds[i].value_name, thresholds[i].description,
                         [arguments, i](const std::string& text) {
                             const std::string option = thresholds[i].option;
                             const double limit = parse_measure(option, text);
                             if (is_share(thresholds[i]) && limit > 1)
                                 throw Error(ExitCode::usage,
                                             option + ": '" + text + "' is above 1; a share is from 0 to 1");
                             arguments->limits[i] = limit;
                         });
            add_choice<ReportFormat>(app, "--format", {ReportFormat::text, ReportFormat::json},
                                     "Report on standard output as text for people or as JSON",
                                     [arguments](ReportFormat given) { arguments->format = given; });
            add_follow_links(app, arguments->follow_links);
            app.add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
            return [arguments] {
                arguments->quiet = arguments->quiet || !stderr_is_terminal();
                validate(*arguments);
            };
        },
    };
}

} // namespace spa::tools
