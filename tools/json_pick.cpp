// SPDX-License-Identifier: Apache-2.0
#include "json_pick.h"

#include "text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace spa::tools {

namespace {

using Json = PickedJson;

constexpr std::size_t most_settings = 40;
constexpr std::uint64_t exact_in_double = std::uint64_t(1) << 53U;

std::string plain_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return significant(value.get<double>(), 6);
    return value.dump();
}

} // namespace

const Json& pick(const Json& json, const char* key) {
    static const Json none;
    if (!json.is_object()) return none;
    const auto found = json.find(key);
    return found == json.end() ? none : *found;
}

std::string cut_text(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "\u2026";
}

Json pick_text(const Json& json, const char* key, std::size_t most) {
    const Json& value = pick(json, key);
    return value.is_string() ? Json(cut_text(value.get_ref<const std::string&>(), most)) : Json(nullptr);
}

Json pick_measure(const Json& json, const char* key, double highest) {
    const Json& value = pick(json, key);
    if (!value.is_number()) return nullptr;
    const double number = value.get<double>();
    return number >= 0 && number <= highest ? Json(number + 0.0) : Json(nullptr); // -0 is 0
}

Json pick_count(const Json& json, const char* key) {
    const Json& value = pick(json, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > exact_in_double) return nullptr;
    return value;
}

Json pick_flag(const Json& json, const char* key) {
    const Json& value = pick(json, key);
    return value.is_boolean() ? value : Json(nullptr);
}

Json pick_texts(const Json& json, const char* key, std::size_t most) {
    Json texts = Json::array();
    const Json& values = pick(json, key);
    if (!values.is_array()) return texts;
    for (const Json& value : values) {
        if (texts.size() == most) break;
        if (value.is_string()) texts.push_back(cut_text(value.get_ref<const std::string&>(), 1000));
    }
    return texts;
}

Json pick_settings(const Json& json, const char* key) {
    const Json& values = pick(json, key);
    if (!values.is_object()) return nullptr;
    Json settings = Json::object();
    for (const auto& [name, value] : values.items()) {
        if (settings.size() == most_settings) break;
        if (value.is_string() || value.is_number() || value.is_boolean())
            settings[cut_text(name, 100)] = cut_text(plain_text(value), 200);
    }
    return settings;
}

} // namespace spa::tools
