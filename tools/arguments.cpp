// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>

namespace spa::tools {

namespace {
constexpr std::uint32_t max_threads = 1024;
} // namespace

CLI::Option* add_text(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& description, const std::function<void(const std::string&)>& set) {
    return app.add_option_function<std::string>(names, set, description)->type_name(value_name);
}

CLI::Option* add_path(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& description, std::filesystem::path& path) {
    return add_text(app, names, value_name, description, [names, &path](const std::string& text) {
        if (text.empty()) throw Error(ExitCode::usage, names + ": the path is empty");
        path = text;
    });
}

std::uint32_t parse_number(const std::string& option, const std::string& text, std::uint32_t lowest,
                           std::uint32_t highest) {
    std::uint32_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stopped != end || value < lowest || value > highest)
        throw Error(ExitCode::usage, option + ": '" + text + "' is not a whole number from " +
                                         std::to_string(lowest) + " to " + std::to_string(highest));
    return value;
}

double parse_measure(const std::string& option, const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stopped != end || !(value >= 0) || !std::isfinite(value))
        throw Error(ExitCode::usage, option + ": '" + text + "' is not a number of 0 or more");
    return value + 0.0; // -0 is 0
}

const char* name(ReportFormat format) { return format == ReportFormat::json ? "json" : "text"; }

CLI::Option* add_report_format(CLI::App& app, ReportFormat& format) {
    return add_choice<ReportFormat>(app, "--format", {ReportFormat::text, ReportFormat::json},
                                    "Report on standard output as text for people or as JSON",
                                    [&format](ReportFormat given) { format = given; })
        ->default_str("text");
}

void add_threads(CLI::App& app, const std::string& description, unsigned& threads) {
    add_text(
        app, "--threads", "T", description + ". The bytes written do not depend on it",
        [&threads](const std::string& text) { threads = parse_number("--threads", text, 0, max_threads); })
        ->default_str(std::to_string(threads));
}

void add_follow_links(CLI::App& app, bool& follow_links) {
    app.add_flag(
        "--follow-links", follow_links,
        "Let an asset refer, through symbolic links, to files outside its folder. Not for assets that "
        "come from strangers");
}

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace spa::tools
