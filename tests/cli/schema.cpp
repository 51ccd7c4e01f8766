// SPDX-License-Identifier: Apache-2.0
#include "schema.h"

#include "process.h"

#include <algorithm>
#include <map>
#include <regex>

namespace spa::test {

namespace {

using nlohmann::json;

bool has_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "boolean") return value.is_boolean();
    return type == "null" && value.is_null();
}

std::string check_type(const json& types, const json& value, const std::string& where) {
    const json list = types.is_array() ? types : json::array({types});
    const bool ok =
        std::any_of(list.begin(), list.end(), [&](const json& type) { return has_type(value, type); });
    return ok ? "" : where + ": is not of type " + types.dump();
}

std::string check_properties(const json& schema, const json& value, const std::string& where) {
    if (!value.is_object()) return "";
    const json properties = schema.value("properties", json::object());
    for (const auto& [key, member] : value.items()) {
        if (!properties.contains(key)) {
            if (schema.value("additionalProperties", true)) continue;
            return where + ": '" + key + "' is not in the schema";
        }
        std::string error = schema_error(properties[key], member, where + "." + key);
        if (!error.empty()) return error;
    }
    return "";
}

std::string check_required(const json& names, const json& value, const std::string& where) {
    if (!value.is_object()) return "";
    for (const json& name : names)
        if (!value.contains(name.get<std::string>())) return where + ": lacks " + name.dump();
    return "";
}

std::string check_items(const json& items, const json& value, const std::string& where) {
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
        std::string error = schema_error(items, value[i], where + "[" + std::to_string(i) + "]");
        if (!error.empty()) return error;
    }
    return "";
}

std::string check_one_of(const json& schemas, const json& value, const std::string& where) {
    std::string errors;
    int matches = 0;
    for (const json& schema : schemas) {
        const std::string error = schema_error(schema, value, where);
        matches += error.empty() ? 1 : 0;
        errors += (errors.empty() ? "" : " | ") + error;
    }
    return matches == 1 ? "" : where + ": matches " + std::to_string(matches) + " of oneOf: " + errors;
}

std::string check_bound(const std::string& keyword, const json& bound, const json& value,
                        const std::string& where) {
    bool ok = true;
    if (keyword == "minItems" && value.is_array()) ok = value.size() >= bound.get<std::size_t>();
    if (keyword == "maxItems" && value.is_array()) ok = value.size() <= bound.get<std::size_t>();
    if (value.is_number()) {
        const double number = value.get<double>(), limit = bound.get<double>();
        if (keyword == "minimum") ok = number >= limit;
        if (keyword == "maximum") ok = number <= limit;
        if (keyword == "exclusiveMinimum") ok = number > limit;
    }
    return ok ? "" : where + ": " + value.dump() + " breaks " + keyword + " " + bound.dump();
}

std::string check_keyword(const std::string& keyword, const json& schema, const json& value,
                          const std::string& where) {
    const json& rule = schema[keyword];
    if (keyword == "$schema" || keyword == "title" || keyword == "description" ||
        keyword == "additionalProperties")
        return "";
    if (keyword == "type") return check_type(rule, value, where);
    if (keyword == "properties") return check_properties(schema, value, where);
    if (keyword == "required") return check_required(rule, value, where);
    if (keyword == "items") return check_items(rule, value, where);
    if (keyword == "oneOf") return check_one_of(rule, value, where);
    if (keyword == "enum")
        return std::find(rule.begin(), rule.end(), value) != rule.end()
                   ? ""
                   : where + ": " + value.dump() + " is not one of " + rule.dump();
    if (keyword == "pattern")
        return !value.is_string() ||
                       std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()))
                   ? ""
                   : where + ": " + value.dump() + " does not match " + rule.dump();
    if (keyword == "minItems" || keyword == "maxItems" || keyword == "minimum" || keyword == "maximum" ||
        keyword == "exclusiveMinimum")
        return check_bound(keyword, rule, value, where);
    return where + ": the schema uses '" + keyword + "', which this checker does not know";
}

} // namespace

std::string schema_error(const json& schema, const json& value, const std::string& where) {
    for (const auto& [keyword, rule] : schema.items()) {
        std::string error = check_keyword(keyword, schema, value, where);
        if (!error.empty()) return error;
    }
    return "";
}

json load_schema(const std::string& verb) {
    return json::parse(read_file(std::string(SPA_SCHEMAS_DIR) + "/" + verb + ".schema.json"));
}

} // namespace spa::test
