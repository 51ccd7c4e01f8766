// SPDX-License-Identifier: Apache-2.0
#include "report_text.h"

#include "batch_report.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string number_or_dash(const Json& value, const auto& text) {
    return value.is_number() ? text(value.get<double>()) : "-";
}

std::string errors_cell(const Json& errors, const char* key, bool share) {
    if (errors.is_null()) return "-";
    return number_or_dash(errors[key],
                          [&](double value) { return share ? percent(value, 3) : significant(value, 3); });
}

std::string ns_cell(const Json& speed, const char* what) {
    if (speed.is_null() || speed[what].is_null()) return "-";
    return number_or_dash(speed[what]["ns"], [](double ns) { return fixed(ns, 1); });
}

std::string shape_cell(const Json& shape) {
    return shape["depth"]["size"].get<std::string>() + "x" + std::to_string(shape["layers"].get<int>());
}

using Row = std::array<std::string, 8>;

Row map_row(const Json& map) {
    const Json& errors = map["errors"];
    return {one_line(map["name"].get_ref<const std::string&>()),
            shape_cell(map["shape"]),
            byte_count(map["bytes"].get<std::uint64_t>()),
            ns_cell(map["speed"], "map"),
            ns_cell(map["speed"], "triangles"),
            errors_cell(errors, "false_hits", true),
            errors_cell(errors, "missed_hits", true),
            errors_cell(errors, "mean_distance", false)};
}

std::string table(const std::vector<Row>& rows) {
    std::array<std::size_t, 8> width{};
    for (const Row& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    std::string text;
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += i == 0 ? pad_right(row[i], width[i]) : "  " + pad_left(row[i], width[i]);
        text += line + "\n";
    }
    return text;
}

std::string plan_text(const Json& plan) {
    std::map<std::string, std::size_t> decisions;
    for (const Json& object : plan["objects"])
        ++decisions[object["decision"].is_string() ? object["decision"].get<std::string>() : "undecided"];
    std::string text = one_line(plan["name"].get_ref<const std::string&>()) + ": ";
    if (plan["error"].is_string()) return text + "not read\n";
    text += std::to_string(plan["objects"].size()) + " objects";
    for (const auto& [decision, count] : decisions)
        text += ", " + std::to_string(count) + " " + one_line(decision);
    return text + "\n";
}

} // namespace

std::string report_text(const Json& report) {
    std::vector<Row> rows{
        {"map", "size", "bytes", "ns", "triangles ns", "false hits", "missed", "mean dt R"}};
    std::string text;
    for (const Json& map : report["maps"])
        if (map["error"].is_null()) rows.push_back(map_row(map));
    if (rows.size() > 1) text += table(rows);
    for (const Json& plan : report["plans"]) text += plan_text(plan);
    for (const Json& map : report["maps"])
        if (!map["error"].is_null())
            text += "not read: " + one_line(map["error"].get_ref<const std::string&>()) + "\n";
    return text;
}

} // namespace spa::tools
