// SPDX-License-Identifier: Apache-2.0
#include "plan_page.h"

#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* head =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
    "'unsafe-inline'\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Plan of a scene</title>\n<style>\n"
    ":root { color-scheme: light dark }\n"
    "body { font: 14px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 90em; padding: 0 1em }\n"
    "table { border-collapse: collapse; width: 100% }\n"
    "th, td { padding: .25em .6em; text-align: left; vertical-align: top; border-bottom: 1px solid #8884 }\n"
    "td.n, th.n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums }\n"
    "td.bars { min-width: 12em }\n"
    ".bar { height: .55em; margin: .2em 0; border-radius: 2px }\n"
    ".t { background: #b0523a } .p { background: #2f7fb8 }\n"
    "tr.drop td { opacity: .6 }\n"
    "dl { display: grid; grid-template-columns: max-content 1fr; gap: .2em 1.2em } dd { margin: 0 }\n"
    "</style>\n</head>\n<body>\n";

// Text of the plan as text of the page. What is not UTF-8 has become U+FFFD on the way through JSON.
std::string escaped(const std::string& text) {
    const std::string dumped = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string result;
    for (const char c : Json::parse(dumped).get<std::string>()) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

std::uint64_t planned_bytes(const Json& object) {
    if (object["decision"] == "triangles") return object["bytes_triangles"];
    return object["expected"]["bytes"];
}

// Bytes from 1 KiB to 1 GiB as a length, by their logarithm.
std::string bar(const char* kind, std::uint64_t bytes) {
    const double share = bytes == 0 ? 0 : std::clamp((std::log2(double(bytes)) - 8) / 22, 0.01, 1.0);
    return std::string("<div class=\"bar ") + kind + "\" style=\"width:" + fixed(share * 100, 1) +
           "%\"></div>";
}

std::string cell(const std::string& text) { return "<td class=\"n\">" + text + "</td>"; }

std::string decision_text(const Json& object) {
    std::string text = object["decision"];
    if (text != "map") return text;
    const Json& settings = object["settings"];
    text += " " + settings["size"].get<std::string>() + ", layers " +
            std::to_string(settings["layers"].get<unsigned>());
    return object["same_as"].is_null() ? text : text + " (shared)";
}

std::string row(const Json& object) {
    const Json& expected = object["expected"];
    const std::uint64_t planned = planned_bytes(object), triangles = object["bytes_triangles"];
    std::string text = "<tr class=\"" + object["decision"].get<std::string>() + "\"><td>";
    text += escaped(object["name"]) + "</td>";
    text += cell(std::to_string(object["triangles"].get<std::uint64_t>()));
    text += cell(fixed(object["views"]["ray_share"].get<double>() * 100, 2));
    text += cell(object["tolerance"].is_null() ? "-" : significant(object["tolerance"], 2));
    text += "<td>" + decision_text(object) + "</td>";
    text += cell(byte_count(planned));
    text += cell(byte_count(triangles));
    text += "<td class=\"bars\">" + bar("p", planned) + bar("t", triangles) + "</td>";
    text += cell(expected.is_null() ? "0" : significant(expected["image_error"], 2));
    return text + "<td>" + escaped(object["why"]) + "</td></tr>\n";
}

std::string sums(const Json& plan) {
    const Json& expected = plan["expected"];
    std::string text = "<dl>\n";
    const auto line = [&text](const std::string& label, const std::string& value) {
        text += "<dt>" + label + "</dt><dd>" + value + "</dd>\n";
    };
    const auto sum = [&expected](const char* bytes, const char* error) {
        return byte_count(expected[bytes]) + ", image error " + significant(expected[error], 2);
    };
    line("The plan", sum("bytes", "image_error"));
    line("All triangles", byte_count(expected["bytes_triangles"]));
    line("One size for what is a map",
         std::to_string(expected["one_size_of_maps"].get<unsigned>()) +
             " cells: " + sum("bytes_one_size_of_maps", "image_error_one_size_of_maps"));
    line("One size for everything", std::to_string(plan["one_size"].get<unsigned>()) +
                                        " cells: " + sum("bytes_one_size", "image_error_one_size"));
    return text + "</dl>\n";
}

} // namespace

std::string plan_page(const Json& plan) {
    std::vector<const Json*> order;
    for (const Json& object : plan["objects"]) order.push_back(&object);
    std::stable_sort(order.begin(), order.end(),
                     [](const Json* a, const Json* b) { return planned_bytes(*a) > planned_bytes(*b); });
    std::string text = head;
    text += "<h1>Plan of " + escaped(plan["scene"]["path"]) + "</h1>\n";
    text += sums(plan);
    text += "<p>Bars: bytes as planned (blue) and as triangles (red), by their logarithm.</p>\n<table>\n"
            "<tr><th>Object</th><th class=\"n\">Triangles</th><th class=\"n\">Rays %</th>"
            "<th class=\"n\">Tolerance</th><th>Plan</th><th class=\"n\">Bytes</th>"
            "<th class=\"n\">As triangles</th><th></th><th class=\"n\">Image error</th><th>Why</th></tr>\n";
    for (const Json* object : order) text += row(*object);
    return text + "</table>\n</body>\n</html>\n";
}

} // namespace spa::tools
