// SPDX-License-Identifier: Apache-2.0
#include "up_to_date.h"

#include "bake_key.h"
#include "text.h"

#include "../formats/container/checksum.h"
#include "../formats/container/reader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fcntl.h>
#include <optional>
#include <span>
#include <sys/xattr.h>
#include <unistd.h>
#include <vector>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using import::FileState;

constexpr const char* attribute = "user.spa.sources";
constexpr std::int64_t nanoseconds = 1'000'000'000;
// Times of file systems can be as coarse as two seconds (FAT): a file that changed less than this before it
// was read can change once more and show the same time.
constexpr std::int64_t coarsest_time = 2 * nanoseconds;

std::int64_t in_nanoseconds(const std::timespec& time) { return time.tv_sec * nanoseconds + time.tv_nsec; }

std::timespec now() {
    std::timespec time{};
    clock_gettime(CLOCK_REALTIME, &time);
    return time;
}

// Of a map's metadata, as far as they say what it was made from.
struct Recorded {
    std::string key;
    Json files, missing;
    Json request; // the options as they were asked for
    std::string version;
    Json facts; // all of the metadata
};

const Json* member(const Json& json, const char* key, Json::value_t type) {
    if (!json.is_object()) return nullptr;
    const auto found = json.find(key);
    return found != json.end() && found->type() == type ? &*found : nullptr;
}

std::optional<Recorded> parse_recorded(const std::string& metadata) {
    Json json = Json::parse(metadata, nullptr, false);
    const Json* key = member(json, "key", Json::value_t::string);
    const Json* source = member(json, "source", Json::value_t::object);
    // Of a search what it was given; else all options.
    const Json* request = member(json, "request", Json::value_t::object);
    if (request == nullptr) request = member(json, "options", Json::value_t::object);
    const Json* generator = member(json, "generator", Json::value_t::object);
    if (key == nullptr || source == nullptr || request == nullptr || generator == nullptr) return {};
    const Json* files = member(*source, "files", Json::value_t::array);
    const Json* missing = member(*source, "missing", Json::value_t::array);
    const Json* version = member(*generator, "version", Json::value_t::string);
    if (files == nullptr || files->empty() || missing == nullptr || version == nullptr) return {};
    Recorded recorded{*key, *files, *missing, *request, *version, {}};
    if (bake_key(recorded.files, recorded.missing, recorded.request, recorded.version) != recorded.key)
        return {};
    recorded.facts = std::move(json);
    return recorded;
}

std::uint64_t number_of(const Json& json, const char* key) {
    const auto found = json.is_object() ? json.find(key) : json.end();
    return found != json.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

// A source in the asset's folder; none for a name that leads out of it, as no bake writes.
std::optional<fs::path> source_path(const fs::path& asset, const Json& entry) {
    const fs::path name = name_of(entry);
    if (name.empty() || name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end() ||
        name.string().find('\0') != std::string::npos)
        return {};
    return asset.parent_path() / name;
}

struct Source {
    fs::path path;
    std::string hash; // recorded
    FileState state;  // on disk
};

// Whether a file is there that an OBJ file takes for the missing one, and that is not recorded.
bool has_new_substitute(const fs::path& folder, const std::string& missing, const Recorded& recorded) {
    const std::optional<std::string> found = import::find_in_any_case(folder, missing);
    std::error_code error;
    return found && fs::exists(folder / *found, error) &&
           std::none_of(recorded.files.begin(), recorded.files.end(),
                        [&](const Json& entry) { return name_of(entry) == *found; });
}

// The recorded files as they are on disk; none if one is gone or has another size, or if one that was missing
// is there.
std::optional<std::vector<Source>> find_sources(const Recorded& recorded, const fs::path& asset) {
    if (name_of(recorded.files.front()) != asset.filename().string()) return {};
    std::vector<Source> sources;
    for (const Json& entry : recorded.files) {
        const std::optional<fs::path> path = source_path(asset, entry);
        const std::optional<FileState> state = path ? import::file_state(*path) : std::nullopt;
        const Json* hash = member(entry, "xxh3", Json::value_t::string);
        if (!state || hash == nullptr || state->size != number_of(entry, "bytes")) return {};
        sources.push_back({*path, *hash, *state});
    }
    const Json* const format = member(recorded.facts["source"], "format", Json::value_t::string);
    const bool in_any_case = format != nullptr && *format == "OBJ";
    for (const Json& entry : recorded.missing) {
        const std::optional<fs::path> path = source_path(asset, entry);
        std::error_code error;
        if (!path || fs::exists(*path, error)) return {};
        if (in_any_case && has_new_substitute(asset.parent_path(), name_of(entry), recorded)) return {};
    }
    return sources;
}

// The device is left out: it is another number after the next mount.
std::string stamp(const std::string& key, const std::vector<FileState>& states) {
    std::string text = key;
    for (const FileState& state : states)
        for (const auto value :
             {std::int64_t(state.inode), std::int64_t(state.size), state.mtime_ns, state.ctime_ns})
            text += " " + std::to_string(value);
    return hex64(container::checksum(std::as_bytes(std::span(text))));
}

std::string read_attribute(const fs::path& path) {
    std::array<char, 64> value{};
    const ssize_t length = getxattr(path.c_str(), attribute, value.data(), value.size());
    return length > 0 ? std::string(value.data(), std::size_t(length)) : std::string();
}

void remember(const fs::path& output, const std::string& key, const std::vector<FileState>& states,
              std::timespec started) {
    for (const FileState& state : states)
        if (std::max(state.mtime_ns, state.ctime_ns) > in_nanoseconds(started) - coarsest_time) return;
    const std::string value = stamp(key, states);
    static_cast<void>(setxattr(output.c_str(), attribute, value.data(), value.size(), 0));
}

// Empty if it cannot be read to its end or changes meanwhile.
std::string hash_of(const Source& source) {
    const int descriptor = open(source.path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return {};
    container::RunningChecksum sum;
    std::vector<std::byte> buffer(std::size_t(1) << 18U);
    ssize_t count = 0;
    std::uint64_t total = 0;
    while (total <= source.state.size && (count = read(descriptor, buffer.data(), buffer.size())) > 0) {
        sum.add(std::span(buffer).first(std::size_t(count)));
        total += std::uint64_t(count);
    }
    close(descriptor);
    return count == 0 && total == source.state.size && import::file_state(source.path) == source.state
               ? hex64(sum.value())
               : std::string();
}

MapFacts facts_of(const Recorded& recorded, const fs::path& output) {
    MapFacts facts;
    for (const Json& file : recorded.files) facts.source_bytes += number_of(file, "bytes");
    facts.triangles = number_of(recorded.facts["source"], "triangles");
    if (recorded.facts.contains("options")) facts.options = recorded.facts["options"].dump();
    if (recorded.facts.contains("figures")) facts.figures = recorded.facts["figures"].dump();
    std::error_code error;
    facts.bytes = fs::file_size(output, error);
    return facts;
}

} // namespace

const char* name(BakeReason reason) {
    switch (reason) {
    case BakeReason::first: return "new";
    case BakeReason::sources: return "sources";
    case BakeReason::options: return "options";
    case BakeReason::version: return "version";
    case BakeReason::damaged: return "damaged";
    case BakeReason::forced: return "forced";
    case BakeReason::none: break;
    }
    return "";
}

MapState judge_map(const fs::path& output, const fs::path& path, const BakeSettings& settings,
                   std::uint64_t read_at_most) {
    const auto stale = [](BakeReason reason) { return MapState{Freshness::stale, reason, {}}; };
    std::error_code error;
    if (!fs::exists(fs::symlink_status(output, error))) return stale(BakeReason::first);
    // Opening a pipe would wait for somebody to write.
    if (!fs::is_regular_file(output, error)) return stale(BakeReason::damaged);
    std::string metadata;
    if (!container::read_metadata(output.string(), metadata).ok()) return stale(BakeReason::damaged);
    const std::optional<Recorded> recorded = parse_recorded(metadata);
    if (!recorded) return stale(BakeReason::damaged);
    if (recorded->version != SPA_VERSION) return stale(BakeReason::version);
    if (recorded->request != request_json(settings)) return stale(BakeReason::options);

    const std::timespec started = now();
    const std::optional<std::vector<Source>> sources = find_sources(*recorded, path);
    if (!sources) return stale(BakeReason::sources);
    std::vector<FileState> states;
    std::uint64_t bytes = 0;
    for (const Source& source : *sources) {
        states.push_back(source.state);
        bytes += source.state.size;
    }
    MapState current{Freshness::current, BakeReason::none, facts_of(*recorded, output)};
    if (read_attribute(output) == stamp(recorded->key, states)) return current;
    if (bytes > read_at_most) return {Freshness::unknown, BakeReason::none, {}};
    for (const Source& source : *sources)
        if (hash_of(source) != source.hash) return stale(BakeReason::sources);
    remember(output, recorded->key, states, started);
    return current;
}

void remember_sources(const fs::path& output, const import::Report& report, const std::string& key,
                      std::timespec started) {
    std::vector<FileState> states;
    for (const import::SourceFile& file : report.files) states.push_back(file.state);
    remember(output, key, states, started);
}

} // namespace spa::tools
