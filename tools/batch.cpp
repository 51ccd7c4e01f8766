// SPDX-License-Identifier: Apache-2.0
#include "batch_page.h"
#include "batch_plan.h"
#include "batch_run.h"
#include "interrupt.h"
#include "output.h"
#include "picture_store.h"
#include "verb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <span>
#include <sstream>

namespace spa::tools {

namespace {

bool is_page(const std::filesystem::path& report) { return report.extension() == ".html"; }

// Says what would go wrong, and removes what a killed run left.
void prepare_report(const std::filesystem::path& path) {
    check_output_file(path);
    const std::string staged = staged_name(path.filename().string());
    remove_leftovers(path.has_parent_path() ? path.parent_path() : ".",
                     [&](const std::string& name) { return name == staged; });
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    StagedFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

// All that can be written; returns what the first that cannot failed for.
std::optional<Error> write_reports(const BatchReport& report, const PictureStore* pictures) {
    std::optional<Error> failure;
    if (report.arguments.reports.empty()) return failure;
    const nlohmann::ordered_json json = batch_json(report);
    for (const std::filesystem::path& path : report.arguments.reports) {
        std::ostringstream text;
        if (is_page(path))
            write_batch_page(text, json, [&](std::size_t asset) {
                return pictures == nullptr ? std::vector<std::byte>() : pictures->get(asset);
            });
        else
            text << json_text(json);
        try {
            write_text(path, text.str());
        } catch (const Error& error) {
            if (!failure) failure = error;
        }
    }
    return failure;
}

// Throws what the batch has to say last, if it did not end well.
void conclude(const BatchReport& report) {
    const auto counts = report.counts();
    const std::string left = std::to_string(counts[std::size_t(AssetStatus::not_started)]);
    if (report.stopped_by == BatchStop::signal)
        throw Interrupted("interrupted; " + left + " assets are left, and the next run goes on there");
    if (report.exit_code() == ExitCode::ok) return;
    const std::string failed = std::to_string(counts[std::size_t(AssetStatus::failed)]);
    throw Error(report.exit_code(),
                failed + " of " + std::to_string(report.assets.size()) + " assets failed" +
                    (report.stopped_by == BatchStop::output
                         ? "; stopped, as outputs cannot be written: " + left + " are left"
                         : ""));
}

void batch(const BatchArguments& arguments) {
    for (const std::filesystem::path& report : arguments.reports) prepare_report(report);
    AssetList list = arguments.plan.empty() ? find_assets(arguments.query)
                                            : plan_assets(read_plan(arguments.plan), arguments.query);
    BatchSettings settings(arguments.config, arguments.command_line);
    for (const BatchAsset& asset : list.assets) static_cast<void>(settings.of(asset.name, asset.settings));
    for (const std::string& warning : list.warnings)
        std::cerr << "spa: warning: " << one_line(warning) << '\n';

    BatchReport report{arguments, list.assets, settings, {}, list.warnings, BatchStop::none, 0};
    std::optional<PictureStore> pictures;
    if (std::any_of(arguments.reports.begin(), arguments.reports.end(), is_page) && !arguments.dry_run)
        pictures.emplace(list.assets.size());
    std::optional<Error> unwritten;
    {
        const InterruptGuard
            guard; // until the reports are written: they are to say what a signal left undone
        run_batch(report, pictures ? PictureSink([&](std::size_t asset, std::span<const std::byte> png) {
                      pictures->put(asset, png);
                  })
                                   : nullptr);
        unwritten = write_reports(report, pictures ? &*pictures : nullptr);
    }
    print(arguments.format == ReportFormat::json ? json_text(batch_json(report)) : batch_text(report));
    if (unwritten) std::cerr << "spa: " << unwritten->what() << '\n';
    conclude(report);
    if (unwritten) throw Error(unwritten->code(), "a report could not be written");
}

} // namespace

Verb batch_verb() {
    return {
        .name = "batch",
        .summary = "bake folders of assets",
        .description =
            "Bakes every asset below the given folders into a .spa file of the same path below OUT_DIR, "
            "several "
            "at once. A map that is up to date is left alone: its metadata hold a key of the asset, every "
            "file that it "
            "refers to, the options and the version of the baker, and the key decides, not the time of a "
            "file. So the "
            "next run goes on where one ended, for whatever reason it did, and costs next to nothing where "
            "nothing "
            "changed.\n\n"
            "Each asset is baked in a process of its own. One that is malformed, crashes, or exceeds "
            "--timeout or "
            "--memory is reported, and the batch goes on; the exit status is then that of the first of them, "
            "in the "
            "order of their paths: 4 after a crash, 6 after a timeout, 5 for want of memory. Where an output "
            "cannot be "
            "written because the disk is full or read-only, no further asset is begun, unless "
            "--keep-going.\n\n"
            "Ctrl-C ends the bakes under way, writes the reports and leaves nothing half-written. Several "
            "runs on one "
            "OUT_DIR do each other no harm.\n\n"
            "A bar on a terminal, elsewhere a line for each asset, goes to standard error; the counts and "
            "what failed "
            "to standard output.\n\n"
            "The options of a bake are those of 'spa bake'; a map has the same bytes as one from there.",
        .examples = "$ spa batch assets -o maps\n"
                    "$ spa batch assets -o maps --size 128 --report maps.html\n"
                    "$ spa batch assets -o maps --include 'props/**' --dry-run\n"
                    "$ spa batch assets -o maps --config bake.json --memory 16G --timeout 600\n"
                    "$ spa batch assets -o maps --shard 1/4\n"
                    "$ spa batch --from-plan room.plan.json --report maps.html\n"
                    "$ find assets -name '*.glb' -print0 | spa batch - -o maps",
        .see_also = "spa bake, spa validate, spa inspect",
        .define = [](CLI::App& app) -> std::function<void()> {
            return [complete = define_batch_arguments(app)] { batch(complete()); };
        },
    };
}

} // namespace spa::tools
