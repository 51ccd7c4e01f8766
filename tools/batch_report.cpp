// SPDX-License-Identifier: Apache-2.0
#include "batch_report.h"

#include "text.h"

#include "../formats/container/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <utility>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_failures_listed = 20;

// What is not known is 0 in a result.
template <class T>
Json number_or_null(T value) {
    return value == T{} ? Json(nullptr) : Json(value);
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json asset_json(const BatchReport& report, std::size_t i) {
    const BatchAsset& asset = report.assets[i];
    const AssetResult& result = report.results[i];
    // Of a map that is there its own; else those that were asked for.
    Json options = result.facts.options.empty() ? options_json(report.settings.of(asset.name, asset.settings))
                                                : Json::parse(result.facts.options);
    return {
        {"source", asset.name},
        {"path", asset.path.string()},
        {"output", asset.output.string()},
        {"status", name(result.status)},
        {"reason", text_or_null(name(result.reason))},
        {"exit_code",
         result.status == AssetStatus::not_started ? Json(nullptr) : Json(int(result.exit_code))},
        {"signal", result.signal == 0 ? Json(nullptr) : Json(signal_name(result.signal))},
        {"error", text_or_null(result.error)},
        {"diagnostics", result.diagnostics},
        {"warnings", result.warnings},
        {"seconds", number_or_null(result.seconds)},
        {"peak_memory_bytes", number_or_null(result.peak_memory_bytes)},
        {"source_bytes", number_or_null(result.facts.source_bytes)},
        {"triangles", number_or_null(result.facts.triangles)},
        {"output_bytes", number_or_null(result.facts.bytes)},
        {"size", options["size"]},
        {"layers", options["layers"]},
        {"node", asset.node ? Json(*asset.node) : Json(nullptr)},
        {"figures", result.facts.figures.empty() ? Json(nullptr) : Json::parse(result.facts.figures)},
    };
}

const char* name(BatchStop stop) { return stop == BatchStop::signal ? "signal" : "output"; }

std::size_t count(const std::array<std::size_t, 4>& counts, AssetStatus status) {
    return counts[std::size_t(status)];
}

std::string counts_text(const BatchReport& report) {
    const auto counts = report.counts();
    std::string text = std::to_string(report.assets.size()) +
                       (report.assets.size() == 1 ? " asset: " : " assets: ") +
                       std::to_string(count(counts, AssetStatus::baked)) +
                       (report.arguments.dry_run ? " to bake, " : " baked, ") +
                       std::to_string(count(counts, AssetStatus::up_to_date)) + " up to date, " +
                       std::to_string(count(counts, AssetStatus::failed)) + " failed";
    if (count(counts, AssetStatus::not_started) > 0)
        text += ", " + std::to_string(count(counts, AssetStatus::not_started)) + " not started";
    return text + "\n";
}

} // namespace

const char* name(AssetStatus status) {
    switch (status) {
    case AssetStatus::baked: return "baked";
    case AssetStatus::up_to_date: return "up_to_date";
    case AssetStatus::failed: return "failed";
    case AssetStatus::not_started: break;
    }
    return "not_started";
}

std::array<std::size_t, 4> BatchReport::counts() const {
    std::array<std::size_t, 4> counts{};
    for (const AssetResult& result : results) ++counts[std::size_t(result.status)];
    return counts;
}

ExitCode BatchReport::exit_code() const {
    const auto failed = std::find_if(results.begin(), results.end(), [](const AssetResult& result) {
        return result.status == AssetStatus::failed;
    });
    return failed == results.end() ? ExitCode::ok : failed->exit_code;
}

Json batch_json(const BatchReport& report) {
    const BatchArguments& arguments = report.arguments;
    const auto counts = report.counts();
    Json assets = Json::array();
    for (std::size_t i = 0; i < report.assets.size(); ++i) assets.push_back(asset_json(report, i));
    const auto& shard = arguments.query.shard;
    return {
        {"generator", {{"name", "spa"}, {"version", SPA_VERSION}}},
        {"inputs", arguments.query.inputs},
        {"plan", arguments.plan.empty() ? Json(nullptr) : Json(arguments.plan.string())},
        {"output", arguments.query.output.string()},
        {"shard", shard ? Json{{"index", shard->index}, {"count", shard->count}} : Json(nullptr)},
        {"jobs", arguments.jobs},
        {"memory_bytes", arguments.memory_bytes},
        {"timeout_seconds", arguments.timeout ? Json(arguments.timeout->count()) : Json(nullptr)},
        {"dry_run", arguments.dry_run},
        {"stopped_by", report.stopped_by == BatchStop::none ? Json(nullptr) : Json(name(report.stopped_by))},
        {"seconds", report.seconds},
        {"warnings", report.warnings},
        {"counts",
         {{"baked", count(counts, AssetStatus::baked)},
          {"up_to_date", count(counts, AssetStatus::up_to_date)},
          {"failed", count(counts, AssetStatus::failed)},
          {"not_started", count(counts, AssetStatus::not_started)}}},
        {"assets", std::move(assets)},
    };
}

std::string batch_text(const BatchReport& report) {
    std::string text = counts_text(report);
    std::size_t listed = 0, unlisted = 0;
    for (std::size_t i = 0; i < report.assets.size(); ++i) {
        const AssetResult& result = report.results[i];
        if (report.arguments.dry_run && result.status == AssetStatus::baked)
            text += "  " + pad_right(name(result.reason), 8) + one_line(report.assets[i].name) + "\n";
        if (result.status != AssetStatus::failed) continue;
        if (++listed > most_failures_listed)
            ++unlisted;
        else
            text += "  failed  exit " + std::to_string(int(result.exit_code)) + ": " +
                    one_line(result.error) + "\n";
    }
    if (unlisted > 0)
        text += "  and " + std::to_string(unlisted) + " more that failed; --report names them\n";
    std::uint64_t read = 0, written = 0;
    for (const AssetResult& result : report.results) {
        if (result.status != AssetStatus::baked) continue;
        read += result.facts.source_bytes;
        written += result.facts.bytes;
    }
    if (report.arguments.dry_run) return text;
    text += "  " + fixed(report.seconds, 2) + " s";
    if (written > 0) text += ", " + byte_count(read) + " of sources into " + byte_count(written) + " of maps";
    text += "\n";
    return text;
}

std::string one_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        // Up to what a line does not bear: a byte that is not UTF-8, then among what is, a control character.
        std::string_view good = text.substr(0, container::find_utf8_error(text));
        const auto control = std::find_if(good.begin(), good.end(), [](char c) {
            return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        });
        good = good.substr(0, std::size_t(control - good.begin()));
        line += good;
        text.remove_prefix(good.size());
        if (text.empty()) break;
        line += text[0] == '\n' ? std::string("\\n") : "\\x" + hexadecimal(text.substr(0, 1));
        text.remove_prefix(1);
    }
    return line;
}

std::string signal_name(int number) {
    constexpr std::array<std::pair<int, const char*>, 13> names{{{SIGSEGV, "SIGSEGV"},
                                                                 {SIGABRT, "SIGABRT"},
                                                                 {SIGBUS, "SIGBUS"},
                                                                 {SIGFPE, "SIGFPE"},
                                                                 {SIGILL, "SIGILL"},
                                                                 {SIGKILL, "SIGKILL"},
                                                                 {SIGTERM, "SIGTERM"},
                                                                 {SIGINT, "SIGINT"},
                                                                 {SIGHUP, "SIGHUP"},
                                                                 {SIGPIPE, "SIGPIPE"},
                                                                 {SIGTRAP, "SIGTRAP"},
                                                                 {SIGXCPU, "SIGXCPU"},
                                                                 {SIGSYS, "SIGSYS"}}};
    for (const auto& [known, text] : names)
        if (known == number) return text;
    return "signal " + std::to_string(number);
}

} // namespace spa::tools
