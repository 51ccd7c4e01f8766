// SPDX-License-Identifier: Apache-2.0
#include "bake_file.h"

#include "bake_search.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "progress.h"

#include "../formats/container/writer.h"

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <chrono>
#include <utility>

namespace spa::tools {

namespace {

// The bakers keep to the number of threads themselves; the reader does not know it.
class ThreadLimit {
public:
    explicit ThreadLimit(unsigned threads) {
        if (threads > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }

private:
    std::optional<tbb::global_control> control_;
};

// The output must not replace what the model was made from: the asset or a file that it refers to.
void check_inputs(const BakeArguments& arguments, const import::Report& source) {
    std::vector<std::filesystem::path> inputs{arguments.input};
    for (const import::SourceFile& file : source.files)
        inputs.push_back(arguments.input.parent_path() / file.name);
    check_output_file(arguments.output, inputs,
                      arguments.make_folders ? OutputFolder::is_made : OutputFolder::is_there);
}

void read_asset(const BakeArguments& arguments, BakedFile& baked) {
    const SlowStep step("reading " + arguments.input.filename().string(), arguments.quiet);
    std::optional<std::string> node = arguments.node;
    if (arguments.settings.node) node = std::to_string(*arguments.settings.node);
    baked.source =
        read_source_asset(arguments.input, node, arguments.settings.division(), arguments.follow_links);
    baked.settings = arguments.settings;
    baked.settings.node = baked.source.node;
}

bake::PartsResult bake_with_progress(const BakeArguments& arguments, const SourceAsset& source) {
    ProgressReport progress("baking " + arguments.input.filename().string(), arguments.quiet);
    try {
        return bake::bake_parts(source.asset.model, source.partition, arguments.settings.options,
                                [&progress](double share) {
                                    progress.update(share);
                                    return interrupt_signal() == 0;
                                });
    } catch (const Error& error) {
        // The baker knows a model, not the file that it came from.
        if (error.code() != ExitCode::invalid_data) throw;
        throw Error(error.code(), arguments.input.string() + ": " + error.what());
    }
}

measure::Measurement measure_with_progress(const BakeArguments& arguments, const SourceAsset& source,
                                           std::vector<Part>& parts) {
    ProgressReport progress("measuring " + arguments.output.filename().string(), arguments.quiet);
    measure::MeasureOptions options;
    options.color_samples = arguments.settings.options.samples;
    options.layers = arguments.settings.options.layers;
    options.threads = arguments.settings.options.threads;
    options.rays = measure::RayOptions{}.rays;
    measure::PartsMeasurement measured = measure::measure_parts(source.asset.model, source.partition, parts,
                                                                options, [&progress](double share) {
                                                                    progress.update(share);
                                                                    return interrupt_signal() == 0;
                                                                });
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].errors = measure::error_figures(parts.size() == 1 ? measured.whole : measured.parts[i]);
    return std::move(measured.whole);
}

std::vector<Part> without_images(const std::vector<Part>& parts) {
    std::vector<Part> bare = parts;
    for (Part& part : bare) {
        part.layers.clear();
        part.mixed = part.folds = {};
    }
    return bare;
}

// Leaves what it found in `baked`.
bake::PartsResult search_map(const BakeArguments& arguments, BakedFile& baked) {
    baked.search = search_with_progress(arguments, baked.source);
    baked.measurement = std::move(baked.search->measurement);
    return std::exchange(baked.search->baked, {});
}

std::vector<std::byte> encode(const SphericalMap& map, const BakeArguments& arguments) {
    const SlowStep step("writing " + arguments.output.filename().string(), arguments.quiet);
    container::WriteOptions options;
    options.compression =
        arguments.settings.compress ? container::Compression::zstd : container::Compression::none;
    std::vector<std::byte> bytes;
    require(container::write(map, options, bytes), arguments.output.string());
    return bytes;
}

// Metadata take more room than the search took them to.
void check_bytes(const BakeArguments& arguments, const BakedFile& baked) {
    if (!baked.search || baked.bytes.size() <= arguments.settings.search->max_bytes) return;
    throw Error(ExitCode::limits, arguments.output.string() + ": the map takes " +
                                      std::to_string(baked.bytes.size()) +
                                      " bytes with its metadata, more than --max-bytes; allow more");
}

} // namespace

BakeFacts BakedFile::facts(const BakeArguments& arguments) const {
    return {arguments,
            settings,
            source.node_name,
            source.asset,
            source.partition,
            part_reports,
            parts,
            report,
            measurement ? &*measurement : nullptr,
            search ? &*search : nullptr};
}

BakedFile bake_file(const BakeArguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const ThreadLimit threads(arguments.settings.options.threads);
    check_inputs(arguments, {});
    BakedFile baked;
    read_asset(arguments, baked);
    check_inputs(arguments, baked.source.asset.report);

    const InterruptGuard guard;
    bake::PartsResult result = arguments.settings.search ? search_map(arguments, baked)
                                                         : bake_with_progress(arguments, baked.source);
    baked.part_reports = std::move(result.reports);
    baked.report = bake::sum(baked.part_reports, baked.source.partition);
    SphericalMap& map = result.map.map;
    if (arguments.settings.measure && !baked.measurement)
        baked.measurement = measure_with_progress(arguments, baked.source, map.parts);
    baked.parts = without_images(map.parts);
    map.metadata = metadata(baked.facts(arguments));
    baked.bytes = encode(map, arguments);
    check_bytes(arguments, baked);
    InterruptGuard::check();
    if (arguments.make_folders) make_folders_of(arguments.output);
    StagedFile file(arguments.output);
    file.write(baked.bytes);
    InterruptGuard::check();
    file.commit();
    baked.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return baked;
}

} // namespace spa::tools
