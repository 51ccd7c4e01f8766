// SPDX-License-Identifier: Apache-2.0
#include "bake_key.h"

#include "text.h"

#include "../formats/container/checksum.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <span>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// What JSON cannot hold is replaced when it is written, so that the name would be another one.
Json name_json(const std::string& name) {
    Json entry = {{"name", name}};
    const Json as_read = Json::parse(dump(entry));
    if (as_read["name"].get_ref<const std::string&>() != name) entry["name_hex"] = hexadecimal(name);
    return entry;
}

// Empty for what is no hexadecimal text.
std::string from_hexadecimal(const std::string& text) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        unsigned value = 0;
        const auto [end, error] = std::from_chars(text.data() + i, text.data() + i + 2, value, 16);
        if (error != std::errc{} || end != text.data() + i + 2) return {};
        bytes += char(value);
    }
    return bytes;
}

std::string text_of(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

} // namespace

Json files_json(const std::vector<import::SourceFile>& files) {
    Json json = Json::array();
    for (const import::SourceFile& file : files) {
        Json entry = name_json(file.name);
        entry["bytes"] = file.bytes;
        entry["xxh3"] = hex64(file.xxh3);
        json.push_back(std::move(entry));
    }
    return json;
}

Json missing_json(const std::vector<std::string>& names) {
    Json json = Json::array();
    for (const std::string& name : names) json.push_back(name_json(name));
    return json;
}

std::string name_of(const Json& entry) {
    if (!entry.is_object()) return {};
    return entry.contains("name_hex") ? from_hexadecimal(text_of(entry, "name_hex")) : text_of(entry, "name");
}

std::string bake_key(const Json& files, const Json& missing, const Json& options,
                     const std::string& version) {
    const std::string text =
        dump({{"files", files}, {"missing", missing}, {"options", options}, {"version", version}});
    return hex64(container::checksum(std::as_bytes(std::span(text))));
}

} // namespace spa::tools
