// SPDX-License-Identifier: Apache-2.0
#include "batch_child.h"

#include "bake_file.h"
#include "failure.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "picture.h"
#include "thumbnail.h"
#include "validate_report.h"

#include "../libspa/bake/crossings.h"

#include <nlohmann/json.hpp>

#include <limits>
#include <new>
#include <span>

namespace spa::tools {

namespace {

using Json = nlohmann::json;

constexpr std::uint32_t picture_size = 96;

void bake(const ChildTask& task, AssetResult& result) {
    BakeArguments arguments;
    arguments.input = task.asset.path;
    arguments.output = task.asset.output;
    arguments.settings = task.settings;
    arguments.make_folders = true;
    arguments.follow_links = task.follow_links;
    arguments.quiet = true;
    std::timespec started{};
    clock_gettime(CLOCK_REALTIME, &started);
    const BakedFile baked = bake_file(arguments);
    const BakeFacts facts = baked.facts(arguments);
    remember_sources(arguments.output, baked.source.asset.report, bake_key(facts), started);
    result.status = AssetStatus::baked;
    result.warnings = warnings(facts);
    for (const import::SourceFile& file : baked.source.asset.report.files)
        result.facts.source_bytes += file.bytes;
    result.facts.triangles = baked.report.triangles;
    result.facts.bytes = baked.bytes.size();
    if (baked.measurement) result.facts.figures = figures_json(*baked.measurement).dump();
}

void judge_and_bake(const ChildTask& task, AssetResult& result) {
    result.reason = task.reason;
    if (task.reason == BakeReason::none) {
        const MapState state = judge_map(task.asset.output, task.asset.path, task.settings,
                                         std::numeric_limits<std::uint64_t>::max());
        result.reason = state.reason;
        result.facts = state.facts;
        result.status = state.freshness == Freshness::current ? AssetStatus::up_to_date : AssetStatus::baked;
        if (result.status == AssetStatus::up_to_date) return;
    }
    if (task.dry_run)
        result.status = AssetStatus::baked;
    else
        bake(task, result);
}

// place: what the message does not say itself.
void fail(AssetResult& result, const std::string& place = "") {
    const Failure failure = current_failure();
    result.status = AssetStatus::failed;
    result.exit_code = failure.code;
    result.error = place + failure.message;
}

// A picture that cannot be made is not worth failing for.
std::vector<std::byte> picture_of(const std::filesystem::path& map) {
    try {
        return encode_png(thumbnail(open_map(map.string()).map(), picture_size));
    } catch (const std::exception&) {
        return {};
    }
}

} // namespace

std::string run_child(const ChildTask& task) {
    ChildOutcome outcome;
    AssetResult& result = outcome.result;
    const std::string place = task.asset.path.string() + ": ";
    try {
        if (!task.is_current) judge_and_bake(task, result);
    } catch (const bake::Cancelled&) {
        outcome.interrupt = interrupt_signal();
    } catch (const OutputError& error) {
        outcome.output_failed = error.concerns_all();
        fail(result);
    } catch (const Error&) {
        fail(result);
    } catch (const std::bad_alloc&) {
        outcome.out_of_memory = true;
        fail(result, place);
    } catch (...) {
        fail(result, place);
    }
    const bool has_map = task.is_current || result.status == AssetStatus::up_to_date ||
                         (result.status == AssetStatus::baked && !task.dry_run);
    if (task.wants_picture && has_map) outcome.picture = picture_of(task.asset.output);
    const Json json = {
        {"status", result.status},
        {"reason", result.reason},
        {"exit_code", result.exit_code},
        {"error", result.error},
        {"warnings", result.warnings},
        {"source_bytes", result.facts.source_bytes},
        {"triangles", result.facts.triangles},
        {"bytes", result.facts.bytes},
        {"figures", result.facts.figures},
        {"interrupt", outcome.interrupt},
        {"out_of_memory", outcome.out_of_memory},
        {"output_failed", outcome.output_failed},
    };
    // Messages hold file names, which may be any bytes: CBOR takes them as they are.
    const std::vector<std::uint8_t> head = Json::to_cbor(json);
    return std::to_string(head.size()) + "\n" + std::string(head.begin(), head.end()) +
           std::string(reinterpret_cast<const char*>(outcome.picture.data()), outcome.picture.size());
}

ChildOutcome parse_outcome(const std::string& bytes) {
    ChildOutcome outcome;
    AssetResult& result = outcome.result;
    try {
        const std::size_t begin = bytes.find('\n') + 1;
        const std::size_t length = std::stoul(bytes);
        const Json json = Json::from_cbor(bytes.substr(begin, length));
        json.at("status").get_to(result.status);
        json.at("reason").get_to(result.reason);
        json.at("exit_code").get_to(result.exit_code);
        json.at("error").get_to(result.error);
        json.at("warnings").get_to(result.warnings);
        json.at("source_bytes").get_to(result.facts.source_bytes);
        json.at("triangles").get_to(result.facts.triangles);
        json.at("bytes").get_to(result.facts.bytes);
        json.at("figures").get_to(result.facts.figures);
        json.at("interrupt").get_to(outcome.interrupt);
        json.at("out_of_memory").get_to(outcome.out_of_memory);
        json.at("output_failed").get_to(outcome.output_failed);
        const auto picture = std::as_bytes(std::span(bytes).subspan(begin + length));
        outcome.picture.assign(picture.begin(), picture.end());
    } catch (const std::exception&) {
        result = {};
        result.status = AssetStatus::failed;
        result.exit_code = ExitCode::internal;
        result.error = "its process ended without a result";
    }
    return outcome;
}

} // namespace spa::tools
